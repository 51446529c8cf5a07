//! Bodies without a power law: the closed friction integrals of casebook FRI-02, the growth of the sum where the
//! integral diverges (FRI-04), and a body that is too low.

use casebook::Case;
use indenters::{
    Axisymmetric, EquivalentLine, FlatCone, FlatPunch, Hyperboloid, RoundTippedCone, Sphere,
    TruncatedParaboloid,
};
use mdr_core::{MdrError, SlideOptions, SlideRow, slide_on_grid};

use crate::support::{VISCOSITY, load_for_depth, material};

fn body(case: &Case) -> Box<dyn Axisymmetric> {
    match case.input_text("shape") {
        "sphere" => Box::new(Sphere::new(case.input("R")).expect("a sphere")),
        "round-tipped cone" => Box::new(
            RoundTippedCone::new(case.input("b"), case.input("tan_theta")).expect("a cone"),
        ),
        "hyperboloid" => {
            let radius = case.input("b");
            Box::new(Hyperboloid::new(radius, case.input("L") / radius).expect("a hyperboloid"))
        }
        "flat-ended cone" => {
            Box::new(FlatCone::new(case.input("b"), case.input("tan_theta")).expect("a flat cone"))
        }
        "truncated paraboloid" => Box::new(
            TruncatedParaboloid::new(case.input("b"), 0.5 / case.input("R")).expect("a paraboloid"),
        ),
        other => panic!("{}: unknown shape {other:?}", case.id()),
    }
}

fn stationary(case: &Case, elements: usize) -> SlideRow {
    let body = body(case);
    let (material, load) = (material(VISCOSITY), load_for_depth(case.input("D")));
    let options = SlideOptions {
        drift_tolerance: 1e-6,
        ..SlideOptions::with_elements(elements, &EquivalentLine(body.as_ref()), &material, &load)
            .expect("a contact radius")
    };
    slide_on_grid(&EquivalentLine(body.as_ref()), &material, &load, &options)
        .expect("a stationary state")
        .last
}

/// The mean slope is below the integral by about 1/(4 n²), with n = 200 elements 6e-6.
#[test]
fn smooth_bodies_have_the_friction_of_the_casebook() {
    for case in casebook::group("FRI-02") {
        let row = stationary(&case, 200);
        case.check_within("mu", row.friction_coefficient, 1e-5);
        case.check_within("x_d", row.contact_length, 1.01 / 200.0);
    }
}

/// A kink that rises makes the integral (16) infinite: the sum grows by the same amount with every decade of the
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

/// Remark 4, casebook EXT-02: the punch has no height at all.
#[test]
fn bodies_lower_than_the_stationary_depth_have_no_stationary_state() {
    let options = SlideOptions {
        spacing: 0.01,
        drift_tolerance: 1e-6,
        max_sliding_distance: 10.0,
    };
    let punch = FlatPunch::new(1.0).expect("a punch");
    let load = load_for_depth(0.1);
    let result = slide_on_grid(
        &EquivalentLine(&punch),
        &material(VISCOSITY),
        &load,
        &options,
    );
    assert!(
        matches!(result, Err(MdrError::ForceBeyondEdge { available, .. }) if available.abs() < 1e-15),
        "{result:?}"
    );
}
