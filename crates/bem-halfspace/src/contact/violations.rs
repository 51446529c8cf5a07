//! How far the conditions of contact are violated.

use std::ops::Range;

use crate::contact::contact_set::ContactSet;

/// The largest violations, as lengths.
#[derive(Debug, Clone, Copy, Default)]
pub(super) struct Violations {
    /// Largest |gap| in the contact; NaN where numbers overflow.
    pub(super) gap: f64,
    /// Largest tension in the contact, as the displacement that it causes at its own element.
    pub(super) tension: f64,
    /// Largest penetration outside the contact.
    pub(super) penetration: f64,
    /// Largest displacement in the contact.
    pub(super) deflection: f64,
}

impl Violations {
    /// The largest relative to the deflection; zero where there is neither, NaN where numbers overflow.
    pub(super) fn relative(&self) -> f64 {
        let largest = self.gap.max(self.tension).max(self.penetration);
        if self.gap.is_nan() {
            f64::NAN
        } else if largest == 0.0 {
            0.0
        } else {
            largest / self.deflection
        }
    }

    fn worst(self, other: Self) -> Self {
        let gap = if self.gap.is_nan() {
            self.gap
        } else {
            larger(self.gap, other.gap)
        };
        Self {
            gap,
            tension: larger(self.tension, other.tension),
            penetration: larger(self.penetration, other.penetration),
            deflection: larger(self.deflection, other.deflection),
        }
    }
}

/// A loaded surface under a body at some depth.
#[derive(Debug, Clone, Copy)]
pub(super) struct Surface<'a> {
    pub(super) separation: &'a [f64],
    pub(super) displacement: &'a [f64],
    pub(super) load: &'a [f64],
    pub(super) indentation_depth: f64,
    /// Displacement of an element under its own unit load.
    pub(super) self_influence: f64,
}

impl Surface<'_> {
    /// Stores the residual of the linear equations, minus the gap in the contact, and finds what is violated.
    pub(super) fn measure(&self, contact: &ContactSet, residual: &mut [f64]) -> Violations {
        let bands = contact.bands();
        let in_band = |band, [residual]: [&mut [f64]; 1]| {
            let first = bands.elements(band).start;
            let mut found = Violations::default();
            for run in contact.runs(band) {
                let residual = &mut residual[run.start - first..run.end - first];
                found = found.worst(self.measure_run(run, residual));
            }
            let lowest = contact.gaps(band).map(|gap| self.lowest(gap));
            let lowest = lowest.fold(f64::INFINITY, f64::min);
            found.penetration = larger(0.0, self.indentation_depth - lowest);
            found
        };
        bands.fold([residual], in_band, Violations::worst)
    }

    fn measure_run(&self, run: &Range<usize>, residual: &mut [f64]) -> Violations {
        let mut found = Violations::default();
        let mut not_a_number = false;
        let heights = self.separation[run.clone()]
            .iter()
            .zip(&self.displacement[run.clone()]);
        let elements = heights.zip(&self.load[run.clone()]).zip(residual);
        for (((separation, displacement), load), residual) in elements {
            let gap = separation + displacement - self.indentation_depth;
            not_a_number |= gap.is_nan();
            *residual = -gap;
            let own = load * self.self_influence;
            found.gap = larger(found.gap, gap.abs());
            found.tension = larger(found.tension, -own);
            found.deflection = larger(found.deflection, larger(*displacement, own));
        }
        if not_a_number {
            found.gap = f64::NAN;
        }
        found
    }

    fn lowest(&self, range: Range<usize>) -> f64 {
        lowest_sum(&self.separation[range.clone()], &self.displacement[range])
    }
}

/// The larger of two numbers of which none is NaN; faster than `f64::max`.
fn larger(left: f64, right: f64) -> f64 {
    if left > right { left } else { right }
}

/// The lowest sum of two heights each; several at a time, because one comparison would wait for the other.
fn lowest_sum(left: &[f64], right: &[f64]) -> f64 {
    const LANES: usize = 8;
    let (left, left_rest) = left.as_chunks::<LANES>();
    let (right, right_rest) = right.as_chunks::<LANES>();
    let mut lowest = [f64::INFINITY; LANES];
    for (left, right) in left.iter().zip(right) {
        for lane in 0..LANES {
            let sum = left[lane] + right[lane];
            lowest[lane] = if sum < lowest[lane] {
                sum
            } else {
                lowest[lane]
            };
        }
    }
    let rest = left_rest.iter().zip(right_rest).map(|(a, b)| a + b);
    lowest.into_iter().chain(rest).fold(f64::INFINITY, f64::min)
}
