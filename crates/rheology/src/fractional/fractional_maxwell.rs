//! The fractional Maxwell element: a springpot in series with a spring.
//!
//! ```text
//! G*(ω) = G z/(1 + z),  z = (iωτ)^a    G(t) = G E_a(−(t/τ)^a)
//! H(ln s) = G sin(π a)/π / (r^a + 2 cos(π a) + r^(−a)),  r = s τ
//! ```
//! with the Mittag-Leffler function E_a.

use std::f64::consts::PI;

use super::expansion::{ContinuousSpectrum, PronyExpansion, fractional_exponent};
use crate::{ComplexModulus, RheologyError};
use numerics::{not_negative, positive};

/// Parameters of a [`FractionalMaxwell`] element.
#[derive(Debug, Clone, Copy, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize))]
pub struct FractionalMaxwellParameters {
    /// Shear modulus G > 0 of the spring, \[Pa].
    pub shear_modulus: f64,
    /// Relaxation time τ > 0: spring and springpot have compliances of equal magnitude at ω = 1/τ, \[s].
    pub relaxation_time: f64,
    /// Exponent 0.01 ≤ a ≤ 0.99 of the springpot.
    pub exponent: f64,
}

/// A spring and a springpot in series; in parallel with a spring it is the fractional standard solid.
#[derive(Debug, Clone, Copy, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize))]
pub struct FractionalMaxwell {
    /// Parameters in SI units.
    parameters: FractionalMaxwellParameters,
}

impl FractionalMaxwell {
    /// The element with these parameters.
    ///
    /// # Errors
    /// [`RheologyError::InvalidParameter`] when one of them is out of range.
    pub fn new(parameters: FractionalMaxwellParameters) -> Result<Self, RheologyError> {
        positive("shear_modulus", parameters.shear_modulus)?;
        positive("relaxation_time", parameters.relaxation_time)?;
        fractional_exponent(parameters.exponent)?;
        Ok(Self { parameters })
    }

    /// Complex modulus at an angular frequency ω ≥ 0 \[rad/s].
    ///
    /// # Errors
    /// [`RheologyError::InvalidParameter`] when the frequency is not finite or below zero.
    pub fn complex_modulus(&self, angular_frequency: f64) -> Result<ComplexModulus, RheologyError> {
        let omega = not_negative("angular_frequency", angular_frequency)?;
        let given = self.parameters;
        let (sine, cosine) = (0.5 * PI * given.exponent).sin_cos();
        let magnitude = (omega * given.relaxation_time).powf(given.exponent);
        // Compute z/(1 + z) with z = (iωτ)^a for |z| ≤ 1, and the equal 1/(1 + 1/z) otherwise, so that nothing overflows. Here ω
        // is the angular frequency, τ the relaxation time and a the exponent.
        let small = magnitude.min(magnitude.recip());
        let square = 1.0 + small * (2.0 * cosine + small);
        let real = if magnitude <= 1.0 {
            small * (cosine + small)
        } else {
            1.0 + small * cosine
        };
        Ok(ComplexModulus {
            storage: given.shear_modulus * real / square,
            loss: given.shear_modulus * small * sine / square,
        })
    }

    /// Prony series of this element over a band [ω_min, ω_max] of angular frequencies \[rad/s].
    ///
    /// Below the band it ends in a spring.
    ///
    /// # Errors
    /// [`RheologyError::InvalidParameter`] when the band is empty or the error outside 1e-12 to 0.1;
    /// [`RheologyError::ExpansionNotReached`] when rounding is larger than the error asked for.
    pub fn expand(
        &self,
        band: [f64; 2],
        relative_error: f64,
    ) -> Result<PronyExpansion, RheologyError> {
        let exponent = self.parameters.exponent;
        let continuous = ContinuousSpectrum {
            log_density: &|log_rate| self.log_density(log_rate),
            exact: &|omega| self.complex_modulus(omega),
            // The half width follows from the poles of the density, which are where r^a = −e^(±iπa). Here r is the rate times the
            // relaxation time, and a the exponent.
            strip_half_width: PI * (1.0 - exponent) / exponent,
            exponent,
            has_glass_modulus: true,
        };
        continuous.expand(band, relative_error)
    }

    /// Logarithm of the spectral density H \[Pa] at the logarithm ln s of a relaxation rate \[1/s].
    fn log_density(&self, log_rate: f64) -> f64 {
        let given = self.parameters;
        // Compute r^a + r^(−a) + 2 cos(π a), with the rate r times the relaxation time and the exponent a, without cancellation
        // at r = 1, a = 1.
        let half = (0.5 * given.exponent * (log_rate + given.relaxation_time.ln())).sinh();
        let cosine = (0.5 * PI * given.exponent).cos();
        let denominator = 4.0 * (half * half + cosine * cosine);
        (given.shear_modulus * (PI * given.exponent).sin() / PI / denominator).ln()
    }
}
