//! Reader of Esri's ASCII grid: a header of names and numbers, then the heights in rows.

use super::text::{Notation, lines, shown, text_of};
use super::{FORMATS, LateralUnit, Memory, Topography, TopographyError};
use numerics::whole_part;

/// Height that marks a missing one if the header states no marker (Esri's convention).
const DEFAULT_MISSING: f64 = -9999.0;
/// Magnitude beyond which heights with the sign of the marker count as missing, too. Chosen: no height is so large, and such
/// markers are the smallest or largest f32, ∓3.4e38, written with any number of digits.
const MAX_ABS_HEIGHT: f64 = 1e30;

/// Names of the header, in lower case; the header ends at the first line that begins with another word.
const HEADER_NAMES: [&str; 10] = [
    "ncols",
    "nrows",
    "xllcorner",
    "yllcorner",
    "xllcenter",
    "yllcenter",
    "cellsize",
    "dx",
    "dy",
    "nodata_value",
];

/// Reads an ASCII grid: a header with names and numbers, and rows of heights.
pub(super) fn read(contents: &[u8], memory: Memory) -> Result<Topography, TopographyError> {
    memory.require_text(contents)?;
    let text = text_of(contents);
    // Read the number of columns and rows, and the spacings, from the names of the header.
    let head = Head::of(&text)?;
    let [columns, rows] = [head.required(&["ncols"])?, head.required(&["nrows"])?];
    let spacing = [
        head.required(&["cellsize", "dx"])?,
        head.required(&["cellsize", "dy"])?,
    ];
    let missing = head.number_of("nodata_value").unwrap_or(DEFAULT_MISSING);
    // Read the heights line by line, and count those in each line.
    let mut heights = Vec::new();
    let mut lengths = Vec::new();
    let notation = Notation::of(&text);
    for (line, text) in lines(&text).skip(head.lines) {
        let cells = notation.cells(text);
        lengths.push((line, cells.len()));
        for (column, cell) in cells.into_iter().enumerate() {
            let height = notation.height(cell).ok_or_else(|| {
                let column = column + 1;
                let problem = format!(
                    "column {column}: a height is needed, and not '{}'",
                    shown(cell)
                );
                TopographyError::Line { line, problem }
            })?;
            heights.push(if is_missing(height, missing) {
                f64::NAN
            } else {
                height
            });
        }
    }
    // Check the number of heights in each line and in all, which the header states.
    check_line_lengths(&lengths, [columns, rows])?;
    let last = lengths.last().map_or(head.lines.max(1), |(line, _)| *line);
    if [columns, rows].iter().any(|count| count.fract() != 0.0)
        || columns * rows - heights.len() as f64 != 0.0
    {
        let count = heights.len();
        return Err(format_error(
            last,
            &format!("{count} heights for {columns} × {rows} points"),
        ));
    }
    let shape = [rows, columns].map(whole_part);
    let mut surface = Topography::of_rows(shape, spacing, heights);
    surface.lateral_unit = LateralUnit::Unstated;
    Ok(surface)
}

/// Error at a line that Esri's ASCII grid cannot have.
fn format_error(line: usize, found: &str) -> TopographyError {
    let format = "an ASCII grid with ncols, nrows, cellsize and heights";
    let problem = format!("{format} is needed, but there is {found}");
    TopographyError::Line { line, problem }
}

/// Whether a height is the `marker` of missing heights, or beyond [`MAX_ABS_HEIGHT`] as the marker is.
fn is_missing(height: f64, marker: f64) -> bool {
    let is_same = height.to_bits() == marker.to_bits();
    let is_huge = |number: f64| number.abs() > MAX_ABS_HEIGHT;
    is_same || (is_huge(height) && is_huge(marker) && height.signum() == marker.signum())
}

/// Checks the `lengths`, pairs of a line number and the number of heights in it, against `ncols` and `nrows`.
///
/// A row may continue in the next line. Refused are lines longer than `ncols`, and lines of equal length that does not divide
/// `ncols` or equals `nrows`, as in a file in which the two were exchanged.
fn check_line_lengths(
    lengths: &[(usize, usize)],
    [columns, rows]: [f64; 2],
) -> Result<(), TopographyError> {
    let longest = lengths.iter().max_by_key(|(_, length)| *length);
    let Some(&(line, length)) = longest.filter(|_| lengths.len() > 1) else {
        return Ok(());
    };
    let heights = length as f64;
    let are_rows = lengths.iter().all(|(_, other)| *other == length);
    let are_parts = columns % heights == 0.0 && heights - rows != 0.0;
    if heights > columns || (are_rows && heights < columns && !are_parts) {
        let problem =
            format!("ncols is {columns} and nrows is {rows}, but this line has {length} heights");
        return Err(TopographyError::Line { line, problem });
    }
    Ok(())
}

/// The header above the heights.
struct Head {
    /// Names and numbers in the order of the file.
    known: Vec<(String, f64)>,
    /// Number of its lines, without empty lines and comments.
    lines: usize,
}

impl Head {
    /// Reads the header; fails for a text without one.
    fn of(text: &str) -> Result<Self, TopographyError> {
        let mut known = Vec::new();
        for (line, text) in lines(text) {
            // Read a name and its number, or end at the first other line.
            let mut words = text.split_whitespace();
            let name = words.next().unwrap_or_default().to_ascii_lowercase();
            if !HEADER_NAMES.contains(&&*name) {
                break;
            }
            let word = words.next().unwrap_or_default();
            let number = word
                .replace(',', ".")
                .parse::<f64>()
                .ok()
                .filter(|number| number.is_finite() || name == "nodata_value")
                .ok_or_else(|| {
                    let problem = format!("{name}: a number is needed, and not '{}'", shown(word));
                    TopographyError::Line { line, problem }
                })?;
            known.push((name, number));
        }
        // Refuse a text without any line of a header, and name the formats that such a text may have.
        let lines = known.len();
        if lines == 0 {
            let advice = "give points x, y and z the extension xyz, and rows of heights txt";
            return Err(format_error(
                1,
                &format!("none of these; {advice}; {FORMATS}"),
            ));
        }
        Ok(Self { known, lines })
    }

    /// The number behind a name; `None` if the header does not have it.
    fn number_of(&self, name: &str) -> Option<f64> {
        let found = self.known.iter().find(|(known, _)| known == name);
        found.map(|(_, number)| *number)
    }

    /// The number of the first of the `names` that the header has.
    fn required(&self, names: &[&str]) -> Result<f64, TopographyError> {
        let found = names.iter().find_map(|name| self.number_of(name));
        found.ok_or_else(|| format_error(1, &format!("no {}", names[0])))
    }
}
