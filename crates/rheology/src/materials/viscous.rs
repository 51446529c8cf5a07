//! The linear viscous law of the paper.
//!
//! ```text
//! σ = 2 η dε/dt        (3)
//! ```

use crate::error::positive;
use crate::{CreepSpectrum, Material, RelaxationSpectrum, RheologyError};

/// An incompressible, linearly viscous material.
#[derive(Debug, Clone, Copy, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize))]
pub struct Viscous {
    viscosity: f64,
}

impl Viscous {
    /// A material of shear `viscosity` η > 0, [Pa s].
    ///
    /// # Errors
    /// [`RheologyError::InvalidParameter`] when the viscosity or its inverse is not finite and greater than zero.
    pub fn new(viscosity: f64) -> Result<Self, RheologyError> {
        positive("viscosity", viscosity)?;
        positive("fluidity", viscosity.recip())?;
        Ok(Self { viscosity })
    }

    /// Shear viscosity η, [Pa s].
    #[must_use]
    pub const fn viscosity(&self) -> f64 {
        self.viscosity
    }
}

impl Material for Viscous {
    /// G(t) = η δ(t).
    fn relaxation(&self) -> RelaxationSpectrum {
        RelaxationSpectrum::without_branches(0.0, self.viscosity)
    }

    /// J(t) = t/η.
    fn creep(&self) -> CreepSpectrum {
        CreepSpectrum::without_elements(0.0, self.viscosity.recip())
    }
}
