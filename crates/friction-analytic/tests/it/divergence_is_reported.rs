use casebook::{assert_close, assert_matches};
use friction_analytic::{
    DivergenceCause, FrictionError, axisymmetric_sliding, line_sliding, power_sliding,
    superposition_sliding,
};
use indenters::{
    AnalyticLine, Axisymmetric, FlatCone, FlatPunch, PowerProfile, PowerTerm, ProfilePoint,
    Superposition, contact_radius,
};

use crate::support::with_depth;

/// The sum that a chain of `n` elements per (a − b) makes of ∫ h̃'² dx / D, with an element edge at the kink b.
fn discrete_friction(body: &dyn Axisymmetric, [kink, front]: [f64; 2], n: u32) -> f64 {
    let spacing = (front - kink) / f64::from(n);
    let height = |k: u32| body.line_height(kink + spacing * f64::from(k));
    let squares: f64 = (0..n).map(|k| (height(k + 1) - height(k)).powi(2)).sum();
    squares / spacing / body.line_height(front)
}

#[test]
fn a_slope_jump_diverges_like_a_logarithm() {
    for case in casebook::group("FRI-04") {
        let (body, depth) = (case.body(), case.input("D"));
        let (material, load) = with_depth(depth);
        let result = axisymmetric_sliding(body.as_ref(), &material, &load);
        assert_eq!(
            case.expected_error(),
            Some("FrictionDiverges"),
            "{}",
            case.id()
        );
        let Err(FrictionError::FrictionDiverges {
            cause,
            indentation_depth,
            contact_length,
        }) = result
        else {
            panic!("{}: {result:?} instead of a divergence", case.id());
        };
        let kink = body.kinks()[0];
        let expected = DivergenceCause::SlopeJump {
            radius: kink.radius,
            jump: kink.slope_jump,
        };
        assert_eq!(cause, expected, "{}", case.id());
        assert_close!(indentation_depth => depth, within 1e-15);
        assert_close!(
            contact_length => contact_radius(body.as_ref(), depth).unwrap(),
            within 1e-15
        );
        let ends = [kink.radius, contact_length];
        let coarse = discrete_friction(body.as_ref(), ends, 2_000);
        let fine = discrete_friction(body.as_ref(), ends, 20_000);
        case.check("mu_increment_per_decade_of_dx", fine - coarse);
    }
}

#[test]
fn a_contact_that_ends_at_the_jump_has_friction() {
    let (tip, jump) = (0.3, 0.1);
    let body = SteepeningCone {
        slope: tip,
        kink: 0.5,
        jump,
    };
    let depth_at_kink = std::f64::consts::FRAC_PI_2 * tip * 0.5;
    let (material, load) = with_depth(depth_at_kink * (1.0 - 1e-9));
    let state = axisymmetric_sliding(&body, &material, &load).unwrap();
    assert_close!(state.friction_coefficient => std::f64::consts::FRAC_PI_2 * tip, within 1e-11);
    let (material, load) = with_depth(depth_at_kink * (1.0 + 1e-9));
    let result = axisymmetric_sliding(&body, &material, &load);
    assert_matches!(
        result,
        Err(FrictionError::FrictionDiverges {
            cause: DivergenceCause::SlopeJump { .. },
            ..
        }),
        " beyond the kink"
    );
}

/// A cone that gets steeper at a radius.
struct SteepeningCone {
    slope: f64,
    kink: f64,
    jump: f64,
}

impl Axisymmetric for SteepeningCone {
    fn profile(&self, radius: f64) -> ProfilePoint {
        let jump = if radius > self.kink { self.jump } else { 0.0 };
        ProfilePoint {
            height: self.slope * radius + jump * (radius - self.kink),
            slope: self.slope + jump,
            curvature: 0.0,
        }
    }

    fn profile_exponent(&self) -> f64 {
        1.0
    }

    fn kinks(&self) -> Vec<indenters::Kink> {
        vec![indenters::Kink {
            radius: self.kink,
            slope_jump: self.jump,
        }]
    }
}

#[test]
fn a_sharp_apex_diverges_in_every_function() {
    let depth = 0.1;
    let (material, load) = with_depth(depth);
    for p in [0.1, 0.4, 0.5] {
        let profile = PowerProfile::new(0.4, p).unwrap();
        let terms = [p, 2.0].map(|exponent| PowerTerm {
            coefficient: 0.4,
            exponent,
        });
        let sum = Superposition::new(terms.to_vec()).unwrap();
        let results = [
            power_sliding(&profile, &material, &load),
            axisymmetric_sliding(&profile, &material, &load),
            superposition_sliding(&sum, &material, &load),
            axisymmetric_sliding(&sum, &material, &load),
        ];
        for result in results {
            let Err(FrictionError::FrictionDiverges {
                cause,
                indentation_depth,
                ..
            }) = result
            else {
                panic!("p = {p}: {result:?} instead of a divergence");
            };
            assert_eq!(
                cause,
                DivergenceCause::ApexExponent { exponent: p },
                "p = {p}"
            );
            assert_close!(indentation_depth => depth, within 1e-15);
        }
    }
}

#[test]
fn a_vertical_edge_diverges_at_every_depth() {
    let punch = FlatPunch::new(0.5).unwrap();
    for depth in [1e-9, 0.1, 1e9] {
        let (material, load) = with_depth(depth);
        let result = axisymmetric_sliding(&punch, &material, &load);
        let expected = FrictionError::FrictionDiverges {
            cause: DivergenceCause::VerticalEdge { radius: 0.5 },
            indentation_depth: depth,
            contact_length: 0.5,
        };
        assert_eq!(result, Err(expected), "depth {depth}");
    }
}

/// A line does not say why it is steep; its integral must not come out as a number all the same.
#[test]
fn the_same_line_without_its_body_is_not_converged() {
    let cone = FlatCone::new(0.5, 0.3).unwrap();
    let line =
        AnalyticLine::new(|x| cone.line_height(x), |x| cone.line_slope(x), [0.5, 2.0]).unwrap();
    let (material, load) = with_depth(0.1);
    let result = line_sliding(&line, &material, &load);
    assert_matches!(result, Err(FrictionError::NotConverged { .. }));
}

#[test]
fn the_message_says_why() {
    let error = power_sliding(
        &PowerProfile::new(0.4, 0.5).unwrap(),
        &with_depth(0.1).0,
        &with_depth(0.1).1,
    )
    .unwrap_err();
    let message = error.to_string();
    assert!(
        message.contains("exponent 0.5, more than 0.5 is needed") && message.contains("depth 0.1 "),
        "{message}"
    );
}
