//! The cycle in which a reciprocating motion ends.
//!
//! What the elements remember at the beginning of a cycle, x, is at its end g(x), and the cycle is the x with g(x) = x.
//! Elements that forget slowly would take as many cycles as their time has periods; instead every second cycle begins with
//! the combination of those before for which g(x) − x is least (Anderson 1965, J. ACM 12, 547; Walker & Ni 2011, SIAM J.
//! Numer. Anal. 49, 1715). One more cycle without it shows how much still changes, and by how much more it may:
//!
//! ```text
//! |x − x*| ≤ |g(x) − x| / (1 − e^(−T/λ))        for the slowest retardation time λ
//! ```

use indenters::RigidLine;

use super::chain::Chain;
use super::legs::Leg;
use super::march::{Marched, Problem};
use crate::MdrError;

/// Cycles after which the search is given up.
const MOST_CYCLES: usize = 400;
/// By how much less forces and depths of single steps need be known than the friction of the cycle.
const PARTS: [f64; 4] = [1.0, 0.1, 0.1, 0.1];
/// Cycles that are followed as they are at first.
const FIRST_CYCLES: usize = 3;
/// Cycles that are combined.
const COMBINED: usize = 8;
/// Smallest pivot of the equations of a combination, relative to the first.
const SINGULAR: f64 = 1e-12;

/// Cycle after cycle of one problem.
pub(super) struct Cycles<'p, 'a, L: ?Sized> {
    problem: &'p Problem<'a, L>,
    chain: Chain<'p, L>,
    /// Beginnings and ends of the last cycles.
    pairs: Vec<[Vec<f64>; 2]>,
}

impl<'p, 'a, L: RigidLine + ?Sized> Cycles<'p, 'a, L> {
    /// Lists of what all elements remember.
    pub(super) const COPIES: f64 = 5.0 * (COMBINED + 2) as f64;

    pub(super) fn new(problem: &'p Problem<'a, L>, chain: Chain<'p, L>) -> Self {
        Self {
            problem,
            chain,
            pairs: Vec::new(),
        }
    }

    /// The cycle that is like the one before, to the tolerance; nothing when the chain was not high enough.
    pub(super) fn settle(
        mut self,
        legs: &[Leg],
        tell: &dyn Fn(f64),
    ) -> Result<Option<Marched>, MdrError> {
        let [start, end] = self.problem.load.times();
        let slowness = -(-(end - start) / self.problem.memory).exp_m1().recip();
        let mut change = 1.0;
        let mut depth = self.chain.depth();
        self.chain.lift(start);
        if let Some(kept) = self.problem.kept.take() {
            self.chain.recall(&kept);
        }
        let mut before: Option<Marched> = None;
        for n_cycles in 1..=MOST_CYCLES {
            let from = self.chain.memory().to_vec();
            let returned = self.chain.lower()?;
            let Some(mut cycle) = self.problem.pass(&mut self.chain, legs, depth, &|_| ())? else {
                return Ok(None);
            };
            depth = self.chain.depth();
            let kept = self.chain.lift(start) - returned;
            cycle.lost += self.problem.unit(self.chain.spacing()) * kept;
            let to = self.chain.memory().to_vec();
            self.pairs.push([from, to]);
            let Some(last) = before.take() else {
                before = Some(cycle);
                continue;
            };
            cycle.n_cycles = n_cycles;
            cycle.rest = cycle.rests(&last, slowness);
            let sizes = cycle.sizes();
            let relative = cycle.rest.iter().zip(sizes).zip(PARTS);
            let relative = relative.map(|((rest, size), part)| part * rest / size);
            change = relative.fold(0.0, f64::max);
            tell((change.ln() / self.problem.tolerance.ln()).clamp(0.0, 1.0));
            if change <= self.problem.tolerance {
                self.problem.kept.replace(Some(self.chain.kept()));
                return Ok(Some(cycle));
            }
            if n_cycles < FIRST_CYCLES {
                before = Some(cycle);
            } else {
                self.combine();
            }
        }
        Err(MdrError::NotPeriodic {
            cycles: MOST_CYCLES,
            change,
            tolerance: self.problem.tolerance,
        })
    }

    /// Begins the next cycle with the best combination of the ends of those before.
    fn combine(&mut self) {
        let excess = self.pairs.len().saturating_sub(COMBINED);
        self.pairs.drain(..excess);
        let residuals: Vec<Vec<f64>> = self.pairs.iter().map(|[x, g]| minus(g, x)).collect();
        let Some(([_, last], others)) = self.pairs.split_last() else {
            return;
        };
        let (residual, before) = residuals.split_at(residuals.len() - 1);
        let (residual, before) = (&before[0], residual);
        let changes: Vec<Vec<f64>> = before.iter().map(|one| minus(residual, one)).collect();
        let weights = least_squares(&changes, residual);
        let mut begun = last.clone();
        for (weight, [_, end]) in weights.iter().zip(others) {
            for (value, (last, end)) in begun.iter_mut().zip(last.iter().zip(end)) {
                *value -= weight * (last - end);
            }
        }
        self.chain.memory().copy_from_slice(&begun);
    }
}

fn minus(a: &[f64], b: &[f64]) -> Vec<f64> {
    a.iter().zip(b).map(|(a, b)| a - b).collect()
}

fn dot(a: &[f64], b: &[f64]) -> f64 {
    a.iter().zip(b).map(|(a, b)| a * b).sum()
}

/// Weights γ for which |b − Σ γ_k a_k| is least, by orthogonalisation; 0 for what depends on the others.
fn least_squares(vectors: &[Vec<f64>], target: &[f64]) -> Vec<f64> {
    let n = vectors.len();
    let mut weights = vec![0.0; n];
    let (mut basis, mut rows): (Vec<Vec<f64>>, Vec<Vec<f64>>) = (Vec::new(), Vec::new());
    // Each basis vector is a combination of the vectors, whose weights are its row; the last cycles come first.
    for index in (0..n).rev() {
        let mut vector = vectors[index].clone();
        let mut row = vec![0.0; n];
        row[index] = 1.0;
        let size = dot(&vector, &vector);
        for (other, other_row) in basis.iter().zip(&rows) {
            let part = dot(other, &vector);
            for (value, other) in vector.iter_mut().zip(other) {
                *value -= part * other;
            }
            for (value, other) in row.iter_mut().zip(other_row) {
                *value -= part * other;
            }
        }
        let left = dot(&vector, &vector);
        if left > SINGULAR * size && left > 0.0 {
            let scale = left.sqrt().recip();
            basis.push(vector.iter().map(|value| scale * value).collect());
            rows.push(row.iter().map(|value| scale * value).collect());
        }
    }
    for (vector, row) in basis.iter().zip(&rows) {
        let part = dot(vector, target);
        for (weight, value) in weights.iter_mut().zip(row) {
            *weight += part * value;
        }
    }
    weights
}
