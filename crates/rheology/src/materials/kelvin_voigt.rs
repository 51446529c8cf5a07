//! The Kelvin–Voigt solid: a spring and a dashpot in parallel.

use crate::error::positive;
use crate::{CreepSpectrum, Material, RelaxationSpectrum, RetardationElement, RheologyError};

/// A spring and a dashpot in parallel, incompressible.
#[derive(Debug, Clone, Copy, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize))]
pub struct KelvinVoigt {
    shear_modulus: f64,
    viscosity: f64,
}

impl KelvinVoigt {
    /// A solid of `shear_modulus` G > 0 \[Pa] and `viscosity` η > 0 [Pa s].
    ///
    /// # Errors
    /// [`RheologyError::InvalidParameter`] when one of them, its inverse or the time η/G is not finite and greater than
    /// zero.
    pub fn new(shear_modulus: f64, viscosity: f64) -> Result<Self, RheologyError> {
        positive("shear_modulus", shear_modulus)?;
        positive("viscosity", viscosity)?;
        positive("compliance", shear_modulus.recip())?;
        positive("fluidity", viscosity.recip())?;
        positive("retardation_time", viscosity / shear_modulus)?;
        Ok(Self {
            shear_modulus,
            viscosity,
        })
    }

    /// Shear modulus G of the spring, \[Pa].
    #[must_use]
    pub const fn shear_modulus(&self) -> f64 {
        self.shear_modulus
    }

    /// Shear viscosity η of the dashpot, [Pa s].
    #[must_use]
    pub const fn viscosity(&self) -> f64 {
        self.viscosity
    }

    /// Time η/G in which the strain creeps at constant stress, \[s].
    #[must_use]
    pub fn retardation_time(&self) -> f64 {
        self.viscosity / self.shear_modulus
    }
}

impl Material for KelvinVoigt {
    /// G(t) = G + η δ(t).
    fn relaxation(&self) -> RelaxationSpectrum {
        RelaxationSpectrum::without_branches(self.shear_modulus, self.viscosity)
    }

    /// J(t) = (1 − e^(−G t/η))/G.
    fn creep(&self) -> CreepSpectrum {
        let element = RetardationElement {
            compliance: self.shear_modulus.recip(),
            retardation_time: self.retardation_time(),
        };
        CreepSpectrum::single(0.0, element)
    }
}
