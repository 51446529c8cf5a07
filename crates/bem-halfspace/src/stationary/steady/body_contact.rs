//! The contact of a body on one mesh.
//!
//! Theory: docs/theory/stationary-half-space.md, "The equations of one contact".

use crate::BemError;
use crate::error::check_contact_elements;
use crate::stationary::search::Search;
use crate::stationary::steady::contact_equations::ContactEquations;
use crate::stationary::steady::mesh::Mesh;
use crate::stationary::steady::plans::Plans;

/// Largest allowed ratio of the RMS residual on an active set to the increase of the gap along one element at the front. Chosen;
/// from 1e-5 to 1e-2 no answer changes by more than 4 % of its bar (case of `evidence tuning`).
const INNER_TOLERANCE_OVER_OPENING: f64 = 1e-3;

/// A solved contact, in the units of the mesh.
pub(super) struct Solution {
    /// Indices of the candidates in contact with their loads, all greater than zero.
    pub(super) loads: Vec<(usize, f64)>,
    /// Indentation depth δ, in units of the depth scale.
    pub(super) depth: f64,
    /// Number of active sets.
    pub(super) iterations: usize,
    /// True if the last active set was solved directly, false if by iteration.
    pub(super) solved_directly: bool,
    /// Largest residual |h + u − d| in the contact, in units of the depth scale.
    pub(super) residual: f64,
    /// Load-weighted mean of half the difference of the gaps ahead of and behind an element, in units of the depth scale. Over the
    /// length of an element it is the slope that the gaps next to the contact add.
    pub(super) gap_difference: f64,
}

/// Solves the complementarity problem on a mesh from an initial active set, given as indices of candidates with their loads.
pub(super) fn solve(
    mesh: &Mesh,
    plans: &mut Plans,
    guess: Vec<(usize, f64)>,
) -> Result<Solution, BemError> {
    // The search starts from the loads of the guess and the heights of the body at the candidates.
    if guess.is_empty() {
        // No candidate is in the initial active set, so that the grid is too coarse for the contact: refuse it.
        check_contact_elements(0)?;
    }
    let elements = 0..mesh.n_elements();
    let heights = elements.map(|element| mesh.height(element)).collect();
    let inner_tolerance = inner_tolerance(guess.len());
    let mut loads = vec![0.0; mesh.n_elements()];
    for (element, load) in guess {
        loads[element] = load;
    }

    // Search the active set. The solution keeps only the elements that carry a load.
    let mut contact = ContactEquations::new(mesh, plans);
    let tolerance = mesh.options.tolerance;
    let mut search = Search::new(&mut contact, heights, inner_tolerance, tolerance, loads);
    search.run()?;
    // The friction from dissipation also contains the gaps next to the contact, weighted with the loads.
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

/// Loosest RMS residual on active sets of about `n_elements` elements, in units of the depth scale. Over one element at the front
/// the gap opens like the power 3/2 of the ratio of its length to the contact length.
fn inner_tolerance(n_elements: usize) -> f64 {
    let along = (n_elements as f64).sqrt().max(1.0);
    INNER_TOLERANCE_OVER_OPENING * along.powf(-1.5)
}
