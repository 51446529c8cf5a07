//! What every material has: two spectra, and the moduli and compliances that follow.

use std::fmt::Debug;

use auto_impl::auto_impl;

use crate::{ComplexCompliance, ComplexModulus, CreepSpectrum, RelaxationSpectrum, RheologyError};

/// A linear viscoelastic material with a constant Poisson ratio.
///
/// Both spectra describe the same shear: s Ĝ(s) · s Ĵ(s) = 1. Ask for the spectrum once if you need many values.
#[auto_impl(&, Box, Arc)]
pub trait Material: Debug + Send + Sync {
    /// How stress relaxes at constant strain.
    fn relaxation(&self) -> RelaxationSpectrum;

    /// How strain creeps at constant stress.
    fn creep(&self) -> CreepSpectrum;

    /// Poisson ratio ν, −1 < ν ≤ 1/2; 1/2 is incompressible.
    fn poisson_ratio(&self) -> f64 {
        0.5
    }

    /// Factor 2 (1 − ν) by which the surface of a half space is more compliant than an incompressible one.
    fn half_space_factor(&self) -> f64 {
        2.0 * (1.0 - self.poisson_ratio())
    }

    /// Relaxation modulus, see [`RelaxationSpectrum::relaxation_modulus`].
    ///
    /// # Errors
    /// [`RheologyError::InvalidParameter`] when the time is not finite or below zero.
    fn relaxation_modulus(&self, time: f64) -> Result<f64, RheologyError> {
        self.relaxation().relaxation_modulus(time)
    }

    /// Creep compliance, see [`CreepSpectrum::creep_compliance`].
    ///
    /// # Errors
    /// [`RheologyError::InvalidParameter`] when the time is not finite or below zero.
    fn creep_compliance(&self, time: f64) -> Result<f64, RheologyError> {
        self.creep().creep_compliance(time)
    }

    /// Complex modulus G' + i G'' at an angular frequency ω ≥ 0 \[rad/s].
    ///
    /// # Errors
    /// [`RheologyError::InvalidParameter`] when the frequency is not finite or below zero.
    fn complex_modulus(&self, angular_frequency: f64) -> Result<ComplexModulus, RheologyError> {
        self.relaxation().complex_modulus(angular_frequency)
    }

    /// Complex compliance J' − i J'' at an angular frequency ω ≥ 0 \[rad/s].
    ///
    /// # Errors
    /// [`RheologyError::InvalidParameter`] when the frequency is not finite or below zero.
    fn complex_compliance(
        &self,
        angular_frequency: f64,
    ) -> Result<ComplexCompliance, RheologyError> {
        self.creep().complex_compliance(angular_frequency)
    }

    /// Loss tangent G''/G', infinite where G' vanishes, at an angular frequency ω ≥ 0 \[rad/s].
    ///
    /// # Errors
    /// [`RheologyError::InvalidParameter`] when the frequency is not finite or below zero.
    fn loss_tangent(&self, angular_frequency: f64) -> Result<f64, RheologyError> {
        self.relaxation().loss_tangent(angular_frequency)
    }
}
