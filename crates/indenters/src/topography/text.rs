//! Heights as text.

use super::{Topography, TopographyError};

/// What stands in the place of a height that was not measured, beside nothing.
const MISSING: [&str; 7] = ["na", "n/a", "null", "none", "bad", "-", "--"];

/// How numbers are separated, and what marks their decimals.
pub(super) struct Notation {
    separator: char,
    comma_is_decimal: bool,
}

impl Notation {
    pub(super) fn of(text: &str) -> Self {
        let has = |part: &str| lines(text).any(|(_, line)| line.contains(part));
        let is_between_digits = |line: &str| {
            let parts: Vec<&str> = line.split(',').collect();
            parts.windows(2).all(|pair| {
                pair[0].ends_with(|c: char| c.is_ascii_digit())
                    && pair[1].starts_with(|c: char| c.is_ascii_digit())
            })
        };
        let is_blank = |line: &str| line.trim().contains([' ', '\t']);
        // Where no cell between tabs is empty they are blanks.
        let tabs_end_cells = lines(text).any(|(_, line)| {
            line.contains("\t\t") || line.starts_with('\t') || line.ends_with('\t')
        });
        let separator = if has(";") {
            ';'
        } else if tabs_end_cells {
            '\t'
        } else if has(",")
            && (has(".") || !lines(text).all(|(_, line)| is_blank(line) && is_between_digits(line)))
        {
            ','
        } else {
            ' '
        };
        Self {
            separator,
            comma_is_decimal: separator != ',',
        }
    }

    pub(super) fn cells<'a>(&self, line: &'a str) -> Vec<&'a str> {
        let plain = |cell: &'a str| cell.trim().trim_matches('"');
        if self.separator == ' ' {
            return line.split_whitespace().map(plain).collect();
        }
        line.split(self.separator).map(plain).collect()
    }

    /// A finite number.
    pub(super) fn number(&self, cell: &str) -> Option<f64> {
        let number = match cell.split_once(',') {
            Some((whole, decimals)) if self.comma_is_decimal && !whole.contains('.') => {
                format!("{whole}.{decimals}").parse()
            }
            _ => cell.parse(),
        };
        number.ok().filter(|number: &f64| number.is_finite())
    }

    /// A finite height, or NaN for a missing one.
    pub(super) fn height(&self, cell: &str) -> Option<f64> {
        let is_missing = cell.is_empty()
            || cell.parse::<f64>().is_ok_and(f64::is_nan)
            || MISSING.iter().any(|word| cell.eq_ignore_ascii_case(word));
        if is_missing {
            return Some(f64::NAN);
        }
        self.number(cell)
    }
}

/// The lines that are neither empty nor comments, counted from 1.
pub(super) fn lines(text: &str) -> impl Iterator<Item = (usize, &str)> {
    let lines = text
        .lines()
        .enumerate()
        .map(|(index, line)| (index + 1, line));
    lines.filter(|(_, line)| !line.trim().is_empty() && !line.trim().starts_with(['#', '%']))
}

/// A line of heights for each y.
pub(super) fn rows(contents: &[u8], spacing: [f64; 2]) -> Result<Topography, TopographyError> {
    let text = text_of(contents);
    let notation = Notation::of(&text);
    let mut heights = Vec::new();
    let [mut rows, mut columns] = [0, 0];
    for (line, cells) in lines(&text) {
        let wrong = |problem| TopographyError::Line { line, problem };
        let cells = notation.cells(cells);
        if rows > 0 && cells.len() != columns {
            let found = cells.len();
            return Err(wrong(format!(
                "{columns} values are needed, but there are {found}"
            )));
        }
        [rows, columns] = [rows + 1, cells.len()];
        for (column, cell) in cells.into_iter().enumerate() {
            let height = notation.height(cell).ok_or_else(|| {
                let shown = cell.chars().filter(|letter| !letter.is_control());
                let [column, shown] = [(column + 1).to_string(), shown.take(40).collect()];
                wrong(format!(
                    "column {column}: a finite height is needed, and not '{shown}'"
                ))
            })?;
            heights.push(height);
        }
    }
    let is_empty = |row: &[f64]| row.last().is_some_and(|height| height.is_nan());
    if columns > 1 && heights.chunks_exact(columns).all(is_empty) {
        let problem =
            "every line ends with an empty cell: leave out the last separators".to_owned();
        return Err(TopographyError::Line { line: 1, problem });
    }
    Ok(Topography::of_rows([rows, columns], spacing, heights))
}

/// The text of a file in UTF-16 where a byte-order mark says so, in UTF-8, or in Latin-1.
pub(super) fn text_of(contents: &[u8]) -> String {
    let is_big = contents.starts_with(b"\xfe\xff");
    if is_big || contents.starts_with(b"\xff\xfe") {
        let unit = if is_big {
            u16::from_be_bytes
        } else {
            u16::from_le_bytes
        };
        let units = contents[2..].chunks_exact(2);
        let letters = char::decode_utf16(units.map(|pair| unit([pair[0], pair[1]])));
        let letters = letters.map(|letter| letter.unwrap_or(char::REPLACEMENT_CHARACTER));
        return letters.collect();
    }
    let contents = contents.strip_prefix(b"\xef\xbb\xbf").unwrap_or(contents);
    let latin = || contents.iter().copied().map(char::from).collect();
    std::str::from_utf8(contents).map_or_else(|_| latin(), str::to_owned)
}
