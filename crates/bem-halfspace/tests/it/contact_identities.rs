//! What holds on any grid: reciprocity, the balance of forces, and no preferred side or unit.

use bem_halfspace::{Control, Convolution, Grid};
use casebook::group;

use crate::support::{Pressing, assert_close, assert_near, cone, difference, paraboloid};

const SHAPE: [usize; 2] = [26, 20];
const FORCE: Control = Control::NormalForce(7.0);

/// Wavy ground with a summit at the given element, without symmetry, on elements with different edges, under a free half
/// space and a periodic one, with lengths and pressures in the given units.
fn grounds(summit: [f64; 2], [length, pressure]: [f64; 2]) -> [Pressing; 2] {
    let grid = Grid::new(SHAPE, [length, 1.3 * length]).expect("a valid grid");
    let height = |element: [f64; 2]| {
        let [x, y] = [0, 1].map(|axis| element[axis] - summit[axis]);
        let bowl = 0.02 * (x * x + 1.5 * y * y + 0.4 * x * y);
        length * (bowl + 0.2 * (1.1 * x).sin() * (0.7 * y + x).cos())
    };
    [Convolution::new(&grid), Convolution::periodic(&grid)].map(|convolution| Pressing {
        compliance: 0.7 / pressure,
        ..Pressing::new(convolution, height)
    })
}

fn ground() -> [Pressing; 2] {
    grounds([12.4, 9.1], [1.0, 1.0])
}

fn dot(left: &[f64], right: &[f64]) -> f64 {
    left.iter().zip(right).map(|(a, b)| a * b).sum()
}

/// w₂ p₁ = w₁ p₂ for the contacts of two bodies at different places.
#[test]
fn contacts_are_reciprocal() {
    let [one, two] = [[9.3, 8.1], [15.2, 11.7]].map(|summit| grounds(summit, [1.0, 1.0]));
    for (one, two) in one.into_iter().zip(two) {
        let (_, first) = one.solve(Control::NormalForce(4.0));
        let (_, second) = two.solve(Control::NormalForce(9.0));
        let work = dot(first.pressure(), second.displacement());
        let expected = dot(second.pressure(), first.displacement());
        // Rounding of the transforms.
        assert_close(&one.convolution, work, expected, 1e-13);
    }
}

/// The force on a body is the work of the pressure under a flat punch of the same contact (casebook BEM-06, Betti), and
/// that of the paraboloid and the cone is the exact one to second order.
#[test]
fn the_force_follows_from_the_flat_punch() {
    let radius = 20.0;
    let cases = group("BEM-06").into_iter();
    for case in cases.filter(|case| case.expected("F").is_some()) {
        let (body, depth) = if case.has_input("R") {
            let curvature = 1.0 / case.input("R");
            (paraboloid(0.5 * curvature), curvature)
        } else {
            let slope = case.input("tan_theta");
            (cone(slope), 0.5 * std::f64::consts::PI * slope)
        };
        let body = Pressing::centred(&body, 48, 1.0 / radius);
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

#[test]
fn the_pressure_balances_the_force() {
    for body in ground() {
        for control in [FORCE, Control::IndentationDepth(0.1)] {
            let (contact, state) = body.solve(control);
            let area = body.convolution.grid().element_area();
            let carried: f64 = state.pressure().iter().sum::<f64>() * area;
            assert_close(control, carried, contact.normal_force, 1e-13);
            if let Control::NormalForce(force) = control {
                assert_close(control, carried, force, 1e-12);
            }
        }
    }
}

#[test]
fn a_mirrored_body_has_the_mirrored_pressure() {
    let [rows, columns] = SHAPE;
    let along_x = |index: usize| (rows - 1 - index / columns) * columns + index % columns;
    let along_y = |index: usize| (index / columns + 1) * columns - 1 - index % columns;
    for body in ground() {
        let (_, state) = body.solve(FORCE);
        for mirror in [&along_x as &dyn Fn(usize) -> usize, &along_y] {
            let image = |field: &[f64]| -> Vec<f64> {
                (0..rows * columns).map(|k| field[mirror(k)]).collect()
            };
            let mut mirrored = body.clone();
            mirrored.heights = image(&body.heights);
            let (_, other) = mirrored.solve(FORCE);
            let error = difference(other.pressure(), &image(state.pressure()));
            assert_near(&body.convolution, error, 0.0, 1e-11);
        }
    }
}

/// With lengths in another unit and pressures in another unit the result is the same.
#[test]
fn contacts_have_no_units() {
    for units in [[1e-12, 1e12], [1e12, 1e-12], [3e-9, 7e10]] {
        let [length, pressure] = units;
        for (here, there) in ground().iter().zip(grounds([12.4, 9.1], units)) {
            let (contact, state) = here.solve(FORCE);
            let force = Control::NormalForce(7.0 * pressure * length * length);
            let (other, state_there) = there.solve(force);
            let depth = other.indentation_depth / length;
            assert_close(units, depth, contact.indentation_depth, 1e-11);
            let expected: Vec<f64> = state.pressure().iter().map(|p| p * pressure).collect();
            let error = difference(state_there.pressure(), &expected);
            assert_near(units, error, 0.0, 1e-11);
        }
    }
}
