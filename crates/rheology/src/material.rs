//! The trait of materials: two spectra, and the moduli and compliances that follow.

use std::fmt::Debug;

use auto_impl::auto_impl;
use numerics::{InvalidParameter, in_range};

use crate::{ComplexCompliance, ComplexModulus, CreepSpectrum, RelaxationSpectrum, RheologyError};

/// A linear viscoelastic material with a constant Poisson ratio.
///
/// Both spectra describe the same shear, s Ĝ(s) · s Ĵ(s) = 1, which the solvers check by [`check_spectra`]. For many values,
/// obtain the spectrum once.
#[auto_impl(&, Box, Arc)]
pub trait Material: Debug + Send + Sync {
    /// Relaxation spectrum: the stress at constant strain.
    fn relaxation(&self) -> RelaxationSpectrum;

    /// Creep spectrum: the strain at constant stress.
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

/// Largest |G*(ω) J*(ω) − 1| with which two spectra count as those of one material. Chosen: conversions are accurate to 1e-9.
const MAX_SPECTRUM_MISMATCH: f64 = 1e-6;

/// Refuses a material whose [`relaxation`](Material::relaxation) and [`creep`](Material::creep) contradict each other.
///
/// The product of complex modulus and complex compliance must be 1 at every angular frequency. It is tested at the inverse of
/// each relaxation and retardation time, and a thousand times below and above all of them. Products that overflow are skipped.
///
/// # Errors
/// [`InvalidParameter`] with the largest deviation of the product from 1.
pub fn check_spectra(material: &(impl Material + ?Sized)) -> Result<(), InvalidParameter> {
    let (relaxation, creep) = (material.relaxation(), material.creep());
    // Collect the frequencies at which one of the spectra changes, and others far below and above.
    let branches = relaxation.branches().iter();
    let elements = creep.elements().iter();
    let times = branches
        .map(|branch| branch.relaxation_time)
        .chain(elements.map(|element| element.retardation_time));
    let mut frequencies: Vec<f64> = times.map(f64::recip).collect();
    if frequencies.is_empty() {
        frequencies.push(1.0);
    }
    let lowest = frequencies.iter().copied().fold(f64::INFINITY, f64::min);
    let highest = frequencies.iter().copied().fold(0.0, f64::max);
    frequencies.extend([1e-3 * lowest, 1e3 * highest]);
    // Find the largest deviation of the product of modulus and compliance from 1.
    let mut largest = 0.0_f64;
    for frequency in frequencies {
        let modulus = relaxation.complex_modulus(frequency);
        let compliance = creep.complex_compliance(frequency);
        let (Ok(modulus), Ok(compliance)) = (modulus, compliance) else {
            continue;
        };
        // Multiply modulus and compliance: (G' + i G'') (J' − i J'') is 1 for spectra of one material.
        let real = modulus.storage * compliance.storage + modulus.loss * compliance.loss;
        let imaginary = modulus.loss * compliance.storage - modulus.storage * compliance.loss;
        let deviation = (real - 1.0).hypot(imaginary);
        if deviation.is_finite() {
            largest = largest.max(deviation);
        }
    }
    let parameter = "largest |G*(ω) J*(ω) - 1| of relaxation() and creep()";
    let allowed = "at most 1e-6: both spectra must describe the same material (to_creep and to_relaxation make one of the other)";
    in_range(
        parameter,
        largest,
        largest <= MAX_SPECTRUM_MISMATCH,
        allowed,
    )
    .map(drop)
}
