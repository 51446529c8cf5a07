//! Sliding of wavy lines and surfaces in full contact with a foundation or a half space.
//!
//! ```text
//! h̃ = g cos(k x)       q = 4 [G_∞ d + Re(G*(k v) g e^(i k x))]
//! F_h per length = 2 k g² G''(k v),    full contact while G_∞ d ≥ |G*(k v)| g,    μ = (k g/2) sin δ at that limit
//! ```
//! with the mean depth d. On the half space, for ν = 1/2, and with the same friction coefficient of one wave at its limit:
//!
//! ```text
//! h = Σ hᵢ cos(qᵢ · x + φᵢ)      pᵢ = 2 |G*(qᵢₓ v)| |qᵢ| hᵢ      τ_f = Σ G''(qᵢₓ v) qᵢₓ |qᵢ| hᵢ²
//! ```
//!
//! The pressure leads every wave by the loss angle at its own frequency, and waves of different wave vectors superpose; see
//! Persson (2001), J. Chem. Phys. 115, 3840.

use numerics::{in_range, positive};
use rheology::{ComplexModulus, Material, check_spectra};

use crate::FrictionError;
use crate::error::{out_of_range, representable};

/// A sliding sinusoidal line.
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

/// Friction and limit of full contact of a sliding wavy line.
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
pub fn wavy_sliding(line: WavyLine, material: &dyn Material) -> Result<FullContact, FrictionError> {
    check_spectra(material)?;
    let amplitude = positive("amplitude", line.amplitude)?;
    let wave_number = std::f64::consts::TAU / positive("wavelength", line.wavelength)?;
    let frequency = positive("angular frequency", wave_number * line.velocity)?;
    let modulus = complex_modulus(material, frequency)?;
    // The modulus |G*| scales the amplitude of the load.
    let dynamic_modulus = modulus.storage.hypot(modulus.loss);
    let slope = wave_number * amplitude;
    let loss = modulus.loss / material.half_space_factor();
    Ok(FullContact {
        friction_per_length: representable("friction", 2.0 * slope * amplitude * loss)?,
        least_depth: amplitude * (dynamic_modulus / material.relaxation().equilibrium_modulus()),
        largest_friction_coefficient: 0.5 * slope * (modulus.loss / dynamic_modulus),
    })
}

/// Complex modulus at an angular frequency \[rad/s], or the error that the frequency is out of range.
fn complex_modulus(
    material: &dyn Material,
    frequency: f64,
) -> Result<ComplexModulus, FrictionError> {
    let modulus = material.relaxation().complex_modulus(frequency);
    modulus.map_err(|_| out_of_range("angular frequency", frequency))
}

/// One wave hᵢ cos(qᵢ · x + φᵢ) of a surface; the friction does not depend on its phase.
#[derive(Debug, Clone, Copy, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize))]
pub struct SurfaceWave {
    /// Amplitude h, \[m].
    pub amplitude: f64,
    /// Wave vector q along and across the sliding direction, \[1/m].
    pub wave_vector: [f64; 2],
}

/// Friction of a wavy surface in full contact, and the pressure at which contact is full.
#[derive(Debug, Clone, Copy, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize))]
#[must_use]
pub struct WavySliding {
    /// Friction force per area, \[Pa]; it does not depend on the pressure.
    pub friction_stress: f64,
    /// Mean pressure from which on contact is full for all phases, \[Pa]: the sum of the pressure amplitudes of all waves. For
    /// a single wave it is the smallest pressure of full contact.
    pub full_contact_pressure: f64,
    /// Friction coefficient under that pressure.
    pub friction_coefficient: f64,
}

/// Friction of a wavy surface in full contact, from the complex moduli at the angular frequencies of its waves.
///
/// # Errors
/// [`FrictionError::InvalidParameter`] when an amplitude, the length of a wave vector or the velocity is not finite and
/// greater than zero, when there is no wave, or when two have the same or opposite wave vectors (they are one wave);
/// [`FrictionError::OutOfRange`] when a frequency, a pressure or the friction overflows or underflows, as on an elastic
/// material.
pub fn wavy_surface_sliding(
    waves: &[SurfaceWave],
    material: &dyn Material,
    velocity: f64,
) -> Result<WavySliding, FrictionError> {
    // Check the waves and the speed.
    positive("number of waves", waves.len() as f64)?;
    positive("velocity", velocity)?;
    check_spectra(material)?;
    refuse_repeated(waves)?;
    // Sum the friction and the pressure amplitudes of all waves.
    let [mut stress, mut pressure] = [0.0; 2];
    for wave in waves {
        let amplitude = positive("amplitude", wave.amplitude)?;
        let [along, across] = wave.wave_vector;
        let wave_number = positive("length of a wave vector", along.hypot(across))?;
        let modulus = complex_modulus(material, along.abs() * velocity)?;
        let pressure_slope = wave_number * amplitude / material.half_space_factor();
        stress += modulus.loss * pressure_slope * (along.abs() * amplitude);
        pressure += 2.0 * modulus.storage.hypot(modulus.loss) * pressure_slope;
    }
    let friction_stress = representable("friction", stress)?;
    let full_contact_pressure = representable("pressure", pressure)?;
    Ok(WavySliding {
        friction_stress,
        full_contact_pressure,
        friction_coefficient: friction_stress / full_contact_pressure,
    })
}

/// Refuses two waves with the same or opposite vectors, which interfere.
fn refuse_repeated(waves: &[SurfaceWave]) -> Result<(), FrictionError> {
    // `canonical` reverses a wave vector into one half plane, and returns it as bits that can be compared.
    let canonical = |wave: &SurfaceWave| {
        let [along, across] = wave.wave_vector;
        let is_reversed = along < 0.0 || along == 0.0 && across < 0.0;
        let sign = if is_reversed { -1.0 } else { 1.0 };
        // Adding 0 turns −0 into 0, whose bits are different.
        [along, across].map(|part| (sign * part + 0.0).to_bits())
    };
    let mut seen = std::collections::BTreeSet::new();
    for wave in waves {
        let allowed = "different from that of every other wave, and not its opposite: such waves add up to one";
        let (along_x, is_new) = (wave.wave_vector[0], seen.insert(canonical(wave)));
        in_range("wave vector", along_x, is_new, allowed)?;
    }
    Ok(())
}
