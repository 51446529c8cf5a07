//! Test of the residuals of a fit for randomness, by their sign changes.

use super::system::{Measurement, Quantity};

/// Sign changes of residuals along frequency or time, isotherm by isotherm.
///
/// Independent noise changes its sign with the probability 1/2 (Geary 1970, Biometrika 57, 123).
#[derive(Debug, Clone, Copy, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize))]
pub struct SignChanges {
    /// Number of sign changes.
    pub found: u32,
    /// Largest possible number: that of neighbouring points.
    pub possible: u32,
}

/// Smallest distance of the number of sign changes below that expected of noise, which chance does not explain. Its unit is
/// the standard deviation. Chosen: in one of 30 000 curves noise alone exceeds it.
const CHANCE_STANDARD_DEVIATIONS: f64 = 4.0;

impl SignChanges {
    /// Whether there are too few sign changes for noise.
    ///
    /// The series then does not have the form of the data, or the isotherms do not lie on one curve.
    pub fn are_too_few(&self) -> bool {
        let possible = f64::from(self.possible);
        f64::from(self.found) < 0.5 * (possible - CHANCE_STANDARD_DEVIATIONS * possible.sqrt())
    }

    /// Sign changes of the residuals of one measured quantity, whose `rows` are by increasing frequency or time; `None` without
    /// measurements of it.
    pub(super) fn count(
        rows: &[Measurement],
        quantity: Quantity,
        residual: impl Fn(&Measurement) -> f64,
    ) -> Option<Self> {
        let of_quantity = rows.iter().filter(|row| row.quantity == quantity);
        let mut signs: Vec<(usize, bool)> = of_quantity
            .map(|row| (row.isotherm, residual(row) > 0.0))
            .collect();
        // The stable sort keeps the order of the frequencies within an isotherm.
        signs.sort_by_key(|(isotherm, _)| *isotherm);
        let mut changes = Self {
            found: 0,
            possible: 0,
        };
        for pair in signs.windows(2) {
            let (one, next) = (pair[0], pair[1]);
            if one.0 == next.0 {
                changes.possible += 1;
                changes.found += u32::from(one.1 != next.1);
            }
        }
        (!signs.is_empty()).then_some(changes)
    }
}
