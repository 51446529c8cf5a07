//! Stationary sliding, solved directly: no time, no free surface, no window.
//!
//! In the frame of the indenter the stationary state is one complementarity problem
//!
//! ```text
//! gap = h + u − d ≥ 0,  P ≥ 0,  P · gap = 0,  Σ P ΔA = F_N,      u(ξ) = J₀ w(ξ) + (1/v) ∫_ξ^∞ J'((s − ξ)/v) w(s) ds
//! ```
//!
//! with the load potential w = (1/4π) ∬ P/r dA, whose kernel is translation-invariant and not symmetric. For a dashpot
//! it is [`wake_influence`]; each retardation element adds an exponential sweep of the potential from ahead. Where the
//! material flows, the surface sinks like ln t, for ever; this constant is absorbed in d, which then has no meaning of
//! its own; friction and contact do not depend on it.
//!
//! Friction is summed with the mean slope of each element. The gap is evaluated between the rear edge, where a dashpot
//! needs it (a march in time does the same when the pressure of a step belongs to the motion during the step), and the
//! centre, where a spring needs it, in proportion to the loss angle at the wave length of two elements.

mod contact_scale;
mod contact_system;
mod depth;
mod estimate;
mod exponential_rule;
mod extrapolation;
mod filter;
mod kernel;
mod krylov;
mod line;
mod loading;
mod mesh;
mod neighbourhood;
mod omission;
mod pivoting;
mod plans;
mod product;
mod region;
mod retarded_potential;
mod sliding_creep;
mod solution;
mod wake_table;
mod wiener_hopf;

use indenters::{SlidingLoad, Surface};
use rheology::Material;

use crate::chunks::in_pool;
use crate::error::{below_one, positive};
use crate::{BemError, Footprint};
pub(crate) use contact_scale::depth_scale_of_body;
pub use depth::SinkingDepth;
pub use estimate::{
    FrictionEstimate, FrictionOptions, Ladder, Refinement, steady_friction,
    steady_friction_at_depth, steady_friction_of_surface,
};
pub use kernel::wake_influence;
pub use line::{
    LineFriction, LineLadder, LineOptions, LineSliding, steady_line, steady_line_friction,
};
pub use loading::DepthControl;
use loading::Loading;
use mesh::Mesh;
pub use omission::SteadyOmission;
use pivoting::Start;
use plans::Plans;
pub use solution::SteadySliding;

/// Meshes of more elements than this start from the solution on a coarser one.
const NESTED: usize = 500;
/// Spacing of the grid to start from.
const COARSER: f64 = 2.0;
/// Tolerance of a solution that is only a start.
const COARSE_TOLERANCE: f64 = 1e-6;

/// Resolution of a stationary solution.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct SteadyOptions {
    /// Edges of an element (Δx, Δy), \[m].
    pub spacing: [f64; 2],
    /// Where in its element the lowest point of the indenter lies, in elements from its centre along x and y, between
    /// −1/2 and 1/2. A body that is mirror symmetric in y shares its symmetry with the grid for 0 and ±1/2 along y;
    /// then half of it is solved.
    pub phase: [f64; 2],
    /// Where contact may occur.
    pub footprint: Footprint,
    /// Largest |gap| allowed in the contact, and largest penetration outside, relative to the depth scale D. That is
    /// F_N/(4ηv) on a dashpot, and the solution of D = h(a) = 2 (1 − ν) F_N J(a/v)/(4a) on any material, with the mean
    /// height h(a) at the distance a from the lowest point.
    pub tolerance: f64,
    /// Changes of the contact set after which the solver gives up.
    pub max_iterations: usize,
}

/// Solves the stationary sliding of `surface` on a linear viscoelastic material under a force on one grid.
///
/// The contact set is found by block principal pivoting (Júdice & Pires 1994, Comput. Oper. Res. 21, 587); single pivots
/// end what would cycle. Small contacts are factorised; large ones are solved by minimal residuals with transforms, with
/// the Wiener–Hopf factors of the kernel as preconditioner, and start from the contact of a coarser grid.
///
/// # Errors
/// [`BemError::InvalidParameter`] for options out of range, or a body that can touch nowhere in the footprint;
/// [`BemError::GridTooLarge`]; [`BemError::GridTooCoarse`]; [`BemError::VerticalWall`]; [`BemError::SlopeNotResolved`];
/// [`BemError::ContactReachesBoundary`]; [`BemError::ContactNotConverged`]; [`BemError::InvalidHeight`];
/// [`BemError::Material`].
pub fn steady(
    surface: &impl Surface,
    material: &(impl Material + ?Sized),
    load: &SlidingLoad,
    options: &SteadyOptions,
) -> Result<SteadySliding, BemError> {
    let loading = Loading::force(surface, (material, load), &options.footprint)?;
    solve(surface, &loading, (options, None), &mut Reuse::default())
}

/// Like [`steady`], but does the work of one `omission` too: the answer is the same up to the tolerance, and costs more.
///
/// # Errors
/// As for [`steady`].
pub fn steady_without_omission(
    surface: &impl Surface,
    material: &(impl Material + ?Sized),
    load: &SlidingLoad,
    options: &SteadyOptions,
    omission: SteadyOmission,
) -> Result<SteadySliding, BemError> {
    let loading = Loading::force(surface, (material, load), &options.footprint)?;
    let work = (options, Some(omission));
    solve(surface, &loading, work, &mut Reuse::default())
}

/// Solves the stationary sliding of `surface` at a depth on one grid; the normal force is part of the answer.
///
/// # Errors
/// As for [`steady`], and [`BemError::InvalidParameter`] for a depth, a speed or a sliding distance out of range.
pub fn steady_at_depth(
    surface: &impl Surface,
    material: &(impl Material + ?Sized),
    control: &DepthControl,
    options: &SteadyOptions,
) -> Result<SteadySliding, BemError> {
    let [rear, front] = options.footprint.x;
    let loading = Loading::depth(material, control, front - rear)?;
    solve(surface, &loading, (options, None), &mut Reuse::default())
}

/// Like [`steady_at_depth`], but does the work of one `omission` too.
///
/// # Errors
/// As for [`steady_at_depth`].
pub fn steady_at_depth_without_omission(
    surface: &impl Surface,
    material: &(impl Material + ?Sized),
    control: &DepthControl,
    options: &SteadyOptions,
    omission: SteadyOmission,
) -> Result<SteadySliding, BemError> {
    let [rear, front] = options.footprint.x;
    let loading = Loading::depth(material, control, front - rear)?;
    let work = (options, Some(omission));
    solve(surface, &loading, work, &mut Reuse::default())
}

/// The depth scale D of [`SteadyOptions::tolerance`] for a `surface` that ends at `extent`: how deep the load presses it,
/// about, \[m].
///
/// # Errors
/// [`BemError::InvalidParameter`] for an extent or a scale out of range; [`BemError::Material`].
pub fn depth_scale(
    surface: &impl Surface,
    (material, load): (&(impl Material + ?Sized), &SlidingLoad),
    extent: &Footprint,
) -> Result<f64, BemError> {
    Ok(Loading::force(surface, (material, load), extent)?.depth_scale)
}

/// A resolution, and what is not left out all the same.
type Work<'a> = (&'a SteadyOptions, Option<SteadyOmission>);

/// What one solution leaves for the next.
#[derive(Debug, Default)]
struct Reuse {
    /// Its contact is the first guess.
    solution: Option<SteadySliding>,
    plans: Plans,
}

fn solve(
    surface: &impl Surface,
    loading: &Loading,
    (options, kept): Work,
    reuse: &mut Reuse,
) -> Result<SteadySliding, BemError> {
    positive("max_iterations", options.max_iterations as f64)?;
    below_one("tolerance", options.tolerance)?;
    let mesh = Mesh::new(surface, (loading, &mut reuse.plans), (options, kept))?;
    if reuse.solution.is_none() && mesh.n_elements() > NESTED && mesh.resolves_body(COARSER) {
        let coarse = coarser(options, loading);
        // Only the kernel of a dashpot is the same on both grids.
        let mut other = Reuse::default();
        let coarse_reuse = if loading.creep.only_flows() {
            &mut *reuse
        } else {
            &mut other
        };
        // Without a solution on the coarse grid the fine one starts from its own guess.
        reuse.solution = solve(surface, loading, (&coarse, kept), coarse_reuse).ok();
    }
    let start = match &reuse.solution {
        Some(other) => Start::Known(loads_of(other, &mesh)),
        None => Start::Guessed(mesh.first_guess()),
    };
    let plans = &mut reuse.plans;
    let solution = in_pool(mesh.n_elements(), || pivoting::solve(&mesh, plans, start))?;
    SteadySliding::new(&mesh, &solution)
}

/// A grid of twice the spacing, for a solution that is only a start.
fn coarser(options: &SteadyOptions, loading: &Loading) -> SteadyOptions {
    SteadyOptions {
        spacing: loading.scaled(options.spacing, COARSER),
        tolerance: options.tolerance.max(COARSE_TOLERANCE),
        ..*options
    }
}

/// The loaded elements of another solution, seen on this mesh.
fn loads_of(other: &SteadySliding, mesh: &Mesh) -> Vec<(usize, f64)> {
    let unit = mesh.loading.pressure_unit();
    (0..mesh.n_elements())
        .map(|element| (element, other.pressure.at(mesh.position(element)) / unit))
        .filter(|(_, load)| *load > 0.0)
        .collect()
}
