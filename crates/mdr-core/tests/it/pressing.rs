//! Pressing without sliding has the exact solution of the half space (casebook MDR-01, VIS-01, EXT-05), as a history
//! and as springs of the compliance of the time.

use casebook::Case;
use indenters::{Axisymmetric, Control, EquivalentLine, HistoryPoint, PowerProfile, PressingLoad};
use mdr_core::{CurvePoint, HistoryOptions, indent, indent_along};
use rheology::Material;

use crate::support::{assert_agree, line_power, material, material_of};

use Control::{IndentationDepth, NormalForce};

/// The points of a history; force and depth are those of casebooks, which know 11 digits.
fn follow(
    body: &dyn Axisymmetric,
    material: &dyn Material,
    points: &[(f64, Control)],
) -> Vec<CurvePoint> {
    let point = |&(time, control): &(f64, Control)| HistoryPoint { time, control };
    let history: Vec<HistoryPoint> = points.iter().map(point).collect();
    indent_along(&body, material, &history, &HistoryOptions::default()).expect("a disc")
}

/// A control that is there from first touch on, as a history and on springs.
fn held(body: &dyn Axisymmetric, material: &dyn Material, at: (f64, Control)) -> CurvePoint {
    let last = follow(body, material, &[(0.0, at.1), at])[1];
    let load = PressingLoad::new(at.1, at.0).expect("a load");
    let pressed = indent(&EquivalentLine(body), material, &load, 1e-9).expect("a contact");
    for (got, expected) in [
        (pressed.indentation_depth, last.indentation_depth),
        (pressed.normal_force, last.normal_force),
        (pressed.ends[1], last.contact_radius),
    ] {
        assert_agree([got, expected], &at);
    }
    for known in [pressed.indentation_depth, pressed.normal_force] {
        assert!(known.error <= 1e-9 * known.value, "{pressed:?}");
    }
    last
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

/// A ramp of the depth and a step of the force, as given by Lee and Radok.
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
