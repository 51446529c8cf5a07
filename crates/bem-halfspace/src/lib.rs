//! Boundary elements for rigid indenters on an elastic, viscous or viscoelastic half space, or a [`Layer`] of it.
//!
//! Rectangular elements carry a constant pressure each; the displacement at their centres follows from Love's influence
//! coefficients by fast convolution; the contact conditions are solved to a stated tolerance. A surface, a material, a load
//! and a relative error are all that these functions need, and every quantity that they return is exact or has an error bar:
//!
//! * [`press()`]: static contact, long after pressing;
//! * [`indent()`]: a constant force or depth for a time;
//! * [`slide()`]: sliding in time from first touch;
//! * [`steady()`]: stationary sliding, solved directly; [`steady_line`] in plane strain.
//!
//! The same on one grid: [`press_on_grid`], [`indent_on_grid`], [`slide_on_grid`], [`steady_on_grid`],
//! [`steady_line_on_grid`]. Histories of force and depth are in [`mod@indent`], arbitrary motions in [`mod@slide`], single
//! contacts on given heights in [`contact`].
//!
//! ```
//! use bem_halfspace::steady;
//! use indenters::{PowerProfile, SlidingLoad};
//! use rheology::Viscous;
//!
//! let (cone, fluid) = (PowerProfile::cone(0.1)?, Viscous::new(1.0e4)?);
//! let friction = steady(&cone, &fluid, &SlidingLoad::new(1.0, 0.01)?, 1e-3)?.friction_coefficient;
//! // The paper finds 0.55 of the friction (π/2) 0.1 of the one-dimensional model.
//! let scaling_factor = friction.value / (0.05 * std::f64::consts::PI);
//! assert!((scaling_factor - 0.55).abs() < 0.025, "s_1 = {scaling_factor}");
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```
#![cfg_attr(not(test), warn(unused_crate_dependencies))]

mod averages;
mod bands;
mod bars;
mod bounds;
mod chunks;
mod conjugate_residuals;
pub mod contact;
mod convolution;
mod error;
mod fast_length;
mod footprint;
mod grid;
pub mod indent;
mod influence;
mod layer;
mod mirror;
pub mod periodic;
mod plan;
mod plane_transform;
mod pressure_field;
mod pressure_spectrum;
mod reached;
mod rectangle;
mod reductions;
mod resolution;
pub mod slide;
pub mod steady;
mod stepping;

/// The program of that page compiles.
#[cfg(doctest)]
#[doc = include_str!("../README.md")]
struct ReadMe;

pub use bars::ContactEstimate;
pub use contact::{Contact, ContactOptions, ContactProblem, ContactState, solve_contact};
pub use convolution::{Convolution, ConvolutionWorkspace};
pub use error::BemError;
pub use footprint::Footprint;
pub use grid::Grid;
pub use indent::{indent, indent_on_grid, press, press_on_grid};
pub use indenters::{Control, HistoryPoint, PressingLoad, SlidingLoad};
pub use influence::influence;
pub use layer::{Elastomer, Layer, layer_factor};
pub use numerics::InvalidParameter;
#[cfg(feature = "rough")]
pub use periodic::{
    PeriodicEstimate, elements_for_bars, press_periodic, slide_periodic, steady_periodic,
    steady_periodic_at_depth,
};
pub use periodic::{
    PeriodicLoad, PeriodicOptions, PeriodicRow, PeriodicSliding, PeriodicTransient,
    slide_periodic_on_grid, steady_periodic_on_grid,
};
pub use pressure_spectrum::line_spectrum;
pub use reached::Reached;
pub use resolution::GridOptions;
pub use slide::{PressureField, slide, slide_on_grid};
pub use steady::{steady, steady_line, steady_line_on_grid, steady_on_grid};
