//! Stationary sliding, solved directly: no time, no free surface, no window.
//!
//! In the frame of the indenter the stationary state is one complementarity problem
//!
//! ```text
//! gap = h + u − d ≥ 0,  P ≥ 0,  P · gap = 0,  Σ P ΔA = F_N,      u = −(1/4πηv) Σ P K
//! ```
//!
//! with the translation-invariant, non-symmetric kernel K of [`wake_influence`]. The constant of the kernel (the
//! surface sinks like ln t, for ever) is absorbed in d, which therefore has no meaning of its own; friction and contact
//! do not depend on it.
//!
//! The gap is evaluated at the rear edge of each element and friction with the element's mean slope. This is what a
//! march in time does when the pressure of a step belongs to the motion during the step.

mod estimate;
mod kernel;
mod mesh;
mod pivoting;
mod solution;

use indenters::{SlidingLoad, Surface};
use rheology::Viscous;

use crate::error::positive;
use crate::footprint::depth_scale;
use crate::{BemError, Footprint};
pub use estimate::{FrictionEstimate, FrictionOptions, Refinement, steady_friction};
pub use kernel::wake_influence;
use mesh::Mesh;
pub use solution::SteadySliding;

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
    /// Changes of the contact set after which the solver gives up.
    pub max_iterations: usize,
}

/// Solves the stationary sliding of `surface` on one grid.
///
/// The contact set is found by block principal pivoting (Júdice & Pires 1994, Comput. Oper. Res. 21, 587) with dense
/// factorisations of the elements in contact; single pivots end what would cycle.
///
/// # Errors
/// [`BemError::InvalidParameter`] for options out of range, or a body that rises nowhere in the footprint;
/// [`BemError::GridTooLarge`]; [`BemError::GridTooCoarse`]; [`BemError::VerticalWall`]; [`BemError::SlopeNotResolved`];
/// [`BemError::ContactReachesBoundary`]; [`BemError::ContactNotConverged`], whose residual is the smallest fraction of
/// elements that violated a contact condition; [`BemError::InvalidHeight`].
pub fn steady(
    surface: &impl Surface,
    material: &Viscous,
    load: &SlidingLoad,
    options: &SteadyOptions,
) -> Result<SteadySliding, BemError> {
    steady_from(None, surface, (material, load), options)
}

/// Like [`steady`], with the contact of another solution as the first guess.
fn steady_from(
    other: Option<&SteadySliding>,
    surface: &impl Surface,
    (material, load): (&Viscous, &SlidingLoad),
    options: &SteadyOptions,
) -> Result<SteadySliding, BemError> {
    let depth_scale = positive("F_N / (4 η v)", depth_scale(material, load))?;
    positive("max_iterations", options.max_iterations as f64)?;
    let mesh = Mesh::new(surface, options, depth_scale)?;
    let touches = |&element: &usize| match other {
        Some(other) => other.pressure.at(mesh.position(element)) > 0.0,
        // The sides of the contact of a paraboloid reach about this height.
        None => mesh.height(element) < 0.5,
    };
    let guess = (0..mesh.n_elements()).filter(touches).collect();
    let solution = pivoting::solve(&mesh, guess, options.max_iterations)?;
    SteadySliding::new(&mesh, &solution, load)
}
