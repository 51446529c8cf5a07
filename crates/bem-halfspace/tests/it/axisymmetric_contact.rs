//! Contacts of axisymmetric bodies have the pressures, displacements, forces and radii of the exact solutions.

use std::f64::consts::PI;

use bem_halfspace::{Contact, ContactState, Control};
use casebook::{Case, group};

use crate::support::Pressing;

/// The height of a body over the radius, infinite where there is no body, and its depth at the contact radius 1.
type Scene = (Box<dyn Fn(f64) -> f64>, f64);

fn scene(case: &Case) -> Scene {
    match case.input_text("shape") {
        "paraboloid" => {
            let curvature = 1.0 / case.input("R");
            (Box::new(move |r| 0.5 * curvature * r * r), curvature)
        }
        "cone" => cone(case.input("tan_theta")),
        "flat punch" => flat_punch(case.input("d")),
        other => panic!("{other} is not in the table"),
    }
}

fn cone(slope: f64) -> Scene {
    (Box::new(move |r| slope * r), 0.5 * PI * slope)
}

fn flat_punch(depth: f64) -> Scene {
    let height = |r| if r <= 1.0 { 0.0 } else { f64::INFINITY };
    (Box::new(height), depth)
}

/// Contact on elements of the given edge around the axis, and the element with its centre at (`offset`, 0).
///
/// The solver works with unit elements; heights and depth are in units of the edge too, so that pressures are not scaled.
fn contact_with(
    (body, depth): &Scene,
    offset: f64,
    spacing: f64,
) -> (Contact, ContactState, usize) {
    let margin = (1.1 / spacing).ceil();
    let before = margin + (offset / spacing).ceil();
    let behind = (margin - (offset / spacing).floor()).max(0.0);
    let columns = 2.0 * margin + 1.0;
    let counts = [before + behind + 1.0, columns, before * columns + margin];
    #[expect(
        clippy::cast_possible_truncation,
        clippy::cast_sign_loss,
        reason = "small counts"
    )]
    let [rows, columns, element] = counts.map(|count| count as usize);
    let shape = [rows, columns];
    let height = |index: usize| {
        let x = ((index / shape[1]) as f64 - before) * spacing + offset;
        let y = ((index % shape[1]) as f64 - margin) * spacing;
        body(x.hypot(y)) / spacing
    };
    let heights: Vec<f64> = (0..shape[0] * shape[1]).map(height).collect();
    let control = Control::IndentationDepth(depth / spacing);
    let (contact, state) = Pressing::on_unit_elements(shape, &heights).solve(control);
    (contact, state, element)
}

fn order(errors: [f64; 2], refinement: f64) -> f64 {
    (errors[0] / errors[1]).abs().ln() / refinement.ln()
}

/// Relative error of a force, mean square over positions of the axis within an element.
fn force_error(scene: &Scene, force: f64, elements: f64) -> f64 {
    let positions = [0.0, 0.13, 0.29, 0.41];
    let error = |position: f64| {
        let spacing = 1.0 / (elements + position);
        let (contact, ..) = contact_with(scene, position * spacing, spacing);
        let radius = (contact.n_contact as f64 / PI).sqrt();
        let misfit = radius - 1.0 / spacing;
        assert!(misfit.abs() < 0.3, "{misfit} of {elements} elements");
        contact.normal_force * spacing * spacing / force - 1.0
    };
    let squares = positions.map(|position| error(position).powi(2));
    (squares.iter().sum::<f64>() / 4.0).sqrt()
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
            let (_, state, element) = contact_with(&scene(&case), radius, 1.0 / elements);
            state.pressure()[element] / exact - 1.0
        });
        // At the edge of the punch the pressure is infinite, and the edge consists of whole elements.
        let (least, largest) = match shape {
            "flat punch" => (0.9, 1e-2),
            _ => (1.7, 1e-3),
        };
        let order = order(errors, 2.0);
        assert!(
            order > least && errors[1].abs() < largest,
            "{}: order {order}, errors {errors:?}",
            case.id()
        );
    }
}

#[test]
fn the_surface_outside_the_contact_moves_as_it_should() {
    for case in group("BEM-01") {
        let Some(exact) = case.expected("u") else {
            continue;
        };
        let (shape, radius) = (case.input_text("shape"), case.input("r"));
        // The surface beside the punch is infinitely steep.
        if shape == "flat punch" && (1.0..1.1).contains(&radius) {
            continue;
        }
        let spacing = 1.0 / 32.0;
        let (_, state, element) = contact_with(&scene(&case), radius, spacing);
        let error = state.displacement()[element] * spacing / exact - 1.0;
        // In the contact it is given by the body; outside it errs like the force.
        let largest = match shape {
            _ if radius < 1.0 => 1e-12,
            "flat punch" => 1e-2,
            _ => 1e-4,
        };
        assert!(error.abs() < largest, "{}: error {error:e}", case.id());
    }
}

/// The pressure of the element on the apex grows with refinement like the mean of the exact pressure over the element,
/// twice the slope times ln 2 for half the edge, beyond which it is by a constant.
#[test]
fn the_pressure_on_the_apex_of_a_cone_grows_like_the_logarithm() {
    let excess = |case: &Case| {
        let spacing = 1.0 / case.input("a_over_h");
        let (_, state, element) = contact_with(&cone(case.input("tan_theta")), 0.0, spacing);
        let mean = case.expected("p_cell_average").expect("a mean");
        state.pressure()[element] - mean
    };
    let cases = group("BEM-01").into_iter();
    let cases = cases.filter(|case| case.has_input("a_over_h"));
    let excess: Vec<f64> = cases.map(|case| excess(&case)).collect();
    let changes: Vec<f64> = excess.windows(2).map(|pair| pair[0] - pair[1]).collect();
    assert!(
        changes
            .windows(2)
            .all(|pair| pair[1].abs() < 0.35 * pair[0].abs())
            && changes.last().is_some_and(|change| change.abs() < 1e-4),
        "second order towards a constant: {excess:?}"
    );
}

#[test]
fn forces_of_power_profiles_converge_with_second_order() {
    for case in group("IND-05") {
        if case.input_text("shape") != "power" {
            continue;
        }
        let [radius, coefficient, exponent] = ["a", "c", "p"].map(|name| case.input(name));
        let [depth, force] =
            ["d", "F"].map(|name| case.expected(name).expect("a depth and a force"));
        // In units of the contact radius.
        let height = move |r: f64| coefficient * (radius * r).powf(exponent) / radius;
        let scene: Scene = (Box::new(height), depth / radius);
        let errors = [8.0, 32.0].map(|n| force_error(&scene, force / radius / radius, n));
        // High powers press with a rim, which eight elements hardly resolve.
        let order = order(errors, 4.0);
        assert!(
            (1.6..2.3).contains(&order) && errors[1] < 2e-4,
            "{}: order {order}, errors {errors:?}",
            case.id()
        );
    }
}

#[test]
fn the_flat_punch_has_the_stiffness_of_its_radius() {
    let mut cases = group("IND-05").into_iter();
    let case = cases.find(|case| case.id().ends_with("flat punch"));
    let case = case.expect("a punch");
    let [radius, depth] = ["a", "d"].map(|name| case.input(name));
    let force = case.expected("F").expect("a force") / radius / radius;
    let errors = [8.0, 32.0].map(|n| force_error(&flat_punch(depth / radius), force, n));
    // The edge lies where whole elements have it.
    let order = order(errors, 4.0);
    assert!(
        order > 0.8 && errors[1] < 1e-2,
        "order {order}, errors {errors:?}"
    );
}
