//! The friction coefficient converges to (16): exactly for the cone, to second order with the mean slope over the step,
//! to first order with the slope at the end of the step.

use indenters::{EquivalentLine, PowerProfile};
use mdr_core::{SlideOptions, SlideRow, slide_on_grid};

use crate::support::{DEPTH, load, material, observed_orders, power, power_friction, slide_to};

/// The approach stops within 1e-11 of the limit, far below the errors of the spacing.
const DRIFT: f64 = 1e-11;

/// Stationary states with the spacing halved four times, from `coarsest` elements along the contact; the front always
/// falls on an element, so that the error is not modulated by its place between two.
fn refined(exponent: f64, coarsest: f64) -> Vec<(f64, SlideRow)> {
    let body = power(exponent);
    let length = body.line_position(DEPTH);
    [1.0, 2.0, 4.0, 8.0, 16.0]
        .map(|refinement: f64| {
            let n = coarsest * refinement;
            let transient = slide_to(&EquivalentLine(&body), DEPTH, length / n, DRIFT);
            (n, transient.last)
        })
        .to_vec()
}

fn errors(
    exponent: f64,
    rows: &[(f64, SlideRow)],
    friction: impl Fn(&SlideRow) -> f64,
) -> Vec<f64> {
    let exact = power_friction(&power(exponent), DEPTH);
    rows.iter()
        .map(|(_, row)| friction(row) / exact - 1.0)
        .collect()
}

fn assert_order(exponent: f64, errors: &[f64], expected: f64) {
    for order in observed_orders(errors) {
        assert!(
            (order - expected).abs() < 0.15,
            "p = {exponent}: order {order} instead of {expected}, errors {errors:?}"
        );
    }
}

/// For p = 3/2 the order rises slowly, by the logarithm below, and comes within 0.15 from 64 elements on.
#[test]
fn mean_slope_is_second_order() {
    for (exponent, coarsest) in [(1.5, 64.0), (2.0, 16.0), (4.0, 16.0)] {
        let rows = refined(exponent, coarsest);
        assert_order(
            exponent,
            &errors(exponent, &rows, |row| row.friction_coefficient),
            2.0,
        );
    }
}

/// The first element carries (Δx^p)²/Δx of the integral instead of p²/(2p − 1) Δx^(2p−1).
#[test]
fn a_cusp_lowers_the_order_to_twice_p_minus_one() {
    let rows = refined(0.75, 16.0);
    assert_order(
        0.75,
        &errors(0.75, &rows, |row| row.friction_coefficient),
        0.5,
    );
    for (n, row) in rows {
        assert_eq!(
            row.friction_coefficient_end_of_step, None,
            "the slope at the cusp is infinite, n = {n}"
        );
    }
}

/// Below p = 3/2 the apex decides, without a cusp too.
#[test]
fn a_blunt_apex_below_three_halves_lowers_the_order() {
    let rows = refined(1.25, 16.0);
    assert_order(
        1.25,
        &errors(1.25, &rows, |row| row.friction_coefficient),
        1.5,
    );
}

/// −(Δx²/12) ∫ h̃''² dx diverges logarithmically at the apex for p = 3/2: n² · error grows by
/// p² (p − 1)² ln 2 / (12 p² / (2p − 1)) = ln 2 / 24 per halving. The next terms are O(1/n²).
#[test]
fn three_halves_has_the_logarithm_of_its_curvature() {
    let rows = refined(1.5, 16.0);
    let scaled: Vec<f64> = errors(1.5, &rows, |row| row.friction_coefficient)
        .iter()
        .zip(&rows)
        .map(|(error, (n, _))| -error * n * n)
        .collect();
    let expected = 2.0_f64.ln() / 24.0;
    for pair in scaled.windows(2) {
        let actual = pair[1] - pair[0];
        assert!(
            (actual / expected - 1.0).abs() < 0.01,
            "n^2 error grows by {actual} instead of {expected}, {scaled:?}"
        );
    }
}

#[test]
fn slope_at_the_end_of_the_step_is_first_order_and_low() {
    for exponent in [1.5, 2.0, 4.0] {
        let rows = refined(exponent, 16.0);
        let end = |row: &SlideRow| {
            row.friction_coefficient_end_of_step
                .expect("a finite slope")
        };
        let errors = errors(exponent, &rows, end);
        assert_order(exponent, &errors, 1.0);
        assert!(
            errors.iter().all(|error| *error < 0.0),
            "p = {exponent}: the slope behind is smaller, but errors are {errors:?}"
        );
    }
}

/// Every element meets the one slope, whatever their number: only rounding is left, about n ε.
#[test]
fn cone_is_exact_at_any_spacing() {
    for n in [3.0, 4.5, 10.0, 33.3, 512.0] {
        let body = power(1.0);
        let spacing = body.line_position(DEPTH) / n;
        let row = slide_to(&EquivalentLine(&body), DEPTH, spacing, DRIFT).last;
        let exact = power_friction(&body, DEPTH);
        let [mean, end] = [
            row.friction_coefficient,
            row.friction_coefficient_end_of_step
                .expect("a finite slope"),
        ];
        for friction in [mean, end] {
            assert!(
                (friction / exact - 1.0).abs() < 1e-12,
                "n = {n}: {friction} instead of {exact}"
            );
        }
    }
}

/// Casebook FRI-01: p = 2 errs by 1/(4 n²) = 4e-6 with 256 elements, p = 4 by about 4 times as much.
#[test]
fn casebook_frictions_come_out() {
    for case in casebook::group("FRI-01") {
        let expects_error = case.expected_error().is_some();
        if !case.has_input("p") || expects_error || !(1.0..5.0).contains(&case.input("p")) {
            continue;
        }
        let body = PowerProfile::new(case.input("c"), case.input("p")).expect("a power profile");
        let material = material(case.input("eta"));
        let load = load(case.input("F"), case.input("v"));
        let options = SlideOptions::with_elements(256, &EquivalentLine(&body), &material, &load)
            .expect("a contact");
        let transient = slide_on_grid(&EquivalentLine(&body), &material, &load, &options)
            .expect("a stationary state");
        case.check_within("mu", transient.last.friction_coefficient, 2e-5);
        case.check_within("d", transient.last.indentation_depth, 1e-9);
    }
}

/// For the parabola x² the compressions are (2j + 1) Δx², the mean slopes (2j + 1) Δx, the slopes at the end 2j Δx.
#[test]
fn ten_elements_and_the_slope_at_the_end_are_several_per_cent_low() {
    let body = power(2.0);
    let spacing = body.line_position(DEPTH) / 10.0;
    let row = slide_to(&EquivalentLine(&body), DEPTH, spacing, DRIFT).last;
    let sum = |term: fn(f64) -> f64| (0..10).map(|j| term(f64::from(j))).sum::<f64>();
    let expected = sum(|j| (2.0 * j + 1.0) * 2.0 * j) / sum(|j| (2.0 * j + 1.0).powi(2));
    let end = row
        .friction_coefficient_end_of_step
        .expect("a finite slope");
    let actual = end / row.friction_coefficient;
    assert!(
        (actual / expected - 1.0).abs() < 1e-10 && expected < 0.93,
        "ratio {actual} instead of {expected}"
    );
}
