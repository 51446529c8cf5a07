//! Friction and contact in the one-dimensional model (method of dimensionality reduction, MDR): a rigid line on a Winkler
//! foundation, whose elements do not interact. In Kürschner 2014, Sect. 3 and 4, they are a chain of dashpots; here they are
//! of any linear viscoelastic [`Material`](rheology::Material).
//!
//! [`steady`](steady()) is the stationary state of sliding, [`slide`](slide()) the approach to it from first contact. [`indent`](indent())
//! is pressing for a time, [`indent_along`] pressing along a history, [`press`](press()) the contact at rest, and [`move_along`]
//! any motion, also reciprocating. All results have error estimates. A body of revolution is given by its
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

mod branches;
mod error;
mod history;
mod line;
mod march;
mod press;
mod steady;

/// The program of the README compiles.
#[cfg(doctest)]
#[doc = include_str!("../README.md")]
struct ReadMe;

/// The crates whose types are arguments and results, so that no other dependency is needed.
pub use ::{indenters, numerics, rheology};
pub use error::MdrError;
pub use history::{
    CurvePoint, ForceDerivatives, HistoryOptions, force_derivatives, indent_along, work_along,
};
pub use march::{
    Sliding, SlidingStep, elements_of_motion, move_along, move_along_memory, slide, slide_memory,
};
pub use numerics::InvalidParameter;
pub use press::{indent, press};
pub use steady::{SteadySliding, steady};
