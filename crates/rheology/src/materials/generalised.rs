//! [`Prony`], a material given by a spectrum, and [`Compressible`], which gives a material another Poisson ratio.

use crate::{CreepSpectrum, Material, RelaxationSpectrum, RheologyError};
use numerics::in_range;

/// An incompressible material whose relaxation modulus is a Prony series.
#[derive(Debug, Clone, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize))]
pub struct Prony {
    /// Relaxation spectrum in shear.
    relaxation: RelaxationSpectrum,
    /// Creep spectrum in shear.
    creep: CreepSpectrum,
}

impl Prony {
    /// Maxwell branches in parallel, with or without a lone spring and a lone dashpot.
    ///
    /// # Errors
    /// [`RheologyError`] when a compliance or a time of its creep overflows or underflows.
    pub fn new(relaxation: RelaxationSpectrum) -> Result<Self, RheologyError> {
        let creep = relaxation.to_creep()?;
        Ok(Self { relaxation, creep })
    }

    /// A Kelvin chain: Kelvin–Voigt elements in series, with or without a lone spring and a lone dashpot.
    ///
    /// # Errors
    /// [`RheologyError`] when a modulus or a time of its relaxation overflows or underflows.
    pub fn from_creep(creep: CreepSpectrum) -> Result<Self, RheologyError> {
        let relaxation = creep.to_relaxation()?;
        Ok(Self { relaxation, creep })
    }
}

impl Material for Prony {
    fn relaxation(&self) -> RelaxationSpectrum {
        self.relaxation.clone()
    }

    fn creep(&self) -> CreepSpectrum {
        self.creep.clone()
    }
}

/// A material whose Poisson ratio does not depend on time.
#[derive(Debug, Clone, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize))]
pub struct Compressible {
    /// Relaxation spectrum in shear.
    relaxation: RelaxationSpectrum,
    /// Creep spectrum in shear.
    creep: CreepSpectrum,
    /// Poisson ratio.
    poisson_ratio: f64,
}

impl Compressible {
    /// The material that behaves like `material` in shear and has the `poisson_ratio` −1 < ν ≤ 1/2.
    ///
    /// # Errors
    /// [`RheologyError::InvalidParameter`] when the ratio is outside that range.
    pub fn new(material: &dyn Material, poisson_ratio: f64) -> Result<Self, RheologyError> {
        let is_in_range = poisson_ratio > -1.0 && poisson_ratio <= 0.5;
        let allowed = "greater than -1 and at most 0.5";
        in_range("poisson_ratio", poisson_ratio, is_in_range, allowed)?;
        Ok(Self {
            relaxation: material.relaxation(),
            creep: material.creep(),
            poisson_ratio,
        })
    }
}

impl Material for Compressible {
    fn relaxation(&self) -> RelaxationSpectrum {
        self.relaxation.clone()
    }

    fn creep(&self) -> CreepSpectrum {
        self.creep.clone()
    }

    fn poisson_ratio(&self) -> f64 {
        self.poisson_ratio
    }
}
