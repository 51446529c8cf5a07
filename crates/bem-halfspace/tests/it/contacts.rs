//! The discrete contact problem has one solution, and both controls find it: on bodies of the casebook, in the smallest
//! contacts, and as reciprocity has it; with refinement it tends to the exact pressures, displacements and forces of
//! axisymmetric bodies.

use std::f64::consts::PI;

use bem_halfspace::{Contact, ContactState, Control, Convolution, Grid};
use casebook::{Case, group};
use indenters::{FlatPunch, Surface};
use numerics::whole_part;

use crate::support::{Pressing, assert_close, assert_near, cone, paraboloid};

#[test]
fn contact_at_given_depth_or_force_is_the_unique_discrete_solution() {
    for case in group("BEM-04") {
        let n = whole_part(case.input("N"));
        let surface = match case.input_text("shape") {
            "paraboloid" => paraboloid(0.5 / case.input("R")),
            _ => cone(case.input("slope")),
        };
        let body = Pressing::centred(&surface, n, 1.0);
        let (contact, state) = body.solve(Control::IndentationDepth(case.input("d")));
        case.check("F", contact.normal_force);
        case.check_within("n_contact", contact.n_contact as f64, 0.0);
        case.check("p_centre", state.pressure()[n / 2 * n + n / 2]);
        let force = case.expected("F").expect("a force");
        let (contact, _) = body.solve(Control::NormalForce(force));
        assert_close(case.id(), contact.indentation_depth, case.input("d"), 1e-9);
        case.check_within("n_contact", contact.n_contact as f64, 0.0);
    }
}

/// The force on a body is the work of the pressure under a flat punch of the same contact (casebook BEM-06, Betti), and
/// that of the paraboloid and the cone is the exact one to second order.
#[test]
fn the_force_follows_from_the_flat_punch() {
    let radius = 20.0;
    let cases = group("BEM-06").into_iter();
    for case in cases.filter(|case| case.expected("F").is_some()) {
        let (surface, depth) = body_of(&case);
        let body = Pressing::centred(&surface, 48, 1.0 / radius);
        let (contact, state) = body.solve(Control::IndentationDepth(depth));
        let mut punch = body.clone();
        punch.heights.fill(f64::INFINITY);
        for &element in state.contact() {
            punch.heights[element] = 0.0;
        }
        let (_, unit) = punch.solve(Control::IndentationDepth(1.0));
        let pairs = unit.pressure().iter().zip(&body.heights);
        let work: f64 = pairs.map(|(p, height)| p * (depth - height)).sum();
        let force = work * body.convolution.grid().element_area();
        assert_close(case.id(), force, contact.normal_force, 1e-11);
        case.check_within("F", force, 1.0 / (radius * radius));
    }
}

/// Contact problem of a body with these heights on unit elements.
fn contact(shape: [usize; 2], heights: &[f64], control: Control) -> (Contact, ContactState) {
    let grid = Grid::new(shape, [1.0; 2]).expect("a valid grid");
    let mut body = Pressing::new(Convolution::new(&grid), |_| 0.0);
    body.heights = heights.to_vec();
    body.solve(control)
}

/// One element has the stiffness of its self-influence, and two isolated ones share the load: where there is no body
/// (height +∞) there is no contact.
#[test]
fn the_smallest_contacts_are_those_of_the_casebook() {
    let deep = Control::IndentationDepth(1.0);
    let (one, _) = contact([1, 1], &[0.0], deep);
    let (at_force, _) = contact([1, 1], &[0.0], Control::NormalForce(one.normal_force));
    assert_near("depth", at_force.indentation_depth, 1.0, 1e-14);
    let mut heights = [f64::INFINITY; 6];
    (heights[0], heights[5]) = (0.0, 0.0);
    let (two, state) = contact([6, 1], &heights, deep);
    assert_eq!(state.contact(), [0, 5], "only elements with a body");
    let cases = group("EXT-02");
    let twin = "EXT-02/two equal isolated cells at distance 5h, h=1 G=1 d=1";
    for (id, name, contact) in [
        ("EXT-02/BEM single cell h=1 G=1 d=1", "F", one),
        (twin, "F_total", two),
    ] {
        let case = cases.iter().find(|case| case.id() == id);
        let case = case.expect("a case of this name");
        case.check(name, contact.normal_force);
    }
}

#[test]
fn without_force_or_depth_nothing_is_in_contact() {
    let heights = [0.3, 0.0, 0.2];
    let (unloaded, state) = contact([3, 1], &heights, Control::NormalForce(0.0));
    let pressure = state.pressure();
    assert!(pressure.iter().all(|value| *value == 0.0), "{pressure:?}");
    assert_near("touch", unloaded.indentation_depth, 0.0, f64::MIN_POSITIVE);
    let (held, _) = contact([1, 3], &heights, Control::IndentationDepth(-0.1));
    for contact in [unloaded, held] {
        let carried = (contact.n_contact, contact.normal_force);
        assert_eq!(carried, (0, 0.0), "{contact:?}");
    }
}

/// A body, and its depth at the contact radius 1.
type Body = (Box<dyn Surface>, f64);

fn body_of(case: &Case) -> Body {
    if case.has_input("R") {
        let depth = 1.0 / case.input("R");
        (Box::new(paraboloid(0.5 * depth)), depth)
    } else if case.has_input("tan_theta") {
        let slope = case.input("tan_theta");
        (Box::new(cone(slope)), 0.5 * PI * slope)
    } else {
        flat_punch(case.input("d"))
    }
}

fn flat_punch(depth: f64) -> Body {
    (Box::new(FlatPunch::new(1.0).expect("a body")), depth)
}

/// Contact on elements of the given edge around the axis, and the element with its centre at (`offset`, 0).
fn contact_with(body: &Body, offset: f64, spacing: f64) -> (Contact, ContactState, usize) {
    let margin = (1.1 / spacing).ceil();
    let before = margin + (offset / spacing).ceil();
    let behind = (margin - (offset / spacing).floor()).max(0.0);
    let columns = 2.0 * margin + 1.0;
    let shape = [before + behind + 1.0, columns].map(whole_part);
    let grid = Grid::new(shape, [spacing; 2]).expect("a valid grid");
    let pressing = Pressing::new(Convolution::new(&grid), |[row, column]| {
        let x = (row - before) * spacing + offset;
        body.0.height([x, (column - margin) * spacing])
    });
    let (contact, state) = pressing.solve(Control::IndentationDepth(body.1));
    (contact, state, whole_part(before * columns + margin))
}

fn order(errors: [f64; 2], refinement: f64) -> f64 {
    (errors[0] / errors[1]).abs().ln() / refinement.ln()
}

#[test]
fn pressures_converge_to_the_exact_ones_with_second_order() {
    for case in group("BEM-01") {
        let Some(exact) = case.expected("p") else {
            continue;
        };
        let (shape, radius) = (case.input_text("shape"), case.input("r"));
        // On the apex of the cone the pressure is infinite.
        if shape == "cone" && radius < 0.01 {
            continue;
        }
        let errors = [16.0, 32.0].map(|elements| {
            let (_, state, element) = contact_with(&body_of(&case), radius, 1.0 / elements);
            state.pressure()[element] / exact - 1.0
        });
        // At the edge of the punch the pressure is infinite, and the edge consists of whole elements.
        let (least, largest) = match shape {
            "flat punch" => (0.9, 1e-2),
            _ => (1.7, 1e-3),
        };
        let order = order(errors, 2.0);
        let holds = order > least && errors[1].abs() < largest;
        assert!(holds, "{case:?}: order {order}, errors {errors:?}");
    }
}

#[test]
fn the_surface_outside_the_contact_moves_as_it_should() {
    let cases = group("BEM-01").into_iter();
    for case in cases.filter(|case| case.expected("u").is_some()) {
        let (shape, radius) = (case.input_text("shape"), case.input("r"));
        // The surface outside the punch is infinitely steep at its edge.
        if shape == "flat punch" && (1.0..1.1).contains(&radius) {
            continue;
        }
        let (_, state, element) = contact_with(&body_of(&case), radius, 1.0 / 32.0);
        // In the contact it is given by the body; outside it errs like the force.
        let largest = match shape {
            _ if radius < 1.0 => 1e-12,
            "flat punch" => 1e-2,
            _ => 1e-4,
        };
        case.check_within("u", state.displacement()[element], largest);
    }
}
