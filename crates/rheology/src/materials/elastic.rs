//! The spring: stress in proportion to strain.

use crate::error::positive;
use crate::{CreepSpectrum, Material, RelaxationSpectrum, RheologyError};

/// An elastic material, incompressible.
#[derive(Debug, Clone, Copy, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize))]
pub struct Elastic {
    shear_modulus: f64,
}

impl Elastic {
    /// A material of `shear_modulus` G > 0, \[Pa].
    ///
    /// # Errors
    /// [`RheologyError::InvalidParameter`] when the modulus or its inverse is not finite and greater than zero.
    pub fn new(shear_modulus: f64) -> Result<Self, RheologyError> {
        positive("shear_modulus", shear_modulus)?;
        positive("compliance", shear_modulus.recip())?;
        Ok(Self { shear_modulus })
    }

    /// Shear modulus G, \[Pa].
    #[must_use]
    pub const fn shear_modulus(&self) -> f64 {
        self.shear_modulus
    }
}

impl Material for Elastic {
    /// G(t) = G.
    fn relaxation(&self) -> RelaxationSpectrum {
        RelaxationSpectrum::without_branches(self.shear_modulus, 0.0)
    }

    /// J(t) = 1/G.
    fn creep(&self) -> CreepSpectrum {
        CreepSpectrum::without_elements(self.shear_modulus.recip(), 0.0)
    }
}
