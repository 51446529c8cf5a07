//! Search for the extent of the points of a surface that are lower than a given height.

/// Half widths of the smallest and the largest square that is searched, in units of the height. Chosen: an end near the largest
/// counts as infinite.
const SEARCH_HALF_WIDTHS: [f64; 2] = [1e-9, 1e60];
/// Ratio of the widths of two squares: the search ends when no lower point lies between a square and one wider by this ratio.
/// Chosen: parts that are farther out are missed.
const SEARCH_MARGIN: f64 = 1024.0;
/// Number of intervals of a search grid along each axis. Chosen: parts narrower than one of them may be missed.
const GRID_INTERVALS: i32 = 128;
/// Largest number of refined grids, each over twice the rectangle found on the previous one. Chosen.
const MAX_REFINEMENTS: usize = 40;

/// Ends `[[x_min, x_max], [y_min, y_max]]` of a rectangle, \[m].
type Rectangle = [[f64; 2]; 2];

/// The extent \[m] of the points that are lower than a height \[m]; see [`Surface::extent_below`](crate::Surface::extent_below).
pub(crate) fn search(height: f64, is_lower: impl Fn([f64; 2]) -> bool) -> Rectangle {
    if height.is_nan() || height <= 0.0 {
        return [[0.0; 2]; 2];
    }
    let [first, last] = SEARCH_HALF_WIDTHS.map(|half_width| half_width * height);
    // Search squares of growing width for points below the height, and return the tightened rectangle around them if it is
    // finite.
    let found = search_squares(&is_lower, [first, last]);
    let is_infinite = |end: f64| end.abs() > last / SEARCH_MARGIN;
    if !found.as_flattened().iter().copied().any(is_infinite) {
        return tighten(&is_lower, found);
    }
    // Replace ends that have reached the largest square by infinity.
    found.map(|[start, end]| {
        let spare = 4.0 / f64::from(GRID_INTERVALS) * (end - start);
        [start - spare, end + spare].map(|end| if is_infinite(end) { end / 0.0 } else { end })
    })
}

/// Bounding box of the lower points on grids over squares about the origin, each twice as wide as the previous one, from the
/// half width `first` to `last` \[m].
fn search_squares(is_lower: impl Fn([f64; 2]) -> bool, [first, last]: [f64; 2]) -> Rectangle {
    let mut found = [[-first, first]; 2];
    let mut half_width = first;
    // Go on while lower points were found within the margin, or none at all.
    let mut lower_at = if is_lower([0.0; 2]) { first } else { last };
    while half_width <= SEARCH_MARGIN * lower_at && half_width < last {
        let inner = bounding_box(&is_lower, [[-half_width, half_width]; 2]);
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

/// Bounding box of the lower points on grids that shrink to it, with a margin of two intervals.
///
/// The margin covers pointed ends between two grid points.
fn tighten(is_lower: impl Fn([f64; 2]) -> bool, mut rectangle: Rectangle) -> Rectangle {
    for _ in 0..MAX_REFINEMENTS {
        let searched = rectangle.map(|[start, end]| {
            let half = 0.5 * (end - start);
            [start - half, end + half]
        });
        let inner = bounding_box(&is_lower, searched);
        let before = rectangle;
        for axis in [0, 1] {
            let [start, end] = searched[axis];
            let spare = 2.0 * (end - start) / f64::from(GRID_INTERVALS);
            rectangle[axis] = [inner[axis][0] - spare, inner[axis][1] + spare];
        }
        let width = |[start, end]: [f64; 2]| end - start;
        let is_converged = |axis: usize| width(rectangle[axis]) > 0.9 * width(before[axis]);
        if is_converged(0) && is_converged(1) {
            break;
        }
    }
    rectangle
}

/// Bounding box of the origin and of the lower points of one grid over the rectangle `searched`.
fn bounding_box(is_lower: impl Fn([f64; 2]) -> bool, searched: Rectangle) -> Rectangle {
    let mut inner = [[0.0_f64; 2]; 2];
    for x in grid_coordinates(searched[0]) {
        for y in grid_coordinates(searched[1]) {
            if is_lower([x, y]) {
                for (ends, coordinate) in inner.iter_mut().zip([x, y]) {
                    *ends = [ends[0].min(coordinate), ends[1].max(coordinate)];
                }
            }
        }
    }
    inner
}

/// Coordinates \[m] of the points of a search grid along one axis, with both ends.
fn grid_coordinates([start, end]: [f64; 2]) -> impl Iterator<Item = f64> {
    (0..=GRID_INTERVALS).map(move |step| {
        let part = f64::from(step) / f64::from(GRID_INTERVALS);
        (1.0 - part) * start + part * end
    })
}
