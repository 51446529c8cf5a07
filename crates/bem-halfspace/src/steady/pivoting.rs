//! Block principal pivoting: guess the contact, solve it, exchange what pulls for what penetrates.
//!
//! While the number of violations falls, all are exchanged at once. A few exchanges without progress are allowed; then
//! single exchanges of the last violation (Murty 1974) lead on until there is progress again.

use faer::Mat;
use faer::linalg::solvers::Solve;

use crate::BemError;
use crate::steady::mesh::Mesh;

/// Block exchanges without progress before single ones.
const PATIENCE: usize = 8;
/// Loads and gaps above the negative of this, relative to the largest, count as zero: rounding of the factorisation.
const ROUNDING: f64 = 1e-12;

/// Loads of the elements in contact, all greater than zero.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct Solution {
    pub(super) loads: Vec<(usize, f64)>,
    pub(super) iterations: usize,
    /// Largest |gap| in the contact, in units of the depth scale.
    pub(super) residual: f64,
}

/// Solves the complementarity problem from a first guess of the contact.
pub(super) fn solve(
    mesh: &Mesh,
    first_guess: Vec<usize>,
    max_iterations: usize,
) -> Result<Solution, BemError> {
    let mut contact = first_guess;
    let (mut fewest, mut patience) = (usize::MAX, PATIENCE);
    for iterations in 1..=max_iterations {
        let candidate = Candidate::solve(mesh, &contact);
        let violations = candidate.violations(mesh, &contact);
        if violations.is_empty() {
            let residual = candidate.residual(mesh, &contact);
            let loads = contact
                .into_iter()
                .zip(candidate.loads)
                .filter(|(_, load)| *load > 0.0);
            return Ok(Solution {
                loads: loads.collect(),
                iterations,
                residual,
            });
        }
        if violations.len() < fewest {
            (fewest, patience) = (violations.len(), PATIENCE);
            contact = exchange(&contact, &violations);
        } else if patience > 0 {
            patience -= 1;
            contact = exchange(&contact, &violations);
        } else {
            contact = exchange(&contact, &violations[violations.len() - 1..]);
        }
    }
    let [residual, tolerance] = [fewest as f64 / mesh.n_elements() as f64, 0.0];
    Err(BemError::ContactNotConverged {
        iterations: max_iterations,
        residual,
        tolerance,
    })
}

/// Symmetric difference of two increasing lists.
fn exchange(contact: &[usize], violations: &[usize]) -> Vec<usize> {
    let mut merged: Vec<usize> = contact.iter().chain(violations).copied().collect();
    merged.sort_unstable();
    let mut next = Vec::with_capacity(merged.len());
    let mut rest = &merged[..];
    while let [first, tail @ ..] = rest {
        if tail.first() == Some(first) {
            rest = &tail[1..];
        } else {
            next.push(*first);
            rest = tail;
        }
    }
    next
}

/// Loads that close the gaps of a guessed contact, of either sign, and the depth.
struct Candidate {
    loads: Vec<f64>,
    depth: f64,
}

impl Candidate {
    /// Solves `h + K x − d = 0` on the contact together with the balance of forces.
    fn solve(mesh: &Mesh, contact: &[usize]) -> Self {
        let n = contact.len();
        let matrix = Mat::from_fn(n + 1, n + 1, |row, column| match (row < n, column < n) {
            (true, true) => mesh.influence(contact[row], contact[column]),
            (true, false) => -1.0,
            (false, true) => mesh.weight(contact[column]),
            (false, false) => 0.0,
        });
        let right = Mat::from_fn(n + 1, 1, |row, _| {
            if row < n {
                -mesh.height(contact[row])
            } else {
                mesh.total_load()
            }
        });
        let solution = matrix.partial_piv_lu().solve(&right);
        Self {
            loads: (0..n).map(|row| solution[(row, 0)]).collect(),
            depth: solution[(n, 0)],
        }
    }

    fn gap(&self, mesh: &Mesh, contact: &[usize], element: usize) -> f64 {
        let moved: f64 = contact
            .iter()
            .zip(&self.loads)
            .map(|(&from, load)| mesh.influence(element, from) * load)
            .sum();
        mesh.height(element) + moved - self.depth
    }

    /// Elements of the contact that pull and others that penetrate, increasing.
    fn violations(&self, mesh: &Mesh, contact: &[usize]) -> Vec<usize> {
        let largest = self
            .loads
            .iter()
            .fold(0.0, |largest: f64, load| largest.max(load.abs()));
        let mut inside = contact.iter().zip(&self.loads).peekable();
        let mut violations = Vec::new();
        for element in 0..mesh.n_elements() {
            let violated = match inside.next_if(|(member, _)| **member == element) {
                Some((_, load)) => *load < -ROUNDING * largest,
                None => self.gap(mesh, contact, element) < -ROUNDING,
            };
            if violated {
                violations.push(element);
            }
        }
        violations
    }

    fn residual(&self, mesh: &Mesh, contact: &[usize]) -> f64 {
        contact
            .iter()
            .map(|&element| self.gap(mesh, contact, element).abs())
            .fold(0.0, f64::max)
    }
}
