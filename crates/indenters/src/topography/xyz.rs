//! Reader of rows of x, y and z in any order; points of the grid that are left out are missing.

use super::grid::{Axis, significant_digits};
use super::header::Stated;
use super::text::{Sheet, text_of};
use super::{LateralUnit, Memory, Topography, TopographyError};

/// Coordinates x and y of a point, and its height z, in the units of the file.
type Point = ([f64; 2], f64);

/// Reads a list of points x, y and z on a grid of equal spacing.
pub(super) fn read(contents: &[u8], memory: Memory) -> Result<Topography, TopographyError> {
    memory.require_text(contents)?;
    let text = text_of(contents);
    let sheet = Sheet::of(&text)?;
    let first = sheet.rows[0].0;
    let wrong = |line: usize, problem: String| TopographyError::Line { line, problem };
    if sheet.width() != 3 {
        let width = sheet.width();
        let problem = format!(
            "x, y and z are needed, but the lines have {width} numbers: leave out other columns and channels"
        );
        return Err(wrong(first, problem));
    }
    // Find the equally spaced grid along x and y on which the points lie.
    let stated = Stated::of(&sheet.head)?;
    let (points, digits) = read_points(&sheet)?;
    let axis = |which: usize, name: &str| {
        let values = points.iter().map(|(element, _)| element[which]).collect();
        let axis = Axis::of(values, digits[which]);
        axis.map_err(|found| {
            wrong(
                first,
                format!("equally spaced points are needed, but along {name} there are {found}"),
            )
        })
    };
    let axes = [axis(0, "x")?, axis(1, "y")?];
    // Put the heights on the grid, and apply the units.
    let heights = place_on_grid(axes, &points, &sheet, memory)?;
    let [x, y] = axes;
    let unit = stated.heights.as_ref().map_or(1.0, |(unit, _)| *unit);
    let lateral = stated.lateral.as_ref().map_or(1.0, |(unit, _)| *unit);
    let spacing = [x.step * lateral, y.step * lateral];
    let mut surface = Topography::of_rows([y.count, x.count], spacing, heights).scaled(unit);
    surface.states_unit = stated.heights.is_some();
    surface.lateral_unit = match (&stated.lateral, &stated.heights) {
        (Some(_), _) => LateralUnit::Stated,
        (None, Some(_)) => LateralUnit::Unstated,
        (None, None) => LateralUnit::AsHeights,
    };
    surface.notes.extend(sheet.skipped());
    surface.notes.extend(stated.note());
    Ok(surface)
}

/// Points of all lines, and the largest numbers of significant digits of x and of y.
fn read_points(sheet: &Sheet<'_>) -> Result<(Vec<Point>, [i32; 2]), TopographyError> {
    let (mut points, mut digits) = (Vec::new(), [0; 2]);
    sheet.for_each_row(|line, cells, numbers| {
        let &[x, y, z] = numbers else {
            return Ok(());
        };
        if x.is_nan() || y.is_nan() {
            let problem = "x and y are needed".to_owned();
            return Err(TopographyError::Line { line, problem });
        }
        for (digits, cell) in digits.iter_mut().zip(cells) {
            *digits = significant_digits(cell).max(*digits);
        }
        points.push(([x, y], z));
        Ok(())
    })?;
    Ok((points, digits))
}

/// Heights of the grid row by row, in the unit of the file; NaN without a point. Refuses points off the grid, two at one node, and a
/// grid of more than a hundred times as many nodes as points.
fn place_on_grid(
    [x, y]: [Axis; 2],
    points: &[Point],
    sheet: &Sheet<'_>,
    memory: Memory,
) -> Result<Vec<f64>, TopographyError> {
    let wrong = |index: usize, problem: String| {
        let line = sheet.rows[index].0;
        TopographyError::Line { line, problem }
    };
    // If less than one in a hundred nodes has a point, the points are scattered and form no grid.
    let n_elements = x.count.checked_mul(y.count);
    if n_elements.is_none_or(|n_elements| n_elements / 100 > points.len()) {
        let (count, [nx, ny]) = (points.len(), [x.count, y.count]);
        return Err(wrong(0, format!("{count} points of a grid of {nx} × {ny}")));
    }
    // Check that the heights of the grid fit into the memory that the points leave free.
    memory
        .require_heights(n_elements.and_then(|n_elements| n_elements.checked_add(points.len())))?;
    let element_at = |[at_x, at_y]: [f64; 2]| Some(y.node(at_y)? * x.count + x.node(at_x)?);
    let mut heights = vec![f64::NAN; x.count * y.count];
    // Put each point on its node, and refuse a second point on the same node.
    let mut is_there = vec![false; heights.len()];
    for (index, (at, height)) in points.iter().enumerate() {
        let [at_x, at_y] = at;
        let element = element_at(*at).ok_or_else(|| {
            let grid = format!("a grid of {:e} × {:e}", x.step, y.step);
            wrong(
                index,
                format!("a point at x = {at_x}, y = {at_y} beside {grid}"),
            )
        })?;
        if std::mem::replace(&mut is_there[element], true) {
            let before = points
                .iter()
                .position(|(at, _)| element_at(*at) == Some(element));
            let line = before.map_or(0, |before| sheet.rows[before].0);
            return Err(wrong(
                index,
                format!(
                    "the point at x = {at_x}, y = {at_y} stands in line {line} already: a file of one channel and one scan is \
                     needed, with each point once"
                ),
            ));
        }
        heights[element] = *height;
    }
    Ok(heights)
}
