use std::f64::consts::FRAC_PI_2;

use casebook::{assert_close, assert_matches, superposition};
use friction_analytic::{
    DivergenceCause, FrictionError, StationarySliding, axisymmetric_sliding, line_sliding,
    power_sliding, superposition_sliding,
};
use indenters::{
    AnalyticLine, Axisymmetric as _, FlatCone, FlatPunch, Kink, PiecewiseLinearProfile,
    contact_radius,
};

use crate::support::{power, with_depth};

/// Depth and contact length of friction that is infinite for a cause.
fn divergence(
    result: Result<StationarySliding, FrictionError>,
    expected: DivergenceCause,
) -> [f64; 2] {
    match result {
        Err(FrictionError::FrictionDiverges {
            cause,
            indentation_depth,
            contact_length,
        }) if cause == expected => [indentation_depth, contact_length],
        other => panic!("{other:?} instead of friction that is infinite because {expected}"),
    }
}

fn jump_at(kink: Kink) -> DivergenceCause {
    DivergenceCause::SlopeJump {
        radius: kink.radius,
        jump: kink.slope_jump,
    }
}

#[test]
fn a_slope_jump_diverges() {
    for case in casebook::group("FRI-04") {
        let (body, expected) = (case.body(), case.input("D"));
        let (material, load) = with_depth(expected);
        let result = axisymmetric_sliding(&body, &material, &load);
        let kink = body.kinks()[0];
        let [depth, length] = divergence(result, jump_at(kink));
        assert_close!(depth => expected, within 1e-15; "{}", case.id());
        assert_close!(length => contact_radius(&body, expected).unwrap(), within 1e-15);
    }
}

#[test]
fn a_contact_that_ends_at_the_jump_has_friction() {
    let body = PiecewiseLinearProfile::new(vec![0.0, 0.5, 2.5], vec![0.0, 0.15, 0.95]).unwrap();
    let slide = |part: f64| {
        let (material, load) = with_depth(FRAC_PI_2 * 0.3 * 0.5 * part);
        axisymmetric_sliding(&body, &material, &load)
    };
    let state = slide(1.0 - 1e-9).unwrap();
    assert_close!(state.friction_coefficient => FRAC_PI_2 * 0.3, within 1e-11);
    let kink = body.kinks()[0];
    assert_close!(kink.slope_jump => 0.1, within 1e-14);
    divergence(slide(1.0 + 1e-7), jump_at(kink));
}

#[test]
fn a_sharp_apex_diverges_in_every_function() {
    let (material, load) = with_depth(0.1);
    for p in [0.1, 0.4, 0.5] {
        let profile = power(0.4, p);
        let sum = superposition(&[(0.4, p), (0.4, 2.0)]);
        for result in [
            power_sliding(&profile, &material, &load),
            axisymmetric_sliding(&profile, &material, &load),
            superposition_sliding(&sum, &material, &load),
            axisymmetric_sliding(&sum, &material, &load),
        ] {
            let apex = DivergenceCause::ApexExponent { exponent: p };
            let [depth, _] = divergence(result, apex);
            assert_close!(depth => 0.1, within 1e-15; "p = {p}");
        }
    }
}

#[test]
fn a_vertical_edge_diverges_at_every_depth() {
    let punch = FlatPunch::new(0.5).unwrap();
    for expected in [1e-9, 0.1, 1e9] {
        let (material, load) = with_depth(expected);
        let result = axisymmetric_sliding(&punch, &material, &load);
        let [depth, length] = divergence(result, DivergenceCause::VerticalEdge { radius: 0.5 });
        assert_close!(depth => expected, within 0.0);
        assert_close!(length => 0.5, within 0.0; "depth {expected}");
    }
}

/// A line does not say why it is steep; its integral must not come out as a number all the same.
#[test]
fn the_same_line_without_its_body_is_not_converged() {
    let cone = FlatCone::new(0.5, 0.3).unwrap();
    let line = AnalyticLine::new(|x| cone.line_height(x), |x| cone.line_slope(x), [0.5, 2.0]);
    let (material, load) = with_depth(0.1);
    let result = line_sliding(&line.unwrap(), &material, &load);
    assert_matches!(result, Err(FrictionError::NotConverged { .. }));
}

#[test]
fn the_message_names_the_cause() {
    let (material, load) = with_depth(0.1);
    let error = power_sliding(&power(0.4, 0.5), &material, &load).unwrap_err();
    let message = error.to_string();
    for part in [
        "exponent 0.5, and an exponent above 0.5 is needed",
        "depth 0.1 ",
    ] {
        assert!(message.contains(part), "no {part:?} in {message:?}");
    }
}
