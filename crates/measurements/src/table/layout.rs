//! Detection of encoding, separator and decimal mark: from bytes to lines of cells.

use std::borrow::Cow;
use std::cmp::Reverse;
use std::collections::BTreeMap;

use encoding_rs::{GB18030, SHIFT_JIS, UTF_8, WINDOWS_1252};

use super::Vocabulary;

/// Decodes a file in UTF-8, in UTF-16 with a byte-order mark, in GB 18030 or Shift JIS, or else in Windows-1252.
///
/// GB 18030 and Shift JIS are accepted if the text contains Chinese or Japanese names of quantities.
pub(crate) fn text_of<'a>(contents: &'a [u8], vocabulary: &Vocabulary) -> Cow<'a, str> {
    let (text, _, has_errors) = UTF_8.decode(contents);
    if !has_errors {
        return text;
    }
    let encodings = [GB18030, SHIFT_JIS].into_iter();
    let mut texts = encodings.filter_map(|encoding| {
        encoding.decode_without_bom_handling_and_without_replacement(contents)
    });
    let known = texts.find(|text| vocabulary.has_ideographs_in(text));
    known.unwrap_or_else(|| WINDOWS_1252.decode(contents).0)
}

/// Separator of the cells and decimal mark of the numbers of a table.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Layout {
    /// Character between cells.
    separator: char,
    /// `.` or `,`.
    decimal_mark: char,
}

/// Separators and their names, for messages.
const SEPARATORS: [(char, &str); 4] = [
    ('\t', "tabs"),
    (';', "semicolons"),
    (',', "commas"),
    (' ', "blanks"),
];

impl Layout {
    /// Layout in which the most lines agree in their numbers of cells and of numeric cells, at least two.
    ///
    /// Among several it is the one with the fewest other cells, then the first.
    pub(crate) fn of<'a>(lines: impl Iterator<Item = &'a str> + Clone) -> Self {
        let layouts = SEPARATORS.iter().flat_map(|&(separator, _)| {
            ['.', ','].map(|decimal_mark| Self {
                separator,
                decimal_mark,
            })
        });
        let rank = |layout: &Self| {
            let mut counts = BTreeMap::new();
            for line in lines.clone() {
                let cells = layout.cells(line);
                let is_number = |cell: &&&str| layout.number(cell).is_some();
                let numbers = cells.iter().filter(is_number).count();
                let empty = cells.iter().filter(|cell| cell.is_empty()).count();
                if numbers >= 2 {
                    let others = cells.len() - numbers - empty;
                    *counts.entry((others, cells.len(), numbers)).or_insert(0) += 1;
                }
            }
            counts
                .into_iter()
                .map(|((others, ..), lines)| (Reverse(lines), others))
                .min()
                .unwrap_or((Reverse(0), usize::MAX))
        };
        // A text without numbers is refused later, with these separators in the message.
        layouts.min_by_key(rank).unwrap_or(Self {
            separator: ',',
            decimal_mark: '.',
        })
    }

    /// Whether one or more blanks separate the cells.
    pub(crate) const fn is_blank(self) -> bool {
        self.separator == ' '
    }

    /// Name of the separator in the plural, for messages.
    pub(crate) fn separators(self) -> &'static str {
        let mut known = SEPARATORS.iter();
        let found = known.find(|(separator, _)| *separator == self.separator);
        found.map_or("", |(_, name)| name)
    }

    /// Cells of a line, without surrounding blanks and quotes.
    pub(crate) fn cells(self, line: &str) -> Vec<&str> {
        if self.is_blank() {
            return line.split_whitespace().collect();
        }
        // In a cell that begins with a quote a quote is doubled, and opens what it has closed (RFC 4180).
        let [mut in_quotes, mut quoted, mut begins] = [false, false, true];
        let cells = line.split(|character| {
            in_quotes |= character == '"' && begins;
            quoted ^= character == '"' && in_quotes;
            let ends = character == self.separator && !quoted;
            in_quotes &= !ends;
            begins = ends || (begins && character == ' ');
            ends
        });
        cells.map(|cell| unquoted(cell.trim())).collect()
    }

    /// Names in a line, which may be a comment; with blanks as separators, names that contain blanks are two blanks apart.
    pub(crate) fn names(self, line: &str) -> Vec<&str> {
        let unmarked = line.trim_start_matches(COMMENT_MARKS);
        let untagged = tagged(unmarked).map_or(unmarked, |(_, names)| names);
        if self.is_blank() && untagged.trim().contains("  ") {
            let names = untagged.split("  ").map(str::trim);
            return names.filter(|name| !name.is_empty()).collect();
        }
        self.cells(untagged)
    }

    /// The number in a cell, with the decimal mark of the layout; `None` for a text and for a number that is not finite.
    pub(crate) fn number(self, cell: &str) -> Option<f64> {
        let number = match self.decimal_mark {
            '.' => cell.parse().ok(),
            _ if cell.contains('.') || cell.ends_with(',') => None,
            _ => cell.replace(',', ".").parse().ok(),
        };
        number.filter(|number: &f64| number.is_finite())
    }
}

/// A cell without the quotes around it.
fn unquoted(cell: &str) -> &str {
    let rest = cell.strip_prefix('"');
    rest.map_or(cell, |rest| rest.strip_suffix('"').unwrap_or(rest).trim())
}

/// Tag of a comment of JPK with names or units of the columns below it, and the text after the tag.
pub(crate) fn tagged(line: &str) -> Option<(&str, &str)> {
    let (tag, rest) = line.trim_start_matches(COMMENT_MARKS).split_once(':')?;
    let is_known = ["columns", "units"].contains(&tag.trim());
    is_known.then(|| (tag.trim(), rest))
}

/// Characters that begin a comment line, which is not read as data.
const COMMENT_MARKS: [char; 2] = ['#', '%'];

/// True for a line that begins with `#`, `%` or `//`.
pub(crate) fn is_comment(line: &str) -> bool {
    line.trim_start().starts_with(COMMENT_MARKS) || line.trim_start().starts_with("//")
}
