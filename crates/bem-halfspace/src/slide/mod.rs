//! Sliding from first touch, through the transition, towards the stationary state, and any other motion.
//!
//! The elements are fixed in the half space. In a step the pressure is constant, the surface moves by
//!
//! ```text
//! u(t + Δt) = history + 2 (1 − ν) α/(4π) K P,        α = Δt/η and history = u(t) on a dashpot
//! ```
//!
//! and at the end of the step the contact conditions hold. [`slide`] advances the indenter by one element per step, so
//! that its motion is exact on the grid; [`follow`] moves it by any amount, stops it and takes it back. Both are a
//! [`March`].

mod march;
mod motion;
mod slopes;
mod stationary;
mod transient;
mod until_stationary;

use indenters::{SlidingLoad, Surface};
use rheology::Material;

pub use crate::stepping::{MarchState, SlideOmission};
use crate::{BemError, ContactOptions, Footprint, Resolution};
pub use march::March;
pub use motion::{Motion, MotionRow};
pub use stationary::StationaryFriction;
pub use transient::{PressureField, SlideRow, Transient};
pub use until_stationary::{StationaryOptions, StationarySlide, slide_to_stationary};

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

impl SlideOptions {
    pub(crate) const fn resolution(&self) -> Resolution {
        Resolution {
            spacing: self.spacing,
            footprint: self.footprint,
            contact: self.contact,
        }
    }
}

/// Presses `surface` into an undeformed half space with a constant force and slides it, from first touch on.
///
/// The element in which the lowest point starts has it in its centre. Of a surface that is
/// [its own mirror image](Surface::mirrors) about y = 0, over a footprint that is so too, only the half at y ≥ 0 is
/// followed.
///
/// # Errors
/// [`BemError::InvalidParameter`] for options out of range; [`BemError::GridTooLarge`]; [`BemError::GridTooCoarse`] when
/// the contact at the end covers fewer than [`MIN_CONTACT_ELEMENTS`] elements along x or y;
/// [`BemError::ContactReachesBoundary`]; [`BemError::VerticalWall`]; [`BemError::SlopeNotResolved`] at the end; [`BemError::ContactNotConverged`];
/// [`BemError::InvalidHeight`]; [`BemError::Material`].
pub fn slide(
    surface: &(impl Surface + ?Sized),
    material: &(impl Material + ?Sized),
    load: &SlidingLoad,
    options: &SlideOptions,
) -> Result<Transient, BemError> {
    let mut march = March::sliding(surface, material, load, options)?;
    let mut rows = Vec::new();
    while let Some(row) = march.step()? {
        rows.push(SlideRow::of(&row)?);
    }
    Transient::of(&march, load, rows)
}

/// Takes `surface` through `motions` over an undeformed half space.
///
/// At time zero the lowest point is over the centre of an element at position zero.
///
/// # Errors
/// Like [`March::new`] and [`March::step`].
pub fn follow(
    surface: &(impl Surface + ?Sized),
    material: &(impl Material + ?Sized),
    motions: &[Motion],
    resolution: &Resolution,
) -> Result<Vec<MotionRow>, BemError> {
    let mut march = March::new(surface, material, motions, resolution)?;
    let mut rows = Vec::with_capacity(motions.len());
    while let Some(row) = march.step()? {
        rows.push(row);
    }
    Ok(rows)
}

/// A contact of fewer elements along x or across it has no meaningful friction.
pub const MIN_CONTACT_ELEMENTS: usize = 3;
