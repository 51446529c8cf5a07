//! Pressing without sliding: on a dashpot depth and contact depend on the impulse F t alone (casebook MDR-01), and on any
//! material the line has the exact solution of the half space (VIS-01, VIS-02, EXT-05).

use casebook::Case;
use friction_analytic::{Indentation, power_indentation_after_impulse};
use indenters::{Control, EquivalentLine, PowerProfile};
use mdr_core::IndentRow;

use crate::support::{
    VISCOSITY, assert_close, assert_order, indent, line_power, material, material_of, power,
};

const FORCE: f64 = 2.0;
const TIME: f64 = 3.0;

/// Elements along the radius, and steps: the sum over elements is known to their number squared, the load held over
/// steps to the number of these.
const ELEMENTS: f64 = 400.0;
const STEPS: usize = 1600;
const TOLERANCE: f64 = 4.0 / STEPS as f64;

fn exact(body: &PowerProfile, time: f64) -> Indentation {
    power_indentation_after_impulse(body, &material(VISCOSITY), FORCE * time).expect("a contact")
}

/// A constant force on a dashpot, with n elements on each side of the apex at the end.
fn pressed(body: &PowerProfile, n: f64, times: &[f64]) -> Vec<IndentRow> {
    let spacing = exact(body, TIME).contact_radius / n;
    let (line, dashpot) = (EquivalentLine(body), material(VISCOSITY));
    let force = |_| Control::NormalForce(FORCE);
    indent(&line, &dashpot, times, spacing, force).expect("a contact")
}

/// The trapezoidal sum over d − h̃ has the order 2, at the cusp of p < 1 the order p + 1, and that of a triangle is its area.
#[test]
fn depth_converges_with_the_order_of_the_trapezoidal_sum() {
    let error = |exponent: f64, n: f64| {
        let body = power(exponent);
        let depth = pressed(&body, n, &[TIME])[0].indentation_depth;
        depth / exact(&body, TIME).indentation_depth - 1.0
    };
    for (exponent, expected) in [(0.5, 1.5), (0.75, 1.75), (1.5, 2.0), (2.0, 2.0), (4.0, 2.0)] {
        let errors = [16.0, 32.0, 64.0, 128.0, 256.0].map(|n| error(exponent, n));
        assert_order(&errors, expected, &exponent);
    }
    let cone = error(1.0, 20.0);
    assert!(cone.abs() < 1e-13, "relative error {cone} of the cone");
}

/// Casebook rows, at the two ends of six decades in time, with 2000 elements along the contact: depth to the
/// trapezoidal sum (p + 1 below one, 2 above, larger with p²), radius to one element.
#[test]
fn casebook_rows_come_out() {
    let rows = casebook::group("MDR-01").into_iter();
    let cases: Vec<Case> = rows.filter(|case| case.has_input("p")).collect();
    assert!(cases.len() >= 12, "only {} rows", cases.len());
    for case in cases {
        let p = case.input("p");
        let body = PowerProfile::new(case.input("c"), p).expect("a power profile");
        let spacing = case.expected("a").expect("a radius") / 1000.0;
        let (line, dashpot) = (EquivalentLine(&body), material(case.input("eta")));
        let force = |_| Control::NormalForce(case.input("F"));
        let rows = indent(&line, &dashpot, &[case.input("t")], spacing, force).expect("a contact");
        let tolerance = 2.0 * p.max(1.0) * 1000.0_f64.powf(-(p + 1.0).min(2.0));
        case.check_within("d", rows[0].indentation_depth, tolerance);
        let [rear, front] = rows[0].contact.expect("a contact");
        case.check_within("a", front, 1.01e-3);
        assert_close([-rear, front], 1e-12, 0.0, &case.id());
        case.check_within("a", 0.5 * rows[0].contact_length, 1.01e-3);
    }
}

/// One step or a thousand, even or clustered at the start: the same depth to rounding, although d ∼ t^(p/(p+1)).
#[test]
fn number_of_time_steps_does_not_matter() {
    for exponent in [0.5, 1.0, 2.0, 4.0] {
        let last_depth = |times: &[f64]| {
            pressed(&power(exponent), 50.3, times)[times.len() - 1].indentation_depth
        };
        let at_once = last_depth(&[TIME]);
        for (n_steps, clustering) in [(10, 1), (1000, 1), (1000, 6)] {
            let fractions = (1..=n_steps).map(|k| f64::from(k) / f64::from(n_steps));
            let times: Vec<f64> = fractions.map(|part| TIME * part.powi(clustering)).collect();
            // A thousand steps each round the depth once.
            let scene = (exponent, n_steps, clustering);
            assert_close([last_depth(&times), at_once], 1e-12, 0.0, &scene);
        }
    }
}

fn bodies(case: &Case) -> [(&'static str, PowerProfile); 2] {
    let cone = PowerProfile::cone(case.input("tan_theta")).expect("a cone");
    let paraboloid = line_power(case.input("R").recip(), 2.0);
    [("paraboloid", paraboloid), ("cone", cone)]
}

/// A depth that rises with the speed V up to a time, and falls again until the time of the case.
fn triangle(body: &PowerProfile, case: &Case, turn: f64) -> Vec<IndentRow> {
    let (end, speed) = (case.input("t"), case.input("V"));
    let radius = indenters::contact_radius(body, speed * turn).expect("a radius");
    let times: Vec<f64> = (1..=STEPS).map(|k| end * k as f64 / STEPS as f64).collect();
    let depth = |time: f64| Control::IndentationDepth(speed * (turn - (time - turn).abs()));
    let (line, material) = (EquivalentLine(body), material_of(case));
    indent(&line, &*material, &times, radius / ELEMENTS, depth).expect("a history")
}

/// Times that grow in proportion up to that of a case.
fn growing(case: &Case, first: f64) -> Vec<f64> {
    let fractions = (0..=STEPS).map(|k| k as f64 / STEPS as f64);
    let times = fractions.map(|part| case.input("t") * first.powf(1.0 - part));
    times.collect()
}

fn half_width(row: &IndentRow) -> f64 {
    let [rear, front] = row.contact.expect("a contact");
    0.5 * (front - rear)
}

/// The casebook's material of infinite stiffness at once is pressed by the speed of the step: half a step late.
#[test]
fn a_rising_depth_has_the_force_of_lee_and_radok() {
    let cases = casebook::group("VIS-01").into_iter();
    for case in cases.filter(|case| case.has_input("V")) {
        for (name, body) in bodies(&case) {
            let row = triangle(&body, &case, case.input("t"))[STEPS - 1];
            case.check_within(&format!("F_{name}"), row.normal_force, TOLERANCE);
            case.check_within(&format!("a_{name}"), half_width(&row), 1.01 / ELEMENTS);
        }
    }
}

/// A constant force from the start: depth and radius follow J(t), in steps that grow with the time, by 1.3 %.
#[test]
fn a_step_of_force_has_the_depth_of_lee_and_radok() {
    let cases = casebook::group("VIS-01").into_iter();
    for case in cases.filter(|case| case.has_input("F")) {
        for (name, body) in bodies(&case) {
            let radius = case.expected(&format!("a_{name}")).expect("a radius");
            let (line, material) = (EquivalentLine(&body), material_of(&case));
            let force = |_| Control::NormalForce(case.input("F"));
            let (times, spacing) = (growing(&case, 1e-9), radius / ELEMENTS);
            let rows = indent(&line, &*material, &times, spacing, force).expect("a history");
            let depth = rows[STEPS].indentation_depth;
            case.check_within(&format!("d_{name}"), depth, 0.013);
        }
    }
}

/// After the turn the contact shrinks faster than the depth, and is lost before it is zero.
#[test]
fn a_falling_depth_has_the_force_of_ting() {
    let mut n_lost = 0;
    let named = |case: &Case| case.has_input("t") && !case.input_text("model").is_empty();
    for case in casebook::group("VIS-02").into_iter().filter(named) {
        for (name, body) in bodies(&case) {
            let Some(expected) = case.expected(&format!("F_{name}")) else {
                continue;
            };
            let rows = triangle(&body, &case, case.input("T"));
            let row = rows[STEPS - 1];
            let largest = rows.iter().map(|row| row.normal_force).fold(0.0, f64::max);
            let context = (case.id(), name);
            assert_close([row.normal_force, expected], TOLERANCE, largest, &context);
            if let Some(radius) = case.expected(&format!("a_{name}")) {
                // In a step the radius falls by some elements.
                assert_close([half_width(&row), radius], 0.02, 0.0, &context);
            } else {
                assert_eq!(row.contact, None, "{}: {row:?}", case.id());
                n_lost += 1;
            }
        }
    }
    assert!(n_lost >= 2, "only {n_lost} contacts are lost");
}

/// EXT-05: a depth that is held relaxes with G(t), from 10⁻¹⁵ s to 10⁹ s, in steps of 1.7 % of the time.
#[test]
fn a_held_depth_relaxes_at_every_time_scale() {
    for case in casebook::group("EXT-05") {
        let Some(expected) = case.expected("F") else {
            continue;
        };
        let body = line_power(case.input("R").recip(), 2.0);
        let (line, depth) = (EquivalentLine(&body), case.input("d"));
        let spacing = body.line_position(depth) / ELEMENTS;
        let held = |_| Control::IndentationDepth(depth);
        let times = growing(&case, 1e-12);
        let rows = indent(&line, &*material_of(&case), &times, spacing, held).expect("a history");
        assert_close([rows[STEPS].normal_force, expected], 0.017, 0.0, &case.id());
    }
}
