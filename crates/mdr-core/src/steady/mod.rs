//! Stationary sliding on any linear viscoelastic foundation, solved directly: no time, no mesh in the material.
//!
//! In the frame of the line time runs along it from the front to the rear. An element comes into contact in front and is
//! compressed by u = d − h̃. It is released where its load would become tensile, and comes into contact again where the line
//! meets the recovering surface.
//!
//! ```text
//! w = G_∞ u + η₀ du/dt + Σ e_i,   τ_i de_i/dt + e_i = τ_i G_i du/dt        in contact, d/dt = −v d/dx
//! F_N = 4 ∫ w dx,   F_h = 4 ∫ w h̃' dx
//! ```
//! w is the load of an element, a quarter of the force per length; d is the depth, h̃ the height of the line, and v the speed.
//! Branch i has the stress e_i, the relaxation time τ_i and the modulus G_i. G_∞ is the equilibrium modulus, and η₀ the lone
//! dashpot.
//!
//! The line is a sequence of polynomials, and between two events everything is integrated in closed form: boundary layers
//! of the width v τ_i need no mesh. F_h is summed as the energy that the dashpots and the release dissipate.
//! These terms do not cancel, so that small friction keeps its digits.
//!
//! Theory: docs/theory/line-viscoelastic.md.

mod depth;
mod problem;
mod sweep;
mod track;

use indenters::{RigidLine, SlidingLoad};
use numerics::{Estimate, between_zero_and_one};
use rheology::Material;

use crate::MdrError;
pub(crate) use problem::{LineProblem, SteadyContact};

/// The contact of a rigid line that slides, in the stationary state, or is pressed.
#[derive(Debug, Clone, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize))]
#[must_use]
#[non_exhaustive]
pub struct SteadySliding {
    /// Friction coefficient μ = F_h/F_N; 0 where nothing slides.
    pub friction_coefficient: Estimate,
    /// Indentation depth d of the lowest point, \[m]; exact where it is prescribed.
    pub indentation_depth: Estimate,
    /// Normal force F_N, \[N]; exact where it is prescribed.
    pub normal_force: Estimate,
    /// Rear and front end of the contact, \[m].
    pub ends: [Estimate; 2],
    /// Contact intervals `[rear, front]` by increasing position on the line, \[m]; between them there is a gap.
    pub contacts: Vec<[f64; 2]>,
    /// Number of polynomials of the line.
    pub n_pieces: usize,
    /// Positions \[m] from the rear to the front, and the load per length there \[N/m], linear in between.
    pub load: Vec<[f64; 2]>,
}

/// Slides a line over a foundation, in the stationary state, until the error of the friction coefficient relative to its
/// value is at most `relative_error`, above 0 and below 1.
///
/// On a [track](SlidingLoad::on_track) the surface ahead of the line is that left by the pass before.
///
/// ```
/// use mdr_core::indenters::{EquivalentLine, SlidingLoad, Sphere};
/// use mdr_core::rheology::{StandardSolid, StandardSolidParameters};
/// use mdr_core::steady;
///
/// let rubber = StandardSolid::new(StandardSolidParameters {
///     equilibrium_modulus: 1e6,
///     maxwell_modulus: 1e7,
///     viscosity: 1e5,
/// })?;
/// let (ball, load) = (Sphere::new(5e-3)?, SlidingLoad::new(1.0, 0.1)?);
/// let line = EquivalentLine(&ball);
/// // Within a retardation time the body comes back four times.
/// let [once, again] = [
///     steady(&line, &rubber, &load, 1e-6)?,
///     steady(&line, &rubber, &load.on_track(2.5e-3)?, 1e-6)?,
/// ];
/// assert!(again.friction_coefficient.value < once.friction_coefficient.value);
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
///
/// An elastic material has the friction coefficient 0, exactly, unless the line ends under load behind.
///
/// # Errors
/// - [`MdrError::ForceBeyondEdge`], [`MdrError::DepthBeyondEdge`] when the contact would reach the edge of the body, or the
///   line ends in front before it carries the force (Remark 4).
/// - [`MdrError::FrictionDiverges`] for a line with p ≤ 1/2 or an upward jump of the slope on a material with a
///   parallel dashpot (16).
/// - [`MdrError::NotConverged`] when the estimated error stays above the one asked for.
/// - [`MdrError::Indenter`] for a load that ends after a distance; see [`slide`](crate::slide()).
/// - On a track [`MdrError::NoCycle`] for a material that flows, [`MdrError::TrackTooShort`] where the track is not longer than
///   the line is below the surface, and [`MdrError::NotPeriodic`].
/// - [`MdrError::NotRising`], [`MdrError::TooMuchDetail`], [`MdrError::InvalidHeight`],
///   [`MdrError::InvalidParameter`], [`MdrError::NonFinite`].
pub fn steady(
    line: &dyn RigidLine,
    material: &dyn Material,
    load: &SlidingLoad,
    relative_error: f64,
) -> Result<SteadySliding, MdrError> {
    let relative_error = between_zero_and_one("relative_error", relative_error)?;
    let control = load.require_stationary()?;
    if load.track().is_some() && material.creep().fluidity() > 0.0 {
        return Err(MdrError::NoCycle);
    }
    let mut problem = LineProblem::new(line, material, load.velocity())?;
    problem.track = load.track();
    problem.check_kinks(control)?;
    problem.refine(control, relative_error, "friction coefficient", |state| {
        state.friction_coefficient
    })
}
