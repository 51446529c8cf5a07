//! Boundary elements for rigid indenters on a viscous or viscoelastic half space.
//!
//! Rectangular elements carry a constant pressure each; the displacement at their centres follows from Love's influence
//! coefficients by fast convolution; the contact conditions are solved to a stated tolerance at every step. Four
//! questions can be asked, in modules named like those of the one-dimensional solver:
//!
//! * [`contact`]: one instant, elastic or a step of a history, at given force or depth;
//! * [`indent`]: normal indentation, any history of force or depth;
//! * [`slide`]: sliding from first touch, through the transition, towards the stationary state, and any other motion;
//! * [`steady`]: stationary sliding, solved directly, with an error bar.
//!
//! The last three take any linear viscoelastic material.
//!
//! ```
//! use bem_halfspace::slide::{SlideOptions, slide};
//! use bem_halfspace::{ContactOptions, Footprint};
//! use indenters::{PowerProfile, SlidingLoad};
//! use rheology::Viscous;
//!
//! let (cone, rubber) = (PowerProfile::cone(0.1)?, Viscous::new(1.0e4)?);
//! let load = SlidingLoad::new(1.0, 0.01)?;
//! // Contact length of the one-dimensional model, Eq. (21), five elements along it, sliding over 24 of it.
//! let length = 1.0 / (2.0 * std::f64::consts::PI * 0.1 * 1.0e4 * 0.01);
//! let options = SlideOptions {
//!     spacing: [length / 5.0; 2],
//!     footprint: Footprint::of_body(&cone, &rubber, &load)?,
//!     sliding_distance: 24.0 * length,
//!     contact: ContactOptions::default(),
//! };
//! let friction = slide(&cone, &rubber, &load, &options)?.stationary(0.02)?.friction_coefficient;
//! // The paper finds 0.55 of the friction (π/2) 0.1 of the one-dimensional model.
//! let scaling_factor = friction / (0.05 * std::f64::consts::PI);
//! assert!((scaling_factor - 0.55).abs() < 0.025, "s_1 = {scaling_factor}");
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```
#![cfg_attr(not(test), warn(unused_crate_dependencies))]

mod bands;
mod bounds;
mod chunks;
pub mod contact;
mod convolution;
mod error;
mod fast_length;
mod footprint;
mod grid;
pub mod indent;
mod influence;
mod mirror;
mod plane_transform;
mod rectangle;
mod resolution;
pub mod slide;
pub mod steady;
mod stepping;

pub use contact::{Contact, ContactOptions, ContactProblem, ContactState, Control, solve_contact};
pub use convolution::{Convolution, ConvolutionWorkspace};
pub use error::BemError;
pub use footprint::Footprint;
pub use grid::Grid;
pub use influence::influence;
pub use resolution::Resolution;
