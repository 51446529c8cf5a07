//! One instant: the forces are compressive, act only on touched elements, and balance the normal force to rounding.

use casebook::fixed_cases;
use proptest::prelude::*;

use super::*;

fn instant<'a>(heights: &'a [f64], displacements: &'a [f64]) -> Instant<'a> {
    Instant {
        heights,
        displacements,
    }
}

/// Casebook EXT-02: f = 4 Δx w.
#[test]
fn single_element_is_four_times_modulus_and_spacing() {
    for case in casebook::group("EXT-02") {
        let (heights, displacements) = ([0.0], [0.0]);
        let instant = instant(&heights, &displacements);
        if case.id().contains("MDR single element") {
            let stiffness = 4.0 * case.input("dx") * case.input("G");
            let compression = instant.level(case.input("d")).compression;
            case.check("F", stiffness * compression);
            let depth = instant.solve(compression, f64::NEG_INFINITY).depth;
            assert!((depth - case.input("d")).abs() < 1e-15, "depth {depth}");
        } else if case.id().contains("force exactly zero") {
            let level = instant.solve(case.input("F"), f64::NEG_INFINITY);
            case.check("d", level.depth);
            case.check("contact_cells", level.n_below as f64);
        }
    }
}

/// The two elements that are no holes are compressed by 2.5 in sum.
#[test]
fn holes_are_never_in_contact() {
    let heights = [f64::INFINITY, 0.0, f64::INFINITY, 0.5];
    let level = instant(&heights, &[0.0; 4]).solve(2.5, f64::NEG_INFINITY);
    let are_two = (level.depth - 1.5).abs() < 1e-15 && level.n_below == 2;
    assert!(are_two, "{level:?}, not 1.5 on two elements");
}

proptest! {
    #![proptest_config(fixed_cases(512))]

    /// More depth is more load: one depth has this balance and complementarity.
    #[test]
    fn any_chain_is_in_balance(
        elements in prop::collection::vec((0.0..1.0_f64, -0.5..0.5_f64), 1..200),
        exponents in (-6.0..3.0_f64, 0.0..60.0_f64),
    ) {
        // Touch depths over many decades make the contacts of Newton's steps shrink slowly.
        let spread = |x: f64| 2.0_f64.powf(-exponents.1 * x);
        let heights: Vec<f64> = elements.iter().map(|(height, _)| spread(*height)).collect();
        let displacements: Vec<f64> = elements.iter().map(|(_, u)| 1e-3 * u).collect();
        let touch: Vec<f64> = heights.iter().zip(&displacements).map(|(h, u)| h + u).collect();
        let needed = 10.0_f64.powf(exponents.0);
        let level = instant(&heights, &displacements).solve(needed, f64::NEG_INFINITY);
        let Level { depth, n_below, compression } = level;
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
