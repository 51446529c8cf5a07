//! A leading edge of several intervals carries load on each of them, and nowhere between (casebook FRI-03).

use casebook::Case;
use mdr_core::{MdrError, SlideOptions, Transient, slide_on_grid};

use crate::support::{Cubic, VISCOSITY, load_for_depth, material, observed_orders};

/// The gaps and fronts at 1/2, 2, 5/2 fall on elements; the error of the mean slope is below n⁻² with n elements per
/// unit length.
fn cubic_cases() -> Vec<Case> {
    casebook::group("FRI-03")
        .into_iter()
        .filter(|case| case.id().contains("/cubic/"))
        .collect()
}

fn slide_cubic(case: &Case, per_length: f64) -> Result<Transient, MdrError> {
    let scale = case.input("eps");
    let mirrored = case.has_input("direction");
    let options = SlideOptions {
        spacing: 1.0 / per_length,
        drift_tolerance: 1e-11,
        max_sliding_distance: 200.0,
    };
    let load = load_for_depth(scale * case.input("D_over_eps"));
    slide_on_grid(
        &Cubic { scale, mirrored },
        &material(VISCOSITY),
        &load,
        &options,
    )
}

#[test]
fn friction_and_ends_agree_with_the_casebook() {
    for case in cubic_cases()
        .iter()
        .filter(|case| case.expected_error().is_none())
    {
        let per_length = 200.0;
        let row = slide_cubic(case, per_length)
            .expect("a stationary state")
            .last;
        case.check_within("mu", row.friction_coefficient, per_length.powi(-2));
        let intervals = case.expected_list("intervals").expect("intervals");
        let ends = [intervals[0], intervals[intervals.len() - 1]];
        let lengths: f64 = intervals.chunks(2).map(|ends| ends[1] - ends[0]).sum();
        let n_intervals = 0.5 * intervals.len() as f64;
        for (name, actual, expected, allowed) in [
            ("rear", row.contact[0], ends[0], 1.0),
            ("front", row.contact[1], ends[1], 1.0),
            ("length", row.contact_length, lengths, n_intervals),
        ] {
            assert!(
                (actual - expected).abs() <= 1.0001 * allowed / per_length,
                "{}: {name} {actual} instead of {expected}",
                case.id()
            );
        }
    }
}

#[test]
fn friction_over_a_gap_is_second_order() {
    let case = cubic_cases().remove(0);
    let exact = case.expected("mu").expect("a friction coefficient");
    let errors: Vec<f64> = [8.0, 16.0, 32.0, 64.0, 128.0]
        .iter()
        .map(|n| slide_cubic(&case, *n).expect("a stationary state"))
        .map(|transient| transient.last.friction_coefficient / exact - 1.0)
        .collect();
    for order in observed_orders(&errors) {
        assert!(
            (order - 2.0).abs() < 0.15,
            "order {order} instead of 2, errors {errors:?}"
        );
    }
}

#[test]
fn too_low_a_leading_edge_has_no_stationary_state() {
    let mut n_refused = 0;
    for case in cubic_cases()
        .iter()
        .filter(|case| case.expected_error().is_some())
    {
        let depth = case.input("eps") * case.input("D_over_eps");
        // Mirrored, the leading edge is the lowest point alone.
        let height = if case.has_input("direction") {
            0.0
        } else {
            1.5 * case.input("eps")
        };
        match slide_cubic(case, 50.0) {
            Err(MdrError::ForceBeyondEdge {
                normal_force,
                carried_force,
                available,
                ..
            }) => {
                n_refused += 1;
                let close = |a: f64, b: f64| (a - b).abs() < 1e-14;
                assert!(
                    close(carried_force / normal_force, height / depth) && close(available, height),
                    "{}: {carried_force} of {normal_force} at {available}, expected {height} of {depth}",
                    case.id()
                );
            }
            other => panic!("{}: {other:?}", case.id()),
        }
    }
    assert_eq!(n_refused, 2, "rows of the casebook");
}
