//! Sliding from first touch to the stationary state, and any other motion on one grid.
//!
//! The elements are fixed in the half space. The pressure is constant during a step, and the contact conditions hold at its end.
//! The displacement there is
//!
//! ```text
//! u(t + Δt) = H + 2 (1 − ν) α/(4π) K P,        α = Δt/η and H = u(t) on a dashpot.
//! ```
//!
//! P is the pressure, K the operator of the influence coefficients, ν the Poisson ratio, α the compliance of the step and H the
//! displacement at its end without load. [`slide_on_grid`] advances the indenter by one element per step, so that its motion is
//! exact on the grid. [`slide_along`] moves it by any amount, stops it and takes it back. Both are a [`March`].
//!
//! Theory: docs/theory/transient-half-space.md, "Motions", "Friction" and "Finite sliding distance".

mod refined;
mod stationary_limit;
mod transient;

use indenters::{SlidingLoad, Surface};

pub use crate::elements::pressure_field::PressureField;
pub use crate::march::{March, Motion, MotionRow};
use crate::{BemError, Elastomer, GridOptions};
pub use refined::{SlideEstimate, slide, slide_memory};
pub use stationary_limit::{
    StationaryFriction, StationaryOptions, StationarySlide, slide_to_stationary,
};
pub use transient::{SlideRow, Transient};

/// Presses `surface` into an undeformed half space under a constant force or at a constant depth and slides it from first
/// touch over the sliding distance of the load, on one grid.
///
/// The lowest point starts over the centre of an element. If surface and footprint are
/// [their own mirror images](Surface::mirrors) about y = 0, only the half y ≥ 0 is followed.
///
/// # Errors
/// [`BemError::SlidingDistanceMissing`]; [`BemError::InvalidParameter`] for options out of range;
/// [`BemError::GridTooLarge`]; [`BemError::TooManySteps`]; [`BemError::GridTooCoarse`] when
/// the contact at the end covers fewer than three elements along x or y;
/// [`BemError::ContactReachesBoundary`]; [`BemError::VerticalWall`]; [`BemError::SlopeNotResolved`] at the end; [`BemError::ContactNotConverged`];
/// [`BemError::Indenter`] for heights that are NaN or −∞; [`BemError::Material`].
pub fn slide_on_grid(
    surface: &dyn Surface,
    elastomer: &dyn Elastomer,
    load: &SlidingLoad,
    options: &GridOptions,
) -> Result<Transient, BemError> {
    follow_march(
        March::sliding(surface, elastomer, load, options)?,
        load,
        &|_| (),
    )
}

/// Solves all steps of a march and collects its rows with contact; `report` receives the fraction that is done.
fn follow_march(
    mut march: March<'_>,
    load: &SlidingLoad,
    report: &dyn Fn(f64),
) -> Result<Transient, BemError> {
    let steps = march.run(report)?.into_iter();
    // Steps without contact, which occur at a given depth only, have no row.
    let rows = steps
        .filter_map(|step| SlideRow::in_contact(&step))
        .collect();
    Transient::from_march(&march, load, rows)
}

/// Moves `surface` through `motions` over an undeformed half space or layer.
///
/// At time zero the lowest point is over the centre of an element at position zero. The result has one row per step in time.
///
/// # Errors
/// Like [`March::new`] and [`March::step`].
pub fn slide_along(
    surface: &dyn Surface,
    elastomer: &dyn Elastomer,
    motions: &[Motion],
    options: &GridOptions,
) -> Result<Vec<MotionRow>, BemError> {
    March::new(surface, elastomer, motions, options)?.run(&|_| ())
}
