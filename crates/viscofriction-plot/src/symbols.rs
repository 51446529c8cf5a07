//! Typesetting of texts: symbols of quantities in italics, with subscripts.
//!
//! "tangential force F_t \[N]" has the symbol F with the subscript t, and units are upright (ISO 80000-1, 2022, Section 7).

/// Part of a text in one style.
#[derive(Debug, Clone, PartialEq, Eq)]
pub(crate) struct Run {
    pub(crate) text: String,
    pub(crate) style: Style,
}

/// Style of a part of a text.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum Style {
    Upright,
    Italic,
    Subscript,
}

/// Text size of a subscript, relative to that of the text.
pub(crate) const SUBSCRIPT_SIZE: f64 = 0.7;
/// Distance of the baseline of a subscript below that of the text, relative to the text size.
pub(crate) const SUBSCRIPT_DROP: f64 = 0.2;

/// Parts of a text in the order in which they are read.
///
/// A symbol is a single Latin letter or a word of Greek letters. After `_` its subscript extends over letters and digits. Text in
/// brackets, and after "=" or a number up to the next comma, contains units and no symbols of one plain letter.
pub(crate) fn runs(text: &str) -> Vec<Run> {
    let mut runs: Vec<Run> = Vec::new();
    let mut push = |part: &str, style: Style| match runs.last_mut() {
        Some(last) if last.style == style => last.text += part,
        _ if part.is_empty() => (),
        _ => runs.push(Run {
            text: part.to_owned(),
            style,
        }),
    };
    let mut at = 0;
    while let Some(first) = text[at..].chars().next() {
        let rest = &text[at..];
        let word = &rest[..length_while(rest, is_letter)];
        if word.is_empty() || !is_symbol(&text[..at], word, &rest[word.len()..]) {
            let length = word.len().max(first.len_utf8());
            push(&rest[..length], Style::Upright);
            at += length;
            continue;
        }
        // Primes lean with their letter, which would cover them otherwise.
        let primes = length_while(&rest[word.len()..], |c| matches!(c, '′' | '″'));
        let symbol = &rest[..word.len() + primes];
        push(symbol, Style::Italic);
        at += symbol.len();
        if let Some(subscript) = subscript_of(&text[at..]) {
            push(subscript, Style::Subscript);
            at += 1 + subscript.len();
        }
    }
    runs
}

/// Length of the longest beginning of a text whose characters all satisfy a condition, in bytes.
fn length_while(text: &str, condition: impl Fn(char) -> bool) -> usize {
    text.find(|character| !condition(character))
        .unwrap_or(text.len())
}

/// True for letters on the baseline; a superscript such as ᵖ is none.
fn is_letter(character: char) -> bool {
    character.is_alphabetic() && !('\u{1d2c}'..='\u{1d6a}').contains(&character)
}

/// True if the character is in the Unicode block of Greek letters.
fn is_greek(character: char) -> bool {
    ('\u{370}'..='\u{3ff}').contains(&character)
}

/// Subscript at the beginning of a text, without its `_`; `None` if there is none.
fn subscript_of(text: &str) -> Option<&str> {
    let subscript = text.strip_prefix('_')?;
    let length = length_while(subscript, char::is_alphanumeric);
    (length > 0).then(|| &subscript[..length])
}

/// True if a word between two other texts is the symbol of a quantity.
fn is_symbol(before: &str, word: &str, after: &str) -> bool {
    let is_single = word.chars().nth(1).is_none();
    let in_brackets = before.matches('[').count() > before.matches(']').count();
    // A key such as "material.x_1" is no quantity.
    let is_part_of_name = before.ends_with(['_', '.', '°']);
    if in_brackets || is_part_of_name {
        return false;
    }
    if word.chars().any(is_greek) {
        return true;
    }
    let is_marked = after.starts_with(['′', '″']) || after.starts_with(is_subscript_digit);
    if is_single && (is_marked || subscript_of(after).is_some()) {
        return true;
    }
    let segment = before.rsplit(',').next().unwrap_or(before);
    let is_unit = segment.contains(|c: char| c == '=' || c.is_ascii_digit());
    let is_article = word == "a" || (word == "A" && before.is_empty());
    let is_operator = word == "d" && after.starts_with(" ln");
    is_single && word != "µ" && !is_unit && !is_article && !is_operator
}

/// True for the digits ₀ to ₉.
fn is_subscript_digit(character: char) -> bool {
    ('₀'..='₉').contains(&character)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn symbols_are_found_among_words_and_units() {
        // Italic parts stand in <>, subscripts in ().
        for (text, expected) in [
            ("tangential force F_t [N]", "tangential force <F>(t) [N]"),
            ("speed v a_T [m/s]", "speed <v> <a>(T) [m/s]"),
            ("friction coefficient μ", "friction coefficient <μ>"),
            ("x [µm]", "<x> [µm]"),
            ("tan δ(Ω)", "tan <δ>(<Ω>)"),
            ("G′ of the series", "<G′> of the series"),
            ("d ln μ per decade of ω", "d ln <μ> per decade of <ω>"),
            ("force over a contact", "force over a contact"),
            ("temperature T = 20 °C", "temperature <T> = 20 °C"),
            (
                "speed v = 0.1 m/s, F = 2 N",
                "speed <v> = 0.1 m/s, <F> = 2 N",
            ),
            ("curvature = 10 1/m", "curvature = 10 1/m"),
            (
                "2/3 of s₁, Kürschner (2014)",
                "2/3 of <s>₁, Kürschner (2014)",
            ),
            ("profile c rᵖ", "profile <c> <r>ᵖ"),
            ("load.x_1", "load.x_1"),
            ("A ball", "A ball"),
            ("10⁻³", "10⁻³"),
        ] {
            let shown = |run: &Run| match run.style {
                Style::Upright => run.text.clone(),
                Style::Italic => format!("<{}>", run.text),
                Style::Subscript => format!("({})", run.text),
            };
            let got: String = runs(text).iter().map(shown).collect();
            assert_eq!(got, expected, "parts of '{text}'");
        }
    }
}
