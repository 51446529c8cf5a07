//! One contact of a body.

use crate::BemError;
use crate::stationary::search::{MovingContact, Search};
use crate::stationary::steady::contact_equations::ContactEquations;
use crate::stationary::steady::filter::Product;
use crate::stationary::steady::mesh::Mesh;
use crate::stationary::steady::plans::Plans;
use crate::stationary::steady::region::Region;

/// Root mean square of the residual of the first contact, as a part of how much the gap opens over an element at the front, and at
/// most, in units of the depth scale.
const PART_OF_OPENING: f64 = 1e-3;
const FIRST_RESIDUAL: f64 = 1e-5;

/// Loads of all elements in contact, all greater than zero, in the units of the mesh.
pub(super) struct Solution {
    pub(super) loads: Vec<(usize, f64)>,
    pub(super) depth: f64,
    pub(super) iterations: usize,
    /// Whether the equations of the last contact were factorised.
    pub(super) factorised: bool,
    /// Largest residual |h + u − d| in the contact, in units of the depth scale.
    pub(super) residual: f64,
    /// Mean under the load of what the gaps beside the contact add to the slope, in elements and units of the depth scale.
    pub(super) opening: f64,
}

/// Solves the complementarity problem from a first guess of the elements in contact and their loads.
pub(super) fn solve(
    mesh: &Mesh,
    plans: &mut Plans,
    guess: Vec<(usize, f64)>,
) -> Result<Solution, BemError> {
    let heights = (0..mesh.n_elements()).map(|element| mesh.height(element));
    let surface = (heights.collect(), first_residual(guess.len()));
    let mut loads = vec![0.0; mesh.n_elements()];
    for (element, load) in guess {
        loads[element] = load;
    }
    let mut contact = OnMesh::new(mesh, plans);
    let mut search = Search::new(&mut contact, surface, mesh.options.tolerance, loads);
    search.run()?;
    let [residual, depth] = [search.residual, search.depth];
    let opening = mesh.opening(&search.pressure, &search.gap);
    let loads = search.pressure.into_iter().enumerate();
    Ok(Solution {
        loads: loads.filter(|(_, load)| *load > 0.0).collect(),
        depth,
        iterations: contact.contacts,
        factorised: contact.equations.is_factorised,
        residual,
        opening,
    })
}

/// That of the first contact, of about so many elements: the gap opens with the power 3/2 of the distance from the front.
fn first_residual(n_elements: usize) -> f64 {
    let along = (n_elements as f64).sqrt().max(1.0);
    FIRST_RESIDUAL.min(PART_OF_OPENING * along.powf(-1.5))
}

struct OnMesh<'mesh> {
    mesh: &'mesh Mesh,
    equations: ContactEquations<'mesh>,
    all: Region,
    product: Product,
    contacts: usize,
}

impl<'mesh> OnMesh<'mesh> {
    fn new(mesh: &'mesh Mesh, plans: &'mesh mut Plans) -> Self {
        let all = mesh.region(0..mesh.n_elements());
        Self {
            mesh,
            product: Product::new(plans.kernel(all.shape), &all),
            equations: ContactEquations::new(mesh, plans),
            all,
            contacts: 0,
        }
    }
}

impl MovingContact for OnMesh<'_> {
    const REPEATS: bool = false;
    /// Ten times as much leads to half as many contacts more again, and a tenth longer to the last; a third as much hardly matters.
    const PARTS_OF_RESIDUAL: [f64; 2] = [0.02, 0.006];

    fn shape(&self) -> [usize; 2] {
        self.mesh.shape()
    }

    fn place(&self, element: usize) -> [usize; 2] {
        self.mesh.places(element)[0]
    }

    fn own_displacement(&self) -> f64 {
        self.mesh.influence(0, 0)
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
        self.contacts += 1;
        self.equations.take(contact, pressure, gap);
    }

    fn residual(&self) -> f64 {
        self.equations.residual()
    }

    fn solve(&mut self, mean: f64, largest: f64) {
        self.equations.solve(mean, largest);
    }

    fn give(&self, pressure: &mut [f64]) {
        for (element, load) in self.equations.contact.iter().zip(&self.equations.loads) {
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
        (
            self.contacts,
            self.contacts >= self.mesh.options.max_iterations,
        )
    }
}
