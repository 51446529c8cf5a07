//! Least squares with unknowns that must not be negative.
//!
//! The active-set method of Lawson & Hanson (1974, Solving Least Squares Problems, ch. 23, DOI
//! 10.1137/1.9781611971217), with orthogonal factorisations throughout: columns of neighbouring relaxation times are
//! too alike for normal equations.

use nalgebra::{DMatrix, DVector};

use crate::RheologyError;

/// The x ≥ 0 that minimises |A x − b|, for a matrix without a column of zeros.
pub(super) fn nnls(
    matrix: &DMatrix<f64>,
    target: &DVector<f64>,
) -> Result<DVector<f64>, RheologyError> {
    let norms = DVector::from_iterator(matrix.ncols(), matrix.column_iter().map(|a| a.norm()));
    let (matrix, target) = compressed(matrix, &norms, target);
    let tolerance = 1e2 * f64::EPSILON * target.norm();
    let mut set = ActiveSet {
        solution: DVector::zeros(matrix.ncols()),
        matrix,
        target,
        passive: Vec::new(),
    };
    let max_changes = 10 * norms.len() + 10;
    // Rounding can call for an unknown that then wants to be negative; it waits until the others have moved.
    let mut refused = Vec::new();
    for _ in 0..max_changes {
        let Some(entering) = set.steepest(&refused, tolerance) else {
            return Ok(set.solution.component_div(&norms));
        };
        set.enter(entering);
        if set.solution[entering] > 0.0 {
            refused.clear();
        } else {
            refused.push(entering);
        }
    }
    Err(RheologyError::FitNotConverged {
        changes: max_changes,
    })
}

struct ActiveSet {
    matrix: DMatrix<f64>,
    target: DVector<f64>,
    solution: DVector<f64>,
    /// The unknowns that may differ from zero.
    passive: Vec<usize>,
}

impl ActiveSet {
    /// The unknown at zero whose growth lowers the residual most.
    fn steepest(&self, refused: &[usize], tolerance: f64) -> Option<usize> {
        let residuals = &self.target - &self.matrix * &self.solution;
        let gradients = self.matrix.tr_mul(&residuals);
        let best = (0..gradients.len())
            .filter(|index| !self.passive.contains(index) && !refused.contains(index))
            .max_by(|&a, &b| gradients[a].total_cmp(&gradients[b]))?;
        (gradients[best] > tolerance).then_some(best)
    }

    /// Lets one more unknown grow, then moves to the unconstrained minimum, dropping what would become negative.
    fn enter(&mut self, index: usize) {
        self.passive.push(index);
        while !self.passive.is_empty() {
            let minimum = least_squares(self.matrix.select_columns(&self.passive), &self.target);
            let blocking = self.first_to_vanish(&minimum);
            let fraction = blocking.map_or(1.0, |(_, fraction)| fraction);
            for (&i, &goal) in self.passive.iter().zip(&minimum) {
                self.solution[i] += fraction * (goal - self.solution[i]);
            }
            let Some((place, _)) = blocking else {
                return;
            };
            let dropped = self.passive.remove(place);
            self.solution[dropped] = 0.0;
        }
    }

    /// The place among the passive unknowns of the one that reaches zero first between here and `minimum`, and at
    /// which fraction of the distance.
    fn first_to_vanish(&self, minimum: &DVector<f64>) -> Option<(usize, f64)> {
        let moving = self.passive.iter().zip(minimum).enumerate();
        let falling = moving.filter(|(_, (_, goal))| **goal <= 0.0);
        let fractions = falling.map(|(place, (&i, goal))| {
            let now = self.solution[i];
            // One that stands at zero and has nowhere to go blocks at once.
            let fraction = if now > 0.0 { now / (now - goal) } else { 0.0 };
            (place, fraction)
        });
        fractions.min_by(|a, b| a.1.total_cmp(&b.1))
    }
}

/// The same problem with unit columns and at most as many rows as columns and target together.
fn compressed(
    matrix: &DMatrix<f64>,
    norms: &DVector<f64>,
    target: &DVector<f64>,
) -> (DMatrix<f64>, DVector<f64>) {
    let last = matrix.ncols();
    let mut all = matrix.clone().insert_column(last, 0.0);
    for (index, norm) in norms.iter().enumerate() {
        all.column_mut(index).unscale_mut(*norm);
    }
    all.set_column(last, target);
    if all.nrows() > all.ncols() {
        all = all.qr().unpack_r();
    }
    let target = all.column(last).into_owned();
    (all.remove_column(last), target)
}

/// The x that minimises |A x − b|.
fn least_squares(matrix: DMatrix<f64>, target: &DVector<f64>) -> DVector<f64> {
    let norms: Vec<f64> = matrix.column_iter().map(|column| column.norm()).collect();
    let qr = matrix.qr();
    let mut right = target.clone();
    qr.q_tr_mul(&mut right);
    let triangle = qr.unpack_r();
    let mut solution = DVector::zeros(triangle.ncols());
    for row in (0..triangle.nrows()).rev() {
        let diagonal = triangle[(row, row)];
        // A column that depends on those before it adds nothing.
        if diagonal.abs() > f64::EPSILON * norms[row] {
            let known = triangle.row(row).transpose().dot(&solution);
            solution[row] = (right[row] - known) / diagonal;
        }
    }
    solution
}

#[cfg(test)]
mod tests {
    use super::*;

    /// At the minimum no unknown at zero wants to grow, and no other wants to change (Kuhn and Tucker).
    #[test]
    fn solution_satisfies_the_optimality_conditions() {
        for seed in 1..=200_u32 {
            let entry = |i: usize, k: usize| {
                (f64::from(seed) * (1.3 * i as f64 + 7.7 * k as f64 + 0.4)).sin()
            };
            let matrix = DMatrix::from_fn(20, 8, entry);
            let target = DVector::from_fn(20, |i, _| entry(i, 99));
            let solution = nnls(&matrix, &target).expect("the active set settles");
            let residual = &target - &matrix * &solution;
            for (k, (&x, column)) in solution.iter().zip(matrix.column_iter()).enumerate() {
                let gradient = column.dot(&residual) / column.norm() / target.norm();
                // A hundred roundings of numbers below one.
                let met = if x > 0.0 {
                    gradient.abs() <= 1e-13
                } else {
                    x.abs() <= 0.0 && gradient <= 1e-13
                };
                assert!(
                    met,
                    "seed {seed}: x[{k}] = {x:e} with gradient {gradient:e}"
                );
            }
        }
    }

    /// Two equal columns, and one that is their sum: any of the solutions fits.
    #[test]
    fn dependent_columns_are_no_obstacle() {
        let columns = [[1.0, 2.0, 0.0], [1.0, 2.0, 0.0], [2.0, 4.0, 0.0]];
        let matrix = DMatrix::from_fn(3, 3, |i, k| columns[k][i]);
        let target = DVector::from_vec(vec![3.0, 6.0, 1.0]);
        let solution = nnls(&matrix, &target).expect("the active set settles");
        let sum = solution[0] + solution[1] + 2.0 * solution[2];
        assert!((sum - 3.0).abs() <= 1e-14, "{solution:?} sums to {sum}");
    }
}
