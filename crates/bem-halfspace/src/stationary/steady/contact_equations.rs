//! Loads of either sign that satisfy the contact equations on a given active set, and the depth that goes with them.
//!
//! ```text
//! h + K x − δ = 0  on the contact,      α δ + β Σ x = γ
//! ```
//!
//! The second equation is the control of force or depth. Small contacts are factorised, large ones solved by iteration.

use nalgebra::{DMatrix, DVector};

use crate::parallel::reductions::add;
use crate::stationary::conjugate_residuals::minimise;
use crate::stationary::steady::filter::Product;
use crate::stationary::steady::mesh::Mesh;
use crate::stationary::steady::plans::Plans;
use crate::stationary::steady::region::Region;
use crate::stationary::steady::wiener_hopf::WienerHopf;

/// A contact is factorised where the cube of its number of elements is at most so many times the number of elements of
/// its box, on which transforms would work: a compact contact up to about 120 elements, a thin crescent far beyond. It is
/// faster there, and exact to rounding.
const FACTORISED: f64 = 5e3;
/// Larger matrices take too much memory.
const LARGEST_MATRIX: usize = 4000;
/// Directions tried before the iteration gives up; a preconditioned contact needs some tens.
pub(super) const MOST_DIRECTIONS: usize = 150;

/// Loads of the elements of a contact and the depth, in the units of the mesh.
pub(super) struct EquationSolution {
    pub(super) loads: Vec<f64>,
    pub(super) depth: f64,
    /// Whether the equations were factorised; if not, they were solved by iteration.
    pub(super) factorised: bool,
}

/// Solves the equations of `contact` up to `tolerance`, the root mean square of the residual in units of the depth scale;
/// `start` is a guess of the loads.
pub(super) fn solve_equations(
    mesh: &Mesh,
    plans: &mut Plans,
    contact: &[usize],
    start: Vec<f64>,
    tolerance: f64,
) -> EquationSolution {
    let region = mesh.region(contact.iter().copied());
    if is_factorised(contact.len(), region.n_places()) {
        return factorise(mesh, contact);
    }
    ContactEquations::new(mesh, plans, contact, region).iterate(start, tolerance)
}

/// Whether so many unknowns in a box of so many elements are factorised.
pub(super) fn is_factorised(n_unknowns: usize, n_places: usize) -> bool {
    let work = (n_unknowns as f64).powi(3);
    n_unknowns <= LARGEST_MATRIX && work <= FACTORISED * n_places as f64
}

fn factorise(mesh: &Mesh, contact: &[usize]) -> EquationSolution {
    let n = contact.len();
    let control = mesh.loading.control;
    let matrix = |row, column| match (row < n, column < n) {
        (true, true) => mesh.influence(contact[row], contact[column]),
        (true, false) => -1.0,
        (false, true) => control.load * mesh.weight(contact[column]),
        (false, false) => control.depth,
    };
    let heights = contact.iter().map(|&element| -mesh.height(element));
    let mut loads = solve_dense(matrix, heights.chain([control.right]).collect());
    EquationSolution {
        depth: loads.remove(n),
        loads,
        factorised: true,
    }
}

/// The solution of linear equations with the entries of a matrix and the right sides, by factorisation; not a number where
/// they are singular.
pub(super) fn solve_dense(entry: impl FnMut(usize, usize) -> f64, right: Vec<f64>) -> Vec<f64> {
    let n = right.len();
    let factors = DMatrix::from_fn(n, n, entry).lu();
    let solution = factors.solve(&DVector::from_vec(right));
    solution.map_or_else(|| vec![f64::NAN; n], |solution| solution.data.into())
}

/// The equations of one contact, for iteration.
struct ContactEquations<'mesh> {
    mesh: &'mesh Mesh,
    contact: &'mesh [usize],
    region: Region,
    product: Product,
    preconditioner: WienerHopf,
    /// The preconditioner applied to a unit depth.
    lowered: Vec<f64>,
}

impl<'mesh> ContactEquations<'mesh> {
    fn new(mesh: &'mesh Mesh, plans: &mut Plans, contact: &'mesh [usize], region: Region) -> Self {
        let mut preconditioner = WienerHopf::new(plans.inverse_factors(region.shape), &region);
        Self {
            lowered: preconditioner.loads(&vec![1.0; contact.len()], &region),
            product: Product::new(plans.kernel(region.shape), &region),
            preconditioner,
            region,
            contact,
            mesh,
        }
    }

    fn iterate(mut self, start: Vec<f64>, tolerance: f64) -> EquationSolution {
        let (mut loads, depth) = self.start(start);
        let mut gaps = self.displacements_below(&loads, depth);
        for (gap, &element) in gaps.iter_mut().zip(self.contact) {
            *gap += self.mesh.height(element);
        }
        let n = self.contact.len();
        let allowed = tolerance * (n as f64).sqrt();
        loads.push(depth);
        let unknowns = [&mut loads[..], &mut gaps[..]];
        let most = [MOST_DIRECTIONS; 2];
        minimise(
            unknowns,
            None,
            most,
            |size, [_, from], [direction, image]| {
                if size.sqrt() <= allowed {
                    return false;
                }
                let (mut loads, depth) = self.correct(from);
                image.copy_from_slice(&self.displacements_below(&loads, depth));
                loads.push(depth);
                direction.copy_from_slice(&loads);
                true
            },
        );
        EquationSolution {
            depth: loads.remove(n),
            loads,
            factorised: false,
        }
    }

    /// Loads and depth that satisfy the control, near the guess.
    fn start(&mut self, mut loads: Vec<f64>) -> (Vec<f64>, f64) {
        let control = self.mesh.loading.control;
        if control.depth != 0.0 {
            let depth = (control.right - control.load * self.total(&loads)) / control.depth;
            return (loads, depth);
        }
        // A change of depth changes the force with hardly any residual.
        let missing = control.right / control.load - self.total(&loads);
        let change = missing / self.total(&self.lowered);
        add(&mut loads, change, &self.lowered);
        let moved = self.product.apply(0, &loads, &self.region);
        let moved = self.contact.iter().zip(moved);
        let depth = moved.map(|(&element, moved)| moved + self.mesh.height(element));
        let mean = depth.sum::<f64>() / self.contact.len() as f64;
        (loads, mean)
    }

    /// K x − δ.
    fn displacements_below(&mut self, loads: &[f64], depth: f64) -> Vec<f64> {
        let mut moved = self.product.apply(0, loads, &self.region);
        moved.iter_mut().for_each(|value| *value -= depth);
        moved
    }

    /// The preconditioner with the control: loads and depth that cause about the given residual and leave the control as
    /// it is.
    fn correct(&mut self, residual: &[f64]) -> (Vec<f64>, f64) {
        let control = self.mesh.loading.control;
        let mut loads = self.preconditioner.loads(residual, &self.region);
        let stiffness = control.depth + control.load * self.total(&self.lowered);
        let depth = -control.load * self.total(&loads) / stiffness;
        add(&mut loads, depth, &self.lowered);
        (loads, depth)
    }

    /// Sum of the loads of the whole.
    fn total(&self, loads: &[f64]) -> f64 {
        let elements = self.contact.iter().copied();
        self.mesh.total_load(elements.zip(loads.iter().copied()))
    }
}
