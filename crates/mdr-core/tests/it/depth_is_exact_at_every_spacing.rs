//! The stationary depth is F_N / (4 η v), (12), whatever the line and the spacing: along the leading edge the
//! compressions of a step telescope.

use indenters::EquivalentLine;
use proptest::prelude::*;
use proptest::test_runner::RngSeed;

use crate::support::{DEPTH, Nodes, power, slide_to};

/// What is left of the approach is below the drift; rounding of the sum of n compressions is far below.
const DRIFT: f64 = 1e-12;

#[test]
fn power_profiles_reach_the_depth_of_the_theorem() {
    for exponent in [0.6, 0.75, 1.0, 1.5, 2.0, 4.0, 10.0] {
        for n in [3.0, 7.7, 16.0, 100.0] {
            let body = power(exponent);
            let spacing = body.line_position(DEPTH) / n;
            let row = slide_to(&EquivalentLine(&body), DEPTH, spacing, DRIFT).last;
            let error = row.indentation_depth / DEPTH - 1.0;
            assert!(
                error.abs() < DRIFT,
                "p = {exponent}, n = {n}: relative error {error}"
            );
        }
    }
}

/// The friction coefficient of the discrete line: Σ increment_j (h_{j+1} − h_j) / (Δx D).
fn discrete_friction(line: &Nodes, depth: f64) -> (usize, f64) {
    let heights = &line.heights;
    let (mut n_contact, mut sum) = (0, 0.0);
    for node in 0..heights.len() - 1 {
        let ahead = heights[node + 1..].iter().copied().fold(depth, f64::min);
        if heights[node] < ahead {
            n_contact += 1;
            sum += (ahead - heights[node]) * (heights[node + 1] - heights[node]);
        }
    }
    (n_contact, sum / (line.spacing * depth))
}

#[test]
fn casebook_discrete_line_is_in_balance() {
    let cases = casebook::group("FRI-03");
    let case = cases
        .iter()
        .find(|case| case.id().ends_with("discrete/steady"))
        .expect("the discrete row");
    let depth = case.input("D");
    let line = Nodes {
        heights: case.input_list("h"),
        spacing: case.input("dx"),
    };
    let row = slide_to(&line, depth, line.spacing, DRIFT).last;
    case.check("sum_increments", row.indentation_depth);
    let increments = case.expected_list("increments").expect("increments");
    let expected = increments
        .iter()
        .filter(|increment| **increment > 0.0)
        .count();
    assert_eq!(
        row.n_contact, expected,
        "elements in contact of {increments:?}"
    );
    let (_, friction) = discrete_friction(&line, depth);
    assert!(
        (row.friction_coefficient / friction - 1.0).abs() < 1e-11,
        "friction {} instead of {friction}",
        row.friction_coefficient
    );
}

proptest! {
    #![proptest_config(ProptestConfig {
        cases: 128,
        rng_seed: RngSeed::Fixed(2014),
        failure_persistence: None,
        ..ProptestConfig::default()
    })]

    /// On the way the depth only grows, and never beyond the stationary one; this is what bounds the chain.
    #[test]
    fn any_line_sinks_to_its_stationary_depth_and_no_further(
        inner in prop::collection::vec(0.0..1.0_f64, 4..30),
        depth in 0.3..1.0_f64,
        spacing in 1e-3..1e3_f64,
    ) {
        // The foremost of the two lowest nodes is the second, so that three elements are in contact.
        let mut heights = vec![0.0, 0.0, 0.1, 0.2];
        heights.extend(inner.iter().map(|height| 0.3 + 0.7 * height));
        heights.push(1.0);
        let line = Nodes { heights, spacing };
        let transient = slide_to(&line, depth, spacing, DRIFT);
        let mut before = 0.0;
        for row in &transient.rows {
            // Rounding of a sum over at most 35 elements, divided by their number.
            let slack = 4.0 * f64::EPSILON * depth;
            prop_assert!(
                row.indentation_depth >= before - slack && row.indentation_depth <= depth + slack,
                "depth {} after {before}, stationary {depth}", row.indentation_depth
            );
            before = row.indentation_depth;
        }
        let row = transient.last;
        prop_assert!((row.indentation_depth / depth - 1.0).abs() < 1e-11, "{row:?}, {depth}");
        let (_, friction) = discrete_friction(&line, depth);
        prop_assert!(
            (row.friction_coefficient / friction - 1.0).abs() < 1e-9,
            "friction {} instead of {friction}", row.friction_coefficient
        );
    }
}
