//! A first guess from grids of larger elements.

use crate::bands::for_each_row;
use crate::contact::mirror_weights::MirrorWeights;
use crate::contact::solve::LoadProblem;
use crate::contact::{Accuracy, ContactState, map_force, solve_loads};
use crate::convolution::Surroundings;

/// A grid with fewer elements along an edge is solved without a guess.
const SMALLEST_EDGE: usize = 32;

/// Loads the state with the solution for elements of twice the edges; leaves it unloaded where there is none.
pub(super) fn start_from_coarser(problem: LoadProblem, state: &mut ContactState) {
    let convolution = problem.convolution;
    let grid = convolution.grid();
    let [rows, columns] = grid.shape();
    let whole = grid.unfolded(convolution.mirrors).shape();
    let is_even = rows.is_multiple_of(2) && columns.is_multiple_of(2);
    let has_period = convolution.surroundings == Surroundings::Periodic;
    if whole.into_iter().any(|n| n < SMALLEST_EDGE) || (has_period && !is_even) {
        return;
    }
    let coarse_convolution = convolution.between_blocks();
    let mut coarse = ContactState::new(&coarse_convolution);
    let problem = LoadProblem {
        convolution: &coarse_convolution,
        separation: &mean_of_four(problem.separation, [rows, columns]),
        control: map_force(problem.control, |total| 0.25 * total),
    };
    // What was reached is a guess too; the finer grid decides whether the problem can be solved.
    let _guess = solve_loads(problem, &mut coarse, &Accuracy::GUESS);
    for_each_row(&mut state.load, columns, |row, loads| {
        let coarse = &coarse.load[row / 2 * columns.div_ceil(2)..];
        for (column, load) in loads.iter_mut().enumerate() {
            *load = coarse[column / 2];
        }
    });
    MirrorWeights::of(convolution).apply(&mut state.load);
}

/// Mean of the finite heights of two by two elements; `+∞` where there are none.
fn mean_of_four(heights: &[f64], [rows, columns]: [usize; 2]) -> Vec<f64> {
    let mean = |row: usize, column: usize| {
        let (mut sum, mut count) = (0.0, 0.0);
        for row in row..(row + 2).min(rows) {
            for column in column..(column + 2).min(columns) {
                let height = heights[row * columns + column];
                if height.is_finite() {
                    sum += height;
                    count += 1.0;
                }
            }
        }
        if count > 0.0 {
            sum / count
        } else {
            f64::INFINITY
        }
    };
    let shape = [rows, columns].map(|n| n.div_ceil(2));
    let mut means = vec![0.0; shape[0] * shape[1]];
    for_each_row(&mut means, shape[1], |row, means| {
        for (column, value) in means.iter_mut().enumerate() {
            *value = mean(2 * row, 2 * column);
        }
    });
    means
}
