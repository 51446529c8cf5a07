//! The generalised Kelvin–Voigt material.

use crate::{CreepSpectrum, Material, RelaxationSpectrum, RheologyError};

/// Kelvin–Voigt elements in series, with or without a lone spring and a lone dashpot, incompressible.
#[derive(Debug, Clone, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize))]
pub struct KelvinChain {
    creep: CreepSpectrum,
    relaxation: RelaxationSpectrum,
}

impl KelvinChain {
    /// The material that creeps like this.
    ///
    /// # Errors
    /// [`RheologyError`] when a modulus or a time of its relaxation is outside the range of `f64`.
    pub fn new(creep: CreepSpectrum) -> Result<Self, RheologyError> {
        let relaxation = creep.to_relaxation()?;
        Ok(Self { creep, relaxation })
    }
}

impl Material for KelvinChain {
    fn relaxation(&self) -> RelaxationSpectrum {
        self.relaxation.clone()
    }

    fn creep(&self) -> CreepSpectrum {
        self.creep.clone()
    }
}
