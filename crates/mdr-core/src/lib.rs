//! Sliding friction by the method of dimensionality reduction: a rigid line on a chain of dashpots, simulated as in
//! Kürschner 2014, Sect. 3 and 4, or on any other linear viscoelastic [`Material`](rheology::Material).
//!
//! The modules have the names of the half-space solver's: [`contact`] is one instant, [`slide`](mod@slide) is marching
//! in time from first touch into the stationary state, [`indent`](mod@indent) is pressing without sliding,
//! [`steady`](mod@steady) is stationary sliding without time. A body of revolution enters as its equivalent line; any
//! other [`RigidLine`](indenters::RigidLine) does as well.
//!
//! The cone of Fig. 7 has the friction coefficient μ = (π/2) c₁, (21), at every speed:
//!
//! ```
//! use indenters::{EquivalentLine, PowerProfile, SlidingLoad};
//! use mdr_core::{SlideOptions, slide};
//! use rheology::Viscous;
//!
//! let cone = PowerProfile::cone(0.1)?;
//! let material = Viscous::new(1e4)?;
//! for velocity in [1e-3, 1e-1] {
//!     let load = SlidingLoad::new(1.0, velocity)?;
//!     let options = SlideOptions::with_elements(50, &cone, &material, &load)?;
//!     let state = slide(&EquivalentLine(&cone), &material, &load, &options)?.stationary;
//!
//!     let expected = std::f64::consts::FRAC_PI_2 * 0.1;
//!     assert!((state.friction_coefficient / expected - 1.0).abs() < 1e-12);
//!     let depth = 1.0 / (4.0 * 1e4 * velocity);
//!     assert!((state.indentation_depth / depth - 1.0).abs() < 1e-9);
//! }
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```
#![cfg_attr(not(test), warn(unused_crate_dependencies))]

mod chain;
mod compensated;
pub mod contact;
mod element_heights;
mod error;
pub mod indent;
mod march;
pub mod slide;
pub mod steady;

pub use contact::{Contact, Element, Instant};
pub use error::MdrError;
pub use indent::{IndentControl, IndentOptions, IndentRow, IndentStep, indent, indent_history};
pub use slide::{SlideOptions, SlideRow, Transient, slide};
pub use steady::{SlidingDepth, SteadyOptions, SteadySliding, steady, steady_at_depth};
