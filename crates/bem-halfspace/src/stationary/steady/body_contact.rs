//! The contact of a body on one mesh.
//!
//! Theory: docs/theory/stationary-half-space.md, "The equations of one contact".

use crate::BemError;
use crate::elements::bounds::Bounds;
use crate::elements::contact_boundary::{
    BoundaryField, LINE_SECOND_DIFFERENCE, root_load_gap_ratios,
};
use crate::error::check_contact_elements;
use crate::influence;
use crate::stationary::search::Search;
use crate::stationary::steady::contact_equations::ContactEquations;
use crate::stationary::steady::mesh::Mesh;
use crate::stationary::steady::plans::Plans;

/// Largest allowed ratio of the RMS residual on an active set to the increase of the gap along one element at the front. Chosen;
/// from 1e-5 to 1e-2 no answer changes by more than 4 % of its bar (case of `evidence tuning`).
const INNER_TOLERANCE_OVER_OPENING: f64 = 1e-3;

/// Mean excess of the area of bodies, in elements, per edge along the boundary. Measured under an elastic paraboloid and an elastic cone,
/// both with this limit, on elements half as wide as long; 0.133 on square elements (case of `evidence tuning`).
const BODY_EXCESS_PER_EDGE: f64 = 0.1445;
/// Increase of the excess per shift of the collocation points, which is the loss angle over π at the shortest wave of the grid. Measured
/// under a paraboloid on power laws with the exponents 0.15 to 0.7, where it is 0.07 to 0.11 (case of `evidence tuning`).
const CREEP_EXCESS: f64 = 0.09;
/// Excess of the width of a strip at each end, in elements. Derived: (1/π) ∫ ln[ξ S(ξ)/2]/ξ² dξ from 0 to ∞ with the symbol S of a line of
/// elements (Wiener–Hopf), see docs/theory/stationary-half-space.md, "The contact area".
const STRIP_EXCESS_PER_EDGE: f64 = 0.1746;

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
    /// Contact area with a boundary that divides elements, in elements.
    pub(super) contact_area: f64,
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
    let contact_area = contact_area(mesh, &search.pressure, &search.gap);
    let loads = search.pressure.into_iter().enumerate();
    Ok(Solution {
        loads: loads.filter(|(_, load)| *load > 0.0).collect(),
        depth,
        iterations: contact.n_active_sets,
        solved_directly: contact.solved_directly,
        residual,
        gap_difference,
        contact_area,
    })
}

/// Contact area in elements, from loads and gaps of all candidates.
fn contact_area(mesh: &Mesh, loads: &[f64], gaps: &[f64]) -> f64 {
    // The box of the contact has a margin of one element, except across a strip.
    let touching = (0..loads.len()).filter(|element| loads[*element] > 0.0);
    let Some(contact) = Bounds::enclosing(touching.flat_map(|element| mesh.indices(element)))
    else {
        return 0.0;
    };
    let (is_strip, edges) = (mesh.loading.is_strip, [1.0, mesh.aspect()]);
    let margin = [1, usize::from(!is_strip)];
    let bounds = Bounds {
        lower: [0, 1].map(|axis| contact.lower[axis].saturating_sub(margin[axis])),
        upper: [0, 1].map(|axis| contact.upper[axis] + margin[axis]),
    };
    // Loads inside and gaps outside determine where the boundary divides an element.
    let mut field = BoundaryField {
        shape: bounds.shape(),
        is_periodic: false,
        aspect: edges[1],
        inside: vec![false; bounds.n_elements()],
        values: vec![f64::NAN; bounds.n_elements()],
        second_difference: [0, 1].map(|axis| mesh.kernel_second_difference(axis)),
        unit_depth_response: None,
    };
    for (element, (load, gap)) in loads.iter().zip(gaps).enumerate() {
        let is_loaded = *load > 0.0;
        for indices in mesh.indices(element) {
            if bounds.contains(indices) {
                let index = bounds.index_of(indices);
                field.inside[index] = is_loaded;
                field.values[index] = if is_loaded { *load } else { *gap };
            }
        }
    }

    // A material changes the second differences of an element and of a line by about the same factor.
    let elastic_ratios = root_load_gap_ratios(edges);
    let ratios = [0, 1].map(|axis| {
        let elastic_difference = if is_strip {
            LINE_SECOND_DIFFERENCE * edges[axis]
        } else {
            let mut next = [0.0; 2];
            next[axis] = edges[axis];
            influence([0.0; 2], edges) - influence(next, edges)
        };
        elastic_ratios[axis] * elastic_difference / field.second_difference[axis]
    });
    // The mean excess of the polygon per edge grows with the shift of the collocation points.
    let elastic_excess = if is_strip {
        STRIP_EXCESS_PER_EDGE
    } else {
        BODY_EXCESS_PER_EDGE
    };
    let excess = elastic_excess + CREEP_EXCESS * mesh.loading.creep.collocation_shift.abs();
    field.polygon_area(ratios).corrected(excess)
}

/// Loosest RMS residual on active sets of about `n_elements` elements, in units of the depth scale. Over one element at the front
/// the gap opens like the power 3/2 of the ratio of its length to the contact length.
fn inner_tolerance(n_elements: usize) -> f64 {
    let along = (n_elements as f64).sqrt().max(1.0);
    INNER_TOLERANCE_OVER_OPENING * along.powf(-1.5)
}
