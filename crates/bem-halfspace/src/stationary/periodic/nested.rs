//! Nested iteration over grids of twice the spacing, and the full contact in closed form.
//!
//! Theory: docs/theory/stationary-half-space.md, "Periodic surfaces", "From grid to grid".

use std::f64::consts::PI;

use rustfft::num_complex::Complex;

use crate::elements::grid::MIN_COARSEST_EDGE;
use crate::parallel::reductions::mean;
use crate::stationary::COARSE_GRID_TOLERANCE;
use crate::stationary::periodic::contact::{self, PeriodicContact, PeriodicSolution};
use crate::stationary::periodic::equations::Equations;
use crate::stationary::periodic::fourier_multiplier::FourierMultiplier;
use crate::stationary::periodic::{PeriodicControl, PeriodicOptions};
use crate::transform::plane_transform::ZERO;
use crate::{Base, BemError, Grid};

/// Largest number of operator applications on a coarser grid. Chosen to limit the time, at twice the largest number
/// measured on 300 contacts on a hundred-thousandth to all of the area. An unconverged pressure is an initial guess too, so that the solution does
/// not depend on it.
const COARSE_GRID_BUDGET: usize = 300;

/// Solves the problem with the equations of its grid: in closed form in full contact, else from a guess.
///
/// `guess` may be a pressure field on this grid, or on elements of twice the edges; with any other length there is none, and nested
/// iteration finds it. It becomes the pressure \[Pa], which outside the contact is minus the gap over the self-influence.
pub(super) fn solve(
    problem: PeriodicContact,
    equations: &mut Equations,
    guess: &mut Vec<f64>,
) -> Result<PeriodicSolution, BemError> {
    if let Some(solved) = full_contact(&problem, equations, guess) {
        return Ok(solved);
    }
    // Otherwise bring the guess to this grid, or find one by nested iteration.
    if 4 * guess.len() == problem.heights.len() {
        *guess = prolong(guess, problem.grid.blocks().shape());
    } else if guess.len() != problem.heights.len() {
        guess.clear();
        solve_on_coarser_grids(&problem, guess)?;
    }
    contact::solve(problem, equations, guess)
}

/// Replaces `pressure` by the prolonged solution on elements of twice the edges, which nested iteration finds; leaves it as it is
/// if the grid cannot be coarsened.
fn solve_on_coarser_grids(
    problem: &PeriodicContact,
    pressure: &mut Vec<f64>,
) -> Result<(), BemError> {
    let can_be_coarsened = |n: &usize| n.is_multiple_of(2) && *n >= 2 * MIN_COARSEST_EDGE;
    if !problem.grid.shape().iter().all(can_be_coarsened) {
        return Ok(());
    }
    // Restrict the problem, and guess its pressure on still coarser grids.
    let grid = problem.grid.blocks();
    let heights = restrict(problem.grid, problem.heights);
    let coarse = PeriodicContact {
        grid: &grid,
        heights: &heights,
        options: PeriodicOptions {
            tolerance: problem.options.tolerance.max(COARSE_GRID_TOLERANCE),
            max_applications: problem.options.max_applications.min(COARSE_GRID_BUDGET),
        },
        ..*problem
    };
    let mut guess = Vec::new();
    solve_on_coarser_grids(&coarse, &mut guess)?;
    let mut equations = Equations::new(problem.sliding, &grid, problem.control)?;
    match contact::solve(coarse, &mut equations, &mut guess) {
        // A solution that has not converged is an initial guess too.
        Ok(_) | Err(BemError::ContactNotConverged { .. }) => {}
        Err(error) => return Err(error),
    }
    *pressure = prolong(&guess, grid.shape());
    Ok(())
}

/// Restriction of heights \[m] to elements of twice the edges: the waves that these resolve, at their centres, row-major.
fn restrict(grid: &Grid, heights: &[f64]) -> Vec<f64> {
    let (columns, [dx, dy]) = (grid.shape()[1], grid.spacing());
    let cut_off = 0.5 * PI * (1.0 - f64::EPSILON.sqrt());
    let mut field = vec![0.0; heights.len()];
    FourierMultiplier::new(grid, &Base::default()).apply(heights, &mut field, |wave| {
        let (q_x, q) = (wave.q_x, wave.reduced_wave_number);
        // For the mean, q is that of the longest wave; this changes nothing but the depth of a guess.
        let q_y = if wave.row == 0 {
            q
        } else {
            (q * q - q_x * q_x).max(0.0).sqrt()
        };
        let is_kept = (q_x * dx).abs() < cut_off && q_y * dy < cut_off;
        if is_kept {
            Complex::from_polar(1.0, 0.5 * (q_x * dx + q_y * dy))
        } else {
            ZERO
        }
    });
    let rows = field.chunks_exact(columns).step_by(2);
    rows.flat_map(|row| row.iter().step_by(2).copied())
        .collect()
}

/// Prolongation of a first guess from a grid of the given `shape` to elements of half the edges, bilinear between the centres.
///
/// If half of the active set would be lost, because it is a few elements next to wide gaps, each element gives its value to its four
/// children.
fn prolong(field: &[f64], shape: [usize; 2]) -> Vec<f64> {
    let in_contact = |field: &[f64]| field.iter().filter(|pressure| **pressure > 0.0).count();
    let fine = interpolated(field, shape, shape.map(|n| 2 * n));
    if in_contact(&fine) >= 2 * in_contact(field) {
        return fine;
    }
    let columns = shape[1];
    let parent = |element: usize| field[element / (4 * columns) * columns + element / 2 % columns];
    (0..fine.len()).map(parent).collect()
}

/// A periodic, row-major field of the shape `from` on a grid of the shape `to`, bilinear between the centres of its elements.
pub(crate) fn interpolated(field: &[f64], from: [usize; 2], to: [usize; 2]) -> Vec<f64> {
    // For each point find the two nearest elements along an axis, and the weight of the second.
    let neighbours = |axis: usize| -> Vec<([usize; 2], f64)> {
        let [n, finer] = [from[axis], to[axis]];
        let between = |index: usize| {
            let place = (index as f64 + 0.5) * n as f64 / finer as f64 + 0.5;
            let second = numerics::whole_part(place);
            let both = [second + n - 1, second].map(|index| index % n);
            (both, place - second as f64)
        };
        (0..finer).map(between).collect()
    };
    let [along_x, along_y] = [0, 1].map(neighbours);
    let value = |element: usize| {
        let (rows, weight_x) = along_x[element / to[1]];
        let (columns, weight_y) = along_y[element % to[1]];
        let [first, second] = rows.map(|row| {
            let [first, second] = columns.map(|column| field[row * from[1] + column]);
            first + weight_y * (second - first)
        });
        first + weight_x * (second - first)
    };
    (0..to[0] * to[1]).map(value).collect()
}

/// Full contact in closed form: writes the `pressure` under which the material follows the surface everywhere, with the prescribed
/// mean. `None`, with `pressure` unchanged, if it is a tension anywhere.
fn full_contact(
    problem: &PeriodicContact,
    equations: &mut Equations,
    pressure: &mut Vec<f64>,
) -> Option<PeriodicSolution> {
    let mean_height = mean(problem.heights);
    let heights = problem.heights.iter();
    let displacement: Vec<f64> = heights.map(|height| mean_height - height).collect();
    // Find the pressure of these displacements, with the prescribed mean.
    let mut full = vec![0.0; displacement.len()];
    equations.kernel.invert_at_centre(&displacement, &mut full);
    let compliance = equations.kernel.mean_compliance;
    let mean_pressure = match problem.control {
        PeriodicControl::MeanPressure(mean_pressure) => mean_pressure,
        // On a half space the compliance is 0 and the depth below 0. This gives minus infinity, and no full contact.
        PeriodicControl::MeanDepth(depth) => depth / compliance,
    };
    let missing = mean_pressure - mean(&full);
    full.iter_mut().for_each(|pressure| *pressure += missing);
    if full.iter().any(|pressure| *pressure <= 0.0) {
        return None;
    }
    *pressure = full;
    Some(PeriodicSolution {
        depth: mean_height + compliance * mean_pressure,
        applications: 1,
        residual: 0.0,
    })
}

#[cfg(test)]
mod tests {
    use std::f64::consts::TAU;

    use super::interpolated;

    fn wave(shape: [usize; 2]) -> Vec<f64> {
        let value = |element: usize| {
            let place = [element / shape[1], element % shape[1]];
            let [x, y] = [0, 1].map(|axis| (place[axis] as f64 + 0.5) / shape[axis] as f64);
            (TAU * (x - 2.0 * y) + 0.3).cos()
        };
        (0..shape[0] * shape[1]).map(value).collect()
    }

    #[test]
    fn a_wave_is_interpolated_with_the_second_order_on_any_number_of_elements() {
        let to = [23, 90];
        let error = |from: [usize; 2]| {
            let found = interpolated(&wave(from), from, to);
            let pairs = found.into_iter().zip(wave(to));
            pairs.fold(0.0, |top: f64, (found, exact)| {
                top.max((found - exact).abs())
            })
        };
        let [coarse, fine] = [[16, 32], [32, 64]].map(error);
        assert!(
            (3.5..4.5).contains(&(coarse / fine)),
            "{coarse}, then {fine}"
        );
        assert!(fine < 0.02, "{fine}");
    }
}
