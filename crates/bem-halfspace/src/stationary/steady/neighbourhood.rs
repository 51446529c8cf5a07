//! The neighbourhood of a few violations, solved by itself.
//!
//! A tooth of the outline wears off by one element per change of the whole active set, and the end of a column may change
//! sides without end. Both concern few elements: the problem is solved for those near the violations, while the other loads
//! and the depth stay.

use nalgebra::DMatrix;

use crate::stationary::steady::contact_equations::solve_dense;
use crate::stationary::steady::mesh::Mesh;

/// Elements on every side of a violation that take part.
const REACH: usize = 4;
/// More elements are not a small problem.
const LARGEST: usize = 250;
/// Block pivots of all violations, and pivots in all.
const BLOCKS: usize = 10;
const PIVOTS: usize = 100;

/// Elements with their load; 0 outside the contact.
type Loads = Vec<(usize, f64)>;

/// Solves the neighbourhood of `violations` from the present gap and load of every element; `None` when it is too large
/// or pivoting cycles. Penetrations up to `allowed` are accepted.
pub(super) fn solve_neighbourhood(
    mesh: &Mesh,
    gaps: &[f64],
    loads: &[f64],
    violations: &[usize],
    allowed: f64,
) -> Option<Loads> {
    let elements = mesh.near(violations, REACH, LARGEST)?;
    let problem = Neighbourhood::new(mesh, gaps, loads, elements);
    let start = problem.elements.iter();
    let inside = start.map(|&element| (loads[element] > 0.0) != violations.contains(&element));
    problem.pivot(inside.collect(), allowed)
}

/// x ≥ 0, g + K x ≥ 0, x (g + K x) = 0.
struct Neighbourhood {
    elements: Vec<usize>,
    influence: DMatrix<f64>,
    /// Gaps without the loads of these elements.
    gaps: Vec<f64>,
}

impl Neighbourhood {
    fn new(mesh: &Mesh, gaps: &[f64], loads: &[f64], elements: Vec<usize>) -> Self {
        let n = elements.len();
        let influence = |to, from| mesh.influence(elements[to], elements[from]);
        let influence = DMatrix::from_fn(n, n, influence);
        let without = |to: usize| {
            let moved = (0..n).map(|from| influence[(to, from)] * loads[elements[from]]);
            gaps[elements[to]] - moved.sum::<f64>()
        };
        Self {
            gaps: (0..n).map(without).collect(),
            elements,
            influence,
        }
    }

    /// Murty's pivots (1974), all violations at once at first.
    fn pivot(&self, mut inside: Vec<bool>, allowed: f64) -> Option<Loads> {
        for pivot in 0..PIVOTS {
            let loads = self.loads_inside(&inside);
            let violations = self.violations(&inside, &loads, allowed)?;
            if violations.is_empty() {
                return Some(self.elements.iter().copied().zip(loads).collect());
            }
            let from = if pivot < BLOCKS {
                0
            } else {
                violations.len() - 1
            };
            for &element in &violations[from..] {
                inside[element] = !inside[element];
            }
        }
        None
    }

    /// Elements in tension or penetrating; `None` when the loads are not numbers.
    fn violations(&self, inside: &[bool], loads: &[f64], allowed: f64) -> Option<Vec<usize>> {
        let violates = |&element: &usize| {
            if inside[element] {
                return loads[element] < 0.0;
            }
            let moved = loads.iter().enumerate();
            let moved = moved.map(|(from, load)| self.influence[(element, from)] * load);
            self.gaps[element] + moved.sum::<f64>() < -allowed
        };
        let finite = loads.iter().all(|load| load.is_finite());
        finite.then(|| (0..inside.len()).filter(violates).collect())
    }

    /// Loads with no gap inside; 0 outside.
    fn loads_inside(&self, inside: &[bool]) -> Vec<f64> {
        let contact = (0..inside.len()).filter(|element| inside[*element]);
        let contact: Vec<usize> = contact.collect();
        let mut loads = vec![0.0; inside.len()];
        if !contact.is_empty() {
            let influence = |to, from| self.influence[(contact[to], contact[from])];
            let right = contact.iter().map(|&element| -self.gaps[element]);
            let solution = solve_dense(influence, right.collect());
            for (&element, load) in contact.iter().zip(solution) {
                loads[element] = load;
            }
        }
        loads
    }
}
