//! Whether what a fit leaves of the data looks like noise.

use super::system::{Measurement, Quantity};

/// Changes of the sign of residuals along frequency or time, isotherm by isotherm, beside those of noise, which changes its sign every
/// other time (Geary 1970, Biometrika 57, 123).
#[derive(Debug, Clone, Copy, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize))]
pub struct SignChanges {
    /// How many there are.
    pub found: u32,
    /// How many there are from one point to the next at most.
    pub possible: u32,
}

/// Standard deviations below the number expected of noise from where on chance is no explanation.
const BY_CHANCE: f64 = 4.0;

impl SignChanges {
    /// Whether there are too few for noise: the series does not have the form of the data, or isotherms do not lie on one curve.
    pub fn are_too_few(&self) -> bool {
        let possible = f64::from(self.possible);
        f64::from(self.found) < 0.5 * (possible - BY_CHANCE * possible.sqrt())
    }

    /// Those of a modulus, with the residual of every row; none without rows.
    pub(super) fn of(
        rows: &[Measurement],
        quantity: Quantity,
        residual: impl Fn(&Measurement) -> f64,
    ) -> Option<Self> {
        let of_quantity = rows.iter().filter(|row| row.quantity == quantity);
        let mut signs: Vec<(usize, bool)> = of_quantity
            .map(|row| (row.isotherm, residual(row) > 0.0))
            .collect();
        // Within an isotherm the order of the frequencies stays.
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
