//! `Ok` means stationary: the drift bounds the distance to the limit, and what was not reached is an error that says how
//! far it came.

use indenters::{EquivalentLine, RigidLine};
use mdr_core::{MdrError, SlideOptions, slide_on_grid};

use crate::support::{
    DEPTH, Nodes, VISCOSITY, load_for_depth, material, power, power_friction, slide_to,
};

/// One contact length of n elements shrinks the distance to the limit by (1 + 1/n)^n or more, which tends to e.
#[test]
fn distance_to_the_limit_is_below_the_drift() {
    for exponent in [1.0, 1.5, 2.0, 4.0] {
        let body = power(exponent);
        let (length, n) = (body.line_position(DEPTH), 100.0_f64);
        let line = EquivalentLine(&body);
        let limit = slide_to(&line, DEPTH, length / n, 1e-13).last;
        for drift_tolerance in [1e-2, 1e-4, 1e-6, 1e-8] {
            let transient = slide_to(&line, DEPTH, length / n, drift_tolerance);
            let row = transient.last;
            let depth = (row.indentation_depth / limit.indentation_depth - 1.0).abs();
            let friction = (row.friction_coefficient / limit.friction_coefficient - 1.0).abs();
            let bound = transient.drift / ((1.0 + 1.0 / n).powf(n) - 1.0);
            // The approach is exponential to first order in the distance itself.
            let bound = bound * (1.0 + 2.0 * drift_tolerance) + 1e-12;
            assert!(
                transient.drift <= drift_tolerance && depth <= bound,
                "p = {exponent}, {drift_tolerance}: depth off by {depth}, bound {bound}"
            );
            assert!(
                friction <= bound,
                "p = {exponent}, {drift_tolerance}: friction off by {friction}, bound {bound}"
            );
        }
    }
}

#[test]
fn too_short_a_distance_returns_the_transient_in_the_error() {
    let body = power(2.0);
    let length = body.line_position(DEPTH);
    let options = SlideOptions {
        spacing: length / 40.0,
        drift_tolerance: 1e-6,
        max_sliding_distance: 2.01 * length,
    };
    let result = slide_on_grid(
        &EquivalentLine(&body),
        &material(VISCOSITY),
        &load_for_depth(DEPTH),
        &options,
    );
    let Err(MdrError::NotStationary {
        drift,
        drift_tolerance,
        sliding_distance,
        rows,
    }) = result
    else {
        panic!("{result:?}");
    };
    assert_eq!(rows.len(), 80, "steps in two contact lengths");
    assert!(
        drift > drift_tolerance && drift < 0.3 && sliding_distance <= 2.0 * length * (1.0 + 1e-12),
        "drift {drift} over {sliding_distance}"
    );
    let friction = rows[79].friction_coefficient;
    let limit = power_friction(&body, DEPTH);
    assert!(
        friction > 0.8 * limit && friction < limit,
        "friction {friction} on the way to {limit}"
    );
}

#[test]
fn drift_is_that_from_nothing_before_one_contact_length() {
    let body = power(2.0);
    let spacing = body.line_position(DEPTH) / 40.0;
    let options = SlideOptions {
        spacing,
        drift_tolerance: 0.5,
        max_sliding_distance: 0.5 * spacing,
    };
    let result = slide_on_grid(
        &EquivalentLine(&body),
        &material(VISCOSITY),
        &load_for_depth(DEPTH),
        &options,
    );
    let expected = MdrError::NotStationary {
        drift: 1.0,
        drift_tolerance: 0.5,
        sliding_distance: 0.0,
        rows: Vec::new(),
    };
    assert_eq!(result, Err(expected), "no step fits into the distance");
}

#[test]
fn too_few_elements_are_refused() {
    let body = power(2.0);
    let spacing = body.line_position(DEPTH) / 1.5;
    let options = SlideOptions {
        spacing,
        drift_tolerance: 1e-6,
        max_sliding_distance: 100.0 * spacing,
    };
    let result = slide_on_grid(
        &EquivalentLine(&body),
        &material(VISCOSITY),
        &load_for_depth(DEPTH),
        &options,
    );
    let expected = MdrError::TooCoarse {
        n_contact: 2,
        needed: 3,
        spacing,
    };
    assert_eq!(result, Err(expected), "one and a half elements");
}

/// The line is high enough, but its last element is not: the end of the domain falls between two elements.
#[test]
fn contact_reaches_the_last_element() {
    struct Ramp;
    impl RigidLine for Ramp {
        fn height(&self, x: f64) -> f64 {
            x
        }
        fn slope(&self, _x: f64) -> f64 {
            1.0
        }
        fn domain(&self) -> [f64; 2] {
            [0.0, 1.0]
        }
    }
    let options = SlideOptions {
        spacing: 0.15,
        drift_tolerance: 1e-9,
        max_sliding_distance: 100.0,
    };
    let result = slide_on_grid(&Ramp, &material(VISCOSITY), &load_for_depth(0.99), &options);
    let Err(MdrError::ContactReachesEdge {
        position,
        indentation_depth,
        time,
    }) = result
    else {
        panic!("{result:?}");
    };
    assert!(
        (position - 0.9).abs() < 1e-12 && indentation_depth > position && time > 0.0,
        "{position} at depth {indentation_depth}, time {time}"
    );
}

/// The line comes down again far behind a hump that is higher than the contact: it is found.
#[test]
fn a_second_foot_beyond_a_hump_is_seen() {
    let mut heights = vec![0.0, 0.1, 0.2, 0.9];
    heights.extend([0.9; 40]);
    heights.extend([0.15, 0.9, 1.0]);
    let line = Nodes {
        heights,
        spacing: 1.0,
    };
    let row = slide_to(&line, 0.3, 1.0, 1e-12).last;
    assert!(
        (row.contact[1] - 44.0).abs() < 1e-12 && (row.indentation_depth - 0.3).abs() < 1e-12,
        "front {:?}, depth {}",
        row.contact,
        row.indentation_depth
    );
}

/// A smooth line on an infinite domain, without a kink to start from: an element is laid on its lowest point.
#[test]
fn the_lowest_point_of_a_smooth_line_is_found() {
    struct Parabola;
    impl RigidLine for Parabola {
        fn height(&self, x: f64) -> f64 {
            2.5 + 10.0 * (x - 0.377).powi(2)
        }
        fn slope(&self, x: f64) -> f64 {
            20.0 * (x - 0.377)
        }
        fn domain(&self) -> [f64; 2] {
            [f64::NEG_INFINITY, f64::INFINITY]
        }
    }
    // D = 0.1, x_d = 0.1, n = 20: the mean slope gives (4/3) (D/x_d) (1 - 1/(4 n^2)) when an element is at the apex.
    let row = slide_to(&Parabola, DEPTH, 0.005, 1e-11).last;
    let expected = 4.0 / 3.0 * (1.0 - 1.0 / 1600.0);
    // The lowest point of a smooth line is known to the square root of rounding, half of the digits.
    assert!(
        (row.friction_coefficient / expected - 1.0).abs() < 1e-7
            && (row.contact[0] - 0.377).abs() < 1e-7,
        "{row:?} instead of {expected}"
    );
}

/// On an infinite domain a foot is seen although it stands a hundred contact lengths ahead of the lowest point.
#[test]
fn a_far_foot_on_an_infinite_domain_is_seen() {
    struct TwoFeet;
    impl RigidLine for TwoFeet {
        fn height(&self, x: f64) -> f64 {
            x.abs().min(0.05 + 0.5 * (x - 30.0).abs())
        }
        fn slope(&self, _x: f64) -> f64 {
            1.0
        }
        fn domain(&self) -> [f64; 2] {
            [f64::NEG_INFINITY, f64::INFINITY]
        }
    }
    let row = slide_to(&TwoFeet, 0.3, 0.05, 1e-11).last;
    assert!(
        row.contact[0].abs() < 1e-12 && (row.contact[1] - 30.45).abs() <= 0.051,
        "contact {:?} instead of [0, 30.5]",
        row.contact
    );
}
