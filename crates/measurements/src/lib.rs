//! Material parameters from measurements: moduli, indentation curves and friction.
//!
//! - [`moduli`] reads tables of moduli as instruments export them and shifts isotherms to a master curve.
//! - [`strain`] reads strain sweeps, the factors of the moduli of filled rubber over the strain amplitude.
//! - [`indentation`] fits a material to a force–indentation curve, with confidence intervals.
//! - [`friction`] reads tables of friction over speed and fits the parameters of any friction model.
//! - [`shear`] reads tables of the shear strength of a contact over speed and temperature.
//!
//! ```
//! use indenters::{Control, HistoryPoint, Sphere};
//! use mdr_core::{HistoryOptions, indent_along};
//! use measurements::indentation::{FitOptions, IndentationCurve, fit_indentation};
//! use rheology::{Prony, RelaxationBranch, RelaxationSpectrum};
//!
//! // A ball of 5 µm goes 0.7 µm into a gel and comes back.
//! let ball = Sphere::new(5e-6)?;
//! let branch = RelaxationBranch::new(2e3, 0.3);
//! let gel = Prony::new(RelaxationSpectrum::new(1e3, 0.0, vec![branch])?)?;
//! let time: Vec<f64> = (0..=200).map(|i| 0.01 * f64::from(i)).collect();
//! let depth: Vec<f64> = time.iter().map(|t| 1e-6 * (t.min(2.0 - t) - 0.3)).collect();
//! let history = time.iter().zip(&depth).map(|(&time, &depth)| HistoryPoint {
//!     time,
//!     control: Control::IndentationDepth(depth),
//! });
//! let history: Vec<HistoryPoint> = history.collect();
//! let pressed = indent_along(&ball, &gel, &history, &HistoryOptions::default())?;
//! let force = pressed.iter().map(|point| point.normal_force.value).collect();
//! let curve = IndentationCurve { time, depth, force };
//! let fit = fit_indentation(&ball, &curve, &FitOptions::default())?;
//! let modulus = fit.findings[0].estimate.map(|one| one.value);
//! assert!(modulus.is_some_and(|value| (value - 1e3).abs() < 1.0));
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```
#![cfg_attr(not(test), warn(unused_crate_dependencies))]

mod error;
mod finding;
pub mod friction;
pub mod indentation;
pub mod moduli;
pub mod shear;
pub mod strain;
mod table;

/// The example in the README, compiled as a doc test.
#[cfg(doctest)]
#[doc = include_str!("../README.md")]
struct ReadMe;

/// Crates whose types are arguments and results.
pub use ::{indenters, rheology};
pub use error::MeasurementError;
pub use finding::Finding;
