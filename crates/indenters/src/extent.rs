//! Where a surface is lower than a given height.

/// Half width of the first square, and of the last, in units of the height.
const HALF_WIDTHS: [f64; 2] = [1e-9, 1e60];
/// The surface is nowhere lower outside a square when it is not up to so many times its width.
const MARGIN: f64 = 1024.0;
/// Intervals of a grid along each axis.
const INTERVALS: i32 = 128;
/// Grids at most, each over twice the rectangle that was found on the one before.
const GRIDS: usize = 40;

/// `[[x_min, x_max], [y_min, y_max]]`.
type Rectangle = [[f64; 2]; 2];

/// The extent of the points that are lower than a height; see [`Surface::extent_below`](crate::Surface::extent_below).
pub(crate) fn search(height: f64, is_lower: impl Fn([f64; 2]) -> bool) -> Rectangle {
    if height.is_nan() || height <= 0.0 {
        return [[0.0; 2]; 2];
    }
    let [first, last] = HALF_WIDTHS.map(|half_width| half_width * height);
    let found = on_squares(&is_lower, [first, last]);
    let endless = |end: f64| end.abs() > last / MARGIN;
    if !found.as_flattened().iter().copied().any(endless) {
        return tightened(&is_lower, found);
    }
    found.map(|[start, end]| {
        let spare = 4.0 / f64::from(INTERVALS) * (end - start);
        [start - spare, end + spare].map(|end| if endless(end) { end / 0.0 } else { end })
    })
}

/// Around the lower points on grids over squares about the origin, each of twice the width of the one before.
fn on_squares(is_lower: impl Fn([f64; 2]) -> bool, [first, last]: [f64; 2]) -> Rectangle {
    let mut found = [[-first, first]; 2];
    let mut half_width = first;
    let mut lower_at = if is_lower([0.0; 2]) { first } else { last };
    while half_width <= MARGIN * lower_at && half_width < last {
        let inner = around_lower(&is_lower, [[-half_width, half_width]; 2]);
        for (found, inner) in found.iter_mut().zip(inner) {
            *found = [found[0].min(inner[0]), found[1].max(inner[1])];
        }
        let mut ends = inner.as_flattened().iter();
        if ends.any(|end| end.abs() >= 0.5 * half_width) {
            lower_at = half_width;
        }
        half_width *= 2.0;
    }
    found
}

/// Around the lower points of ever finer grids, with two intervals to spare, for pointed ends between two points.
fn tightened(is_lower: impl Fn([f64; 2]) -> bool, mut rectangle: Rectangle) -> Rectangle {
    for _ in 0..GRIDS {
        let searched = rectangle.map(|[start, end]| {
            let half = 0.5 * (end - start);
            [start - half, end + half]
        });
        let inner = around_lower(&is_lower, searched);
        let before = rectangle;
        for axis in [0, 1] {
            let [start, end] = searched[axis];
            let spare = 2.0 * (end - start) / f64::from(INTERVALS);
            rectangle[axis] = [inner[axis][0] - spare, inner[axis][1] + spare];
        }
        let width = |[start, end]: [f64; 2]| end - start;
        let settled = |axis: usize| width(rectangle[axis]) > 0.9 * width(before[axis]);
        if settled(0) && settled(1) {
            break;
        }
    }
    rectangle
}

/// The rectangle around the origin and the lower points of a grid.
fn around_lower(is_lower: impl Fn([f64; 2]) -> bool, searched: Rectangle) -> Rectangle {
    let mut inner = [[0.0_f64; 2]; 2];
    for x in steps(searched[0]) {
        for y in steps(searched[1]) {
            if is_lower([x, y]) {
                for (ends, coordinate) in inner.iter_mut().zip([x, y]) {
                    *ends = [ends[0].min(coordinate), ends[1].max(coordinate)];
                }
            }
        }
    }
    inner
}

fn steps([start, end]: [f64; 2]) -> impl Iterator<Item = f64> {
    (0..=INTERVALS).map(move |step| {
        let part = f64::from(step) / f64::from(INTERVALS);
        (1.0 - part) * start + part * end
    })
}
