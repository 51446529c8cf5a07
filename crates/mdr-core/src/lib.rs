//! Friction and contact in the one-dimensional model (method of dimensionality reduction, MDR): a rigid line on elements
//! that do not feel each other, a chain of dashpots in Kürschner 2014, Sect. 3 and 4, and here of any linear viscoelastic
//! [`Material`](rheology::Material).
//!
//! [`steady`](steady()) is the stationary state of sliding, [`slide`](slide()) the approach to it from first touch, [`indent`](indent())
//! pressing for a time, [`press`](press()) the contact at rest, [`move_along`] any motion, to and fro too; each gives its
//! numbers with their errors.
//! [`slide_on_grid`] marches on one stated resolution. A body of revolution is given by its
//! [`EquivalentLine`](indenters::EquivalentLine), or any other [`RigidLine`](indenters::RigidLine) as it is.
//!
//! The cone of Fig. 7 has the friction coefficient μ = (π/2) c₁, (21), at every speed:
//!
//! ```
//! use mdr_core::indenters::{EquivalentLine, PowerProfile, SlidingLoad};
//! use mdr_core::rheology::Viscous;
//! use mdr_core::steady;
//!
//! let cone = PowerProfile::cone(0.1)?;
//! let material = Viscous::new(1e4)?;
//! for velocity in [1e-3, 1e-1] {
//!     let load = SlidingLoad::new(1.0, velocity)?;
//!     let state = steady(&EquivalentLine(&cone), &material, &load, 1e-8)?;
//!
//!     let expected = std::f64::consts::FRAC_PI_2 * 0.1;
//!     let friction = state.friction_coefficient;
//!     assert!((friction.value - expected).abs() <= friction.error);
//! }
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```
#![cfg_attr(not(test), warn(unused_crate_dependencies))]

mod compensated;
mod element_heights;
mod error;
mod force_balance;
mod history;
mod motion;
mod press;
mod refinement;
mod slide;
mod steady;

/// The program of that page compiles.
#[cfg(doctest)]
#[doc = include_str!("../README.md")]
struct ReadMe;

/// The crates whose types are arguments and results, so that no other dependency is needed.
pub use ::{indenters, numerics, rheology};
pub use error::MdrError;
pub use history::{
    CurvePoint, ForceDerivatives, HistoryOptions, force_derivatives, indent_along, work_along,
};
pub use motion::{elements_of_motion, move_along, move_along_memory};
pub use numerics::InvalidParameter;
pub use press::{Pressed, indent, press};
pub use slide::{SlideOptions, SlideRow, Sliding, Transient, slide, slide_memory, slide_on_grid};
pub use steady::{SteadySliding, steady};
