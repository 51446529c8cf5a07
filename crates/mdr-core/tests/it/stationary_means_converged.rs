//! `Ok` means stationary: on a dashpot the depth is (12) to the tolerance of the drift, and refusals say what is missing.

use casebook::assert_matches;
use indenters::EquivalentLine;
use mdr_core::{MdrError, slide};
use numerics::Accuracy;

use crate::support::{
    DEPTH, VISCOSITY, assert_close, endless, last, line, load_for_depth, material, power, slide_to,
};

/// One contact length shrinks the distance to the limit by e or more, so that it is below 1e-9/(e − 1); with n elements
/// (1 + 1/n)^n stands for e.
#[test]
fn distance_to_the_limit_is_below_the_drift() {
    for exponent in [1.0, 1.5, 2.0, 4.0] {
        let body = power(exponent);
        let sliding = slide_to(&EquivalentLine(&body), DEPTH, 100).expect("a state");
        let depth = sliding.indentation_depth.value;
        assert_close([depth, DEPTH], 1e-9 / 1.7, 0.0, &exponent);
        let truncation = sliding.error_parts.truncation.expect("a part");
        assert!(truncation < 1e-9, "p = {exponent}: {truncation}");
    }
}

#[test]
fn too_few_elements_are_refused() {
    let body = power(2.0);
    assert_matches!(
        slide_to(&EquivalentLine(&body), DEPTH, 4),
        Err(MdrError::TooCoarse { n_contact: 2, needed: 3, spacing })
            if (spacing * 2.0 / body.line_position(DEPTH) - 1.0).abs() < 1e-9
    );
}

/// The line is high enough, but its last element is not: the end of the domain falls between two elements.
#[test]
fn contact_reaches_the_last_element() {
    let ramp = line([0.0, 1.0], |x| x);
    // Three parts of 0.9 with six elements each are elements of 0.15; the last one is at 0.9.
    let load = load_for_depth(0.99).after(2.7).expect("a distance");
    let slid = slide(&ramp, &material(VISCOSITY), &load, Accuracy::Elements(6));
    assert_matches!(
        slid,
        Err(MdrError::ContactReachesEdge { position, indentation_depth, time })
            if position >= 0.6 && indentation_depth > position && time > 0.0
    );
}

/// A smooth line on an infinite domain, without a kink to start from: an element is laid on its lowest point.
#[test]
fn the_lowest_point_of_a_smooth_line_is_found() {
    let parabola = endless(|x| 2.5 + 10.0 * (x - 0.377) * (x - 0.377));
    // D = 0.1, x_d = 0.1, n = 20: the mean slope gives (4/3) (D/x_d) (1 - 1/(4 n^2)) when an element is at the apex.
    let row = last(&slide_to(&parabola, DEPTH, 20).expect("a state"));
    let expected = 4.0 / 3.0 * (1.0 - 1.0 / 1600.0);
    // The lowest point of a smooth line is known to the square root of rounding, half of the digits.
    assert_close([row.friction_coefficient, expected], 1e-7, 0.0, &row);
    assert_close([row.contact[0], 0.377], 1e-7, 1.0, &row);
}
