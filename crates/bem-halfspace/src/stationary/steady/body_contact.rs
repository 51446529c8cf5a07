//! One contact of a body.

use crate::BemError;
use crate::error::check_contact_elements;
use crate::stationary::search::Search;
use crate::stationary::steady::contact_equations::ContactEquations;
use crate::stationary::steady::mesh::Mesh;
use crate::stationary::steady::plans::Plans;

/// Root mean square of the residual that the solution of any contact may have: as a part of how much the gap opens over an element
/// at the front, and at most, in units of the depth scale.
const INNER_TOLERANCE_OVER_OPENING: f64 = 1e-3;
const MAX_INNER_TOLERANCE: f64 = 1e-5;

/// Loads of all elements in contact, all greater than zero, in the units of the mesh.
pub(super) struct Solution {
    pub(super) loads: Vec<(usize, f64)>,
    pub(super) depth: f64,
    pub(super) iterations: usize,
    /// Whether the equations of the last contact were solved_directly.
    pub(super) solved_directly: bool,
    /// Largest residual |h + u − d| in the contact, in units of the depth scale.
    pub(super) residual: f64,
    /// Mean under the load of what the gaps beside the contact add to the slope, in elements and units of the depth scale.
    pub(super) gap_difference: f64,
}

/// Solves the complementarity problem from a first guess of the elements in contact and their loads.
pub(super) fn solve(
    mesh: &Mesh,
    plans: &mut Plans,
    guess: Vec<(usize, f64)>,
) -> Result<Solution, BemError> {
    if guess.is_empty() {
        // No element is as low as the contact is deep.
        check_contact_elements(0)?;
    }
    let heights = (0..mesh.n_elements()).map(|element| mesh.height(element));
    let heights = heights.collect();
    let inner_tolerance = inner_tolerance(guess.len());
    let mut loads = vec![0.0; mesh.n_elements()];
    for (element, load) in guess {
        loads[element] = load;
    }
    let mut contact = ContactEquations::new(mesh, plans);
    let tolerance = mesh.options.tolerance;
    let mut search = Search::new(&mut contact, heights, inner_tolerance, tolerance, loads);
    search.run()?;
    let [residual, depth] = [search.residual, search.depth];
    let gap_difference = mesh.mean_gap_difference(&search.pressure, &search.gap);
    let loads = search.pressure.into_iter().enumerate();
    Ok(Solution {
        loads: loads.filter(|(_, load)| *load > 0.0).collect(),
        depth,
        iterations: contact.n_active_sets,
        solved_directly: contact.solved_directly,
        residual,
        gap_difference,
    })
}

/// That of contacts of about so many elements: the gap opens with the power 3/2 of the distance from the front.
fn inner_tolerance(n_elements: usize) -> f64 {
    let along = (n_elements as f64).sqrt().max(1.0);
    MAX_INNER_TOLERANCE.min(INNER_TOLERANCE_OVER_OPENING * along.powf(-1.5))
}
