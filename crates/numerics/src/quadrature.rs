//! Integrals over an interval whose ends may carry an integrable singularity.
//!
//! The double-exponential rule: the substitution `x = tanh(π/2 sinh t)` moves the ends of the interval to infinity, where
//! the trapezoidal rule converges exponentially (Takahasi & Mori 1974, Publ. RIMS 9, 721).

use std::f64::consts::FRAC_PI_2;

use crate::Estimate;

/// Step in t of the coarsest trapezoidal sum, which is halved at least [`MIN_HALVINGS`] times. Chosen; it moves integrals by less
/// than their stated error.
const COARSEST_STEP: f64 = 0.5;
/// Largest number of times that the step is halved. Chosen to limit the computing time: a sum then has some 12 000 nodes. The
/// last change is returned as the error.
const MAX_HALVINGS: usize = 9;
/// Number of halvings before the change by a halving is trusted as the error. Chosen: the first sums may agree by chance, for
/// example if both miss a narrow feature. The first trusted sum has 195 nodes; with fewer halvings narrower features are missed.
const MIN_HALVINGS: usize = 3;
/// Largest |t| of a node. Derived: from asinh(708.4/π) = 6.11 on, the weights e^(−π sinh t) fall below the smallest normal
/// number, e^(−708.4).
const LAST_NODE: f64 = 6.1;

/// Exponent x beyond which a term e^(−x) is left out of sums and integrals of the order 1: e^(−40) = 4e-18 is 1/50 of rounding.
pub const NEGLIGIBLE_EXPONENT: f64 = 40.0;

/// Integrates `integrand` from `interval[0]` to `interval[1]`.
///
/// The integrand receives its argument as the pair (nearer end, distance from that end with its sign), so that a
/// singularity at an end can be resolved below the rounding of `x`; [`integrate`] is the plain form. The error estimate is the
/// change by the last halving of the step. Halving stops when it falls below `relative_tolerance` times the integral of the
/// absolute value, or after the last halving; `Estimate::error` holds the error that was reached.
pub fn integrate_from_ends(
    integrand: impl Fn(f64, f64) -> f64,
    interval: [f64; 2],
    relative_tolerance: f64,
) -> Estimate {
    let half_width = 0.5 * (interval[1] - interval[0]);
    let mut step = COARSEST_STEP;
    // The first value of the integral is the coarsest trapezoidal sum, over the nodes t = 0, ±`step`, ±2 `step`, ….
    let mut sums = node_sums(&integrand, interval, 0.0, step);
    let mut previous = half_width * step * sums.signed;
    let mut error = f64::INFINITY;
    for halving in 0..MAX_HALVINGS {
        // Add the nodes halfway between the previous ones.
        let between = node_sums(&integrand, interval, 0.5 * step, step);
        sums.signed += between.signed;
        sums.modulus += between.modulus;
        step *= 0.5;
        let value = half_width * step * sums.signed;
        error = (value - previous).abs();
        let floor = relative_tolerance * (half_width * step * sums.modulus).abs();
        previous = value;
        if halving + 1 >= MIN_HALVINGS && error <= floor {
            break;
        }
    }
    Estimate::new(previous, error)
}

/// Integrates `integrand(x)` over an interval; see [`integrate_from_ends`].
///
/// A singular end at `x = 0` is resolved fully, any other one up to the rounding of `x`.
pub fn integrate(
    integrand: impl Fn(f64) -> f64,
    interval: [f64; 2],
    relative_tolerance: f64,
) -> Estimate {
    let from_end = |end, distance| integrand(end + distance);
    integrate_from_ends(from_end, interval, relative_tolerance)
}

/// Weighted sums over nodes, without the step.
#[derive(Debug, Clone, Copy, Default)]
struct NodeSums {
    /// Sum of the integrand.
    signed: f64,
    /// Sum of the absolute values of the integrand.
    modulus: f64,
}

/// Weighted sums of the integrand and its absolute value over the nodes t = ±(`first` + k `step`), k = 0, 1, …, up to [`LAST_NODE`].
fn node_sums(
    integrand: &impl Fn(f64, f64) -> f64,
    interval: [f64; 2],
    first: f64,
    step: f64,
) -> NodeSums {
    let half_width = 0.5 * (interval[1] - interval[0]);
    let mut sums = NodeSums::default();
    let mut k = 0_u32;
    loop {
        let t = first + f64::from(k) * step;
        k += 1;
        if t > LAST_NODE {
            return sums;
        }
        let u = FRAC_PI_2 * t.sinh();
        // `complement` is 1 − tanh u, computed without cancellation.
        let complement = 2.0 / (1.0 + (2.0 * u).exp());
        let weight = FRAC_PI_2 * t.cosh() / u.cosh().powi(2);
        let distance = half_width * complement;
        // Stop where a node reaches the end, or its weight leaves the range of numbers.
        if distance == 0.0 || weight == 0.0 || !weight.is_finite() {
            return sums;
        }
        // Both nodes ±t have the same weight; t = 0 is a single node.
        let mut add = |end: f64, offset: f64| {
            let term = weight * integrand(end, offset);
            sums.signed += term;
            sums.modulus += term.abs();
        };
        add(interval[1], -distance);
        if t > 0.0 {
            add(interval[0], distance);
        }
    }
}

#[cfg(test)]
mod tests {
    use std::cell::Cell;

    use super::*;
    use approx::assert_relative_eq;

    #[test]
    fn a_singular_end_costs_no_accuracy() {
        let integral = integrate(|x| x.powf(-0.9), [0.0, 2.0], 1e-13);
        let exact = 10.0 * 2.0_f64.powf(0.1);
        assert_relative_eq!(integral.value, exact, max_relative = 1e-12);
    }

    #[test]
    fn a_feature_that_the_first_sums_miss_is_found() {
        let narrow = |x: f64| (-((x - 0.19) / 0.005).powi(2)).exp();
        let integral = integrate(narrow, [-1.0, 1.0], 1e-10);
        let exact = 0.005 * std::f64::consts::PI.sqrt();
        assert_relative_eq!(integral.value, exact, max_relative = 1e-10);
    }

    /// The nodes lie at t = ±k/32 up to 6.1, or at ±k/64 for more digits, at any scale of the integrand.
    #[test]
    fn no_more_nodes_are_taken_than_the_tolerance_needs() {
        for (tolerance, expected) in [(1e-3, 391), (1e-9, 781)] {
            for scale in [1e-9, 1.0, 1e9] {
                let count = Cell::new(0);
                let counted = |x: f64| {
                    count.set(count.get() + 1);
                    scale / (0.1 + x * x)
                };
                let integral = integrate(counted, [-1.0, 3.0], tolerance);
                assert_eq!(count.get(), expected, "{tolerance:e}: {integral:?}");
            }
        }
    }

    #[test]
    fn the_error_of_a_divergent_integral_is_large() {
        let integral = integrate(|x| 1.0 / x, [0.0, 1.0], 1e-10);
        assert!(
            integral.error > 1e-5 * integral.value.abs(),
            "{integral:?} of a divergent integral"
        );
    }
}
