//! Whether a pressure solves a contact, by sums over all pairs of elements: the judge of the contact solver.
//!
//! A contact has one solution, so that conditions which hold are as good as a second solver.

use std::f64::consts::PI;

use bem_halfspace::{Contact, ContactProblem, Control, influence};

use super::case::{Comparison, Finding};

/// The conditions of contact: the gap is zero under load and nowhere negative, no pressure is negative, and the force is
/// the sum of the pressures.
///
/// Gaps are relative to the largest displacement, as in `ContactOptions::tolerance`.
pub(super) fn conditions(
    problem: &ContactProblem,
    contact: &Contact,
    pressure: &[f64],
    tolerance: f64,
) -> Finding {
    let displacement = displacement(problem, pressure);
    let largest = displacement.iter().copied().fold(0.0, f64::max);
    let elements = problem.separation.iter().zip(&displacement).zip(pressure);
    let violations = elements.map(|((separation, moved), load)| {
        let gap = separation + moved - contact.indentation_depth;
        if *load > 0.0 { gap.abs() } else { -gap }
    });
    // Unlike `f64::max` this keeps what is not a number.
    let keeps = |worst: f64, violation| violation <= worst || worst.is_nan();
    let worst = violations.fold(
        0.0,
        |worst, next| if keeps(worst, next) { worst } else { next },
    );
    let lowest = pressure.iter().copied().fold(0.0, f64::min);
    let area = problem.convolution.grid().element_area();
    let force = area * pressure.iter().sum::<f64>();
    let (name, got, prescribed) = match problem.control {
        Control::NormalForce(prescribed) => ("prescribed force", force, prescribed),
        Control::IndentationDepth(prescribed) => {
            ("prescribed depth", contact.indentation_depth, prescribed)
        }
    };
    Finding::of(&[
        Comparison::relative("gap", worst, 0.0, tolerance).in_units_of(largest),
        Comparison::relative("tension", lowest, 0.0, 0.0).in_units_of(1.0),
        Comparison::relative("force", force, contact.normal_force, 1e-12).in_units_of(force),
        Comparison::relative(name, got, prescribed, 1e-12),
    ])
}

fn displacement(problem: &ContactProblem, pressure: &[f64]) -> Vec<f64> {
    let grid = problem.convolution.grid();
    let ([n_x, n_y], [dx, dy]) = (grid.shape(), grid.spacing());
    let factor = problem.compliance / (4.0 * PI);
    let kernel: Vec<f64> = (0..n_x * n_y)
        .map(|k| [dx * (k / n_y) as f64, dy * (k % n_y) as f64])
        .map(|offset| factor * influence(offset, [dx, dy]))
        .collect();
    let mut displacement = vec![0.0; n_x * n_y];
    for (source, load) in pressure.iter().enumerate().filter(|(_, load)| **load > 0.0) {
        let [row, column] = [source / n_y, source % n_y];
        for (target_row, values) in displacement.chunks_exact_mut(n_y).enumerate() {
            let kernel = &kernel[target_row.abs_diff(row) * n_y..][..n_y];
            for (target, value) in values.iter_mut().enumerate() {
                *value += kernel[target.abs_diff(column)] * load;
            }
        }
    }
    displacement
}
