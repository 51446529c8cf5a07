//! A wavy line pressed fully into a foundation, on which it slides.
//!
//! ```text
//! h̃ = g cos(k x)       q = 4 [G_∞ d + Re(G*(k v) g e^(i k x))]
//! F_h per length = 2 k g² G''(k v),    full contact while G_∞ d ≥ |G*(k v)| g,    μ = (k g/2) sin δ at that limit
//! ```
//! d is the mean depth. The half space in full contact has the same friction coefficient at its own limit.

use rheology::Material;

use crate::FrictionError;
use crate::error::{positive, representable};

/// A sinusoidal line in motion.
#[derive(Debug, Clone, Copy, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize))]
pub struct WavyLine {
    /// Amplitude g, \[m].
    pub amplitude: f64,
    /// Wavelength 2π/k, \[m].
    pub wavelength: f64,
    /// Sliding speed v, \[m/s].
    pub velocity: f64,
}

/// Sliding of a wavy line in full contact.
#[derive(Debug, Clone, Copy, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize))]
#[must_use]
pub struct FullContact {
    /// Friction force per length of the line, \[N/m]; it does not depend on the depth.
    pub friction_per_length: f64,
    /// Smallest mean depth of full contact, \[m]; infinite on a fluid, which carries no mean load.
    pub least_depth: f64,
    /// Friction coefficient at the smallest mean depth, the largest of full contact.
    pub largest_friction_coefficient: f64,
}

/// Friction of a wavy line in full contact, from the complex modulus at the angular frequency k v.
///
/// # Errors
/// [`FrictionError::InvalidParameter`] when a number of the line is not finite and greater than zero,
/// [`FrictionError::OutOfRange`] when the friction overflows or underflows, as on an elastic material.
pub fn wavy_sliding(
    line: WavyLine,
    material: &(impl Material + ?Sized),
) -> Result<FullContact, FrictionError> {
    let amplitude = positive("amplitude", line.amplitude)?;
    let wave_number = std::f64::consts::TAU / positive("wavelength", line.wavelength)?;
    let frequency = positive("angular frequency", wave_number * line.velocity)?;
    let relaxation = material.relaxation();
    let out_of_range = |_| FrictionError::OutOfRange {
        quantity: "angular frequency",
        value: frequency,
    };
    let modulus = relaxation
        .complex_modulus(frequency)
        .map_err(out_of_range)?;
    let size = modulus.storage.hypot(modulus.loss);
    let steepness = wave_number * amplitude;
    let loss = modulus.loss / material.half_space_factor();
    Ok(FullContact {
        friction_per_length: representable("friction", 2.0 * steepness * amplitude * loss)?,
        least_depth: amplitude * (size / relaxation.equilibrium_modulus()),
        largest_friction_coefficient: 0.5 * steepness * (modulus.loss / size),
    })
}
