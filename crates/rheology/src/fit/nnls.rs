//! Least squares with unknowns that must not be negative.
//!
//! The active-set method of Lawson & Hanson (1974, Solving Least Squares Problems, ch. 23, DOI
//! 10.1137/1.9781611971217), with orthogonal factorisations throughout: columns of neighbouring relaxation times are
//! too alike for normal equations.

use crate::RheologyError;

/// The x ≥ 0 that minimises |A x − b|, for A given by its `columns`, none of them zero.
///
/// # Errors
/// [`RheologyError::FitNotConverged`] when the active set does not settle.
pub(super) fn nnls(columns: &[Vec<f64>], target: &[f64]) -> Result<Vec<f64>, RheologyError> {
    let norms: Vec<f64> = columns.iter().map(|column| norm(column)).collect();
    let (columns, target) = compressed(columns, &norms, target);
    let tolerance = 1e2 * f64::EPSILON * norm(&target);
    let mut set = ActiveSet {
        columns: &columns,
        target: &target,
        solution: vec![0.0; columns.len()],
        passive: Vec::new(),
    };
    let max_changes = 10 * columns.len() + 10;
    // Rounding can call for an unknown that then wants to be negative; it waits until the others have moved.
    let mut refused = Vec::new();
    for _ in 0..max_changes {
        let Some(entering) = set.steepest(&refused, tolerance) else {
            let scaled = set.solution.iter().zip(&norms);
            return Ok(scaled.map(|(x, norm)| x / norm).collect());
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

struct ActiveSet<'a> {
    columns: &'a [Vec<f64>],
    target: &'a [f64],
    solution: Vec<f64>,
    /// The unknowns that may differ from zero.
    passive: Vec<usize>,
}

impl ActiveSet<'_> {
    fn residual(&self) -> Vec<f64> {
        let mut residual = self.target.to_vec();
        for &index in &self.passive {
            add_multiple(&mut residual, -self.solution[index], &self.columns[index]);
        }
        residual
    }

    /// The unknown at zero whose growth lowers the residual most.
    fn steepest(&self, refused: &[usize], tolerance: f64) -> Option<usize> {
        let residual = self.residual();
        let gradients = (0..self.columns.len())
            .filter(|index| !self.passive.contains(index) && !refused.contains(index))
            .map(|index| (index, dot(&self.columns[index], &residual)));
        let best = gradients.max_by(|a, b| a.1.total_cmp(&b.1))?;
        (best.1 > tolerance).then_some(best.0)
    }

    /// Lets one more unknown grow, then moves to the unconstrained minimum, dropping what becomes negative on the way.
    fn enter(&mut self, index: usize) {
        self.passive.push(index);
        while !self.passive.is_empty() {
            let columns = self.passive.iter().map(|&i| self.columns[i].clone());
            let minimum = least_squares(columns.collect(), self.target);
            let Some((blocking, fraction)) = self.first_to_vanish(&minimum) else {
                for (&i, &goal) in self.passive.iter().zip(&minimum) {
                    self.solution[i] = goal;
                }
                return;
            };
            for (&i, &goal) in self.passive.iter().zip(&minimum) {
                self.solution[i] += fraction * (goal - self.solution[i]);
            }
            let dropped = self.passive.remove(blocking);
            self.solution[dropped] = 0.0;
        }
    }

    /// The place among the passive unknowns of the one that reaches zero first on the way to `minimum`, and the
    /// fraction of the way.
    fn first_to_vanish(&self, minimum: &[f64]) -> Option<(usize, f64)> {
        let on_the_way = self.passive.iter().zip(minimum).enumerate();
        on_the_way
            .filter(|(_, (_, goal))| **goal <= 0.0)
            .map(|(place, (&i, goal))| {
                let now = self.solution[i];
                // One that stands at zero and has nowhere to go blocks at once.
                let fraction = if now > 0.0 { now / (now - goal) } else { 0.0 };
                (place, fraction)
            })
            .min_by(|a, b| a.1.total_cmp(&b.1))
    }
}

/// The same problem with unit columns and as many rows as columns and target together.
fn compressed(columns: &[Vec<f64>], norms: &[f64], target: &[f64]) -> (Vec<Vec<f64>>, Vec<f64>) {
    let unit = columns.iter().zip(norms);
    let mut all: Vec<Vec<f64>> = unit
        .map(|(column, norm)| column.iter().map(|x| x / norm).collect())
        .collect();
    all.push(target.to_vec());
    if target.len() > all.len() {
        triangularise(&mut all);
        let n_rows = all.len();
        for column in &mut all {
            column.truncate(n_rows);
        }
    }
    let target = all.pop().unwrap_or_default();
    (all, target)
}

/// The x that minimises |A x − b|.
pub(super) fn least_squares(mut columns: Vec<Vec<f64>>, target: &[f64]) -> Vec<f64> {
    let n = columns.len();
    columns.push(target.to_vec());
    triangularise(&mut columns);
    let right = columns.pop().unwrap_or_default();
    let mut solution = vec![0.0; n];
    for row in (0..n).rev() {
        let known: f64 = (row + 1..n).map(|k| columns[k][row] * solution[k]).sum();
        let diagonal = columns[row][row];
        // A column that depends on those before it adds nothing.
        if diagonal.abs() > f64::EPSILON * norm(&columns[row]) {
            solution[row] = (right[row] - known) / diagonal;
        }
    }
    solution
}

/// Makes the matrix upper triangular by Householder reflections.
fn triangularise(columns: &mut [Vec<f64>]) {
    for pivot in 0..columns.len() {
        let (done, rest) = columns.split_at_mut(pivot + 1);
        let column = &mut done[pivot];
        if pivot + 1 >= column.len() {
            return;
        }
        let length = norm(&column[pivot..]);
        if length == 0.0 {
            continue;
        }
        let head = -length.copysign(column[pivot]);
        let mut mirror = column[pivot..].to_vec();
        mirror[0] -= head;
        let square = dot(&mirror, &mirror);
        for other in rest {
            let factor = -2.0 * dot(&mirror, &other[pivot..]) / square;
            add_multiple(&mut other[pivot..], factor, &mirror);
        }
        column[pivot..].fill(0.0);
        column[pivot] = head;
    }
}

fn norm(values: &[f64]) -> f64 {
    dot(values, values).sqrt()
}

fn dot(a: &[f64], b: &[f64]) -> f64 {
    a.iter().zip(b).map(|(x, y)| x * y).sum()
}

fn add_multiple(values: &mut [f64], factor: f64, other: &[f64]) {
    for (value, other) in values.iter_mut().zip(other) {
        *value += factor * other;
    }
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
            let columns: Vec<Vec<f64>> = (0..8)
                .map(|k| (0..20).map(|i| entry(i, k)).collect())
                .collect();
            let target: Vec<f64> = (0..20).map(|i| entry(i, 99)).collect();
            let solution = nnls(&columns, &target).expect("the active set settles");
            let mut residual = target.clone();
            for (x, column) in solution.iter().zip(&columns) {
                add_multiple(&mut residual, -x, column);
            }
            for (k, (&x, column)) in solution.iter().zip(&columns).enumerate() {
                let gradient = dot(column, &residual) / norm(column) / norm(&target);
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
        let columns = [
            vec![1.0, 2.0, 0.0],
            vec![1.0, 2.0, 0.0],
            vec![2.0, 4.0, 0.0],
        ];
        let solution = nnls(&columns, &[3.0, 6.0, 1.0]).expect("the active set settles");
        let sum = solution[0] + solution[1] + 2.0 * solution[2];
        assert!((sum - 3.0).abs() <= 1e-14, "{solution:?} sums to {sum}");
    }
}
