//! The forces are compressive, act only on touched elements, and balance the normal force to rounding.

use casebook::fixed_cases;
use proptest::prelude::*;

use super::*;

proptest! {
    #![proptest_config(fixed_cases(512))]

    /// More depth is more load: one depth has this balance and complementarity.
    #[test]
    fn any_foundation_is_in_balance(
        elements in prop::collection::vec((0.0..1.0_f64, -0.5..0.5_f64), 1..200),
        exponents in (-6.0..3.0_f64, 0.0..60.0_f64),
    ) {
        // Touch depths over many decades make the contacts of Newton's steps shrink slowly.
        let spread = |x: f64| 2.0_f64.powf(-exponents.1 * x);
        // The last element is a hole.
        let heights = elements.iter().map(|(height, _)| spread(*height)).chain([f64::INFINITY]);
        let heights: Vec<f64> = heights.collect();
        let displacements = elements.iter().map(|(_, u)| 1e-3 * u).chain([0.0]);
        let displacements: Vec<f64> = displacements.collect();
        let touch: Vec<f64> = heights.iter().zip(&displacements).map(|(h, u)| h + u).collect();
        let needed = 10.0_f64.powf(exponents.0);
        let balance = ForceBalance { heights: &heights, displacements: &displacements };
        let level = balance.solve(needed, f64::NEG_INFINITY);
        let TrialDepth { depth, n_below, compression } = level;
        let below = touch.iter().filter(|t| **t < depth);
        prop_assert_eq!(n_below, below.clone().count(), "complementarity: loaded below the depth");

        // The depth is a number with ε relative rounding, times the stiffness of the contact.
        let n = n_below as f64;
        let scale = below.clone().fold(depth.abs(), |a, t| a.max(t.abs()));
        let rounding = 2.0 * f64::EPSILON * (n * scale + needed);
        prop_assert!((compression - needed).abs() <= rounding, "{compression} for {needed}");
        // The sum of n numbers rounds n times.
        let expected = (needed + below.sum::<f64>()) / n;
        let allowed = 4.0 * n * f64::EPSILON * scale.max(expected.abs());
        prop_assert!((depth - expected).abs() <= allowed, "depth {depth}, not {expected}");
    }
}
