//! Rows of x, y and z in metres, in any order; points of the grid that are left out are missing.

use super::memory::Memory;
use super::text::{Notation, lines, text_of};
use super::{Topography, Unread};
use numerics::whole_part;

/// Part of a spacing by which a point may miss its place in the grid.
const MISS: f64 = 0.01;

pub(super) fn read(contents: &[u8], memory: Memory) -> Result<Topography, Unread> {
    memory.holds_text(contents)?;
    let text = text_of(contents);
    let notation = Notation::of(&text);
    let point = |(number, line): (usize, &str)| {
        let point = match notation.cells(line)[..] {
            [x, y, z] => notation
                .number(x)
                .zip(notation.number(y))
                .zip(notation.height(z)),
            _ => None,
        };
        let point = point.map(|((x, y), z)| [x, y, z]);
        point.ok_or_else(|| format!("line {number}: '{line:.40}'"))
    };
    let points: Vec<[f64; 3]> = lines(&text).map(point).collect::<Result<_, _>>()?;
    let axis = |which: usize| axis(points.iter().map(|point| point[which]).collect());
    let [(x, dx, nx), (y, dy, ny)] = [axis(0)?, axis(1)?];
    let places = nx.checked_mul(ny);
    if places.is_none_or(|places| places / 100 > points.len()) {
        let count = points.len();
        return Err(format!("{count} points of a grid of {nx} × {ny}").into());
    }
    // Beside the points themselves.
    memory.holds(places.and_then(|places| places.checked_add(points.len())))?;
    let mut heights = vec![f64::NAN; nx * ny];
    for [at_x, at_y, height] in points {
        let steps = [(at_x - x) / dx, (at_y - y) / dy];
        if steps.iter().any(|step| (step - step.round()).abs() > MISS) {
            return Err(
                format!("a point at x = {at_x}, y = {at_y} beside a grid of {dx} × {dy}").into(),
            );
        }
        let [column, row] = steps.map(|step| whole_part(step.round()));
        heights[row * nx + column] = height;
    }
    Ok(Topography::of_rows([ny, nx], [dx, dy], heights))
}

/// First of equally spaced coordinates, their distance and number.
fn axis(mut values: Vec<f64>) -> Result<(f64, f64, usize), String> {
    values.sort_by(f64::total_cmp);
    let ends = values.first().copied().zip(values.last().copied());
    let (first, last) = ends.ok_or("no points")?;
    let range = last - first;
    let steps = values.windows(2).map(|pair| pair[1] - pair[0]);
    let steps = steps.filter(|step| *step > 1e-6 * range);
    let smallest = steps.fold(range, f64::min);
    let count = (range / smallest).round();
    if !(range > 0.0 && count.is_finite()) {
        return Err(format!("coordinates from {first} to {last}"));
    }
    Ok((first, range / count, whole_part(count) + 1))
}
