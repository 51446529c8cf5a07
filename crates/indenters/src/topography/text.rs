//! Texts of numbers: detection of the separator, of the rows and of the header above them.

use super::{FORMATS, TopographyError};

/// Words for a missing height in lower case, besides an empty cell and NaN: those of spreadsheets, languages and instruments.
const MISSING_WORDS: [&str; 16] = [
    "na", "n/a", "#n/a", "#nv", "<na>", "null", "none", "bad", "-", "--", "---", "***", "nodata",
    "1.#qnan", "-1.#ind", "nan(ind)",
];
/// Length of the beginning of a text from which the separator is found, \[bytes]. Chosen: it limits the time for long texts.
const SAMPLED_BYTES: usize = 1 << 20;
/// Error values of spreadsheets after their first character `#`, as in `#N/A`. Lines that begin with them are rows and not
/// comments.
const FAILED_FORMULAS: [&str; 8] = ["N/A", "NV", "DIV", "VALUE", "WERT", "NUM", "REF", "NAME"];

/// Separator of the cells and number of cells in a row.
#[derive(Clone, Copy)]
pub(super) struct Notation {
    /// Separator of the cells; a blank stands for any number of blanks and tabs.
    separator: char,
    /// Number of cells in a row.
    width: usize,
}

impl Notation {
    /// The separator for which the most lines consist of equally many numbers; among several, the one with the most cells.
    pub(super) fn of(text: &str) -> Self {
        let mut size = 0;
        let sample = lines(text).take_while(|(_, line)| {
            size += line.len();
            size <= SAMPLED_BYTES + line.len()
        });
        let sample: Vec<&str> = sample.map(|(_, line)| line).collect();
        let found = [';', '\t', ',', ' '].map(|separator| {
            let notation = Self {
                separator,
                width: 0,
            };
            let (rows, width) = notation.count_rows(&sample);
            (rows, Self { width, ..notation })
        });
        let best = found.into_iter().rev().max_by_key(|(rows, notation)| {
            // A line with a single number is a row for any separator that it does not contain.
            (*rows, notation.width)
        });
        best.map_or(found[0].1, |(_, notation)| notation)
    }

    /// Largest number of lines with equally many numbers, and the number of numbers in each.
    fn count_rows(self, sample: &[&str]) -> (usize, usize) {
        // Count the lines of numbers by their numbers of cells; of equal counts the longer line wins.
        let mut counts = std::collections::BTreeMap::new();
        for line in sample {
            let cells = self.cells(line);
            let is_number = |cell: &&str| self.number(cell).is_some();
            if cells.iter().all(|cell| self.height(cell).is_some()) && cells.iter().any(is_number) {
                *counts.entry(cells.len()).or_insert(0) += 1;
            }
        }
        let most = counts.into_iter().map(|(width, rows)| (rows, width)).max();
        most.unwrap_or((0, 0))
    }

    /// The cells of a line without quotation marks; a separator between quotation marks, unless it is a blank, is a part of the cell.
    pub(super) fn cells<'a>(&self, line: &'a str) -> Vec<&'a str> {
        if self.separator == ' ' {
            let cells = line.split([' ', '\t']).map(unquoted);
            return cells.filter(|cell| !cell.is_empty()).collect();
        }
        let mut is_quoted = false;
        let cells = line.split(|letter| {
            is_quoted ^= letter == '"';
            letter == self.separator && !is_quoted
        });
        cells.map(unquoted).collect()
    }

    /// A finite number with a decimal point, or with a decimal comma if the separator is not a comma; `None` if the cell is none.
    pub(super) fn number(&self, cell: &str) -> Option<f64> {
        // Accept one mark at most: two are those of thousands, or of a comma that separates cells.
        let marks = cell.bytes().filter(|byte| b".,".contains(byte)).count();
        if marks > 1 || (self.separator == ',' && cell.contains(',')) {
            return None;
        }
        let number: f64 = match cell.split_once(',') {
            Some((_, decimals))
                if !decimals.starts_with(|letter: char| letter.is_ascii_digit()) =>
            {
                return None;
            }
            Some((whole, decimals)) => format!("{whole}.{decimals}")
                .replace('−', "-")
                .parse()
                .ok()?,
            None => cell.parse().ok().or_else(|| parse_foreign(cell))?,
        };
        number.is_finite().then_some(number)
    }

    /// A finite height, or NaN for a missing one; `None` if the cell is neither.
    pub(super) fn height(&self, cell: &str) -> Option<f64> {
        let is_missing = || {
            cell.is_empty()
                || cell.parse::<f64>().is_ok_and(f64::is_nan)
                || MISSING_WORDS
                    .iter()
                    .any(|word| cell.eq_ignore_ascii_case(word))
        };
        self.number(cell)
            .or_else(|| is_missing().then_some(f64::NAN))
    }

    /// Whether a line is a row of numbers and missing numbers.
    fn is_row(&self, line: &str) -> bool {
        let cells = self.cells(line);
        self.width > 0
            && cells.len() == self.width
            && cells.iter().all(|cell| self.height(cell).is_some())
    }

    /// Whether a line above the rows belongs to a preamble: it has letters, and at most half of its words are numbers.
    ///
    /// A damaged row has more numbers.
    fn is_preamble(&self, line: &str) -> bool {
        let words = line.split([' ', '\t', ',', ';', ':', '=', '"']);
        let words: Vec<&str> = words.filter(|word| !word.is_empty()).collect();
        let is_number = |word: &&&str| self.height(word).is_some();
        let numbers = words.iter().filter(is_number).count();
        2 * numbers <= words.len() && line.contains(char::is_alphabetic)
    }
}

/// A number with a typographic minus or with an exponent of Fortran.
fn parse_foreign(cell: &str) -> Option<f64> {
    cell.replace('−', "-").replace(['D', 'd'], "e").parse().ok()
}

/// A cell without blanks and quotation marks around it.
fn unquoted(cell: &str) -> &str {
    cell.trim().trim_matches('"').trim()
}

/// The rows of a text and the lines above them.
pub(super) struct Sheet<'a> {
    /// Separator and number of the cells of a row.
    pub(super) notation: Notation,
    /// Rows of numbers with their line numbers, which count from 1.
    pub(super) rows: Vec<(usize, &'a str)>,
    /// Lines above the rows, comments included.
    pub(super) head: Vec<(usize, &'a str)>,
    /// Whether the last line has no newline; the file may have been truncated.
    lacks_final_newline: bool,
    /// Lines above the rows other than comments.
    preamble: Vec<(usize, &'a str)>,
}

impl<'a> Sheet<'a> {
    /// Finds the rows of a text.
    ///
    /// # Errors
    /// [`TopographyError::Line`] without rows, and for a line above them that is a damaged row.
    pub(super) fn of(text: &'a str) -> Result<Self, TopographyError> {
        let notation = Notation::of(text);
        let mut rows: Vec<_> = lines(text).collect();
        let first = rows
            .iter()
            .position(|(_, line)| notation.is_row(line))
            .ok_or_else(|| without_rows(&rows))?;
        let above = rows.drain(..first).collect::<Vec<_>>();
        if let Some(&(line, text)) = above.iter().find(|(_, line)| !notation.is_preamble(line)) {
            let cells = notation.cells(text);
            return Err(notation.wrong_row(line, &cells));
        }
        let begin = rows[0].0;
        let head = text.lines().enumerate().take(begin - 1);
        Ok(Self {
            notation,
            lacks_final_newline: !text.ends_with(['\n', '\r']),
            head: head.map(|(index, line)| (index + 1, line)).collect(),
            preamble: above,
            rows,
        })
    }

    /// Number of cells in each row.
    pub(super) const fn width(&self) -> usize {
        self.notation.width
    }

    /// Note on the skipped lines above the rows; `None` if there are none.
    pub(super) fn skipped(&self) -> Option<String> {
        let ((first, text), (last, _)) = (self.preamble.first()?, self.preamble.last()?);
        Some(if first == last {
            format!(
                "line {first} is no line of numbers and was skipped: '{}'",
                shown(text)
            )
        } else {
            format!("lines {first} to {last} are no lines of numbers and were skipped")
        })
    }

    /// The first line above the rows that names their columns, and its first two names; `None` if there is none. Names that differ in digits
    /// only, such as V1 and V2, number the columns of any matrix.
    pub(super) fn names_of_columns(&self) -> Option<(usize, [&'a str; 2])> {
        let stem = |name: &str| name.replace(|letter: char| letter.is_ascii_digit(), "");
        self.preamble.iter().find_map(|&(line, text)| {
            let names = self.notation.cells(text);
            let is_name = |name: &&str| name.contains(char::is_alphabetic);
            let are_names = names.len() == self.width() && names.iter().all(is_name);
            let other = (names.iter().skip(1)).find(|name| stem(name) != stem(names[0]))?;
            are_names.then_some((line, [names[0], *other]))
        })
    }

    /// Calls `visit` with the line number, the cells and the numbers of each row; missing numbers are NaN.
    ///
    /// # Errors
    /// [`TopographyError::Line`] for a row of another length or with a cell that is no number, for a truncated last number,
    /// and for a text with both decimal points and decimal commas.
    pub(super) fn for_each_row(
        &self,
        mut visit: impl FnMut(usize, &[&'a str], &[f64]) -> Result<(), TopographyError>,
    ) -> Result<(), TopographyError> {
        let mut marks: [Option<(usize, &str)>; 2] = [None, None];
        let mut digits = DigitCounts::default();
        for &(line, text) in &self.rows {
            // Read the numbers of a row; a row with a cell that is neither a number nor missing, or with another number of cells,
            // is refused.
            let cells = self.notation.cells(text);
            let numbers = cells
                .iter()
                .map(|cell| self.notation.height(cell))
                .collect::<Option<Vec<f64>>>()
                .filter(|numbers| numbers.len() == self.width())
                .ok_or_else(|| self.notation.wrong_row(line, &cells))?;
            // Keep the first cells with a decimal comma and with a decimal point, for the check at the end.
            for (first, mark) in marks.iter_mut().zip([',', '.']) {
                let found = cells.iter().find(|cell| cell.contains(mark));
                *first = first.or_else(|| found.map(|cell| (line, *cell)));
            }
            digits.record(&cells);
            visit(line, &cells, &numbers)?;
        }
        // Refuse a text without a final newline whose last number is shorter than the others, and seems truncated.
        let last = self.rows.last().map_or(1, |(line, _)| *line);
        if self.lacks_final_newline
            && let Some(problem) = digits.truncated_end()
        {
            return Err(TopographyError::Line {
                line: last,
                problem,
            });
        }
        // Refuse a text that has both decimal commas and decimal points.
        let [Some((line, comma)), Some((other, point))] = marks else {
            return Ok(());
        };
        let problem = format!(
            "'{}' has a comma and '{}' in line {other} a point: decimal commas are needed, or decimal points, and not both; \
             write the numbers without separators of thousands",
            shown(comma),
            shown(point)
        );
        Err(TopographyError::Line { line, problem })
    }
}

/// Numbers of digits of the last number of a text and of all others, from which a truncation is detected.
#[derive(Default)]
struct DigitCounts<'a> {
    /// Numbers of decimals and of characters of the exponent of the first number.
    others: Option<[usize; 2]>,
    /// Whether the numbers before the last one differ in these counts.
    differ: bool,
    /// The last number so far.
    last: Option<&'a str>,
}

impl<'a> DigitCounts<'a> {
    /// Counts the numbers of a row, after which the last one of the row is the last number.
    fn record(&mut self, cells: &[&'a str]) {
        for cell in cells
            .iter()
            .filter(|cell| cell.starts_with(|first: char| !first.is_alphabetic()))
        {
            if let Some(before) = self.last.replace(cell) {
                let before = Self::of_number(before);
                self.differ |= *self.others.get_or_insert(before) != before;
            }
        }
    }

    /// Numbers of decimals and of characters of the exponent of a number.
    fn of_number(cell: &str) -> [usize; 2] {
        let (mantissa, exponent) = cell.split_once(['e', 'E']).unwrap_or((cell, ""));
        let decimals = mantissa
            .split_once(['.', ','])
            .map_or("", |(_, decimals)| decimals);
        [decimals.len(), exponent.len()]
    }

    /// Message if the last number has fewer digits than all others, which agree.
    fn truncated_end(&self) -> Option<String> {
        let (last, others) = (self.last?, self.others?);
        let is_shorter = Self::of_number(last)
            .iter()
            .zip(others)
            .any(|(last, other)| *last < other);
        (!self.differ && is_shorter).then(|| {
            format!("the text ends with '{}', which has less digits than all other numbers: was it cut?", shown(last))
        })
    }
}

impl Notation {
    /// Error for a line that is no row of numbers.
    fn wrong_row(&self, line: usize, cells: &[&str]) -> TopographyError {
        let wrong = cells.iter().position(|cell| self.height(cell).is_none());
        let problem = match wrong {
            _ if cells.len() != self.width => {
                let (needed, found) = (self.width, cells.len());
                format!("{needed} values are needed, but there are {found}")
            }
            Some(column) => {
                let thousands_hint = thousands_hint(cells[column]);
                // A table with axes has their names in the corner, and numbers in all other cells of the first row.
                let others = cells[1..].iter().all(|cell| self.number(cell).is_some());
                let corner = if column == 0 && others {
                    "; are the first row and column an index or axes?"
                } else {
                    ""
                };
                format!(
                    "column {}: a finite height is needed, and not '{}'{thousands_hint}{corner}",
                    column + 1,
                    shown(cells[column])
                )
            }
            None => "a line of numbers is needed".to_owned(),
        };
        TopographyError::Line { line, problem }
    }
}

/// Error for a text without a row of numbers.
fn without_rows(lines: &[(usize, &str)]) -> TopographyError {
    let Some(&(line, text)) = lines.first() else {
        let problem = "numbers are needed, and the text is empty but for comments".to_owned();
        return TopographyError::Line { line: 1, problem };
    };
    // The separator is unknown; show the first word.
    let word = text
        .split([';', '\t', ' '])
        .find(|word| !word.is_empty())
        .unwrap_or_default();
    let thousands_hint = thousands_hint(word);
    let problem = format!(
        "no line is a row of numbers; this one begins with '{}'{thousands_hint}; {FORMATS}",
        shown(word)
    );
    TopographyError::Line { line, problem }
}

/// Hint for messages about a number with both a comma and a point.
fn thousands_hint(cell: &str) -> &'static str {
    let is_number = !cell.contains(char::is_alphabetic);
    if is_number && cell.contains(',') && cell.contains('.') {
        " (is there a separator of thousands?)"
    } else {
        ""
    }
}

/// The first 40 characters of a cell, for messages.
pub(super) fn shown(cell: &str) -> String {
    let letters = cell.chars().filter(|letter| !letter.is_control());
    letters.take(40).collect()
}

/// Lines that are neither empty nor comments, with their line numbers, which count from 1.
pub(super) fn lines(text: &str) -> impl Iterator<Item = (usize, &str)> {
    let lines = text
        .lines()
        .enumerate()
        .map(|(index, line)| (index + 1, line));
    lines.filter(|(_, line)| !line.trim().is_empty() && !is_comment(line))
}

/// Whether a line is a comment, after `#`, `%` or `//`.
pub(super) fn is_comment(line: &str) -> bool {
    let trimmed = line.trim_start();
    match trimmed.strip_prefix('#') {
        Some(rest) => !FAILED_FORMULAS.iter().any(|word| rest.starts_with(word)),
        None => trimmed.starts_with('%') || trimmed.starts_with("//"),
    }
}

/// The text of a file in UTF-16, UTF-8 or Latin-1; a missing height of two words ("no data") becomes `nan`.
pub(super) fn text_of(contents: &[u8]) -> String {
    let mut text = decode(contents);
    if !text.contains('\n') {
        // The text has no line feeds, so carriage returns separate its lines.
        text = text.replace('\r', "\n");
    }
    if text.contains("No Data") || text.contains("no data") {
        return text.replace("No Data", "nan").replace("no data", "nan");
    }
    text
}

/// Decodes UTF-16 if there is a byte-order mark or if ASCII letters have zero bytes, then UTF-8, else Latin-1.
fn decode(contents: &[u8]) -> String {
    // In UTF-16 every other byte of ASCII letters is zero: which one says the order of the bytes.
    let is_zero = |at: usize| contents.get(at) == Some(&0) && contents.get(at + 2) == Some(&0);
    let is_big_endian = contents.starts_with(b"\xfe\xff") || (is_zero(0) && !is_zero(1));
    if is_big_endian || contents.starts_with(b"\xff\xfe") || is_zero(1) {
        let unit = if is_big_endian {
            u16::from_be_bytes
        } else {
            u16::from_le_bytes
        };
        let units = contents
            .chunks_exact(2)
            .map(|pair| unit([pair[0], pair[1]]));
        return char::decode_utf16(units.skip_while(|unit| *unit == 0xfeff))
            .map(|letter| letter.unwrap_or(char::REPLACEMENT_CHARACTER))
            .collect();
    }
    let without_mark = contents.strip_prefix(b"\xef\xbb\xbf").unwrap_or(contents);
    let latin = || without_mark.iter().copied().map(char::from).collect();
    std::str::from_utf8(without_mark).map_or_else(|_| latin(), str::to_owned)
}
