//! Whether a pressure solves a contact, by sums over all pairs of elements: the judge of the contact solver.
//!
//! A contact has one solution, so that conditions which hold are as good as a second solver.

use std::f64::consts::PI;

use bem_halfspace::{Contact, ContactProblem, Control, influence};

use crate::stability::case::{Comparison, Outcome};

/// The conditions `gap = 0` under load, `gap ≥ 0` elsewhere, `P ≥ 0`, and the force.
///
/// Gaps count relative to the largest displacement, as in `ContactOptions::tolerance`.
pub(super) fn conditions(
    problem: &ContactProblem,
    (contact, pressure): (&Contact, &[f64]),
    tolerance: f64,
) -> Outcome {
    let displacement = displacement(problem, pressure);
    let largest = displacement.iter().copied().fold(0.0, f64::max);
    let mut worst = 0.0_f64;
    for ((separation, moved), load) in problem.separation.iter().zip(&displacement).zip(pressure) {
        let gap = separation + moved - contact.indentation_depth;
        let violation = if *load > 0.0 { gap.abs() } else { -gap };
        worst = if violation.is_nan() {
            f64::NAN
        } else {
            worst.max(violation)
        };
    }
    let area = problem.convolution.grid().element_area();
    let force = area * pressure.iter().sum::<f64>();
    let lowest = pressure.iter().copied().fold(0.0, f64::min);
    let mut comparisons = vec![
        comparison("gap", [worst, 0.0], largest, tolerance),
        comparison("pull", [lowest, 0.0], 1.0, 0.0),
        comparison("force", [force, contact.normal_force], force, 1e-12),
    ];
    comparisons.push(match problem.control {
        Control::NormalForce(asked) => comparison("force asked for", [force, asked], asked, 1e-12),
        Control::IndentationDepth(asked) => {
            let pair = [contact.indentation_depth, asked];
            comparison("depth asked for", pair, asked, 1e-12)
        }
    });
    Outcome::Values(comparisons)
}

fn comparison(
    quantity: &'static str,
    [got, expected]: [f64; 2],
    scale: f64,
    tolerance: f64,
) -> Comparison {
    Comparison {
        quantity,
        expected,
        got,
        scale,
        tolerance,
    }
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
