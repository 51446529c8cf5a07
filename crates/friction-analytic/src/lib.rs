//! Friction of rigid bodies that slide over a viscous foundation: the theorems of Kürschner (2014, ZAMM) and related exact
//! solutions.
//!
//! - Stationary sliding: depth (12), contact line and friction coefficient (16), for [power profiles](power_sliding),
//!   their [sums](superposition_sliding), any [body of revolution](axisymmetric_sliding) and any [line](line_sliding).
//! - Towards the stationary state: the [sinking velocity](sinking_velocity) (15) and the exact [transient](transient_sliding) of cone and
//!   paraboloid from first touch.
//! - Without sliding: the [indentation after an impulse](indentation_after_impulse), exact on the half space too, with
//!   its [pressure](indentation_pressure), and the force of a [ramp of the depth](ramp_force) on any material.
//! - Other materials: cone and paraboloid on a [Kelvin–Voigt](kelvin_voigt_sliding) and a [Maxwell](maxwell_sliding)
//!   foundation, a [wavy line](wavy_sliding) in full contact on any; for any solid the friction at
//!   [low](low_speed_friction) and [high](high_speed_friction) speed, on the half space at low speed to
//!   [second order](slow_sliding()) with an error bar.
//! - In plane strain: a [cylinder](cylinder_sliding) on a three-element or Kelvin–Voigt solid (Hunter 1961).
//! - On the half space: the [function s(p)](scaling_factor) that Kürschner leaves open, as a table with error bars, and
//!   the [friction](half_space_power_friction) that follows from it; [wavy surfaces](wavy_surface_sliding) in full contact
//!   on any material.
//! - On a [layer](BondedLayer) of any thickness that is bonded to a rigid base: the elastic contact of any body of revolution,
//!   and the equivalent [profile](LayerProfile) of a Winkler foundation with the same force at all depths, on any material.
//! - On [thin layers](ThinLayer): the Winkler foundation, in plane strain [also for sliding](winkler_line_force), and the
//!   incompressible film.
//! - Rough surfaces in partial contact: Persson's theory, from a [spectrum](persson_of_spectrum) or from
//!   [waves](persson_of_waves).
//!
//! All friction is that of the one-dimensional model unless a result says otherwise. If it is infinite, the result is
//! [`FrictionError::FrictionDiverges`] with its cause.
//!
//! ```
//! use friction_analytic::power_sliding;
//! use indenters::{PowerProfile, SlidingLoad};
//! use rheology::Viscous;
//!
//! # fn main() -> Result<(), Box<dyn std::error::Error>> {
//! let elastomer = Viscous::new(50.0)?;
//! let load = SlidingLoad::new(2.0, 0.1)?;
//! // Eq. (21): the friction of a cone is π/2 times its slope, at every load and speed.
//! let cone = power_sliding(&PowerProfile::cone(0.1)?, &elastomer, &load)?;
//! assert!((cone.friction_coefficient - 0.157_079_632_679_489_66).abs() < 1e-15);
//! // Eq. (22): that of a paraboloid is 2/3 √(2 c F/(η v)).
//! let paraboloid = power_sliding(&PowerProfile::paraboloid(0.4)?, &elastomer, &load)?;
//! assert!((paraboloid.friction_coefficient - 0.377_123_616_632_825_34).abs() < 1e-15);
//! assert!((paraboloid.indentation_depth - 0.1).abs() < 1e-16);
//! # Ok(())
//! # }
//! ```
#![cfg_attr(not(test), warn(unused_crate_dependencies))]

mod axisymmetric;
mod cylinder;
mod elastic_limit;
mod error;
mod indentation;
mod layer;
mod line;
mod persson;
mod pieces;
mod power;
mod ramp;
mod scaling;
mod sinking;
mod slow_sliding;
mod slow_sliding_spectrum;
mod stationary;
mod superposition;
mod thin_layer;
mod transient;
mod viscoelastic;
mod wavy;

/// Compiles the program of README.md as a test.
#[cfg(doctest)]
#[doc = include_str!("../README.md")]
struct ReadMe;

/// Crates whose types are arguments and results, re-exported so that callers need no other dependency.
pub use ::{indenters, numerics, rheology};
pub use axisymmetric::axisymmetric_sliding;
pub use cylinder::{CylinderSliding, LineContact, cylinder_sliding};
pub use elastic_limit::{
    ElasticContact, ElasticLimitFriction, high_speed_friction, low_speed_friction,
};
pub use error::{DivergenceCause, FrictionError};
pub use indentation::{
    Indentation, cylinder_half_width_after_impulse, impulse_to_depth, indentation_after_impulse,
    indentation_pressure, power_indentation_after_impulse, power_peak_pressure,
};
pub use layer::{BondedLayer, LayerContact, LayerProfile};
pub use line::line_sliding;
pub use numerics::InvalidParameter;
pub use persson::{
    EnergyFactor, PerssonSliding, RoughLoad, SelfAffineSpectrum, persson_of_spectrum,
    persson_of_waves,
};
pub use power::power_sliding;
pub use ramp::{DepthRamp, ramp_force};
pub use scaling::{half_space_power_friction, scaling_factor};
pub use sinking::{one_sided_sinking_velocity, sinking_velocity};
pub use slow_sliding::{SlowSliding, slow_sliding};
pub use slow_sliding_spectrum::slow_sliding_spectrum;
pub use stationary::{StationarySliding, stationary_depth};
pub use superposition::superposition_sliding;
pub use thin_layer::{ThinContact, ThinLayer, winkler_line_force};
pub use transient::{
    TransientSliding, cone_depth_by_equation_15, sliding_distance_to_depth, transient_sliding,
};
pub use viscoelastic::{
    SlidingContact, ViscoelasticSliding, kelvin_voigt_sliding, maxwell_sliding,
};
pub use wavy::{
    FullContact, SurfaceWave, WavyLine, WavySliding, wavy_sliding, wavy_surface_sliding,
};
