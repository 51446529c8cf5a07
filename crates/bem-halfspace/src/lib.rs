//! Boundary elements for rigid indenters on an elastic, viscous or viscoelastic half space, a [`Layer`] of it or a
//! [`Substrate`] of one's own.
//!
//! Rectangular elements have a constant pressure each. The displacement at their centres follows from Love's influence
//! coefficients by fast convolution; periodic surfaces are solved by trigonometric collocation. The contact conditions are solved
//! to a stated tolerance. The following functions take a surface, a material, a load and a relative error. Every quantity that
//! they return is exact or has an error bar:
//!
//! * [`press()`]: static contact, with the equilibrium modulus;
//! * [`indent()`]: a constant force or depth for a time;
//! * [`slide()`]: sliding in time from first touch;
//! * [`steady()`]: stationary sliding, solved directly, also [in plane strain](SteadyBody::Line).
//!
//! The request of a relative error may also be an [`Accuracy::Elements`], or a [`Request`] with a receiver of the [`Progress`], which
//! decides whether finer grids are begun.
//!
//! The variants on one grid are [`slide_on_grid`] and [`steady_on_grid`]. Histories of force and depth are
//! in [`mod@indent`], arbitrary motions in [`mod@slide`], single contacts on given heights in [`contact`], and the temperature under
//! moving heat sources in [`heat`].
//!
//! Theory: docs/theory/contact.md (one contact), transient-half-space.md (in time) and stationary-half-space.md.
//!
//! ```
//! use bem_halfspace::indenters::{PowerProfile, SlidingLoad};
//! use bem_halfspace::rheology::Viscous;
//! use bem_halfspace::steady;
//!
//! let (cone, fluid) = (PowerProfile::cone(0.1)?, Viscous::new(1.0e4)?);
//! let friction = steady(&cone, &fluid, &SlidingLoad::new(1.0, 0.01)?, 1e-3)?.friction_coefficient;
//! // Kürschner (2014) finds 0.55 of the friction coefficient (π/2) 0.1 of the one-dimensional model.
//! let scaling_factor = friction.value / (0.05 * std::f64::consts::PI);
//! assert!((scaling_factor - 0.55).abs() < 0.025, "s_1 = {scaling_factor}");
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```
#![cfg_attr(not(test), warn(unused_crate_dependencies))]

pub mod contact;
mod dense;
mod elements;
mod error;
mod estimate;
pub mod heat;
mod march;
mod motions;
mod parallel;
mod stationary;
mod substrate;
mod transform;

/// Periodic surfaces, rough and wavy ones: stationary sliding, pressing, sliding from rest, and any motion.
///
/// Theory: docs/theory/stationary-half-space.md, "Periodic surfaces", and transient-half-space.md, "Motions".
pub mod periodic {
    pub use crate::march::periodic::{PeriodicRow, PeriodicTransient, slide_on_grid};
    #[cfg(feature = "rough")]
    pub use crate::motions::periodic::{elements_of_motion, move_along, move_along_memory};
    pub use crate::stationary::periodic::{
        PeriodicControl, PeriodicLoad, PeriodicOptions, PeriodicSliding, steady_on_grid,
    };
    #[cfg(feature = "rough")]
    pub use crate::stationary::periodic::{
        PeriodicEstimate, edge_for_bars, elements_for_bars, fewest_elements, gap, largest_grid,
        memory, sensitivity, slide, steady, steady_on_coarse_grid,
    };
}

/// Compiles the program of README.md as a test.
#[cfg(doctest)]
#[doc = include_str!("../README.md")]
struct ReadMe;

/// Crates whose types are arguments and results of this one, re-exported so that no other dependency is needed.
pub use ::{indenters, numerics, rheology};
pub use contact::{Contact, ContactOptions, ContactProblem, ContactState, Patch, solve_contact};
pub use elements::footprint::Footprint;
pub use elements::gap_field::GapField;
pub use elements::grid::Grid;
pub use elements::resolution::GridOptions;
pub use error::BemError;
pub use estimate::bars::ContactEstimate;
pub use estimate::reached::Reached;
pub use indent::{indent_along, press};
pub use indenters::{Control, HistoryPoint, PressingLoad, SlidingLoad};
pub use motions::{indent, move_along, move_along_memory, slide};
#[doc(inline)]
pub use numerics::{Accuracy, ErrorParts, Estimate, InvalidParameter, Progress, Request};
#[cfg(feature = "rough")]
pub use periodic::PeriodicEstimate;
pub use periodic::{
    PeriodicControl, PeriodicLoad, PeriodicOptions, PeriodicRow, PeriodicSliding, PeriodicTransient,
};
pub use rheology::layer_factor;
pub use slide::{PressureField, slide_along, slide_on_grid};
pub use stationary::steady;
pub use steady::{SteadyBody, steady_on_grid};
pub use substrate::base::{Base, Elastomer, Substrate};
pub use substrate::influence::influence;
pub use substrate::layer::Layer;
pub use substrate::wave_shift::{ShiftOfWave, WaveShift};
pub use transform::convolution::{Convolution, ConvolutionWorkspace, Rows};
pub use transform::pressure_spectrum::line_spectrum;
