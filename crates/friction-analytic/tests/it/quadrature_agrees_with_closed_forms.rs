use casebook::{assert_close, assert_matches, fixed_cases, superposition};
use friction_analytic::{
    FrictionError, StationarySliding, axisymmetric_sliding, power_sliding, superposition_sliding,
};
use indenters::{Axisymmetric, IndenterError, RoundTippedCone, Superposition};
use proptest::prelude::*;

use crate::support::{power, with_depth};

fn slide(body: &dyn Axisymmetric, depth: f64) -> StationarySliding {
    let (material, load) = with_depth(depth);
    axisymmetric_sliding(body, &material, &load).expect("the body has a stationary state")
}

/// A sum of powers slides as the double sum says.
fn sum_up(sum: &Superposition, depth: f64) -> Result<StationarySliding, FrictionError> {
    let (material, load) = with_depth(depth);
    superposition_sliding(sum, &material, &load)
}

#[test]
fn sphere_round_tipped_cone_and_hyperboloid_match() {
    for case in casebook::group("FRI-02") {
        let state = slide(case.body().as_ref(), case.input("D"));
        case.check("x_d", state.contact_length());
        case.check("mu", state.friction_coefficient);
        let is_known = state.error < 1e-10 * state.friction_coefficient;
        assert!(is_known, "{state:?}");
    }
}

/// Behind the end of the tip the slope of the line rises like a root: μ from ∫ over both parts, by hand for the tip,
/// in u = √(x − b) for the rest.
#[test]
fn a_jump_of_the_curvature_costs_no_accuracy() {
    let (b, t) = (0.5_f64, 0.3);
    let cone = RoundTippedCone::new(b, t).unwrap();
    let depth = 0.4;
    let state = slide(&cone, depth);
    let a = state.contact_length();
    assert!(a > b, "the contact {a} ends inside the tip");
    let tip = 4.0 * t * t * b / 3.0;
    let outside = |u: f64| {
        let x = b + u * u;
        let leg = u * (x + b).sqrt();
        2.0 * u * (t * (leg.atan2(b) + 2.0 * b / (x + leg))).powi(2)
    };
    let outside = numerics::integrate(outside, [0.0, (a - b).sqrt()], 1e-13).value;
    assert_close!(state.friction_coefficient => (tip + outside) / depth, within 1e-11);
}

/// The one with p = 0.51 has 98 per cent of its integral below 1e-300 of the contact length.
#[test]
fn quadrature_agrees_with_the_closed_form_for_every_exponent() {
    for p in [
        0.500_001, 0.501, 0.51, 0.55, 0.6, 0.7, 0.75, 0.9, 1.0, 1.2, 1.5, 2.0, 3.0, 4.0, 6.0, 10.0,
        20.0, 40.0, 64.0, 200.0, 1000.0,
    ] {
        // A coefficient [m^(1 − p)] of a large exponent leaves the range of numbers before 12 decades are reached.
        let decades = 12_f64.min(300.0 / p - 0.1);
        for scale in [-decades, 0.0, decades].map(|log| 10_f64.powf(log)) {
            // The contact length is scale · 0.8 whatever the exponent.
            let depth = 0.1 * scale;
            let kappa = indenters::stretch(p).unwrap();
            let profile = power(depth / kappa * (0.8 * scale).powf(-p), p);
            let (material, load) = with_depth(depth);
            let exact = power_sliding(&profile, &material, &load).unwrap();
            let numerical = slide(&profile, depth);
            let [mu, expected] = [&numerical, &exact].map(|state| state.friction_coefficient);
            // Both start from a rounded p, which weighs 1/(2p − 1); x_d of the closed form is rounded in logarithms.
            let rounding = f64::EPSILON / (2.0 * p - 1.0);
            assert_close!(mu => expected, within 1e-12 + rounding; "p = {p}, scale {scale:e}");
            assert!(exact.error <= 1e-13 * expected, "{exact:?}");
            let claimed = (numerical.error + exact.error) / expected;
            assert_close!(mu => expected, within claimed + rounding; "p = {p}, scale {scale:e}");
        }
    }
}

#[test]
fn a_sum_that_turns_downwards_is_refused() {
    // h̃ = (π/2) x − 2 x² has its maximum π²/32 at π/8.
    let sum = superposition(&[(1.0, 1.0), (-1.0, 2.0)]);
    let limit = std::f64::consts::PI.powi(2) / 32.0;
    let refused = sum_up(&sum, limit * (1.0 + 1e-6));
    assert_matches!(
        refused,
        Err(FrictionError::Indenter(
            IndenterError::NonMonotoneLine { .. }
        ))
    );
    let closed = sum_up(&sum, 0.9 * limit).unwrap();
    let numerical = slide(&sum, 0.9 * limit);
    assert_close!(closed.friction_coefficient => numerical.friction_coefficient, within 1e-11);
}

proptest! {
    #![proptest_config(fixed_cases(48))]

    #[test]
    fn the_double_sum_agrees_with_quadrature(
        coefficients in prop::array::uniform3(0.01_f64..10.0),
        lowest in 0.55_f64..1.5,
        gaps in prop::array::uniform2(0.12_f64..4.0),
        log_scale in -12.0_f64..12.0,
    ) {
        let scale = 10_f64.powf(log_scale);
        let exponents = [lowest, lowest + gaps[0], lowest + gaps[0] + gaps[1]];
        let terms = coefficients.iter().zip(exponents);
        let terms: Vec<_> = terms.map(|(c, p)| (c * scale.powf(1.0 - p), p)).collect();
        let sum = superposition(&terms);
        let closed = sum_up(&sum, 0.3 * scale).unwrap();
        let numerical = slide(&sum, 0.3 * scale);
        let claimed = (closed.error + numerical.error) / numerical.friction_coefficient;
        assert_close!(closed.friction_coefficient => numerical.friction_coefficient, within claimed.min(1e-11));
        prop_assert!(closed.error <= 1e-12 * closed.friction_coefficient, "{:?}", closed);
        // Cauchy and Schwarz: the steepest use of a given depth is a constant slope.
        let smallest = closed.indentation_depth / closed.contact_length();
        prop_assert!(closed.friction_coefficient >= smallest * (1.0 - 1e-12),
            "μ = {} below d/x_d = {smallest}", closed.friction_coefficient);
    }
}
