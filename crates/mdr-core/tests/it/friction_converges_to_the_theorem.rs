//! On a dashpot the stationary depth is F_N / (4 η v), (12), at any spacing, and the friction coefficient converges to (16):
//! exactly for the cone, to second order for smooth bodies.

use indenters::EquivalentLine;

use crate::support::{
    DEPTH, VISCOSITY, assert_close, assert_order, body_of, last, load_for_depth, march, material,
    power, power_friction, slide_to,
};

/// The friction of the stationary state with n elements along the contact, so that the front falls on an element.
fn friction(exponent: f64, elements: usize) -> f64 {
    let sliding = slide_to(&EquivalentLine(&power(exponent)), DEPTH, elements);
    last(&sliding.expect("a stationary state")).friction_coefficient
}

/// Relative errors with the spacing halved four times.
fn errors(exponent: f64) -> [f64; 5] {
    let exact = power_friction(&power(exponent), DEPTH);
    [16, 32, 64, 128, 256].map(|n| friction(exponent, n) / exact - 1.0)
}

/// Below p = 3/2 the apex decides: the first element carries (Δx^p)²/Δx of the integral instead of p²/(2p − 1) Δx^(2p−1).
#[test]
fn mean_slope_is_second_order_and_lower_at_an_apex_below_three_halves() {
    for (exponent, expected) in [(0.75, 0.5), (1.25, 1.5), (2.0, 2.0), (4.0, 2.0)] {
        assert_order(&errors(exponent), expected, &exponent);
    }
}

/// Every element meets the one slope, whatever their number: only rounding is left, about n ε.
#[test]
fn cone_is_exact_at_any_spacing() {
    let exact = power_friction(&power(1.0), DEPTH);
    for n in [6, 10, 33, 512] {
        assert_close([friction(1.0, n), exact], 1e-12, 0.0, &n);
    }
}

/// FRI-02: the mean slope is below the integral by about 1/(4 n²), with n = 200 elements 6e-6.
#[test]
fn smooth_bodies_have_the_friction_of_the_casebook() {
    for case in casebook::group("FRI-02") {
        let (body, load) = (body_of(&case), load_for_depth(case.input("D")));
        let sliding = march(&EquivalentLine(&*body), &material(VISCOSITY), &load, 200);
        let row = last(&sliding);
        case.check_within("mu", row.friction_coefficient, 1e-5);
        let length = row.n_contact as f64 * sliding.spacing;
        case.check_within("x_d", length, 1.01 / 200.0);
    }
}
