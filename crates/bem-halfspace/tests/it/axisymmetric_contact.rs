//! Contacts of axisymmetric bodies have the pressures and displacements of the exact solutions, and a punch its force.

use std::f64::consts::PI;

use bem_halfspace::{Contact, ContactState, Control};
use casebook::{Case, group};

use crate::support::Pressing;

/// The height of a body over the radius, infinite where there is no body, and its depth at the contact radius 1.
struct Body {
    height: Box<dyn Fn(f64) -> f64>,
    depth: f64,
}

impl Body {
    fn new(depth: f64, height: impl Fn(f64) -> f64 + 'static) -> Self {
        let height = Box::new(height);
        Self { height, depth }
    }

    fn of(case: &Case) -> Self {
        match case.input_text("shape") {
            "paraboloid" => {
                let curvature = 1.0 / case.input("R");
                Self::new(curvature, move |r| 0.5 * curvature * r * r)
            }
            "cone" => Self::cone(case.input("tan_theta")),
            "flat punch" => Self::flat_punch(case.input("d")),
            other => panic!("{other} is not in the table"),
        }
    }

    fn cone(slope: f64) -> Self {
        Self::new(0.5 * PI * slope, move |r| slope * r)
    }

    fn flat_punch(depth: f64) -> Self {
        Self::new(depth, |r| if r <= 1.0 { 0.0 } else { f64::INFINITY })
    }

    /// Contact on elements of the given edge around the axis, and the element with its centre at (`offset`, 0).
    ///
    /// The solver works with unit elements; heights and depth are in units of the edge too, so that pressures are not
    /// scaled.
    fn contact_with(&self, offset: f64, spacing: f64) -> (Contact, ContactState, usize) {
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
        let height = |index: usize| {
            let x = ((index / columns) as f64 - before) * spacing + offset;
            let y = ((index % columns) as f64 - margin) * spacing;
            (self.height)(x.hypot(y)) / spacing
        };
        let heights: Vec<f64> = (0..rows * columns).map(height).collect();
        let control = Control::IndentationDepth(self.depth / spacing);
        let body = Pressing::on_unit_elements([rows, columns], &heights);
        let (contact, state) = body.solve(control);
        (contact, state, element)
    }
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
            let (_, state, element) = Body::of(&case).contact_with(radius, 1.0 / elements);
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
    let cases = group("BEM-01").into_iter();
    for case in cases.filter(|case| case.expected("u").is_some()) {
        let (shape, radius) = (case.input_text("shape"), case.input("r"));
        // The surface beside the punch is infinitely steep.
        if shape == "flat punch" && (1.0..1.1).contains(&radius) {
            continue;
        }
        let spacing = 1.0 / 32.0;
        let (_, state, element) = Body::of(&case).contact_with(radius, spacing);
        // In the contact it is given by the body; outside it errs like the force.
        let largest = match shape {
            _ if radius < 1.0 => 1e-12,
            "flat punch" => 1e-2,
            _ => 1e-4,
        };
        case.check_within("u", state.displacement()[element] * spacing, largest);
    }
}

/// The pressure of the element on the apex grows with refinement like the mean of the exact pressure over the element,
/// twice the slope times ln 2 for half the edge, beyond which it is by a constant.
#[test]
fn the_pressure_on_the_apex_of_a_cone_grows_like_the_logarithm() {
    let cases = group("BEM-01").into_iter();
    let cases = cases.filter(|case| case.has_input("a_over_h"));
    let excess = cases.map(|case| {
        let body = Body::cone(case.input("tan_theta"));
        let (_, state, element) = body.contact_with(0.0, 1.0 / case.input("a_over_h"));
        state.pressure()[element] - case.expected("p_cell_average").expect("a mean")
    });
    let excess: Vec<f64> = excess.collect();
    let changes: Vec<f64> = excess.windows(2).map(|pair| pair[0] - pair[1]).collect();
    let mut pairs = changes.windows(2);
    assert!(
        pairs.all(|pair| pair[1].abs() < 0.35 * pair[0].abs())
            && changes.last().is_some_and(|change| change.abs() < 1e-4),
        "second order towards a constant: {excess:?}"
    );
}

/// The edge lies where whole elements have it; mean square over positions of the axis within an element.
#[test]
fn the_force_of_a_flat_punch_converges_with_first_order() {
    let punch = Body::flat_punch(1.0);
    let errors = [8.0, 32.0].map(|elements| {
        let squares = [0.0, 0.13, 0.29, 0.41].map(|position: f64| {
            let spacing = 1.0 / (elements + position);
            let (contact, ..) = punch.contact_with(position * spacing, spacing);
            // F = 8 G d a.
            (contact.normal_force * spacing * spacing / 8.0 - 1.0).powi(2)
        });
        (squares.iter().sum::<f64>() / 4.0).sqrt()
    });
    let order = order(errors, 4.0);
    assert!(
        order > 0.8 && errors[1] < 1e-2,
        "order {order}, errors {errors:?}"
    );
}
