//! Esri's ASCII grid: names and numbers, then the heights in rows.

use super::text::{Notation, lines, shown, text_of};
use super::{FORMATS, LateralUnit, Memory, Topography, TopographyError};
use numerics::whole_part;

const DEFAULT_MISSING: f64 = -9999.0;
/// Markers of missing heights beyond it are the least or largest number of f32, with as many digits as a writer likes.
const LARGEST_HEIGHT: f64 = 1e30;

const NAMES: [&str; 10] = [
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

pub(super) fn read(contents: &[u8], memory: Memory) -> Result<Topography, TopographyError> {
    memory.holds_text(contents)?;
    let text = text_of(contents);
    let head = Head::of(&text)?;
    let [columns, rows] = [head.needed(&["ncols"])?, head.needed(&["nrows"])?];
    let spacing = [
        head.needed(&["cellsize", "dx"])?,
        head.needed(&["cellsize", "dy"])?,
    ];
    let missing = head.number("nodata_value").unwrap_or(DEFAULT_MISSING);
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
    check_lengths(&lengths, [columns, rows])?;
    let last = lengths.last().map_or(head.lines.max(1), |(line, _)| *line);
    if [columns, rows].iter().any(|count| count.fract() != 0.0)
        || columns * rows - heights.len() as f64 != 0.0
    {
        let count = heights.len();
        return Err(wrong(
            last,
            &format!("{count} heights for {columns} × {rows} points"),
        ));
    }
    let shape = [rows, columns].map(whole_part);
    let mut surface = Topography::of_rows(shape, spacing, heights);
    surface.lateral_unit = LateralUnit::Unstated;
    Ok(surface)
}

fn wrong(line: usize, found: &str) -> TopographyError {
    let format = "an ASCII grid with ncols, nrows, cellsize and heights";
    let problem = format!("{format} is needed, but there is {found}");
    TopographyError::Line { line, problem }
}

fn is_missing(height: f64, marker: f64) -> bool {
    let is_same = height.to_bits() == marker.to_bits();
    let is_huge = |number: f64| number.abs() > LARGEST_HEIGHT;
    is_same || (is_huge(height) && is_huge(marker) && height.signum() == marker.signum())
}

/// Refuses rows that are longer than `ncols`, and equally long ones that are no parts of such a row, or as long as there are
/// rows, as where both were exchanged; else a row may go on in the next line.
fn check_lengths(
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

/// The names above the heights.
struct Head {
    known: Vec<(String, f64)>,
    /// Lines of names, of those that are neither empty nor comments.
    lines: usize,
}

impl Head {
    fn of(text: &str) -> Result<Self, TopographyError> {
        let mut known = Vec::new();
        for (line, text) in lines(text) {
            let mut words = text.split_whitespace();
            let name = words.next().unwrap_or_default().to_ascii_lowercase();
            if !NAMES.contains(&&*name) {
                break;
            }
            let word = words.next().unwrap_or_default();
            let number: Option<f64> = word.replace(',', ".").parse().ok();
            let number = number.filter(|number| number.is_finite() || name == "nodata_value");
            let number = number.ok_or_else(|| {
                let problem = format!("{name}: a number is needed, and not '{}'", shown(word));
                TopographyError::Line { line, problem }
            })?;
            known.push((name, number));
        }
        let lines = known.len();
        if lines == 0 {
            let advice = "give points x, y and z the extension xyz, and rows of heights txt";
            return Err(wrong(1, &format!("none of these; {advice}; {FORMATS}")));
        }
        Ok(Self { known, lines })
    }

    fn number(&self, name: &str) -> Option<f64> {
        let found = self.known.iter().find(|(known, _)| known == name);
        found.map(|(_, number)| *number)
    }

    /// The first of some names that is there.
    fn needed(&self, names: &[&str]) -> Result<f64, TopographyError> {
        let found = names.iter().find_map(|name| self.number(name));
        found.ok_or_else(|| wrong(1, &format!("no {}", names[0])))
    }
}
