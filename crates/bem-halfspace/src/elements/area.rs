//! Contact area from the active elements, with the perimeter correction of Yastrebov, Anciaux & Molinari (2017).

use std::f64::consts::{LN_2, PI};
use std::ops::Range;

use crate::elements::bounds::Bounds;
use crate::elements::mirror::Mirror;

/// Perimeter correction: mean excess of a counted area, in elements, per edge between an element in contact and one outside.
///
/// Derived as the mean over all directions of the contact boundary (Yastrebov, Anciaux & Molinari 2017).
pub(crate) const EXCESS_PER_EDGE: f64 = (PI - 1.0 + LN_2) / 24.0;

/// Area of `count` elements with `edges` edges to elements outside, after the perimeter correction, in areas of an element. It is more
/// than half of `count`, because an element has at most four such edges.
pub(crate) fn corrected_area(count: usize, edges: usize) -> f64 {
    count as f64 - EXCESS_PER_EDGE * edges as f64
}

/// Contact area of a periodic surface after the perimeter correction, as a fraction of the period.
pub(crate) struct AreaFraction {
    /// Corrected area as a fraction of the period.
    pub(crate) area: f64,
    /// Perimeter correction that was subtracted, as a fraction of the period.
    #[cfg_attr(
        not(feature = "rough"),
        expect(dead_code, reason = "it is for the error bars of rough surfaces")
    )]
    pub(crate) perimeter_correction: f64,
}

/// Contact area of a periodic, row-major pressure field with a number of columns: elements with a positive pressure are in contact.
pub(crate) fn area_fraction(columns: usize, pressure: &[f64]) -> AreaFraction {
    let n = pressure.len();
    let inside = |element: usize| pressure[element] > 0.0;
    // Each edge is counted once, from the element before it along x or y.
    let [mut count, mut edges] = [0; 2];
    for element in 0..n {
        let row = element / columns * columns;
        let neighbours = [(element + columns) % n, row + (element + 1 - row) % columns];
        count += usize::from(inside(element));
        let differs = |other: &usize| inside(*other) != inside(element);
        edges += neighbours.into_iter().filter(differs).count();
    }
    let area = corrected_area(count, edges) / n as f64;
    AreaFraction {
        area,
        perimeter_correction: count as f64 / n as f64 - area,
    }
}

/// Contact area of the loaded elements in a box and of their images, after the perimeter correction, in areas of an element.
///
/// `loads` are those of the box `bounds`, row-major. Mirrors are at the first row and column of the field in which the box lies.
pub(crate) fn area_in_elements(loads: &[f64], bounds: &Bounds, mirrors: [Mirror; 2]) -> f64 {
    let [rows, columns] = bounds.shape();
    let has_load = |row: usize, column: usize| {
        row < rows && column < columns && loads[row * columns + column] > 0.0
    };
    let [mut count, mut edges] = [0; 2];
    for (row, column) in (0..loads.len()).map(|index| (index / columns, index % columns)) {
        if !has_load(row, column) {
            continue;
        }
        // Count the images of the element along each axis, the element itself included.
        let is_first = [bounds.lower[0] + row == 0, bounds.lower[1] + column == 0];
        let images = [0, 1].map(|axis| match mirrors[axis] {
            Mirror::Centre if is_first[axis] => 1,
            other => multiplicity(other),
        });
        count += images[0] * images[1];
        // Count the edges to elements without load. The neighbour of the first element across a mirror is its image or the element
        // itself, so that it has load.
        let before = [
            has_load(row.wrapping_sub(1), column),
            has_load(row, column.wrapping_sub(1)),
        ];
        let after = [has_load(row + 1, column), has_load(row, column + 1)];
        for axis in 0..2 {
            let at_mirror = is_first[axis] && !mirrors[axis].is_none();
            let ends = usize::from(!before[axis] && !at_mirror) + usize::from(!after[axis]);
            edges += ends * multiplicity(mirrors[axis]) * images[1 - axis];
        }
    }
    corrected_area(count, edges)
}

/// Number of images of an edge between two elements of the symmetry-reduced domain, itself included.
const fn multiplicity(mirror: Mirror) -> usize {
    if mirror.is_none() { 1 } else { 2 }
}

/// Measure of the singularity of the pressure at the contact boundary: the ratio of the mean square load of the outermost
/// elements to that under a flat punch with the same force and area. It is at most 1, and 0 if no element is at the boundary.
///
/// Elements at the edge of a punch with a radius of a elements have √(a/2) times the mean load, from p = F/(2π a √(a² − r²)). Where the
/// pressure vanishes like a root they have √(1/a) times the mean load, so that the ratio is of the order 1/a². Loads are those of the
/// box `bounds`, row-major.
pub(crate) fn edge_singularity(loads: &[f64], bounds: &Bounds, mirrors: [Mirror; 2]) -> f64 {
    let [rows, columns] = bounds.shape();
    let load = |row: usize, column: usize| {
        if row < rows && column < columns {
            loads[row * columns + column]
        } else {
            0.0
        }
    };
    let at_mirror = [0, 1].map(|axis| bounds.lower[axis] == 0 && !mirrors[axis].is_none());
    // Add up the loads of all loaded elements, and the squared loads of those with a neighbour without load.
    let [mut count, mut sum] = [0.0; 2];
    let [mut edge_count, mut edge_squares] = [0.0; 2];
    for (row, column) in (0..loads.len()).map(|index| (index / columns, index % columns)) {
        let own_load = load(row, column);
        if own_load <= 0.0 {
            continue;
        }
        count += 1.0;
        sum += own_load;
        let is_inside = (row == 0 && at_mirror[0] || load(row.wrapping_sub(1), column) > 0.0)
            && (column == 0 && at_mirror[1] || load(row, column.wrapping_sub(1)) > 0.0)
            && load(row + 1, column) > 0.0
            && load(row, column + 1) > 0.0;
        if !is_inside {
            edge_count += 1.0;
            edge_squares += own_load * own_load;
        }
    }
    if edge_count == 0.0 {
        return 0.0;
    }
    // Compute the mean square load at the edge of a flat punch of the same force and area, with its radius in elements.
    let images = mirrors.iter().filter(|mirror| !mirror.is_none()).count();
    let radius = (count * f64::from(1_u32 << images) / PI).sqrt();
    let square_under_punch = 0.5 * radius * (sum / count).powi(2);
    (edge_squares / edge_count / square_under_punch).min(1.0)
}

/// Discretisation error of a counted contact area, in areas of an element: √(Σ L²) over all straight runs of L edges of its boundary.
///
/// Along a run the true boundary lies within half an element of the counted one, so that the area is off by at most L/2. The errors
/// of runs are independent, except where runs are images of each other: four sides of L edges that are displaced alike make 2 L,
/// which is the root of 4 L².
pub(crate) fn boundary_uncertainty(loads: &[f64], bounds: &Bounds, mirrors: [Mirror; 2]) -> f64 {
    let runs = boundary_runs(loads, bounds, mirrors, |_| 1.0);
    let squares = runs.iter().map(|run| run.weight * run.weight);
    squares.sum::<f64>().sqrt()
}

/// A straight run of edges of the boundary of a contact.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct BoundaryRun {
    /// Sum of a weight over the loaded elements of the run.
    pub(crate) weight: f64,
    /// True if the boundary turns to the same side at both ends of the run, as at an extremum of the smooth boundary. Elsewhere that passes
    /// from one side of the elements to the other along the run.
    pub(crate) is_extremum: bool,
}

/// Rows (axis 0) or columns of a box and of its images. Those behind a mirror, which is at the first one of the field, are negative.
pub(crate) fn unfolded_range(bounds: &Bounds, mirrors: [Mirror; 2], axis: usize) -> Range<isize> {
    let [lower, upper] = [bounds.lower, bounds.upper].map(|end| end[axis].cast_signed());
    match mirrors[axis] {
        Mirror::None => lower..upper,
        Mirror::Centre => 1 - upper..upper,
        Mirror::Edge => -upper..upper,
    }
}

/// Row-major index in a box of an element with signed indices, or of the element that it is the image of; `None` outside the box.
pub(crate) fn folded_index(
    bounds: &Bounds,
    mirrors: [Mirror; 2],
    index: [isize; 2],
) -> Option<usize> {
    let shape = bounds.shape();
    let [row, column] = [0, 1].map(|axis| {
        let folded = match mirrors[axis] {
            Mirror::Centre => index[axis].abs(),
            Mirror::Edge if index[axis] < 0 => -1 - index[axis],
            _ => index[axis],
        };
        // Beyond either end of the box the difference is no index, and is rejected below.
        (folded - bounds.lower[axis].cast_signed()).cast_unsigned()
    });
    (row < shape[0] && column < shape[1]).then(|| row * shape[1] + column)
}

/// All straight runs of the boundary of the loaded elements, those of mirror images included. `weight` takes the index of an element in
/// the box.
pub(crate) fn boundary_runs(
    loads: &[f64],
    bounds: &Bounds,
    mirrors: [Mirror; 2],
    weight: impl Fn(usize) -> f64,
) -> Vec<BoundaryRun> {
    let range = |axis: usize| unfolded_range(bounds, mirrors, axis);
    let loaded = |index: [isize; 2]| {
        folded_index(bounds, mirrors, index).filter(|index| loads[*index] > 0.0)
    };
    let mut runs = Vec::new();
    for axis in 0..2 {
        let at = |across: isize, along: isize| {
            loaded(if axis == 0 {
                [across, along]
            } else {
                [along, across]
            })
        };
        // Along each line of edges, a run ends where the side of the loaded element changes: at a concave corner if both elements beyond
        // the end are loaded, otherwise at a convex one.
        for line in range(axis).start..=range(axis).end {
            let pair = |along: isize| [at(line, along), at(line - 1, along)];
            let side = |along: isize| match pair(along) {
                [Some(_), None] => 1,
                [None, Some(_)] => -1,
                _ => 0_i8,
            };
            let is_concave = |along: isize| pair(along).iter().all(Option::is_some);
            let along = range(1 - axis);
            let mut first = along.start;
            while first < along.end {
                let own_side = side(first);
                let mut end = first + 1;
                while end < along.end && side(end) == own_side {
                    end += 1;
                }
                // Only an edge with a loaded element on exactly one side belongs to the boundary.
                if own_side != 0 {
                    let elements = (first..end).filter_map(|one| pair(one)[0].or(pair(one)[1]));
                    runs.push(BoundaryRun {
                        weight: elements.map(&weight).sum(),
                        is_extremum: is_concave(first - 1) == is_concave(end),
                    });
                }
                first = end;
            }
        }
    }
    runs
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
        let expected = corrected_area(34, 28);
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
            let area = area_in_elements(&loads, &bounds, mirrors);
            assert!((area - expected).abs() < 1e-12, "{mirrors:?}: {area}");
            // The boundary has two sides of 5 edges, two of 7 edges, and four single edges at the hole.
            let uncertainty = boundary_uncertainty(&loads, &bounds, mirrors);
            assert!(
                (uncertainty - 152_f64.sqrt()).abs() < 1e-12,
                "{mirrors:?}: {uncertainty}"
            );
        }
        // Test mirrors about edges in a box that does not begin at the mirror along y: two bars of 8 × 2 elements.
        let bounds = Bounds {
            lower: [0, 1],
            upper: [4, 3],
        };
        let area = area_in_elements(&[1.0; 8], &bounds, [Mirror::Edge; 2]);
        assert!((area - corrected_area(32, 40)).abs() < 1e-12, "{area}");
        let uncertainty = boundary_uncertainty(&[1.0; 8], &bounds, [Mirror::Edge; 2]);
        let expected = (4.0_f64 * (64.0 + 4.0)).sqrt();
        assert!((uncertainty - expected).abs() < 1e-12, "{uncertainty}");
    }
}
