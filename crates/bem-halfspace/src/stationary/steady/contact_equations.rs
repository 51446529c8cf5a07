//! Loads of either sign that satisfy the contact equations on a given active set.
//!
//! ```text
//! h + K x − δ = 0  on the contact,      α δ + β Σ x = γ
//! ```
//!
//! The second equation is the control of force or depth. Small contacts are factorised, large ones solved by iteration.

use nalgebra::{DMatrix, DVector};

use crate::BemError;
use crate::parallel::reductions::{add, dot, larger};
use crate::stationary::conjugate_residuals::{minimise, norm};
use crate::stationary::search::MovingContact;
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

/// The contact of a body, and its equations.
pub(super) struct ContactEquations<'mesh> {
    mesh: &'mesh Mesh,
    plans: &'mesh mut Plans,
    /// For the displacements of all elements that may touch.
    all: Region,
    product: Product,
    /// The elements in contact, and their loads and gaps.
    contact: Vec<usize>,
    loads: Vec<f64>,
    gaps: Vec<f64>,
    /// Contacts so far.
    pub(super) contacts: usize,
    /// Whether the last contact was factorised; if not, it was solved by iteration.
    pub(super) is_factorised: bool,
}

impl MovingContact for ContactEquations<'_> {
    const REPEATS: bool = false;
    /// With ten times as much there are 1.4 times as many contacts, which take a tenth longer; a third as much hardly matters.
    const PARTS_OF_RESIDUAL: [f64; 2] = [0.02, 0.006];

    fn shape(&self) -> [usize; 2] {
        self.mesh.shape()
    }

    fn place(&self, element: usize) -> [usize; 2] {
        self.mesh.places(element)[0]
    }

    fn own_displacement(&self) -> f64 {
        self.mesh.own_creep()
    }

    /// Residuals are relative to the depth scale.
    fn displace(&mut self, pressure: &[f64], moved: &mut [f64]) -> f64 {
        moved.copy_from_slice(&self.product.apply(0, pressure, &self.all));
        1.0
    }

    fn depth(&self, pressure: &[f64]) -> Option<f64> {
        let control = self.mesh.loading.control;
        let total = self.mesh.total_load(pressure.iter().copied().enumerate());
        (control.depth != 0.0).then(|| (control.right - control.load * total) / control.depth)
    }

    fn take(&mut self, contact: &[bool], pressure: &[f64], gap: &[f64]) {
        let elements = (0..contact.len()).filter(|element| contact[*element]);
        self.contact = elements.collect();
        let listed = |field: &[f64]| self.contact.iter().map(|element| field[*element]).collect();
        (self.loads, self.gaps) = (listed(pressure), listed(gap));
        self.contacts += 1;
    }

    fn residual(&self) -> f64 {
        norm(&self.gaps) / (self.contact.len() as f64).sqrt()
    }

    fn solve(&mut self, mean: f64, largest: f64) -> Result<(), BemError> {
        let region = self.mesh.region(self.contact.iter().copied());
        self.is_factorised = is_factorised(self.contact.len(), region.n_places());
        if self.is_factorised {
            return self.factorise();
        }
        self.iterate(&region, mean, largest);
        Ok(())
    }

    fn give(&self, pressure: &mut [f64]) {
        for (element, load) in self.contact.iter().zip(&self.loads) {
            pressure[*element] = *load;
        }
    }

    fn is_near(&self, _: usize) -> bool {
        false
    }

    fn balance(&self, pressure: &mut [f64]) {
        self.mesh.balance(pressure);
    }

    fn tried(&self) -> (usize, bool) {
        let is_too_often = self.contacts >= self.mesh.options.max_iterations;
        (self.contacts, is_too_often)
    }
}

impl<'mesh> ContactEquations<'mesh> {
    pub(super) fn new(mesh: &'mesh Mesh, plans: &'mesh mut Plans) -> Self {
        let all = mesh.region(0..mesh.n_elements());
        Self {
            mesh,
            product: Product::new(plans.kernel(all.shape), &all),
            plans,
            all,
            contact: Vec::new(),
            loads: Vec::new(),
            gaps: Vec::new(),
            contacts: 0,
            is_factorised: false,
        }
    }

    fn factorise(&mut self) -> Result<(), BemError> {
        let (mesh, contact) = (self.mesh, &self.contact);
        let n = contact.len();
        let control = mesh.loading.control;
        let matrix = |row, column| match (row < n, column < n) {
            (true, true) => mesh.influence(contact[row], contact[column]),
            (true, false) => -1.0,
            (false, true) => control.load * mesh.weight(contact[column]),
            (false, false) => control.depth,
        };
        let heights = contact.iter().map(|&element| -mesh.height(element));
        let solution = solve_dense(matrix, heights.chain([control.right]).collect());
        self.loads = solution.ok_or(BemError::SingularContact { elements: n })?;
        self.loads.truncate(n);
        self.gaps.fill(0.0);
        Ok(())
    }

    fn iterate(&mut self, region: &Region, mean: f64, largest: f64) {
        let mut directions = Directions::new(self, region);
        let n = self.contact.len() as f64;
        let unknowns = [&mut self.loads[..], &mut self.gaps];
        minimise(
            unknowns,
            None,
            [MOST_DIRECTIONS; 2],
            |size, [gaps, from], found| {
                let top = || gaps.iter().fold(0.0, |top, gap| larger(top, gap.abs()));
                let size = (size / n).sqrt();
                let goes_on = size > mean && (size > largest || top() > largest);
                if goes_on {
                    directions.find(from, found);
                }
                goes_on
            },
        );
    }
}

/// Whether so many unknowns in a box of so many elements are factorised.
pub(super) fn is_factorised(n_unknowns: usize, n_places: usize) -> bool {
    let work = (n_unknowns as f64).powi(3);
    n_unknowns <= LARGEST_MATRIX && work <= FACTORISED * n_places as f64
}

/// The solution of linear equations with the entries of a matrix and the right sides, by factorisation; `None` if they are
/// singular.
fn solve_dense(entry: impl FnMut(usize, usize) -> f64, right: Vec<f64>) -> Option<Vec<f64>> {
    let n = right.len();
    let factors = DMatrix::from_fn(n, n, entry).lu();
    let solution = factors.solve(&DVector::from_vec(right))?;
    Some(solution.data.into())
}

/// Directions for the iteration of one contact.
struct Directions<'a> {
    mesh: &'a Mesh,
    region: &'a Region,
    /// 1, or 2 for an element with a mirror image.
    weights: Vec<f64>,
    product: Product,
    preconditioner: WienerHopf,
    /// The preconditioner applied to a unit depth.
    lowered: Vec<f64>,
}

impl<'a> Directions<'a> {
    fn new<'mesh: 'a>(equations: &mut ContactEquations<'mesh>, region: &'a Region) -> Self {
        let (mesh, plans) = (equations.mesh, &mut *equations.plans);
        let mut preconditioner = WienerHopf::new(plans.inverse_factors(region.shape), region);
        let contact = equations.contact.iter();
        Self {
            lowered: preconditioner.loads(&vec![1.0; equations.contact.len()], region),
            product: Product::new(plans.kernel(region.shape), region),
            weights: contact.map(|element| mesh.weight(*element)).collect(),
            preconditioner,
            region,
            mesh,
        }
    }

    /// Loads that about close the gaps, with the depth that leaves the control as it is, and the gaps K x − δ that they add.
    fn find(&mut self, gaps: &[f64], [direction, image]: [&mut [f64]; 2]) {
        let control = self.mesh.loading.control;
        let mut loads = self.preconditioner.loads(gaps, self.region);
        let stiffness = control.depth + control.load * self.total(&self.lowered);
        let depth = -control.load * self.total(&loads) / stiffness;
        add(&mut loads, depth, &self.lowered);
        let moved = self.product.apply(0, &loads, self.region);
        for (place, moved) in image.iter_mut().zip(moved) {
            *place = moved - depth;
        }
        direction.copy_from_slice(&loads);
    }

    /// Sum of the loads of the whole.
    fn total(&self, loads: &[f64]) -> f64 {
        dot(loads, &self.weights)
    }
}

#[cfg(test)]
mod tests {
    use super::solve_dense;

    #[test]
    fn singular_equations_have_no_solution() {
        let of_rank = |rank: usize| {
            let entry = |row: usize, column: usize| f64::from(row == column && row < rank);
            solve_dense(entry, vec![1.0, 2.0, 3.0])
        };
        assert_eq!(of_rank(3), Some(vec![1.0, 2.0, 3.0]));
        assert_eq!(of_rank(2), None, "of rank 2");
    }
}
