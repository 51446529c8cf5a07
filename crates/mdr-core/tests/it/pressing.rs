//! Pressing without sliding has the exact solution of the half space (casebook MDR-01, VIS-01, VIS-02, EXT-05): a history to
//! rounding, and a chain of elements within its bars.

use casebook::Case;
use indenters::{Axisymmetric, Control, EquivalentLine, PowerProfile, PressingLoad};
use mdr_core::{CurvePoint, Follow, HistoryPoint, Indentation, indent, indent_along};
use numerics::{Accuracy, Estimate, Request};
use rheology::Material;

use crate::support::{
    VISCOSITY, assert_agree, assert_close, assert_order, line_power, material, material_of, power,
};

use Control::{IndentationDepth, NormalForce};

/// The points of a history; force and depth are those of casebooks, which know 11 digits.
fn follow(
    body: &dyn Axisymmetric,
    material: &dyn Material,
    points: &[(f64, Control)],
) -> Vec<CurvePoint> {
    let point = |&(time, control): &(f64, Control)| HistoryPoint { time, control };
    let history: Vec<HistoryPoint> = points.iter().map(point).collect();
    indent_along(body, material, &history, &Follow::default()).expect("a disc")
}

fn on_chain<'a>(
    body: &dyn Axisymmetric,
    material: &dyn Material,
    (time, control): (f64, Control),
    request: impl Into<Request<'a>>,
) -> Indentation {
    let load = PressingLoad::new(control, time).expect("a load");
    indent(&EquivalentLine(body), material, &load, request).expect("a contact")
}

/// A control that is there from first touch on: the state as a history, and on chains within their bars.
fn held(body: &dyn Axisymmetric, material: &dyn Material, at: (f64, Control)) -> CurvePoint {
    let last = follow(body, material, &[(0.0, at.1), at])[1];
    let exact = Estimate::exact;
    for accuracy in [Accuracy::Elements(32), Accuracy::RelativeError(1e-3)] {
        let chain = on_chain(body, material, at, accuracy);
        for (got, expected) in [
            (chain.indentation_depth, last.indentation_depth.value),
            (chain.normal_force, last.normal_force.value),
            (chain.ends[0], -last.contact_radius.value),
            (chain.ends[1], last.contact_radius.value),
        ] {
            // The closed form rounds, too.
            let expected = Estimate {
                error: 1e-12 * expected.abs(),
                ..exact(expected)
            };
            assert_agree([got, expected], &(accuracy, &at));
        }
    }
    last
}

/// The trapezoidal sum over d − h̃ has the order 2, at the cusp of p < 1 the order p + 1, and that of a triangle is its area.
#[test]
fn depth_converges_with_the_order_of_the_trapezoidal_sum() {
    let at = (3.0, NormalForce(2.0));
    let error = |exponent: f64, n: usize| {
        let (body, dashpot) = (power(exponent), material(VISCOSITY));
        let exact = follow(&body, &dashpot, &[(0.0, at.1), at])[1].indentation_depth;
        let chain = on_chain(&body, &dashpot, at, Accuracy::Elements(2 * n));
        chain.indentation_depth.value / exact.value - 1.0
    };
    for (exponent, expected) in [(0.5, 1.5), (0.75, 1.75), (1.5, 2.0), (2.0, 2.0), (4.0, 2.0)] {
        let errors = [16, 32, 64, 128, 256].map(|n| error(exponent, n));
        assert_order(&errors, expected, &exponent);
    }
    // The elements of the length of the contact are known to 1e-9.
    let cone = error(1.0, 20);
    assert!(cone.abs() < 1e-11, "relative error {cone} of the cone");
}

/// On a dashpot depth and contact depend on the impulse F t alone, over six decades in time.
#[test]
fn a_force_on_a_dashpot_has_the_depth_of_its_impulse() {
    let rows = casebook::group("MDR-01").into_iter();
    let cases: Vec<Case> = rows.filter(|case| case.has_input("p")).collect();
    assert!(cases.len() >= 12, "only {} rows", cases.len());
    for case in cases {
        let body = PowerProfile::new(case.input("c"), case.input("p")).expect("a power profile");
        let at = (case.input("t"), NormalForce(case.input("F")));
        let last = held(&body, &material(case.input("eta")), at);
        case.check_within("d", last.indentation_depth.value, 1e-12);
        case.check_within("a", last.contact_radius.value, 1e-12);
    }
}

fn bodies(case: &Case) -> [(&'static str, PowerProfile); 2] {
    let cone = PowerProfile::cone(case.input("tan_theta")).expect("a cone");
    let paraboloid = line_power(case.input("R").recip(), 2.0);
    [("paraboloid", paraboloid), ("cone", cone)]
}

/// A depth that rises and a force that is there at once, as Lee and Radok say.
#[test]
fn ramps_of_depth_and_steps_of_force_are_those_of_lee_and_radok() {
    for case in casebook::group("VIS-01") {
        let (material, time) = (material_of(&case), case.input("t"));
        for (name, body) in bodies(&case) {
            let last = if case.has_input("V") {
                let depth = IndentationDepth(case.input("V") * time);
                let points = [(0.0, IndentationDepth(0.0)), (time, depth)];
                let last = follow(&body, &*material, &points)[1];
                case.check_within(&format!("F_{name}"), last.normal_force.value, 1e-11);
                last
            } else {
                let last = held(&body, &*material, (time, NormalForce(case.input("F"))));
                case.check_within(&format!("d_{name}"), last.indentation_depth.value, 1e-11);
                last
            };
            case.check_within(&format!("a_{name}"), last.contact_radius.value, 1e-11);
        }
    }
}

/// After the turn the contact shrinks faster than the depth, and is lost before it is zero.
#[test]
fn a_falling_depth_has_the_force_of_ting() {
    let mut n_lost = 0;
    let named = |case: &Case| case.has_input("t") && !case.input_text("model").is_empty();
    for case in casebook::group("VIS-02").into_iter().filter(named) {
        let [turn, time, speed] = ["T", "t", "V"].map(|name| case.input(name));
        let depths = [(0.0, 0.0), (turn, turn), (time, 2.0 * turn - time)];
        let points = depths.map(|(time, way)| (time, IndentationDepth(speed * way)));
        for (name, body) in bodies(&case) {
            let Some(expected) = case.expected(&format!("F_{name}")) else {
                continue;
            };
            let curve = follow(&body, &*material_of(&case), &points);
            let (force, largest) = (curve[2].normal_force.value, curve[1].normal_force.value);
            assert_close([force, expected], 1e-10, largest, &(case.id(), name));
            let radius = case.expected(&format!("a_{name}"));
            n_lost += usize::from(radius.is_none());
            let pair = [curve[2].contact_radius.value, radius.unwrap_or(0.0)];
            assert_close(pair, 1e-10, 0.0, &(case.id(), name));
        }
    }
    assert!(n_lost >= 2, "only {n_lost} contacts are lost");
}

/// EXT-05: a depth that is held relaxes with G(t), from 10⁻¹⁵ s to 10⁹ s.
#[test]
fn a_held_depth_relaxes_at_every_time_scale() {
    for case in casebook::group("EXT-05") {
        if case.expected("F").is_some() {
            let body = line_power(case.input("R").recip(), 2.0);
            let at = (case.input("t"), IndentationDepth(case.input("d")));
            let last = held(&body, &*material_of(&case), at);
            case.check_within("F", last.normal_force.value, 1e-10);
        }
    }
}
