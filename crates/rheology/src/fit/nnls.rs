//! Nonnegative least squares by the active-set method of Lawson & Hanson (1974, Solving Least Squares Problems, ch. 23, DOI
//! 10.1137/1.9781611971217).
//!
//! All factorisations are orthogonal, because columns of neighbouring relaxation times are nearly parallel.

use nalgebra::{DMatrix, DVector};

use crate::RheologyError;

/// Solution x ≥ 0 that minimises |A x − b|, for a `matrix` A without a column of zeros and a `target` b.
///
/// [`RheologyError::FitNotConverged`] after 10 n + 10 changes of the active set for n unknowns.
pub(super) fn nnls(
    matrix: &DMatrix<f64>,
    target: &DVector<f64>,
) -> Result<DVector<f64>, RheologyError> {
    let norms = DVector::from_iterator(matrix.ncols(), matrix.column_iter().map(|a| a.norm()));
    let (matrix, target) = compress(matrix, &norms, target);
    // The columns have unit length; gradients of the squared residual up to this size count as rounding.
    let tolerance = 1e2 * f64::EPSILON * target.norm();
    let mut set = ActiveSet {
        solution: DVector::zeros(matrix.ncols()),
        matrix,
        target,
        passive: Vec::new(),
    };
    let max_changes = 10 * norms.len() + 10;
    // Rounding can admit an unknown that would become negative; it is refused until another one has entered.
    let mut refused = Vec::new();
    for _ in 0..max_changes {
        let Some(entering) = set.entering_unknown(&refused, tolerance) else {
            return Ok(set.solution.component_div(&norms));
        };
        set.add_unknown(entering);
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

/// The normalised problem and the current iterate.
struct ActiveSet {
    /// Matrix with normalised columns.
    matrix: DMatrix<f64>,
    /// Right side.
    target: DVector<f64>,
    /// Present solution; 0 outside the passive set.
    solution: DVector<f64>,
    /// Indices of the passive set, the unknowns that may differ from zero.
    passive: Vec<usize>,
}

impl ActiveSet {
    /// Index of the unknown at zero along which the sum of squares falls most steeply, but for those that are `refused`; `None` if
    /// it falls along none by more than the `tolerance`.
    fn entering_unknown(&self, refused: &[usize], tolerance: f64) -> Option<usize> {
        let residuals = &self.target - &self.matrix * &self.solution;
        let gradients = self.matrix.tr_mul(&residuals);
        let best = (0..gradients.len())
            .filter(|index| !self.passive.contains(index) && !refused.contains(index))
            .max_by(|&a, &b| gradients[a].total_cmp(&gradients[b]))?;
        (gradients[best] > tolerance).then_some(best)
    }

    /// Adds an unknown to the passive set, then moves to the minimum on the set and drops unknowns that reach zero.
    fn add_unknown(&mut self, index: usize) {
        self.passive.push(index);
        while !self.passive.is_empty() {
            let minimum = least_squares(self.matrix.select_columns(&self.passive), &self.target);
            let blocking = self.blocking_unknown(&minimum);
            let fraction = blocking.as_ref().map_or(1.0, |blocking| blocking.fraction);
            for (&i, &goal) in self.passive.iter().zip(&minimum) {
                self.solution[i] += fraction * (goal - self.solution[i]);
            }
            let Some(blocking) = blocking else {
                return;
            };
            let dropped = self.passive.remove(blocking.passive_index);
            self.solution[dropped] = 0.0;
        }
    }

    /// The passive unknown that reaches zero first on the way to `minimum`; `None` if none does.
    fn blocking_unknown(&self, minimum: &DVector<f64>) -> Option<Blocking> {
        let moving = self.passive.iter().zip(minimum).enumerate();
        let falling = moving.filter(|(_, (_, goal))| **goal <= 0.0);
        let candidates = falling.map(|(passive_index, (&i, goal))| {
            let now = self.solution[i];
            // An unknown that is zero already blocks the whole step.
            let fraction = if now > 0.0 { now / (now - goal) } else { 0.0 };
            Blocking {
                passive_index,
                fraction,
            }
        });
        candidates.min_by(|a, b| a.fraction.total_cmp(&b.fraction))
    }
}

/// An unknown that limits a step.
struct Blocking {
    /// Index of the unknown in the passive set.
    passive_index: usize,
    /// Fraction of the step at which it reaches zero.
    fraction: f64,
}

/// The problem with unit columns, reduced by a QR factorisation to at most `ncols + 1` rows.
fn compress(
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

/// Least-squares solution x, which minimises |A x − b|, by a QR factorisation and back substitution.
fn least_squares(matrix: DMatrix<f64>, target: &DVector<f64>) -> DVector<f64> {
    let norms: Vec<f64> = matrix.column_iter().map(|column| column.norm()).collect();
    let qr = matrix.qr();
    let mut right = target.clone();
    qr.q_tr_mul(&mut right);
    let triangle = qr.unpack_r();
    let mut solution = DVector::zeros(triangle.ncols());
    for row in (0..triangle.nrows()).rev() {
        let diagonal = triangle[(row, row)];
        // A column that depends on previous ones gets the coefficient 0.
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
                // The conditions of the minimum must hold within some hundred roundings of numbers below one.
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
