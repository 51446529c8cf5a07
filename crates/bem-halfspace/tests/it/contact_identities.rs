//! What holds on any grid: reciprocity, the balance of forces, and no preferred side or unit.

use bem_halfspace::{
    Contact, ContactProblem, ContactState, Control, Convolution, Grid, solve_contact,
};
use casebook::group;
use indenters::PowerProfile;

use crate::support::{TIGHT, centred_heights};

const SHAPE: [usize; 2] = [26, 20];

/// A grid with elements of different edges under a periodic half space or a free one.
fn convolutions() -> [Convolution; 2] {
    let grid = Grid::new(SHAPE, [1.0, 1.3]).expect("a valid grid");
    [Convolution::new(&grid), Convolution::periodic(&grid)]
}

/// Wavy ground with a summit at the given element, without symmetry.
fn heights(summit: [f64; 2]) -> Vec<f64> {
    let height = |index: usize| {
        let position = [index / SHAPE[1], index % SHAPE[1]];
        let [x, y] = [0, 1].map(|axis| position[axis] as f64 - summit[axis]);
        0.02 * (x * x + 1.5 * y * y + 0.4 * x * y) + 0.2 * (1.1 * x).sin() * (0.7 * y + x).cos()
    };
    (0..SHAPE[0] * SHAPE[1]).map(height).collect()
}

fn solve(
    convolution: &Convolution,
    (heights, compliance): (&[f64], f64),
    control: Control,
) -> (Contact, ContactState) {
    let mut state = ContactState::new(convolution);
    let problem = ContactProblem {
        convolution,
        separation: heights,
        compliance,
        control,
    };
    let contact = solve_contact(&problem, &mut state, &TIGHT).expect("a contact");
    (contact, state)
}

fn dot(left: &[f64], right: &[f64]) -> f64 {
    left.iter().zip(right).map(|(a, b)| a * b).sum()
}

/// w₂ p₁ = w₁ p₂ for the contacts of two bodies at different places.
#[test]
fn contacts_are_reciprocal() {
    for convolution in convolutions() {
        let [one, two] = [([9.3, 8.1], 4.0), ([15.2, 11.7], 9.0)].map(|(summit, force)| {
            let body = heights(summit);
            solve(&convolution, (&body, 0.7), Control::NormalForce(force)).1
        });
        let works = [
            dot(one.pressure(), two.displacement()),
            dot(two.pressure(), one.displacement()),
        ];
        let error = (works[0] / works[1] - 1.0).abs();
        // Rounding of the transforms.
        assert!(error < 1e-13, "{convolution:?}: {works:?}");
    }
}

/// The force on a body is the work of the pressure under a flat punch of the same contact (casebook BEM-06, Betti), and
/// that of the paraboloid and the cone is the exact one to second order.
#[test]
fn the_force_follows_from_the_flat_punch() {
    let radius = 20.0;
    for case in group("BEM-06") {
        let Some(exact) = case.expected("F") else {
            continue;
        };
        let (body, depth) = if case.has_input("R") {
            let curvature = 1.0 / case.input("R");
            (PowerProfile::paraboloid(0.5 * curvature), curvature)
        } else {
            let slope = case.input("tan_theta");
            let depth = 0.5 * std::f64::consts::PI * slope;
            (PowerProfile::cone(slope), depth)
        };
        let heights = centred_heights(&body.expect("a body"), 48, 1.0 / radius);
        let grid = Grid::new([48, 48], [1.0 / radius; 2]).expect("a valid grid");
        let convolution = Convolution::new(&grid);
        let control = Control::IndentationDepth(depth);
        let (contact, state) = solve(&convolution, (&heights, 1.0), control);
        let mut punch = vec![f64::INFINITY; heights.len()];
        for &element in state.contact() {
            punch[element] = 0.0;
        }
        let control = Control::IndentationDepth(1.0);
        let (_, unit) = solve(&convolution, (&punch, 1.0), control);
        let pairs = unit.pressure().iter().zip(&heights);
        let work: f64 = pairs.map(|(p, height)| p * (depth - height)).sum();
        let force = work * grid.element_area();
        let error = (force / contact.normal_force - 1.0).abs();
        assert!(error < 1e-11, "{}: {force} of {contact:?}", case.id());
        case.check_within("F", force, 1.0 / (radius * radius));
        assert!(exact > 0.0, "{} presses", case.id());
    }
}

#[test]
fn the_pressure_balances_the_force() {
    for convolution in convolutions() {
        let area = convolution.grid().element_area();
        let body = heights([12.4, 9.1]);
        for control in [Control::NormalForce(7.0), Control::IndentationDepth(0.1)] {
            let (contact, state) = solve(&convolution, (&body, 0.7), control);
            let carried: f64 = state.pressure().iter().sum::<f64>() * area;
            let error = (carried / contact.normal_force - 1.0).abs();
            assert!(error < 1e-13, "{carried} of {contact:?}");
            if let Control::NormalForce(force) = control {
                let error = (carried / force - 1.0).abs();
                assert!(error < 1e-12, "{carried} instead of {force}");
            }
        }
    }
}

/// The largest difference of two pressures relative to the largest pressure.
fn difference(actual: &[f64], expected: impl Iterator<Item = f64> + Clone) -> f64 {
    let largest = expected.clone().fold(0.0, f64::max);
    let differences = actual.iter().zip(expected).map(|(a, b)| (a - b).abs());
    differences.fold(0.0, f64::max) / largest
}

#[test]
fn a_mirrored_body_has_the_mirrored_pressure() {
    for convolution in convolutions() {
        let body = heights([12.4, 9.1]);
        let force = Control::NormalForce(7.0);
        let (_, state) = solve(&convolution, (&body, 0.7), force);
        let [rows, columns] = SHAPE;
        let along_x = |index: usize| (rows - 1 - index / columns) * columns + index % columns;
        let along_y = |index: usize| (index / columns + 1) * columns - 1 - index % columns;
        for mirror in [&along_x as &dyn Fn(usize) -> usize, &along_y] {
            let elements = 0..rows * columns;
            let mirrored: Vec<f64> = elements.clone().map(|k| body[mirror(k)]).collect();
            let (_, other) = solve(&convolution, (&mirrored, 0.7), force);
            let expected = elements.map(|k| state.pressure()[mirror(k)]);
            let error = difference(other.pressure(), expected);
            assert!(error < 1e-11, "{convolution:?}: off by {error:e}");
        }
    }
}

/// With lengths in another unit and pressures in another unit the answer is the same.
#[test]
fn contacts_have_no_units() {
    let body = heights([12.4, 9.1]);
    for (length, pressure) in [(1e-12, 1e12), (1e12, 1e-12), (3e-9, 7e10)] {
        let grid = Grid::new(SHAPE, [length, 1.3 * length]).expect("a valid grid");
        let scaled = [Convolution::new(&grid), Convolution::periodic(&grid)];
        let body_there: Vec<f64> = body.iter().map(|height| height * length).collect();
        for (here, there) in convolutions().iter().zip(&scaled) {
            let (contact, state) = solve(here, (&body, 0.7), Control::NormalForce(7.0));
            let force = Control::NormalForce(7.0 * pressure * length * length);
            let (other, state_there) = solve(there, (&body_there, 0.7 / pressure), force);
            let depth = other.indentation_depth / length;
            let error = (depth / contact.indentation_depth - 1.0).abs();
            assert!(error < 1e-11, "depth {depth} instead of {contact:?}");
            let expected = state.pressure().iter().map(|value| value * pressure);
            let error = difference(state_there.pressure(), expected);
            assert!(
                error < 1e-11,
                "units {length}, {pressure}: off by {error:e}"
            );
        }
    }
}
