//! What holds on any grid: reciprocity, and the balance of forces.

use bem_halfspace::{Control, Convolution, Grid};
use casebook::group;

use crate::support::{Pressing, assert_close, cone, paraboloid};

/// Wavy ground with a summit at the given element, without symmetry, on elements with different edges, under a free half
/// space and a periodic one.
fn grounds(summit: [f64; 2]) -> [Pressing; 2] {
    let grid = Grid::new([26, 20], [1.0, 1.3]).expect("a valid grid");
    let height = |element: [f64; 2]| {
        let [x, y] = [0, 1].map(|axis| element[axis] - summit[axis]);
        let bowl = 0.02 * (x * x + 1.5 * y * y + 0.4 * x * y);
        bowl + 0.2 * (1.1 * x).sin() * (0.7 * y + x).cos()
    };
    [Convolution::new(&grid), Convolution::periodic(&grid)].map(|convolution| Pressing {
        compliance: 0.7,
        ..Pressing::new(convolution, height)
    })
}

fn dot(left: &[f64], right: &[f64]) -> f64 {
    left.iter().zip(right).map(|(a, b)| a * b).sum()
}

/// w₂ p₁ = w₁ p₂ for the contacts of two bodies at different places, each of which carries its force.
#[test]
fn contacts_are_reciprocal_and_balance_the_force() {
    for (one, two) in grounds([9.3, 8.1]).into_iter().zip(grounds([15.2, 11.7])) {
        let [first, second] = [
            (one, Control::NormalForce(4.0)),
            (two, Control::IndentationDepth(0.1)),
        ]
        .map(|(body, control)| {
            let (contact, state) = body.solve(control);
            let carried = state.pressure().iter().sum::<f64>() * 1.3;
            assert_close(control, carried, contact.normal_force, 1e-13);
            state
        });
        let work = dot(first.pressure(), second.displacement());
        let expected = dot(second.pressure(), first.displacement());
        // Rounding of the transforms.
        assert_close("work", work, expected, 1e-13);
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
