//! Stationary sliding of single bodies and profiles, solved directly in the frame of the indenter, without a march in time.
//!
//! In the frame of the indenter the stationary state is one complementarity problem
//!
//! ```text
//! gap = h + u − d ≥ 0,  P ≥ 0,  P · gap = 0,  Σ P ΔA = F_N,      u(ξ) = J₀ w(ξ) + (1/v) ∫_ξ^∞ J'((s − ξ)/v) w(s) ds
//! ```
//!
//! for the height h of the body, the displacement u of the surface, the depth d and the pressure P on elements of the area ΔA.
//! F_N is the normal force, v the sliding speed and ξ the coordinate along x. J is the creep compliance, with the instantaneous
//! value J₀. The load potential is w = (1/4π) ∬ P/r dA with the distance r.
//!
//! The kernel of u is translation-invariant and not symmetric. For a dashpot it is [`wake_influence()`]; each retardation element
//! adds an exponential sweep of the potential from ahead. Where the material flows, the surface sinks like the logarithm of time,
//! without limit. This constant is absorbed in d, which then has no meaning of its own; friction and contact do not depend on it.
//!
//! Friction is summed with the mean slope of each element. The gap is evaluated at a collocation point between the rear edge and the
//! centre of the element. Its position is proportional to the loss angle at the wave length of two elements. A dashpot needs the rear
//! edge, a spring the centre. A march in time does the same for a dashpot when the pressure of a step belongs to the motion during the
//! step.
//!
//! Theory: docs/theory/stationary-half-space.md, "One complementarity problem" and "Where the gap is evaluated".

mod body_contact;
mod body_estimate;
mod contact_equations;
mod contact_scale;
mod exponential_rule;
mod extrapolation;
mod filter;
mod gap;
mod grid_refinement;
mod line;
mod loading;
mod mesh;
mod patch_resolution;
mod plans;
mod region;
mod retarded_potential;
pub mod sensitivity;
mod sinking_depth;
mod sliding_creep;
mod solution;
mod steady_body;
mod wake_influence;
mod wake_table;
mod wiener_hopf;

use indenters::{SlidingLoad, Surface};
use numerics::{between_zero_and_one, positive};

use crate::elements::grid::MIN_COARSEST_EDGE;
pub use crate::estimate::averages::{Average, Refinement};
use crate::parallel::chunks::in_pool;
use crate::stationary::COARSE_GRID_TOLERANCE;
use crate::{BemError, Elastomer, Footprint};
use body_contact::Solution;
pub use body_estimate::{steady, steady_grid, steady_memory, steady_refined};
pub(crate) use contact_scale::depth_scale_of_surface;
pub use gap::gap;
pub use grid_refinement::RefinementOptions;
use loading::Loading;
use mesh::Mesh;
use plans::Plans;
pub use sinking_depth::SinkingDepth;
pub use solution::{SteadyEstimate, SteadySliding};
pub use steady_body::SteadyBody;
pub use wake_influence::wake_influence;

/// One grid for a stationary solution. In plane strain its values along y have no effect.
#[derive(Debug, Clone, Copy, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize))]
pub struct SteadyOptions {
    /// Edges of an element (Δx, Δy), \[m].
    pub spacing: [f64; 2],
    /// Position of the lowest point of the indenter in its element, in elements from the centre along x and y, between
    /// −1/2 and 1/2. A body that is mirror symmetric in y shares its symmetry with the grid for 0 and ±1/2 along y;
    /// then half of the problem is solved.
    pub phase: [f64; 2],
    /// Rectangle around the lowest point in which contact may occur, \[m].
    pub footprint: Footprint,
    /// Largest residual h + u − d allowed in the contact, and largest penetration outside, relative to the depth scale D.
    ///
    /// At a given depth D is the depth. Under a force D = h(a) = 2 (1 − ν) F_N J(a/v)/(4a), with the mean height h(a) at the distance
    /// a from the lowest point; on a dashpot that is F_N/(4ηv) for every body. A residual of some units in the last place of the
    /// depth is always allowed.
    pub tolerance: f64,
    /// Largest number of active sets that the search may try.
    pub max_iterations: usize,
}

impl SteadyOptions {
    /// A grid with the lowest point over the centre of an element, solved to a tolerance of 1e-9 with at most 500 active
    /// sets.
    pub const fn new(spacing: [f64; 2], footprint: Footprint) -> Self {
        Self {
            spacing,
            phase: [0.0; 2],
            footprint,
            tolerance: 1e-9,
            max_iterations: 500,
        }
    }
}

/// Solves the stationary sliding of a body on a linear viscoelastic material on one grid, under a force or at a depth. The sliding
/// distance of the load matters only for a depth on a material that flows.
///
/// The active set is found by block principal pivoting (Júdice & Pires 1994, Comput. Oper. Res. 21, 587), with single pivots as the
/// safeguard against cycles. Small contacts are solved directly. Large ones are solved by GCR with transforms and the Wiener–Hopf
/// factors of the kernel as preconditioner, and start from the contact on a coarser grid.
///
/// # Errors
/// [`BemError::InvalidParameter`] for options out of range, or a body that can touch nowhere in the footprint;
/// [`BemError::SlidingDistanceMissing`]; [`BemError::GridTooLarge`]; [`BemError::GridTooCoarse`]; [`BemError::VerticalWall`];
/// [`BemError::SlopeNotResolved`]; [`BemError::ContactReachesBoundary`]; [`BemError::ContactNotConverged`];
/// [`BemError::SingularContact`]; [`BemError::Material`];
/// [`BemError::Indenter`] for heights that are NaN or −∞.
pub fn steady_on_grid<'a>(
    body: impl Into<SteadyBody<'a>>,
    elastomer: &dyn Elastomer,
    load: &SlidingLoad,
    options: &SteadyOptions,
) -> Result<SteadySliding, BemError> {
    let (surface, loading, grid) = body.into().on_grid(elastomer, load, options)?;
    solve(&surface, &loading, &grid, &mut Reuse::default())
}

/// Data that one solution passes on to the next.
#[derive(Debug, Default)]
struct Reuse {
    /// The solution whose loads are the initial guess.
    solution: Option<SteadySliding>,
    /// Kernel tables and spectra.
    plans: Plans,
}

/// Solves on one grid and converts the solution to SI units.
fn solve(
    surface: &dyn Surface,
    loading: &Loading,
    options: &SteadyOptions,
    reuse: &mut Reuse,
) -> Result<SteadySliding, BemError> {
    let (mesh, solution) = solve_on_mesh(surface, loading, options, reuse)?;
    SteadySliding::new(&mesh, &solution)
}

/// Solves on one grid, from the solution in `reuse` or else from that on a coarser grid.
fn solve_on_mesh(
    surface: &dyn Surface,
    loading: &Loading,
    options: &SteadyOptions,
    reuse: &mut Reuse,
) -> Result<(Mesh, Solution), BemError> {
    positive("max_iterations", options.max_iterations as f64)?;
    between_zero_and_one("tolerance", options.tolerance)?;
    let mesh = Mesh::new(surface, loading, options, &mut reuse.plans)?;

    // A large mesh starts from the solution on elements of twice the edges (nested iteration). This ends at the latest with an
    // element as long as the footprint.
    let coarse = SteadyOptions {
        spacing: loading.scaled(options.spacing, 2.0),
        tolerance: options.tolerance.max(COARSE_GRID_TOLERANCE),
        ..*options
    };
    let [rear, front] = options.footprint.x;
    let is_large = mesh.n_elements() > MIN_COARSEST_EDGE * MIN_COARSEST_EDGE;
    if reuse.solution.is_none() && is_large && coarse.spacing[0] < front - rear {
        // Only the kernel of a dashpot is the same on both grids, so that its tables are shared.
        let mut separate = Reuse::default();
        let coarse_reuse = if loading.creep.only_flows() {
            &mut *reuse
        } else {
            &mut separate
        };
        // If the coarse grid has no solution, the fine one starts from the initial active set of its mesh.
        reuse.solution = solve(surface, loading, &coarse, coarse_reuse).ok();
    }

    // Start from the loads of the last solution, or else from the initial active set of the mesh.
    let guess = match &reuse.solution {
        Some(solution) => prolonged_loads(solution, &mesh),
        None => mesh.initial_active_set(),
    };
    let plans = &mut reuse.plans;
    let solution = in_pool(mesh.n_elements(), || {
        body_contact::solve(&mesh, plans, guess)
    })?;
    Ok((mesh, solution))
}

/// The loads of a solution on another grid, sampled at the elements of this mesh; only loaded elements.
fn prolonged_loads(solution: &SteadySliding, mesh: &Mesh) -> Vec<(usize, f64)> {
    let unit = mesh.loading.pressure_unit();
    let load = |element| {
        (
            element,
            solution.pressure.pressure_at(mesh.position(element)) / unit,
        )
    };
    let loads = (0..mesh.n_elements()).map(load);
    loads.filter(|(_, load)| *load > 0.0).collect()
}
