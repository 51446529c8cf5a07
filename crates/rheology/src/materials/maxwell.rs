//! The Maxwell fluid: a spring and a dashpot in series.

use crate::error::positive;
use crate::{CreepSpectrum, Material, RelaxationBranch, RelaxationSpectrum, RheologyError};

/// A spring and a dashpot in series, incompressible.
#[derive(Debug, Clone, Copy, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize))]
pub struct Maxwell {
    shear_modulus: f64,
    viscosity: f64,
}

impl Maxwell {
    /// A fluid of `shear_modulus` G > 0 \[Pa] and `viscosity` η > 0 [Pa s].
    ///
    /// # Errors
    /// [`RheologyError::InvalidParameter`] when one of them, its inverse or the time η/G is not finite and greater than
    /// zero.
    pub fn new(shear_modulus: f64, viscosity: f64) -> Result<Self, RheologyError> {
        positive("shear_modulus", shear_modulus)?;
        positive("viscosity", viscosity)?;
        positive("compliance", shear_modulus.recip())?;
        positive("fluidity", viscosity.recip())?;
        positive("relaxation_time", viscosity / shear_modulus)?;
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

    /// Time η/G in which the stress relaxes at constant strain, \[s].
    #[must_use]
    pub fn relaxation_time(&self) -> f64 {
        self.viscosity / self.shear_modulus
    }
}

impl Material for Maxwell {
    /// G(t) = G e^(−G t/η).
    fn relaxation(&self) -> RelaxationSpectrum {
        let branch = RelaxationBranch {
            modulus: self.shear_modulus,
            relaxation_time: self.relaxation_time(),
        };
        RelaxationSpectrum::single(0.0, branch)
    }

    /// J(t) = 1/G + t/η.
    fn creep(&self) -> CreepSpectrum {
        CreepSpectrum::without_elements(self.shear_modulus.recip(), self.viscosity.recip())
    }
}
