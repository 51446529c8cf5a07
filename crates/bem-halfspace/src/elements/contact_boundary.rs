//! Where a contact ends between the elements of a grid, and how that changes with their loads and gaps.
//!
//! While a contact grows past the elements of a row, the load x of the last one inside rises from 0, and the gap g of the first one
//! beside it falls to 0, both linearly as long as all other elements stay where they are. The part
//!
//! ```text
//! s = x/(x + κ g)
//! ```
//!
//! of an element rises from 0 to 1 meanwhile, then the next element is the last one inside, with s = 0. Elements and parts of
//! elements together thus are an area that does not jump when elements change sides, whatever κ is, so that its derivative with the
//! elements where they are is that of the area up to what is different from place to place. With κ the ratio of the range of x to
//! that of g it is so at each place. This ratio belongs to the kernel k of the grid: in the unit 1/b, with the bend b = k₀ − (k₁ + k₋₁)/2
//! along the row, it lies between 0.3, where the pressure is singular, and 0.6, where it vanishes like a root.
//!
//! Rows know the whole area, and columns know it, too: each place counts with n_x² as one of a row, and with n_y² as one of a column,
//! where n is the normal.
//!
//! With the same parts, weighted with the square of the load (x + κ g) with which an element leaves the rim, the *growth* is the measure
//! of what elements leave undone: it is the product of a load and an adjoint load that both rise like this one.

/// The ratio κ times the bend of the kernel where many elements are at the rim, on which errors of it average out.
pub(crate) const LOAD_GAP_RATIO: f64 = 0.4;

/// Loads of the elements in contact and gaps of those beside it, on a box of elements.
pub(crate) struct BoundaryField {
    pub(crate) shape: [usize; 2],
    /// Whether an end of the box is the other one, too.
    pub(crate) is_periodic: bool,
    /// Δy/Δx.
    pub(crate) aspect: f64,
    pub(crate) inside: Vec<bool>,
    /// The load of an element in contact, and the gap of one beside it; not finite where it is not known.
    pub(crate) values: Vec<f64>,
}

/// The derivatives of one measure, per element, by the loads and gaps.
#[derive(Debug, Clone)]
pub(crate) struct BoundaryDerivatives {
    pub(crate) by_values: Vec<f64>,
    /// By the logarithm of the bend of the kernel along each axis.
    pub(crate) by_second_difference: [f64; 2],
}

/// How the contact changes at its rim.
#[derive(Debug, Clone)]
pub(crate) struct ContactBoundary {
    /// Of the number of elements in contact.
    pub(crate) area: BoundaryDerivatives,
    /// Of the growth, in a unit of its own.
    pub(crate) boundary_weight: BoundaryDerivatives,
}

/// An element in contact and the one beside it.
#[derive(Debug, Clone, Copy)]
pub(crate) struct BoundaryPair {
    pub(crate) inside: usize,
    pub(crate) outside: usize,
    pub(crate) axis: usize,
}

impl BoundaryDerivatives {
    fn none(n: usize) -> Self {
        Self {
            by_values: vec![0.0; n],
            by_second_difference: [0.0; 2],
        }
    }

    /// Adds the derivatives of x/(x + κ g) at a side, times (x + κ g)²/κ and a weight.
    fn add(&mut self, side: BoundaryPair, weight: f64, [load, gap]: [f64; 2]) {
        self.by_values[side.inside] += weight * gap;
        self.by_values[side.outside] -= weight * load;
        self.by_second_difference[side.axis] += weight * load * gap;
    }
}

impl ContactBoundary {
    /// With the ratio κ at each side.
    pub(crate) fn new(field: &BoundaryField, ratio: impl Fn(BoundaryPair) -> f64) -> Self {
        let mut rim = Self {
            area: BoundaryDerivatives::none(field.values.len()),
            boundary_weight: BoundaryDerivatives::none(field.values.len()),
        };
        for side in field.pairs() {
            let ratio = ratio(side);
            let [load, gap] = [side.inside, side.outside].map(|place| field.values[place]);
            let leaves = load + ratio * gap;
            // Gaps below 0 are errors of the solution.
            if leaves <= 0.0 {
                continue;
            }
            let part = field.part(side, ratio, leaves);
            rim.area
                .add(side, part * ratio / leaves.powi(2), [load, gap]);
            rim.boundary_weight.add(side, part * ratio, [load, gap]);
        }
        rim
    }
}

impl BoundaryField {
    /// All sides with a gap that is known.
    fn pairs(&self) -> impl Iterator<Item = BoundaryPair> {
        let inside = (0..self.values.len()).filter(|place| self.inside[*place]);
        inside.flat_map(move |inside| {
            let ways = [(0, true), (0, false), (1, true), (1, false)];
            ways.into_iter().filter_map(move |(axis, ahead)| {
                let outside = self.next(inside, axis, ahead)?;
                let is_rim = !self.inside[outside] && self.values[outside].is_finite();
                is_rim.then_some(BoundaryPair {
                    inside,
                    outside,
                    axis,
                })
            })
        })
    }

    fn next(&self, place: usize, axis: usize, ahead: bool) -> Option<usize> {
        let [rows, columns] = self.shape;
        let mut at = [place / columns, place % columns];
        let length = [rows, columns][axis];
        at[axis] = match (ahead, at[axis]) {
            (true, last) if last + 1 == length => self.is_periodic.then_some(0)?,
            (true, here) => here + 1,
            (false, 0) => self.is_periodic.then_some(length - 1)?,
            (false, here) => here - 1,
        };
        Some(at[0] * columns + at[1])
    }

    /// The square of the part of the normal along the axis of a side, of the field that is x inside and −κ g beside.
    fn part(&self, side: BoundaryPair, ratio: f64, leaves: f64) -> f64 {
        let along = |place: usize| {
            let value = |place: usize| match self.values[place] {
                value if self.inside[place] => value,
                value => -ratio * value,
            };
            let beside = |ahead| {
                let next = self.next(place, 1 - side.axis, ahead).map(value);
                next.filter(|value| value.is_finite())
            };
            match (beside(true), beside(false)) {
                (Some(next), Some(before)) => 0.5 * (next - before),
                (Some(next), None) => next - value(place),
                (None, Some(before)) => value(place) - before,
                (None, None) => 0.0,
            }
        };
        let tangent = 0.5 * (along(side.inside) + along(side.outside));
        // Per length: steps along x are 1 long, and those along y as the aspect has it.
        let steps = [1.0, self.aspect];
        let squares = [
            (leaves / steps[side.axis]).powi(2),
            (tangent / steps[1 - side.axis]).powi(2),
        ];
        squares[0] / (squares[0] + squares[1])
    }
}

#[cfg(test)]
mod tests {
    use std::f64::consts::PI;

    use super::*;

    /// A disc of so many elements as its radius, on elements of this aspect, whose loads fall by 1 from one row to the next at the rim.
    fn disc(radius: f64, centre: f64, aspect: f64) -> BoundaryField {
        let shape = [40, 60];
        let height = |place: usize| {
            let x = (place / shape[1]) as f64 - 20.0 - centre;
            let y = ((place % shape[1]) as f64 - 30.0 - centre) * aspect;
            (radius * radius - x * x - y * y) / (2.0 * radius)
        };
        let heights: Vec<f64> = (0..shape[0] * shape[1]).map(height).collect();
        let value = |height: &f64| match *height {
            height if height > 0.0 => height,
            height => -height / LOAD_GAP_RATIO,
        };
        BoundaryField {
            shape,
            is_periodic: false,
            aspect,
            inside: heights.iter().map(|height| *height > 0.0).collect(),
            values: heights.iter().map(value).collect(),
        }
    }

    /// The change of a measure when all loads grow, and all gaps fall, like those of a disc of a larger radius.
    fn grown(field: &BoundaryField, measure: &BoundaryDerivatives) -> f64 {
        let pairs = measure.by_values.iter().zip(&field.inside);
        let changes = pairs
            .map(|(by_value, inside)| by_value * if *inside { 1.0 } else { -1.0 / LOAD_GAP_RATIO });
        changes.sum()
    }

    #[test]
    fn rows_and_columns_together_know_the_area_of_a_disc() {
        for aspect in [0.6, 1.0] {
            for (radius, centre) in [(14.3, 0.0), (15.0, 0.5), (16.1, 0.21)] {
                let field = disc(radius, centre, aspect);
                let rim = ContactBoundary::new(&field, |_| LOAD_GAP_RATIO);
                let got = grown(&field, &rim.area);
                let expected = 2.0 * PI * radius / aspect;
                assert!(
                    (got / expected - 1.0).abs() < 0.02,
                    "{got} instead of {expected}"
                );
            }
        }
    }

    /// The sum of the parts does not jump when an element changes sides, and rises by 1 from one to the next.
    #[test]
    fn one_element_after_the_other_comes_into_contact() {
        const STEPS: usize = 100;
        let row = |load: f64| BoundaryField {
            shape: [4, 1],
            is_periodic: false,
            aspect: 1.0,
            inside: vec![false, true, false, false],
            values: vec![f64::NAN, load, (1.0 - load) / LOAD_GAP_RATIO, f64::INFINITY],
        };
        let changes = (0..STEPS).map(|step| {
            let field = row((step as f64 + 0.5) / STEPS as f64);
            grown(
                &field,
                &ContactBoundary::new(&field, |_| 2.0 * LOAD_GAP_RATIO).area,
            ) / STEPS as f64
        });
        let whole: f64 = changes.sum();
        assert!((whole - 1.0).abs() < 1e-3, "{whole}");
    }

    #[test]
    fn a_box_that_wraps_has_no_ends() {
        let mut field = BoundaryField {
            shape: [2, 3],
            is_periodic: true,
            aspect: 1.0,
            inside: vec![true, false, false, true, false, false],
            values: vec![1.0, 2.0, 2.0, 1.0, 2.0, 2.0],
        };
        assert_eq!(field.pairs().count(), 4);
        field.is_periodic = false;
        assert_eq!(field.pairs().count(), 2);
    }
}
