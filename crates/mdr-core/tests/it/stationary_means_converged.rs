//! `Ok` means stationary: the drift bounds the distance to the limit, and what was not reached is an error that says how
//! far it came.

use casebook::assert_matches;
use indenters::EquivalentLine;
use mdr_core::{MdrError, SlideOptions, Transient, slide_on_grid};

use crate::support::{
    DEPTH, VISCOSITY, assert_close, endless, line, load_for_depth, material, power, power_friction,
    slide_to,
};

/// One contact length of n elements shrinks the distance to the limit by (1 + 1/n)^n or more, which tends to e.
#[test]
fn distance_to_the_limit_is_below_the_drift() {
    for exponent in [1.0, 1.5, 2.0, 4.0] {
        let body = power(exponent);
        let (length, n) = (body.line_position(DEPTH), 100.0_f64);
        let line = EquivalentLine(&body);
        let march = |drift| slide_to(&line, DEPTH, length / n, drift).expect("a state");
        let limit = march(1e-13).last;
        for drift_tolerance in [1e-2, 1e-4, 1e-6, 1e-8] {
            let Transient { last, drift, .. } = march(drift_tolerance);
            let depth = (last.indentation_depth / limit.indentation_depth - 1.0).abs();
            let friction = (last.friction_coefficient / limit.friction_coefficient - 1.0).abs();
            let bound = drift / ((1.0 + 1.0 / n).powf(n) - 1.0);
            // The approach is exponential to first order in the distance itself.
            let bound = bound * (1.0 + 2.0 * drift_tolerance) + 1e-12;
            let are_near = depth <= bound && friction <= bound;
            let is_near = drift <= drift_tolerance && are_near;
            assert!(is_near, "p = {exponent}, {drift}: {depth}, {friction}");
        }
    }
}

/// The parabola with a spacing and over a distance relative to the length of its contact.
fn parabola(spacing: f64, max_sliding_distance: f64) -> Result<Transient, MdrError> {
    let body = power(2.0);
    let length = body.line_position(DEPTH);
    let options = SlideOptions {
        spacing: length * spacing,
        drift_tolerance: 1e-6,
        max_sliding_distance: length * max_sliding_distance,
    };
    let (dashpot, load) = (material(VISCOSITY), load_for_depth(DEPTH));
    slide_on_grid(&EquivalentLine(&body), &dashpot, &load, &options)
}

#[test]
fn too_short_a_distance_returns_the_transient_in_the_error() {
    let length = power(2.0).line_position(DEPTH);
    let limit = power_friction(&power(2.0), DEPTH);
    assert_matches!(
        parabola(1.0 / 40.0, 2.01),
        Err(MdrError::NotStationary { drift, drift_tolerance, sliding_distance, ref rows })
            if drift > drift_tolerance && drift < 0.3
                && sliding_distance <= 2.0 * length * (1.0 + 1e-12)
                // The steps in two contact lengths.
                && rows.len() == 80
                && (0.8 * limit..limit).contains(&rows[79].friction_coefficient)
    );
    // No step fits into the distance: the drift is that from nothing.
    let expected = MdrError::NotStationary {
        drift: 1.0,
        drift_tolerance: 1e-6,
        sliding_distance: 0.0,
        rows: Vec::new(),
    };
    let half_a_step = parabola(1.0 / 40.0, 0.5 / 40.0);
    assert_eq!(half_a_step, Err(expected), "half a step");
}

#[test]
fn too_few_elements_are_refused() {
    assert_matches!(
        parabola(1.0 / 1.5, 100.0),
        Err(MdrError::TooCoarse { n_contact: 2, needed: 3, spacing })
            if (spacing * 1.5 / power(2.0).line_position(DEPTH) - 1.0).abs() < 1e-15
    );
}

/// The line is high enough, but its last element is not: the end of the domain falls between two elements.
#[test]
fn contact_reaches_the_last_element() {
    let ramp = line([0.0, 1.0], |x| x);
    assert_matches!(
        slide_to(&ramp, 0.99, 0.15, 1e-9),
        Err(MdrError::ContactReachesEdge { position, indentation_depth, time })
            if (position - 0.9).abs() < 1e-12 && indentation_depth > position && time > 0.0
    );
}

/// A smooth line on an infinite domain, without a kink to start from: an element is laid on its lowest point.
#[test]
fn the_lowest_point_of_a_smooth_line_is_found() {
    let parabola = endless(|x| 2.5 + 10.0 * (x - 0.377) * (x - 0.377));
    // D = 0.1, x_d = 0.1, n = 20: the mean slope gives (4/3) (D/x_d) (1 - 1/(4 n^2)) when an element is at the apex.
    let state = slide_to(&parabola, DEPTH, 0.005, 1e-11);
    let row = state.expect("a state").last;
    let expected = 4.0 / 3.0 * (1.0 - 1.0 / 1600.0);
    // The lowest point of a smooth line is known to the square root of rounding, half of the digits.
    assert_close([row.friction_coefficient, expected], 1e-7, 0.0, &row);
    assert_close([row.contact[0], 0.377], 1e-7, 1.0, &row);
}

/// On an infinite domain a foot is seen although it stands a hundred contact lengths ahead of the lowest point.
#[test]
fn a_far_foot_on_an_infinite_domain_is_seen() {
    let feet = endless(|x: f64| x.abs().min(0.05 + 0.5 * (x - 30.0).abs()));
    let row = slide_to(&feet, 0.3, 0.05, 1e-11).expect("a state").last;
    assert_close([row.contact[0], 0.0], 1e-12, 1.0, &row);
    assert_close([row.contact[1], 30.45], 0.051 / 30.45, 0.0, &row);
}
