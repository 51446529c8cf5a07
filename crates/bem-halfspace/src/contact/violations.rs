//! How far the conditions of contact are violated.

use crate::contact::reductions::{larger, largest, lower, reduce, sum};

/// The largest violations, as lengths.
#[derive(Debug, Clone, Copy, Default)]
pub(super) struct Violations {
    /// Largest |gap| in the contact; NaN where numbers overflow.
    pub(super) gap: f64,
    /// Largest tension in the contact, as the displacement that it causes at its own element; a half of it where a mirror
    /// passes through.
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

    /// Those of two parts of a contact.
    pub(super) fn worst(self, other: Self) -> Self {
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

    /// Those in the contact, whose load causes the displacement `own_influence` at its own element each.
    pub(super) fn inside(
        residual: &[f64],
        [load, displacement]: [&[f64]; 2],
        own_influence: f64,
    ) -> Self {
        // Zero where all numbers are finite, else NaN; the extremes do not matter then.
        let spoiled = sum([residual], |[residual]| 0.0 * residual);
        let lowest_load = reduce([load], 0.0, |[load]| load, lower);
        let largest_load = largest([load], 0.0, |[load]| load);
        Self {
            gap: spoiled + largest([residual], 0.0, |[residual]| residual.abs()),
            tension: -own_influence * lowest_load,
            penetration: 0.0,
            deflection: largest([displacement], own_influence * largest_load, |[own]| own),
        }
    }
}
