//! The area of a contact, from the elements that are in contact.

use std::f64::consts::{LN_2, PI};

use crate::elements::bounds::Bounds;
use crate::elements::mirror::Mirror;

/// Part of an element by which counted areas are too large for each edge between an element in contact and one that is not,
/// in the mean over the directions of the outline (Yastrebov, Anciaux & Molinari 2017).
pub(crate) const EXCESS_PER_EDGE: f64 = (PI - 1.0 + LN_2) / 24.0;

/// So many elements in contact with so many edges to others, less the excess at these edges, in elements; above half of
/// their number.
pub(crate) fn less_excess(count: usize, edges: usize) -> f64 {
    count as f64 - EXCESS_PER_EDGE * edges as f64
}

/// The area of a contact that repeats itself.
pub(crate) struct OfPeriod {
    /// As a part of the period.
    pub(crate) area: f64,
    /// What was taken from that of the elements in contact, likewise.
    #[cfg_attr(
        not(feature = "rough"),
        expect(dead_code, reason = "it is for the bars of rough surfaces")
    )]
    pub(crate) excess: f64,
}

/// Of pressures in rows of so many elements.
pub(crate) fn of_period(columns: usize, pressure: &[f64]) -> OfPeriod {
    let n = pressure.len();
    let inside = |element: usize| pressure[element] > 0.0;
    let [mut count, mut edges] = [0; 2];
    for element in 0..n {
        let row = element / columns * columns;
        let neighbours = [(element + columns) % n, row + (element + 1 - row) % columns];
        count += usize::from(inside(element));
        let differs = |other: &usize| inside(*other) != inside(element);
        edges += neighbours.into_iter().filter(differs).count();
    }
    let area = less_excess(count, edges) / n as f64;
    OfPeriod {
        area,
        excess: count as f64 / n as f64 - area,
    }
}

/// The area of the elements with load in a box, and of their images, in elements; the field begins at its mirrors.
pub(crate) fn in_elements(loads: &[f64], bounds: &Bounds, mirrors: [Mirror; 2]) -> f64 {
    let [rows, columns] = bounds.shape();
    let has_load = |row: usize, column: usize| {
        row < rows && column < columns && loads[row * columns + column] > 0.0
    };
    let [mut count, mut edges] = [0; 2];
    for (row, column) in (0..loads.len()).map(|index| (index / columns, index % columns)) {
        if !has_load(row, column) {
            continue;
        }
        let is_first = [bounds.lower[0] + row == 0, bounds.lower[1] + column == 0];
        let images = [0, 1].map(|axis| match mirrors[axis] {
            Mirror::Centre if is_first[axis] => 1,
            other => pairs(other),
        });
        count += images[0] * images[1];
        // Before the first element in front of a mirror lies its image or itself.
        let before = [
            has_load(row.wrapping_sub(1), column),
            has_load(row, column.wrapping_sub(1)),
        ];
        let after = [has_load(row + 1, column), has_load(row, column + 1)];
        for axis in 0..2 {
            let at_mirror = is_first[axis] && !mirrors[axis].is_none();
            let ends = usize::from(!before[axis] && !at_mirror) + usize::from(!after[axis]);
            edges += ends * pairs(mirrors[axis]) * images[1 - axis];
        }
    }
    less_excess(count, edges)
}

/// How often an edge between two elements in front of a mirror is there.
const fn pairs(mirror: Mirror) -> usize {
    if mirror.is_none() { 1 } else { 2 }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::elements::mirror::NO_MIRRORS;

    /// Five rows of seven columns in contact, with one hole: 34 elements, 24 edges outside and 4 inside.
    #[test]
    fn the_part_in_front_of_mirrors_has_the_area_of_the_whole() {
        let field = |[rows, columns]: [usize; 2], hole: usize| {
            let mut loads = vec![1.0; rows * columns];
            loads[hole] = 0.0;
            (loads, [rows, columns])
        };
        let expected = less_excess(34, 28);
        let cases = [
            (field([5, 7], 17), NO_MIRRORS),
            (field([3, 7], 3), [Mirror::Centre, Mirror::None]),
            (field([5, 4], 8), [Mirror::None, Mirror::Centre]),
            (field([3, 4], 0), [Mirror::Centre; 2]),
        ];
        for ((loads, upper), mirrors) in cases {
            let bounds = Bounds {
                lower: [0; 2],
                upper,
            };
            let area = in_elements(&loads, &bounds, mirrors);
            assert!((area - expected).abs() < 1e-12, "{mirrors:?}: {area}");
        }
        // About edges, in a box that does not begin at the mirror along y: two bars of 8 × 2 elements.
        let bounds = Bounds {
            lower: [0, 1],
            upper: [4, 3],
        };
        let area = in_elements(&[1.0; 8], &bounds, [Mirror::Edge; 2]);
        assert!((area - less_excess(32, 40)).abs() < 1e-12, "{area}");
    }
}
