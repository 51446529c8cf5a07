//! A text of one line of heights for each y, and what looks like one and is none.

use super::grid::Axis;
use super::header::Stated;
use super::text::{Sheet, is_comment, text_of};
use super::{FORMATS, LateralUnit, Memory, Topography, TopographyError};

/// Part by which the spacing that is given may be off from that of a size that is rounded in the head of a file.
const SIZE_ROUNDING: f64 = 0.01;
/// Part of their distance by which coordinates that were rounded may be off, in at least `MANY` of them.
const LABEL_ROUNDING: f64 = 0.3;
const MANY: usize = 8;
/// Coordinates that are fewer are compared with this tolerance.
const EXACT: f64 = 1e-6;
/// Numbers that are no longer a line by accident.
const FEWEST: usize = 4;
/// Columns of a list of points: x, y, z and what scanners add, as colours and normals.
const MOST_COLUMNS_OF_POINTS: usize = 10;

pub(super) fn read(
    contents: &[u8],
    spacing: Option<[f64; 2]>,
    memory: Memory,
) -> Result<Topography, TopographyError> {
    memory.holds_text(contents)?;
    let text = text_of(contents);
    let sheet = Sheet::of(&text)?;
    let found = rows(&text, &sheet, spacing);
    found.map_err(|error| match error {
        // Above the rows stands something that no text of rows needs.
        TopographyError::Line { line, problem } if sheet.skipped().is_some() => {
            let problem = format!("{problem}; {FORMATS}");
            TopographyError::Line { line, problem }
        }
        other => other,
    })
}

fn rows(
    text: &str,
    sheet: &Sheet<'_>,
    spacing: Option<[f64; 2]>,
) -> Result<Topography, TopographyError> {
    check_blocks(text, sheet)?;
    // The spacing has no unit but metres.
    let stated = Stated {
        lateral: None,
        ..Stated::of(&sheet.head)?
    };
    let mut heights = Vec::new();
    sheet.for_each_row(|_, _, numbers| {
        heights.extend_from_slice(numbers);
        Ok(())
    })?;
    let shape @ [_, columns] = [sheet.rows.len(), sheet.width()];
    let first = sheet.rows[0].0;
    if let Some(problem) = no_heights(&heights, columns) {
        return Err(TopographyError::Line {
            line: first,
            problem,
        });
    }
    let spacing = spacing_of(shape, &stated, spacing)?;
    let unit = stated.heights.as_ref().map_or(1.0, |(unit, _)| *unit);
    let mut surface = Topography::of_rows(shape, spacing, heights).scaled(unit);
    surface.states_unit = stated.heights.is_some();
    surface.lateral_unit = LateralUnit::Stated;
    surface.notes.extend(sheet.skipped());
    surface.notes.extend(stated.note());
    Ok(surface)
}

/// Refuses a second block of heights, behind an empty line, a comment or both, as of a second channel. Files may have an empty
/// line or a comment above every line.
fn check_blocks(text: &str, sheet: &Sheet<'_>) -> Result<(), TopographyError> {
    let pairs = sheet.rows.windows(2);
    let begins = pairs.filter(|pair| pair[1].0 - pair[0].0 > 1);
    let begins: Vec<usize> = begins.map(|pair| pair[1].0).collect();
    if begins.is_empty() || begins.len() + 1 == sheet.rows.len() {
        return Ok(());
    }
    let line = begins[0];
    let between = text.lines().take(line - 1).collect::<Vec<_>>();
    let names = between
        .iter()
        .rev()
        .take_while(|line| line.trim().is_empty() || is_comment(line));
    let name = names.filter(|line| !line.trim().is_empty()).last();
    let name = name.map_or(String::new(), |name| {
        format!(" ('{}')", super::text::shown(name.trim()))
    });
    let problem = format!(
        "a second block of heights begins{name}: a file of one channel is needed, without empty lines between its rows"
    );
    Err(TopographyError::Line { line, problem })
}

/// The spacing that is given, or that of the size in the head of the file.
fn spacing_of(
    [rows, columns]: [usize; 2],
    stated: &Stated,
    given: Option<[f64; 2]>,
) -> Result<[f64; 2], TopographyError> {
    let of_size = stated
        .size
        .map(|[x, y]| [x / columns as f64, y / rows as f64]);
    match (given, of_size) {
        (Some(given), Some(of_size)) => {
            let is_off = |axis: usize| (given[axis] / of_size[axis] - 1.0).abs() > SIZE_ROUNDING;
            if is_off(0) || is_off(1) {
                let ([x, y], [dx, dy]) = (of_size, given);
                let problem = format!(
                    "the head of the file states a size that makes it {x:.4e} m and {y:.4e} m, and not {dx:.4e} m and {dy:.4e} m; \
                     leave it out, or correct the file"
                );
                return Err(TopographyError::Spacing { problem });
            }
            Ok(given)
        }
        (Some(spacing), None) | (None, Some(spacing)) => Ok(spacing),
        (None, None) => Err(TopographyError::without_spacing()),
    }
}

/// Why numbers in rows are no heights of a grid; `None` if nothing says so.
fn no_heights(heights: &[f64], columns: usize) -> Option<String> {
    let rows: Vec<&[f64]> = heights.chunks_exact(columns).collect();
    let is_empty = |row: &&[f64]| row.last().is_some_and(|height| height.is_nan());
    if columns > 1 && rows.iter().all(is_empty) {
        return Some(
            "every line ends with an empty cell: leave out the last separators".to_owned(),
        );
    }
    if is_list_of_points(&rows, columns) {
        return Some(format!(
            "a list of points, x, y and {}, and no grid of heights: give the file the extension xyz, with three columns",
            if columns == 3 { "z" } else { "more" }
        ));
    }
    let column = |at: usize| rows.iter().map(|row| row[at]).collect::<Vec<f64>>();
    // The corner of two axes is no part of them.
    let along_x: Vec<Vec<f64>> = rows.iter().map(|row| row[1..].to_vec()).collect();
    let along_y: Vec<Vec<f64>> = (0..columns).map(|at| column(at)[1..].to_vec()).collect();
    let problem = match [are_labelled(&along_x), are_labelled(&along_y)] {
        [true, true] => "the first row and the first column are an index or axes, and no heights",
        [true, false] => "the first row is an index or an axis, and no heights",
        [false, true] => "the first column is an index or an axis, and no heights",
        [false, false] => return None,
    };
    Some(format!(
        "{problem}: leave them out, as pandas does with to_csv(index=False, header=False), and give the distances as spacing"
    ))
}

/// Whether the first of some lines of numbers counts the others' places in equal steps, which those themselves do not.
fn are_labelled(lines: &[Vec<f64>]) -> bool {
    let [first, second, others @ ..] = lines else {
        return false;
    };
    let is_last = others.last().is_some_and(|last| counts(last));
    let counting = others.iter().filter(|line| counts(line)).count();
    counts(first) && !counts(second) && !is_last && 2 * counting <= others.len()
}

/// Whether numbers go up or down in equal steps.
fn counts(numbers: &[f64]) -> bool {
    let n = numbers.len();
    if n < FEWEST {
        return false;
    }
    let step = (numbers[n - 1] - numbers[0]) / (n - 1) as f64;
    let tolerance = if n < MANY { EXACT } else { LABEL_ROUNDING } * step.abs();
    let miss = |(place, number): (usize, &f64)| (number - numbers[0] - place as f64 * step).abs();
    // NaN misses.
    step != 0.0
        && numbers
            .iter()
            .enumerate()
            .map(miss)
            .all(|miss| miss <= tolerance)
}

/// Whether the first two of three or more columns are the places of a grid.
fn is_list_of_points(rows: &[&[f64]], columns: usize) -> bool {
    if !(3..=MOST_COLUMNS_OF_POINTS).contains(&columns) || rows.len() < FEWEST {
        return false;
    }
    let axes = [0, 1].map(|axis| {
        let values: Vec<f64> = rows.iter().map(|row| row[axis]).collect();
        let are_known = values.iter().all(|value| value.is_finite());
        are_known.then(|| Axis::of(values, 0).ok()).flatten()
    });
    let [Some(x), Some(y)] = axes else {
        return false;
    };
    let points = x.count.saturating_mul(y.count);
    points >= rows.len() && points <= rows.len() + rows.len() / 2
}
