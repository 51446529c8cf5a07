//! Reader of a text with one line of heights per y, with checks for labels, lists of points and several blocks.

use super::grid::Axis;
use super::header::Stated;
use super::text::{Sheet, is_comment, text_of};
use super::{FORMATS, LateralUnit, Memory, Topography, TopographyError};

/// Largest relative difference between the given spacing and that of the size in the header. Chosen, because the header is
/// rounded.
const SPACING_TOLERANCE: f64 = 0.01;
/// Largest ratio of the deviation of a rounded label from equal spacing to the spacing. Chosen: labels that are rounded by
/// half a spacing may coincide.
const ROUNDED_LABEL_TOLERANCE: f64 = 0.3;
/// Number of labels from which they may be rounded. Chosen: of fewer numbers some are equally spaced within the larger tolerance
/// by chance.
const MIN_ROUNDED_LABELS: usize = 8;
/// Largest ratio of the deviation of fewer than [`MIN_ROUNDED_LABELS`] labels from equal spacing to the spacing. Chosen:
/// practically none.
const EXACT_LABEL_TOLERANCE: f64 = 1e-6;
/// Smallest number of equally spaced numbers that count as labels and not as a coincidence. Chosen: two numbers are always
/// equally spaced, and three often.
const MIN_LABELS: usize = 4;
/// Largest number of columns with which rows may be a list of points. Chosen: x, y, z, and colours and normals that scanners add.
const MAX_POINT_COLUMNS: usize = 10;

/// Reads rows of heights, with a spacing that is given or stated in the text.
pub(super) fn read(
    contents: &[u8],
    spacing: Option<[f64; 2]>,
    memory: Memory,
) -> Result<Topography, TopographyError> {
    memory.require_text(contents)?;
    let text = text_of(contents);
    let sheet = Sheet::of(&text)?;
    check_names(&sheet)?;
    let found = read_rows(&text, &sheet, spacing);
    found.map_err(|error| match error {
        // Skipped lines above the rows suggest another format.
        TopographyError::Line { line, problem } if sheet.skipped().is_some() => {
            let problem = format!("{problem}; {FORMATS}");
            TopographyError::Line { line, problem }
        }
        other => other,
    })
}

/// Reads the rows of a sheet as heights, with a `spacing` along x and y \[m] that is given, or stated in the lines above them.
fn read_rows(
    text: &str,
    sheet: &Sheet<'_>,
    spacing: Option<[f64; 2]>,
) -> Result<Topography, TopographyError> {
    check_single_block(text, sheet)?;
    // A unit of x and y has no effect: the spacing is given in metres.
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
    if let Some(problem) = reason_for_refusal(&heights, columns) {
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

/// Refuses a second block of heights after an empty line or a comment, as of a second channel.
///
/// An empty line or a comment between all rows is allowed.
fn check_single_block(text: &str, sheet: &Sheet<'_>) -> Result<(), TopographyError> {
    // Rows that do not follow the row before them begin a block.
    let pairs = sheet.rows.windows(2);
    let begins = pairs.filter(|pair| pair[1].0 - pair[0].0 > 1);
    let begins: Vec<usize> = begins.map(|pair| pair[1].0).collect();
    if begins.is_empty() || begins.len() + 1 == sheet.rows.len() {
        return Ok(());
    }
    // Name the block by the first of the comments above it.
    let line = begins[0];
    let between = text.lines().take(line - 1).collect::<Vec<_>>();
    let name = between
        .iter()
        .rev()
        .take_while(|line| line.trim().is_empty() || is_comment(line))
        .filter(|line| !line.trim().is_empty())
        .last()
        .map_or(String::new(), |name| {
            format!(" ('{}')", super::text::shown(name.trim()))
        });
    let problem = format!(
        "a second block of heights begins{name}: a file of one channel is needed, without empty lines between its rows"
    );
    Err(TopographyError::Line { line, problem })
}

/// Refuses columns with names: those of a table of measurements or results.
fn check_names(sheet: &Sheet<'_>) -> Result<(), TopographyError> {
    let Some((line, names)) = sheet.names_of_columns() else {
        return Ok(());
    };
    let [first, other] = names.map(super::text::shown);
    let problem = format!(
        "the columns have the names '{first}' and '{other}': this is a table of measurements or results, and columns of heights have no \
         names"
    );
    Err(TopographyError::Line { line, problem })
}

/// The given spacing, or that of the size in the header of the file, \[m].
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
            let is_off =
                |axis: usize| (given[axis] / of_size[axis] - 1.0).abs() > SPACING_TOLERANCE;
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

/// Reason for which numbers in rows are not heights of a grid; `None` if there is none.
fn reason_for_refusal(heights: &[f64], columns: usize) -> Option<String> {
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
    // Compare rows and columns without the corner, which belongs to neither axis.
    let along_x: Vec<Vec<f64>> = rows.iter().map(|row| row[1..].to_vec()).collect();
    let along_y: Vec<Vec<f64>> = (0..columns).map(|at| column(at)[1..].to_vec()).collect();
    let problem = match [first_is_label(&along_x), first_is_label(&along_y)] {
        [true, true] => "the first row and the first column are an index or axes, and no heights",
        [true, false] => "the first row is an index or an axis, and no heights",
        [false, true] => "the first column is an index or an axis, and no heights",
        [false, false] => return None,
    };
    Some(format!(
        "{problem}: leave them out, as pandas does with to_csv(index=False, header=False), and give the distances as spacing"
    ))
}

/// Whether the first of some lines is a label: its numbers are equally spaced, and those of most other lines are not.
fn first_is_label(lines: &[Vec<f64>]) -> bool {
    let [first, second, others @ ..] = lines else {
        return false;
    };
    // Compare other lines, because all lines of a tilted surface are equally spaced.
    let is_last = others.last().is_some_and(|last| is_equally_spaced(last));
    let n_equally_spaced = others.iter().filter(|line| is_equally_spaced(line)).count();
    is_equally_spaced(first)
        && !is_equally_spaced(second)
        && !is_last
        && 2 * n_equally_spaced <= others.len()
}

/// Whether numbers increase or decrease in equal steps, within the tolerance of labels; false for fewer than [`MIN_LABELS`].
fn is_equally_spaced(numbers: &[f64]) -> bool {
    let n = numbers.len();
    if n < MIN_LABELS {
        return false;
    }
    let step = (numbers[n - 1] - numbers[0]) / (n - 1) as f64;
    let tolerance = if n < MIN_ROUNDED_LABELS {
        EXACT_LABEL_TOLERANCE
    } else {
        ROUNDED_LABEL_TOLERANCE
    } * step.abs();
    let deviation =
        |(place, number): (usize, &f64)| (number - numbers[0] - place as f64 * step).abs();
    // The comparison is written so that it is false for NaN.
    step != 0.0
        && numbers
            .iter()
            .enumerate()
            .map(deviation)
            .all(|deviation| deviation <= tolerance)
}

/// Whether the first two of three or more columns are coordinates of a grid.
fn is_list_of_points(rows: &[&[f64]], columns: usize) -> bool {
    if !(3..=MAX_POINT_COLUMNS).contains(&columns) || rows.len() < MIN_LABELS {
        return false;
    }
    // Coordinates are those of points if the grid that they span is mostly occupied.
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
