//! Rust source reduced to what the rules look at.

/// The source without the items marked `#[cfg(test)]`.
///
/// Relies on the format that CI checks first: such an item ends with `;` on its own line, or with a line that closes the
/// brace at the indentation of the attribute.
pub(super) fn without_tests(text: &str) -> String {
    let mut kept = String::new();
    let mut lines = text.lines();
    while let Some(line) = lines.next() {
        if line.trim() != "#[cfg(test)]" {
            kept.push_str(line);
            kept.push('\n');
            continue;
        }
        let indentation = &line[..line.len() - line.trim_start().len()];
        let end = format!("{indentation}}}");
        let is_end = |item: &str| item == end || is_whole(item, indentation);
        lines.by_ref().find(|item| is_end(item));
    }
    kept
}

/// Whether an item is on one line.
fn is_whole(line: &str, indentation: &str) -> bool {
    let own = line.strip_prefix(indentation).unwrap_or_default();
    !own.starts_with([' ', '#']) && (own.ends_with(';') || own.ends_with("{}"))
}

/// Words and single punctuation characters, without comments, literals in quotes and white space.
pub(super) fn tokens(text: &str) -> Vec<&str> {
    let mut tokens = Vec::new();
    let mut rest = text;
    while let Some(first) = rest.chars().next() {
        let length = token_length(rest, first);
        let is_code = !first.is_whitespace() && !is_comment(rest) && !starts_literal(rest);
        if is_code {
            tokens.push(&rest[..length]);
        }
        rest = &rest[length..];
    }
    tokens
}

fn token_length(rest: &str, first: char) -> usize {
    if rest.starts_with("//") {
        return rest.find('\n').unwrap_or(rest.len());
    }
    if rest.starts_with("/*") {
        return block_comment_length(rest);
    }
    if let Some(length) = raw_string_length(rest) {
        return length;
    }
    if first == '"' {
        return quoted_length(rest, '"');
    }
    if is_character(rest) {
        return quoted_length(rest, '\'');
    }
    let is_word = |c: char| c.is_alphanumeric() || c == '_';
    if is_word(first) {
        return rest.find(|c| !is_word(c)).unwrap_or(rest.len());
    }
    first.len_utf8()
}

fn is_comment(rest: &str) -> bool {
    rest.starts_with("//") || rest.starts_with("/*")
}

fn starts_literal(rest: &str) -> bool {
    rest.starts_with('"') || is_character(rest) || raw_string_length(rest).is_some()
}

/// `'x'` or `'\n'`, and not a lifetime.
fn is_character(rest: &str) -> bool {
    let mut characters = rest.chars();
    if characters.next() != Some('\'') {
        return false;
    }
    match characters.next() {
        Some('\\') => true,
        Some(_) => characters.next() == Some('\''),
        None => false,
    }
}

/// Length of a literal up to the quote that is not escaped.
fn quoted_length(rest: &str, quote: char) -> usize {
    let mut escaped = false;
    for (at, character) in rest.char_indices().skip(1) {
        if character == quote && !escaped {
            return at + quote.len_utf8();
        }
        escaped = character == '\\' && !escaped;
    }
    rest.len()
}

fn raw_string_length(rest: &str) -> Option<usize> {
    let body = rest.strip_prefix("br").or_else(|| rest.strip_prefix('r'))?;
    let hashes = body.len() - body.trim_start_matches('#').len();
    let start = rest.len() - body.len() + hashes + 1;
    body[hashes..].strip_prefix('"')?;
    let end = format!("\"{}", &body[..hashes]);
    let length = rest[start..].find(&end).map(|at| start + at + end.len());
    Some(length.unwrap_or(rest.len()))
}

fn block_comment_length(rest: &str) -> usize {
    let mut depth = 0_usize;
    let mut at = 0;
    while at < rest.len() {
        if rest[at..].starts_with("/*") {
            depth += 1;
            at += 2;
        } else if rest[at..].starts_with("*/") {
            depth -= 1;
            at += 2;
            if depth == 0 {
                return at;
            }
        } else {
            at += rest[at..].chars().next().map_or(1, char::len_utf8);
        }
    }
    rest.len()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn comments_and_literals_are_no_code() {
        let text = r####"
            // a "comment" with print!
            let /* one /* in */ another */ x: &'a str = "str\"ing"; let q = '"'; let n = '\'';
            let raw = r#"raw " string"#; done
        "####;
        let expected = [
            "let", "x", ":", "&", "'", "a", "str", "=", ";", "let", "q", "=", ";", "let", "n", "=",
            ";", "let", "raw", "=", ";", "done",
        ];
        assert_eq!(tokens(text), expected, "tokens of {text}");
    }

    #[test]
    fn test_items_are_left_out() {
        let text = "fn a() {}\n\n#[cfg(test)]\nmod tests {\n    fn b() {\n    }\n}\n#[cfg(test)]\nmod more;\n\
                    impl A {\n    #[cfg(test)]\n    fn c() {\n    }\n\n    fn d() {}\n}\n";
        let expected = "fn a() {}\n\nimpl A {\n\n    fn d() {}\n}\n";
        assert_eq!(without_tests(text), expected, "of {text}");
    }
}
