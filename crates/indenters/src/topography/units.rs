//! Units of length as files and people write them.

/// Metres in a unit of length; `None` if it is none. The names are those of instruments, in small letters or as SI writes
/// them, and `æm` is what MS-DOS made of `µm`.
pub(super) fn metres(unit: &str) -> Option<f64> {
    let unit = unit.trim_matches(|end: char| end.is_whitespace() || end == '\0');
    Some(match unit {
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

/// A length with a unit, as `10 um`, `1.5e-3mm` or `0,25 µm`, in metres; `None` if it is none.
#[must_use]
pub fn length(text: &str) -> Option<f64> {
    let text = text.trim();
    let is_part = |letter: char| letter.is_ascii_digit() || "+-.,".contains(letter);
    let mut end = text.find(|letter| !is_part(letter))?;
    // An exponent is a part of the number, and not the begin of the unit.
    let exponent = text[end..].strip_prefix(['e', 'E']);
    if let Some(exponent) = exponent.filter(|rest| rest.starts_with(is_part)) {
        let length = exponent.find(|letter| !is_part(letter))?;
        end += 1 + length;
    }
    let number: f64 = text[..end].replace(',', ".").parse().ok()?;
    Some(number * metres(&text[end..])?)
}
