//! Any material with a constant Poisson ratio other than one half.

use crate::{CreepSpectrum, Material, RelaxationSpectrum, RheologyError};

/// A material whose Poisson ratio does not depend on time.
#[derive(Debug, Clone, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize))]
pub struct Compressible {
    relaxation: RelaxationSpectrum,
    creep: CreepSpectrum,
    poisson_ratio: f64,
}

impl Compressible {
    /// The material that behaves like `material` in shear and has the `poisson_ratio` −1 < ν ≤ 1/2.
    ///
    /// # Errors
    /// [`RheologyError::InvalidParameter`] when the ratio is outside that range.
    pub fn new(material: &dyn Material, poisson_ratio: f64) -> Result<Self, RheologyError> {
        if !(poisson_ratio > -1.0 && poisson_ratio <= 0.5) {
            return Err(RheologyError::InvalidParameter {
                parameter: "poisson_ratio",
                value: poisson_ratio,
                allowed: "greater than -1 and at most 0.5",
            });
        }
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
