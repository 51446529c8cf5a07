//! Pressing by a given force or depth, and letting go, on any material (casebook VIS-01, VIS-02, EXT-05): the line has
//! the exact solution of the half space.

use casebook::Case;
use indenters::{Control, EquivalentLine};
use mdr_core::{IndentRow, IndentStep, indent_history};

use rheology::Prony;

use crate::support::{Shape, assert_close, indent, model, prony};

/// Elements along the radius, and steps: the sum over elements is known to their number squared, the load held over
/// steps to the number of these.
const ELEMENTS: f64 = 400.0;
const STEPS: usize = 1600;
const TOLERANCE: f64 = 4.0 / STEPS as f64;

const SHAPES: [(Shape, &str); 2] = [(Shape::Paraboloid, "paraboloid"), (Shape::Cone, "cone")];

fn line_coefficient(shape: Shape, case: &Case) -> f64 {
    match shape {
        Shape::Cone => case.input("tan_theta") * std::f64::consts::FRAC_PI_2,
        Shape::Paraboloid => case.input("R").recip(),
    }
}

fn material_of(case: &Case) -> Prony {
    if !case.has_input("Ge") {
        return model(case.input_text("model"));
    }
    let [moduli, times] = ["G", "tau"].map(|name| case.input_list(name));
    let branches: Vec<(f64, f64)> = moduli.into_iter().zip(times).collect();
    let eta = if case.has_input("eta") {
        case.input("eta")
    } else {
        0.0
    };
    prony([case.input("Ge"), eta], &branches)
}

/// A depth that rises with the speed V up to a time, and falls again.
fn triangle(case: &Case, turn: f64, end: f64) -> Vec<IndentStep> {
    let step = |k: usize| {
        let time = end * k as f64 / STEPS as f64;
        let depth = case.input("V") * (turn - (time - turn).abs());
        IndentStep {
            time,
            control: Control::IndentationDepth(depth),
        }
    };
    (1..=STEPS).map(step).collect()
}

fn press(shape: Shape, case: &Case, [turn, end]: [f64; 2]) -> Vec<IndentRow> {
    let body = shape.body(line_coefficient(shape, case));
    let radius = indenters::contact_radius(&body, case.input("V") * turn).expect("a radius");
    let spacing = radius / ELEMENTS;
    let material = material_of(case);
    indent_history(
        &EquivalentLine(&body),
        &material,
        &triangle(case, turn, end),
        spacing,
    )
    .expect("a history")
}

/// The casebook's material of infinite stiffness at once is pressed by the speed of the step: half a step late.
#[test]
fn a_rising_depth_has_the_force_of_lee_and_radok() {
    for case in casebook::group("VIS-01") {
        if !case.has_input("V") {
            continue;
        }
        for (shape, name) in SHAPES {
            let time = case.input("t");
            let rows = press(shape, &case, [time, time]);
            let row = rows[STEPS - 1];
            case.check_within(&format!("F_{name}"), row.normal_force, TOLERANCE);
            let [rear, front] = row.contact.expect("a contact");
            case.check_within(&format!("a_{name}"), 0.5 * (front - rear), 1.01 / ELEMENTS);
        }
    }
}

/// A constant force from the start: depth and radius follow J(t), in steps that grow with the time.
#[test]
fn a_step_of_force_has_the_depth_of_lee_and_radok() {
    for case in casebook::group("VIS-01") {
        if !case.has_input("F") {
            continue;
        }
        let time = case.input("t");
        let fraction = |k: usize| k as f64 / STEPS as f64;
        let times: Vec<f64> = (1..=STEPS)
            .map(|k| time * 1e-9_f64.powf(1.0 - fraction(k)))
            .collect();
        for (shape, name) in SHAPES {
            let body = shape.body(line_coefficient(shape, &case));
            let radius = case.expected(&format!("a_{name}")).expect("a radius");
            let spacing = radius / ELEMENTS;
            let material = material_of(&case);
            let rows = indent(
                &EquivalentLine(&body),
                &material,
                case.input("F"),
                &times,
                spacing,
            )
            .expect("a history");
            // The steps are 1.3 % of the time.
            case.check_within(
                &format!("d_{name}"),
                rows[STEPS - 1].indentation_depth,
                0.013,
            );
        }
    }
}

/// After the turn the contact shrinks faster than the depth, and is lost before it is zero.
#[test]
fn a_falling_depth_has_the_force_of_ting() {
    let mut n_lost = 0;
    for case in casebook::group("VIS-02") {
        if !case.has_input("T") || !case.has_input("t") || case.input_text("model").is_empty() {
            continue;
        }
        for (shape, name) in SHAPES {
            let end = case.input("t");
            let Some(expected) = case.expected(&format!("F_{name}")) else {
                continue;
            };
            let rows = press(shape, &case, [case.input("T"), end]);
            let row = rows[STEPS - 1];
            let largest = rows.iter().map(|row| row.normal_force).fold(0.0, f64::max);
            assert_close(
                [row.normal_force, expected],
                TOLERANCE,
                largest,
                &(case.id(), name),
            );
            match case.expected(&format!("a_{name}")) {
                Some(radius) => {
                    let [rear, front] = row.contact.expect("a contact");
                    // In a step the radius falls by some elements.
                    assert_close(
                        [0.5 * (front - rear), radius],
                        0.02,
                        0.0,
                        &(case.id(), name),
                    );
                }
                None => {
                    assert_eq!(row.contact, None, "{}: {row:?}", case.id());
                    n_lost += 1;
                }
            }
        }
    }
    assert!(n_lost >= 2, "only {n_lost} contacts are lost");
}

/// EXT-05: a depth that is held relaxes with G(t), from 10⁻¹⁵ s to 10⁹ s.
#[test]
fn a_held_depth_relaxes_at_every_time_scale() {
    for case in casebook::group("EXT-05") {
        let Some(expected) = case.expected("F") else {
            continue;
        };
        let body = Shape::Paraboloid.body(case.input("R").recip());
        let radius = (case.input("R") * case.input("d")).sqrt();
        let spacing = radius / ELEMENTS;
        let held = |time| IndentStep {
            time,
            control: Control::IndentationDepth(case.input("d")),
        };
        let time = case.input("t");
        let fraction = |k: usize| k as f64 / STEPS as f64;
        let times = (0..=STEPS).map(|k| 1e-12 * time * 1e12_f64.powf(fraction(k)));
        let steps: Vec<IndentStep> = times.map(held).collect();
        let material = material_of(&case);
        let rows =
            indent_history(&EquivalentLine(&body), &material, &steps, spacing).expect("a history");
        // The steps are 1.7 % of the time.
        assert_close([rows[STEPS].normal_force, expected], 0.017, 0.0, &case.id());
    }
}
