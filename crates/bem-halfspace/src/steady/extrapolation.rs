//! The limit of a sequence of refinements by √2, and how far it may be off.

/// The limit and its estimated error.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Limit {
    pub(super) value: f64,
    pub(super) error: f64,
}

impl Limit {
    /// Before anything is known.
    pub(super) const NONE: Self = Self {
        value: 0.0,
        error: f64::MAX,
    };

    /// Whether the error is small enough in relation to the value.
    pub(super) fn holds(&self, relative_error: f64) -> bool {
        self.error <= relative_error * self.value.abs()
    }
}

/// Extrapolates values on grids of which each has √2 times as many elements along a length as the one before.
///
/// The error of a grid falls with the spacing to the power `order`, and where that is below 1 with the power 1 next.
/// Each power is eliminated over a factor of two in the spacing. The error estimated is what the last refinement
/// changed, plus a quarter of what the last elimination did.
pub(super) fn extrapolate(values: &[f64], order: f64) -> Limit {
    let once = eliminate(values, order);
    let twice = eliminate(&once, 1.0);
    let [last_values, last_once] = [last(values), last(&once)];
    match (&twice[..], &once[..]) {
        ([.., before, value], _) if order < 1.0 => Limit {
            value: *value,
            error: (value - before).abs() + 0.25 * (value - last_once).abs(),
        },
        (_, [.., before, value]) => Limit {
            value: *value,
            error: (value - before).abs() + 0.25 * (value - last_values).abs(),
        },
        (_, [value]) => Limit {
            value: *value,
            error: (value - last_values).abs(),
        },
        _ => Limit {
            value: last_values,
            error: last_values.abs(),
        },
    }
}

/// Removes the error of one order from a sequence; two values are used up.
fn eliminate(values: &[f64], order: f64) -> Vec<f64> {
    // 2^order − 1, which is small for the sharpest cusps.
    let gain = (order * std::f64::consts::LN_2).exp_m1();
    values
        .windows(3)
        .map(|window| window[2] + (window[2] - window[0]) / gain)
        .collect()
}

fn last(values: &[f64]) -> f64 {
    values.last().copied().unwrap_or(0.0)
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Values whose limit is 3.
    fn sequence(orders: [f64; 2], length: i32) -> Vec<f64> {
        let spacing = |level: i32| 2.0_f64.powf(-0.5 * f64::from(level));
        (0..length)
            .map(|level| {
                3.0 - spacing(level).powf(orders[0]) + 0.2 * spacing(level).powf(orders[1])
            })
            .collect()
    }

    #[test]
    fn two_powers_are_eliminated() {
        let limit = extrapolate(&sequence([0.1, 1.0], 6), 0.1);
        assert!((limit.value - 3.0).abs() < 1e-12, "{limit:?}");
        assert!(limit.error > 0.0 && limit.error < 1.0, "{limit:?}");
    }

    #[test]
    fn the_error_covers_what_one_elimination_leaves() {
        for length in 3..9 {
            let limit = extrapolate(&sequence([1.5, 2.0], length), 1.5);
            let deviation = (limit.value - 3.0).abs();
            assert!(
                deviation < limit.error,
                "{length} values: {limit:?} instead of 3"
            );
        }
    }
}
