//! Units of length in their common spellings.

/// Length of a unit, \[m]; `None` if it is no unit of length.
///
/// The spellings are those of instruments; `æm` is `µm` in the wrong code page.
pub(super) fn metres(unit: &str) -> Option<f64> {
    let name = unit.trim_matches(|end: char| end.is_whitespace() || end == '\0');
    Some(match name {
        "m" | "meter" | "metre" | "meters" | "metres" => 1.0,
        "cm" => 1e-2,
        "mm" | "millimeter" | "millimetre" => 1e-3,
        "µm" | "μm" | "um" | "æm" | "micron" | "microns" | "micrometer" | "micrometers"
        | "micrometre" | "micrometres" => 1e-6,
        "nm" | "nanometer" | "nanometers" | "nanometre" | "nanometres" => 1e-9,
        "\u{c5}" | "\u{212b}" | "angstrom" | "Angstrom" => 1e-10,
        "pm" => 1e-12,
        _ => return None,
    })
}

/// A length with a unit, such as `10 um`, `1.5e-3mm` or `0,25 µm`, in metres; `None` if the text is no length.
#[must_use]
pub fn length(text: &str) -> Option<f64> {
    let text = text.trim();
    let is_part = |letter: char| letter.is_ascii_digit() || "+-.,".contains(letter);
    let mut end = text.find(|letter| !is_part(letter))?;
    // An exponent belongs to the number, not to the unit.
    let exponent = text[end..].strip_prefix(['e', 'E']);
    if let Some(exponent) = exponent.filter(|rest| rest.starts_with(is_part)) {
        let length = exponent.find(|letter| !is_part(letter))?;
        end += 1 + length;
    }
    let number: f64 = text[..end].replace(',', ".").parse().ok()?;
    Some(number * metres(&text[end..])?)
}
