//! The generalised Maxwell material, whose relaxation modulus is a Prony series.

use crate::{CreepSpectrum, Material, RelaxationSpectrum, RheologyError};

/// Maxwell branches in parallel, with or without a lone spring and a lone dashpot, incompressible.
#[derive(Debug, Clone, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize))]
pub struct Prony {
    relaxation: RelaxationSpectrum,
    creep: CreepSpectrum,
}

impl Prony {
    /// The material that relaxes like this.
    ///
    /// # Errors
    /// [`RheologyError`] when a compliance or a time of its creep is outside the range of `f64`.
    pub fn new(relaxation: RelaxationSpectrum) -> Result<Self, RheologyError> {
        let creep = relaxation.to_creep()?;
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
