//! Linear viscoelastic materials for the friction of rubber.
//!
//! [`Viscous`] is the material of the theory (Kürschner 2014, ZAMM 94, Eq. 3). It approximates the middle frequency range of
//! an elastomer, the [`StandardSolid`] (Eq. 2, Fig. 1). Further materials are [`Elastic`], [`KelvinVoigt`], [`Maxwell`] and
//! [`Prony`]; [`Compressible`] adds a Poisson ratio to any of them. [`Springpot`] and [`FractionalMaxwell`] are expanded
//! into a Prony series with a stated error.
//!
//! Every [`Material`] has two exactly equivalent descriptions, its [`RelaxationSpectrum`] and its [`CreepSpectrum`]. Both
//! give moduli and compliances over time and frequency; a contact solver needs an [`ExponentialStep`] only.
//!
//! ```
//! use rheology::{Material, RheologyError, StandardSolid, StandardSolidParameters, Viscous};
//!
//! let rubber = StandardSolid::new(StandardSolidParameters {
//!     equilibrium_modulus: 1e4,
//!     maxwell_modulus: 1e7,
//!     viscosity: 1e5,
//! })?;
//! // Eq. (2) with γ = 0.001: the loss tangent is largest where Ω² = γ/(1 + γ).
//! let peak = rubber.loss_peak();
//! assert!((peak.loss_tangent - 15.803_488_531_025_35).abs() < 1e-12);
//! // Far below Ω = 1 the loss modulus is that of the dashpot alone.
//! let dashpot = Viscous::new(rubber.parameters().viscosity)?;
//! let ratio = rubber.complex_modulus(0.1)?.loss / dashpot.complex_modulus(0.1)?.loss;
//! assert!((ratio - 1.0).abs() < 1.1e-6);
//! # Ok::<(), RheologyError>(())
//! ```
#![cfg_attr(not(test), warn(unused_crate_dependencies))]

mod complex;
mod error;
#[cfg(feature = "fit")]
pub mod fit;
mod fractional;
mod layer;
mod material;
mod materials;
mod shear_strength;
mod shift;
mod spectrum;
mod step;
mod strain;
mod time_temperature;
mod window;

/// The example in the README, compiled as a doc test.
#[cfg(doctest)]
#[doc = include_str!("../README.md")]
struct ReadMe;

pub use complex::{ComplexCompliance, ComplexModulus};
pub use error::RheologyError;
pub use fractional::PronyExpansion;
pub use fractional::fractional_maxwell::{FractionalMaxwell, FractionalMaxwellParameters};
pub use fractional::springpot::Springpot;
pub use layer::{layer_deficit, layer_factor};
pub use material::{Material, check_spectra};
pub use materials::elementary::{Elastic, KelvinVoigt, Maxwell, Viscous};
pub use materials::generalised::{Compressible, Prony};
pub use materials::standard_solid::{LossPeak, StandardSolid, StandardSolidParameters};
pub use numerics::InvalidParameter;
pub use shear_strength::{
    BellParameters, BellShearStrength, ConstantShearStrength, DEFAULT_BELL_WIDTH, ShearStrength,
    ShearStrengthPoint, ShearStrengthTable,
};
pub use shift::{KELVIN_AT_ZERO_CELSIUS, Shift, ShiftLaw, VerticalLaw};
pub use spectrum::creep::{CreepSpectrum, RetardationElement};
pub use spectrum::relaxation::{RelaxationBranch, RelaxationSpectrum};
pub use spectrum::stationary::StationaryCreep;
pub use step::ExponentialStep;
pub use strain::{KrausModel, ModulusFactors, StrainDependence, StrainPoint, StrainTable};
pub use time_temperature::{ArrheniusShift, WlfShift};
pub use window::{OutsideWindow, StressBand};
