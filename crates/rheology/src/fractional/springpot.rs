//! The springpot, a power law in time and frequency.
//!
//! ```text
//! G*(ω) = K (iω)^a    G(t) = K t^(−a)/Γ(1 − a)    J(t) = t^a/(K Γ(1 + a))    H(ln s) = K sin(π a)/π s^a
//! ```

use std::f64::consts::PI;

use super::expansion::{ContinuousSpectrum, PronyExpansion, fractional_exponent};
use crate::{ComplexModulus, RheologyError};
use numerics::{not_negative, positive};

/// A power law between spring (a = 0) and dashpot (a = 1).
#[derive(Debug, Clone, Copy, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize))]
pub struct Springpot {
    /// Coefficient K, \[Pa sᵃ].
    coefficient: f64,
    /// Exponent a.
    exponent: f64,
}

impl Springpot {
    /// The element of `coefficient` K > 0 [Pa sᵃ] and `exponent` 0.01 ≤ a ≤ 0.99.
    ///
    /// # Errors
    /// [`RheologyError::InvalidParameter`] when one of them is out of range.
    pub fn new(coefficient: f64, exponent: f64) -> Result<Self, RheologyError> {
        Ok(Self {
            coefficient: positive("coefficient", coefficient)?,
            exponent: fractional_exponent(exponent)?,
        })
    }

    /// Relaxation modulus G(t), \[Pa], at a time t ≥ 0 \[s]; infinite at t = 0.
    ///
    /// # Errors
    /// [`RheologyError::InvalidParameter`] when the time is not finite or below zero.
    pub fn relaxation_modulus(&self, time: f64) -> Result<f64, RheologyError> {
        let power = not_negative("time", time)?.powf(-self.exponent);
        Ok(self.coefficient * power / libm::tgamma(1.0 - self.exponent))
    }

    /// Creep compliance J(t), \[1/Pa], at a time t ≥ 0 \[s].
    ///
    /// # Errors
    /// [`RheologyError::InvalidParameter`] when the time is not finite or below zero.
    pub fn creep_compliance(&self, time: f64) -> Result<f64, RheologyError> {
        let power = not_negative("time", time)?.powf(self.exponent);
        Ok(power / self.coefficient / libm::tgamma(1.0 + self.exponent))
    }

    /// Complex modulus at an angular frequency ω ≥ 0 \[rad/s].
    ///
    /// # Errors
    /// [`RheologyError::InvalidParameter`] when the frequency is not finite or below zero.
    pub fn complex_modulus(&self, angular_frequency: f64) -> Result<ComplexModulus, RheologyError> {
        let omega = not_negative("angular_frequency", angular_frequency)?;
        let magnitude = self.coefficient * omega.powf(self.exponent);
        let (sine, cosine) = (0.5 * PI * self.exponent).sin_cos();
        Ok(ComplexModulus {
            storage: magnitude * cosine,
            loss: magnitude * sine,
        })
    }

    /// Loss tangent tan(π a/2), the same at every frequency.
    pub fn loss_tangent(&self) -> f64 {
        (0.5 * PI * self.exponent).tan()
    }

    /// Prony series of this element over a band [ω_min, ω_max] of angular frequencies \[rad/s].
    ///
    /// Below the band it ends in a spring, above it in a dashpot.
    ///
    /// # Errors
    /// [`RheologyError::InvalidParameter`] when the band is empty or the error outside 1e-12 to 0.1;
    /// [`RheologyError::ExpansionNotReached`] when rounding is larger than the error asked for.
    pub fn expand(
        &self,
        band: [f64; 2],
        relative_error: f64,
    ) -> Result<PronyExpansion, RheologyError> {
        let scale = self.coefficient * (PI * self.exponent).sin() / PI;
        let continuous = ContinuousSpectrum {
            log_density: &|log_rate| scale.ln() + self.exponent * log_rate,
            exact: &|omega| self.complex_modulus(omega),
            strip_half_width: f64::INFINITY,
            exponent: self.exponent,
            has_glass_modulus: false,
        };
        continuous.expand(band, relative_error)
    }
}
