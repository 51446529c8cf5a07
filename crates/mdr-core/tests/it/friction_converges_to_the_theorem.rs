//! On a dashpot the stationary depth is F_N / (4 η v), (12), at any spacing, and the friction coefficient converges to (16):
//! exactly for the cone, to second order with the mean slope over the step, to first order with the slope at its end.

use casebook::Case;
use indenters::EquivalentLine;
use mdr_core::SlideRow;

use crate::support::{
    DEPTH, VISCOSITY, assert_close, assert_order, body_of, load_for_depth, march, material, power,
    power_friction, slide_to,
};

/// The approach stops within this of the limit, far below the errors of the spacing.
const DRIFT: f64 = 1e-11;

/// The stationary state with n elements along the contact; with a whole number the front falls on an element, so that the
/// error is not modulated by its place between two.
fn state(exponent: f64, n: f64, drift_tolerance: f64) -> SlideRow {
    let body = power(exponent);
    let spacing = body.line_position(DEPTH) / n;
    let transient = slide_to(&EquivalentLine(&body), DEPTH, spacing, drift_tolerance);
    transient.expect("a stationary state").last
}

fn mean(row: &SlideRow) -> f64 {
    row.friction_coefficient
}

fn end(row: &SlideRow) -> f64 {
    let friction = row.friction_coefficient_end_of_step;
    friction.expect("a finite slope")
}

/// Relative errors with the spacing halved four times.
fn errors(exponent: f64, friction: fn(&SlideRow) -> f64) -> [f64; 5] {
    let exact = power_friction(&power(exponent), DEPTH);
    [16.0, 32.0, 64.0, 128.0, 256.0].map(|n| friction(&state(exponent, n, DRIFT)) / exact - 1.0)
}

/// Below p = 3/2 the apex decides: the first element carries (Δx^p)²/Δx of the integral instead of p²/(2p − 1) Δx^(2p−1).
#[test]
fn mean_slope_is_second_order_and_lower_at_an_apex_below_three_halves() {
    for (exponent, expected) in [(0.75, 0.5), (1.25, 1.5), (2.0, 2.0), (4.0, 2.0)] {
        assert_order(&errors(exponent, mean), expected, &exponent);
    }
    let at_a_cusp = state(0.75, 16.0, DRIFT).friction_coefficient_end_of_step;
    assert_eq!(at_a_cusp, None, "the slope at the cusp is infinite");
}

#[test]
fn slope_at_the_end_of_the_step_is_first_order_and_low() {
    for exponent in [1.5, 2.0, 4.0] {
        let errors = errors(exponent, end);
        assert_order(&errors, 1.0, &exponent);
        // The slope behind is smaller.
        let are_low = errors.iter().all(|error| *error < 0.0);
        assert!(are_low, "p = {exponent}: {errors:?}");
    }
    // For the parabola x² the compressions are (2j + 1) Δx², the mean slopes (2j + 1) Δx, the slopes at the end 2j Δx.
    let row = state(2.0, 10.0, DRIFT);
    let sum = |term: fn(f64) -> f64| (0..10).map(|j| term(f64::from(j))).sum::<f64>();
    let expected = sum(|j| (2.0 * j + 1.0) * 2.0 * j) / sum(|j| (2.0 * j + 1.0).powi(2));
    assert_close([end(&row) / mean(&row), expected], 1e-10, 0.0, &row);
}

/// Every element meets the one slope, whatever their number: only rounding is left, about n ε.
#[test]
fn cone_is_exact_at_any_spacing() {
    let exact = power_friction(&power(1.0), DEPTH);
    for n in [3.0, 4.5, 10.0, 33.3, 512.0] {
        let row = state(1.0, n, DRIFT);
        for friction in [mean(&row), end(&row)] {
            assert_close([friction, exact], 1e-12, 0.0, &n);
        }
    }
}

fn stationary(case: &Case, elements: usize) -> SlideRow {
    let (body, dashpot) = (body_of(case), material(VISCOSITY));
    let load = load_for_depth(case.input("D"));
    march(&EquivalentLine(&*body), &dashpot, &load, elements, 1e-6).last
}

/// FRI-02: the mean slope is below the integral by about 1/(4 n²), with n = 200 elements 6e-6.
#[test]
fn smooth_bodies_have_the_friction_of_the_casebook() {
    for case in casebook::group("FRI-02") {
        let row = stationary(&case, 200);
        case.check_within("mu", row.friction_coefficient, 1e-5);
        case.check_within("x_d", row.contact_length, 1.01 / 200.0);
    }
}

/// FRI-04: a kink that rises makes the integral (16) infinite: the sum grows by the same amount with every decade of the
/// spacing. Behind the kink h̃ ∼ √s (1 + O(s)) at the distance s, so that the amount approaches its limit to first
/// order; a quarter of the spacing leaves a quarter of what is missing, and the extrapolation only the noise of the
/// contact's front.
#[test]
fn friction_behind_a_kink_grows_with_the_logarithm_of_the_spacing() {
    for case in casebook::group("FRI-04") {
        let friction = |elements| stationary(&case, elements).friction_coefficient;
        let [coarse, fine] = [25, 100].map(|n| friction(10 * n) - friction(n));
        let extrapolated = (4.0 * fine - coarse) / 3.0;
        case.check_within("mu_increment_per_decade_of_dx", extrapolated, 0.003);
    }
}
