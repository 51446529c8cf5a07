//! Sliding from first touch, through the transition, towards the stationary state.
//!
//! The elements are fixed in the half space, and the indenter advances by one element per step, so that its motion is
//! exact on the grid. The pressure of a step is constant in time, the surface moves by
//!
//! ```text
//! u(t + Δt) = u(t) + Δt/(4πη) K P,        Δt = Δx / v
//! ```
//!
//! and at the end of the step the contact conditions hold. Inside, heights are measured in D = F_N/(4ηv) and lengths in
//! Δx, so that only ratios enter.

mod march;
mod sampled_indenter;
mod stationary;
mod transient;

use indenters::{SlidingLoad, Surface};
use rheology::Viscous;

use crate::{BemError, ContactOptions, Footprint};
use march::March;
pub use stationary::StationaryFriction;
pub use transient::{PressureField, SlideRow, Transient};

/// Resolution of a sliding simulation.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct SlideOptions {
    /// Edges of an element [Δx, Δy], \[m].
    pub spacing: [f64; 2],
    /// Where contact may occur.
    pub footprint: Footprint,
    /// How far the indenter slides, \[m].
    pub sliding_distance: f64,
    /// How exactly each step is solved.
    pub contact: ContactOptions,
}

/// Presses `surface` into an undeformed half space with a constant force and slides it, from first touch on.
///
/// The element in which the lowest point starts has it in its centre.
///
/// # Errors
/// [`BemError::InvalidParameter`] for options out of range; [`BemError::GridTooLarge`]; [`BemError::GridTooCoarse`] when
/// the contact at the end covers fewer than [`MIN_CONTACT_ELEMENTS`] elements along x or y;
/// [`BemError::ContactReachesBoundary`]; [`BemError::VerticalWall`]; [`BemError::SlopeNotResolved`] at the end; [`BemError::ContactNotConverged`];
/// [`BemError::InvalidHeight`].
pub fn slide(
    surface: &impl Surface,
    material: &Viscous,
    load: &SlidingLoad,
    options: &SlideOptions,
) -> Result<Transient, BemError> {
    let mut march = March::new(surface, material, load, options)?;
    let rows = (0..march.n_steps())
        .map(|_| march.step())
        .collect::<Result<Vec<_>, _>>()?;
    march.finish(rows)
}

/// A contact of fewer elements along x or across it has no meaningful friction.
pub const MIN_CONTACT_ELEMENTS: usize = 3;
