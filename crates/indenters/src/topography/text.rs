//! Texts of numbers: how their cells are separated, which lines are rows, and what stands above them.

use super::{FORMATS, TopographyError};

/// What stands in the place of a height that was not measured, beside nothing and the NaN of C.
const MISSING: [&str; 16] = [
    "na", "n/a", "#n/a", "#nv", "<na>", "null", "none", "bad", "-", "--", "---", "***", "nodata",
    "1.#qnan", "-1.#ind", "nan(ind)",
];
/// Part of a text by which the separator is found, \[bytes].
const SAMPLE: usize = 1 << 20;
/// What spreadsheets write in the place of a number, which is no comment.
const FAILED_FORMULAS: [&str; 8] = ["N/A", "NV", "DIV", "VALUE", "WERT", "NUM", "REF", "NAME"];

/// How numbers are separated.
#[derive(Clone, Copy)]
pub(super) struct Notation {
    separator: char,
    /// Cells of a row.
    width: usize,
}

impl Notation {
    /// The separator for which the most lines consist of equally many numbers, of several the one with the most cells.
    pub(super) fn of(text: &str) -> Self {
        let mut size = 0;
        let sample = lines(text).take_while(|(_, line)| {
            size += line.len();
            size <= SAMPLE + line.len()
        });
        let sample: Vec<&str> = sample.map(|(_, line)| line).collect();
        let found = [';', '\t', ',', ' '].map(|separator| {
            let notation = Self {
                separator,
                width: 0,
            };
            let (rows, width) = notation.rows_of(&sample);
            (rows, Self { width, ..notation })
        });
        let best = found.into_iter().rev().max_by_key(|(rows, notation)| {
            // A single cell is a number for every separator that the text has not.
            (*rows, notation.width)
        });
        best.map_or(found[0].1, |(_, notation)| notation)
    }

    /// The most lines with equally many numbers, and how many numbers these have.
    fn rows_of(self, sample: &[&str]) -> (usize, usize) {
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

    /// A finite number, with a decimal point, or a decimal comma where commas do not separate.
    pub(super) fn number(&self, cell: &str) -> Option<f64> {
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
            None => cell.parse().ok().or_else(|| foreign(cell))?,
        };
        number.is_finite().then_some(number)
    }

    /// A finite height, or NaN for a missing one.
    pub(super) fn height(&self, cell: &str) -> Option<f64> {
        let is_missing = || {
            cell.is_empty()
                || cell.parse::<f64>().is_ok_and(f64::is_nan)
                || MISSING.iter().any(|word| cell.eq_ignore_ascii_case(word))
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

    /// Whether a line above the rows is a part of a preamble: it has letters, and at most half of its words are numbers. A row
    /// that was damaged has more.
    fn is_preamble(&self, line: &str) -> bool {
        let words = line.split([' ', '\t', ',', ';', ':', '=', '"']);
        let words: Vec<&str> = words.filter(|word| !word.is_empty()).collect();
        let is_number = |word: &&&str| self.height(word).is_some();
        let numbers = words.iter().filter(is_number).count();
        2 * numbers <= words.len() && line.contains(char::is_alphabetic)
    }
}

/// A number with the minus of typesetters, or the exponent of Fortran.
fn foreign(cell: &str) -> Option<f64> {
    cell.replace('−', "-").replace(['D', 'd'], "e").parse().ok()
}

fn unquoted(cell: &str) -> &str {
    cell.trim().trim_matches('"').trim()
}

/// The rows of a text, and what stands above them.
pub(super) struct Sheet<'a> {
    pub(super) notation: Notation,
    /// Lines of numbers and their places, counted from 1.
    pub(super) rows: Vec<(usize, &'a str)>,
    /// Comments and other lines above the rows.
    pub(super) head: Vec<(usize, &'a str)>,
    /// Whether the last line has no end, as of a file that was cut, or of a program that writes none.
    is_open: bool,
    /// Lines above the rows that are no comments.
    preamble: Vec<(usize, &'a str)>,
}

impl<'a> Sheet<'a> {
    /// # Errors
    /// [`TopographyError::Line`] without rows, and for a line above them that is a damaged row.
    pub(super) fn of(text: &'a str) -> Result<Self, TopographyError> {
        let notation = Notation::of(text);
        let mut rows: Vec<_> = lines(text).collect();
        let first = rows.iter().position(|(_, line)| notation.is_row(line));
        let first = first.ok_or_else(|| without_rows(&rows))?;
        let above = rows.drain(..first).collect::<Vec<_>>();
        if let Some(&(line, text)) = above.iter().find(|(_, line)| !notation.is_preamble(line)) {
            let cells = notation.cells(text);
            return Err(notation.wrong_row(line, &cells));
        }
        let begin = rows[0].0;
        let head = text.lines().enumerate().take(begin - 1);
        Ok(Self {
            notation,
            is_open: !text.ends_with(['\n', '\r']),
            head: head.map(|(index, line)| (index + 1, line)).collect(),
            preamble: above,
            rows,
        })
    }

    /// Numbers of a row, in the order of its cells.
    pub(super) const fn width(&self) -> usize {
        self.notation.width
    }

    /// That lines above the rows were skipped; `None` if there are none.
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

    /// Hands on the cells of each row and their numbers, NaN where they are missing.
    ///
    /// # Errors
    /// [`TopographyError::Line`] for a line of another length or with another cell, and for a text with decimal points and
    /// decimal commas.
    pub(super) fn for_each_row(
        &self,
        mut take: impl FnMut(usize, &[&'a str], &[f64]) -> Result<(), TopographyError>,
    ) -> Result<(), TopographyError> {
        let mut marks: [Option<(usize, &str)>; 2] = [None, None];
        let mut digits = Digits::default();
        for &(line, text) in &self.rows {
            let cells = self.notation.cells(text);
            let numbers = cells.iter().map(|cell| self.notation.height(cell));
            let numbers = numbers.collect::<Option<Vec<f64>>>();
            let numbers = numbers.filter(|numbers| numbers.len() == self.width());
            let numbers = numbers.ok_or_else(|| self.notation.wrong_row(line, &cells))?;
            for (first, mark) in marks.iter_mut().zip([',', '.']) {
                let found = cells.iter().find(|cell| cell.contains(mark));
                *first = first.or_else(|| found.map(|cell| (line, *cell)));
            }
            digits.see(&cells);
            take(line, &cells, &numbers)?;
        }
        let last = self.rows.last().map_or(1, |(line, _)| *line);
        if self.is_open
            && let Some(problem) = digits.cut()
        {
            return Err(TopographyError::Line {
                line: last,
                problem,
            });
        }
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

/// Decimals and exponents of the numbers of a text: those of the last one, and those of all others if they are as many.
#[derive(Default)]
struct Digits<'a> {
    others: Option<[usize; 2]>,
    differ: bool,
    last: Option<&'a str>,
}

impl<'a> Digits<'a> {
    fn see(&mut self, cells: &[&'a str]) {
        for cell in cells
            .iter()
            .filter(|cell| cell.starts_with(|first: char| !first.is_alphabetic()))
        {
            if let Some(before) = self.last.replace(cell) {
                let before = Self::of(before);
                self.differ |= *self.others.get_or_insert(before) != before;
            }
        }
    }

    /// As many decimals, and letters of the exponent.
    fn of(cell: &str) -> [usize; 2] {
        let (mantissa, exponent) = cell.split_once(['e', 'E']).unwrap_or((cell, ""));
        let decimals = mantissa
            .split_once(['.', ','])
            .map_or("", |(_, decimals)| decimals);
        [decimals.len(), exponent.len()]
    }

    /// That the last number has less digits than all others.
    fn cut(&self) -> Option<String> {
        let (last, others) = (self.last?, self.others?);
        let is_shorter = Self::of(last)
            .iter()
            .zip(others)
            .any(|(last, other)| *last < other);
        (!self.differ && is_shorter).then(|| {
            format!("the text ends with '{}', which has less digits than all other numbers: was it cut?", shown(last))
        })
    }
}

impl Notation {
    /// Why a line is no row.
    fn wrong_row(&self, line: usize, cells: &[&str]) -> TopographyError {
        let wrong = cells.iter().position(|cell| self.height(cell).is_none());
        let problem = match wrong {
            _ if cells.len() != self.width => {
                let (needed, found) = (self.width, cells.len());
                format!("{needed} values are needed, but there are {found}")
            }
            Some(column) => {
                let thousands = thousands(cells[column]);
                // Of a first row with the names of two axes in the corner all other cells are numbers.
                let others = cells[1..].iter().all(|cell| self.number(cell).is_some());
                let corner = if column == 0 && others {
                    "; are the first row and column an index or axes?"
                } else {
                    ""
                };
                format!(
                    "column {}: a finite height is needed, and not '{}'{thousands}{corner}",
                    column + 1,
                    shown(cells[column])
                )
            }
            None => "a line of numbers is needed".to_owned(),
        };
        TopographyError::Line { line, problem }
    }
}

/// That no line is a row.
fn without_rows(lines: &[(usize, &str)]) -> TopographyError {
    let Some(&(line, text)) = lines.first() else {
        let problem = "numbers are needed, and the text is empty but for comments".to_owned();
        return TopographyError::Line { line: 1, problem };
    };
    // The separator is unknown: the first word says most.
    let word = text.split([';', '\t', ' ']).find(|word| !word.is_empty());
    let word = word.unwrap_or_default();
    let thousands = thousands(word);
    let problem = format!(
        "no line is a row of numbers; this one begins with '{}'{thousands}; {FORMATS}",
        shown(word)
    );
    TopographyError::Line { line, problem }
}

/// A question about a number that has a comma and a point, for messages.
fn thousands(cell: &str) -> &'static str {
    let is_number = !cell.contains(char::is_alphabetic);
    if is_number && cell.contains(',') && cell.contains('.') {
        " (is there a separator of thousands?)"
    } else {
        ""
    }
}

/// The begin of a cell, for messages.
pub(super) fn shown(cell: &str) -> String {
    let letters = cell.chars().filter(|letter| !letter.is_control());
    letters.take(40).collect()
}

/// The lines that are neither empty nor comments, counted from 1.
pub(super) fn lines(text: &str) -> impl Iterator<Item = (usize, &str)> {
    let lines = text
        .lines()
        .enumerate()
        .map(|(index, line)| (index + 1, line));
    lines.filter(|(_, line)| !line.trim().is_empty() && !is_comment(line))
}

/// Whether a line is a comment, after `#`, `%` or `//`.
pub(super) fn is_comment(line: &str) -> bool {
    let line = line.trim_start();
    match line.strip_prefix('#') {
        Some(rest) => !FAILED_FORMULAS.iter().any(|word| rest.starts_with(word)),
        None => line.starts_with('%') || line.starts_with("//"),
    }
}

/// The text of a file in UTF-16 where a byte-order mark or the zeros of ASCII say so, in UTF-8, or in Latin-1; missing heights
/// of two words are one.
pub(super) fn text_of(contents: &[u8]) -> String {
    let mut text = decoded(contents);
    if !text.contains('\n') {
        // Lines of old Macintoshes.
        text = text.replace('\r', "\n");
    }
    if text.contains("No Data") || text.contains("no data") {
        return text.replace("No Data", "nan").replace("no data", "nan");
    }
    text
}

fn decoded(contents: &[u8]) -> String {
    let is_zero = |at: usize| contents.get(at) == Some(&0) && contents.get(at + 2) == Some(&0);
    let is_big = contents.starts_with(b"\xfe\xff") || (is_zero(0) && !is_zero(1));
    if is_big || contents.starts_with(b"\xff\xfe") || is_zero(1) {
        let unit = if is_big {
            u16::from_be_bytes
        } else {
            u16::from_le_bytes
        };
        let units = contents
            .chunks_exact(2)
            .map(|pair| unit([pair[0], pair[1]]));
        let letters = char::decode_utf16(units.skip_while(|unit| *unit == 0xfeff));
        let letters = letters.map(|letter| letter.unwrap_or(char::REPLACEMENT_CHARACTER));
        return letters.collect();
    }
    let contents = contents.strip_prefix(b"\xef\xbb\xbf").unwrap_or(contents);
    let latin = || contents.iter().copied().map(char::from).collect();
    std::str::from_utf8(contents).map_or_else(|_| latin(), str::to_owned)
}
