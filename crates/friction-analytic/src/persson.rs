//! Persson's theory of sliding rough surfaces: real area of contact and friction from the roughness spectrum.
//!
//! ```text
//! G(q) = (1/8) ∫ d²q' q'² C |E*(q'ₓ v)/σ₀|²  over |q'| < q,      P(q) = erf(1/(2 √G)),      A/A₀ = P(q₁)
//! μ = (1/2) ∫ d²q |q| |qₓ| C S P Im E*(|qₓ| v)/σ₀,               E* = 2 G*/(1 − ν)
//! ```
//!
//! with ⟨h²⟩ = ∫ C d²q. P(q) is the area fraction with all waves up to the wave number q, and q₁ the largest one. S, a
//! polynomial in P², is the ratio of the energy of a wave in partial contact to that in full contact. In full contact P = S =
//! 1, and the friction is exact. Otherwise the theory is an approximation, whose error is not part of the error estimates here.
//! Comparison with boundary elements: docs/rough-theory.md.

use std::f64::consts::{FRAC_PI_2, TAU};

use numerics::{
    Estimate, between_zero_and_one, in_range, integrate_from_ends, not_negative, positive,
};
use rheology::{Material, RelaxationSpectrum, check_spectra};

use crate::error::representable;
use crate::{FrictionError, SurfaceWave};

/// Mean pressure and sliding speed of a rough surface.
#[derive(Debug, Clone, Copy, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize))]
pub struct RoughLoad {
    /// Mean pressure σ₀ > 0, \[Pa].
    pub mean_pressure: f64,
    /// Sliding speed v ≥ 0, \[m/s].
    pub velocity: f64,
}

/// An isotropic self-affine spectrum C(q): constant from the longest wave to the roll-off, then C ∝ q^(−2 (1 + H)).
#[derive(Debug, Clone, Copy, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize))]
pub struct SelfAffineSpectrum {
    /// Hurst exponent H, between 0 and 1.
    pub hurst_exponent: f64,
    /// Root mean square slope, that of |∇h|, > 0.
    pub rms_slope: f64,
    /// Longest wavelength, \[m].
    pub longest_wavelength: f64,
    /// Roll-off wavelength, \[m]; the longest one for a spectrum without a plateau.
    pub roll_off_wavelength: f64,
    /// Shortest wavelength, \[m].
    pub shortest_wavelength: f64,
}

/// Energy factor S = c₀ + c₁ P² + c₂ P⁴: the energy of a wave in partial contact over that in full contact.
///
/// P is the area fraction with all longer waves. The coefficients add up to 1.
#[derive(Debug, Clone, Copy, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize))]
pub struct EnergyFactor([f64; N_TERMS]);

impl EnergyFactor {
    /// S = 1, Persson (2001), J. Chem. Phys. 115, 3840.
    pub const PERSSON_2001: Self = Self([1.0, 0.0, 0.0]);
    /// S = (1 + P²)/2, Persson (2006), Surf. Sci. Rep. 61, 201.
    pub const PERSSON_2006: Self = Self([0.5, 0.5, 0.0]);
    /// S = (5 − 2 P² + 6 P⁴)/9, Wang and Müser (2017), Tribol. Lett. 65, 103.
    pub const WANG_MUSER_2017: Self = Self([5.0 / 9.0, -2.0 / 9.0, 2.0 / 3.0]);

    /// Factor S = γ + (1 − γ) P².
    ///
    /// # Errors
    /// [`FrictionError::InvalidParameter`] for a γ that is not finite.
    pub fn interpolated(gamma: f64) -> Result<Self, FrictionError> {
        let gamma = numerics::finite("gamma", gamma)?;
        Ok(Self([gamma, 1.0 - gamma, 0.0]))
    }
}

/// Area and friction of a rough surface by Persson's theory. The errors are those of the quadrature, not of the theory.
#[derive(Debug, Clone, Copy, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize))]
#[must_use]
pub struct PerssonSliding {
    /// Ratio of the real area of contact to the nominal one.
    pub area_fraction: Estimate,
    /// Variance of the pressure in full contact, divided by the square of the mean pressure: 2 G of all waves.
    pub pressure_variance: Estimate,
    /// Friction coefficients with S = 1, P² and P⁴, the terms of an [`EnergyFactor`].
    parts: [Estimate; N_TERMS],
}

impl PerssonSliding {
    /// Friction coefficient with an energy factor.
    pub fn friction_coefficient(&self, factor: EnergyFactor) -> Estimate {
        let terms = factor.0.into_iter().zip(self.parts);
        terms.map(|(weight, term)| term * weight).sum()
    }

    /// Area fraction A of Xu and others (2024), Int. J. Solids Struct. 290, 112684, in which the variance of the pressure falls
    /// with the area in contact:
    ///
    /// ```text
    /// A = erf(1/√(2 V (γ + (1 − γ) A)))
    /// ```
    ///
    /// V is the [variance](Self::pressure_variance). With γ = 1 it is Persson's area; for elastic surfaces they find γ = 0.42
    /// to 0.45.
    ///
    /// # Errors
    /// [`FrictionError::InvalidParameter`] for a γ that is not above 0 and at most 1.
    pub fn area_fraction_of_xu(&self, gamma: f64) -> Result<Estimate, FrictionError> {
        in_range(
            "gamma",
            gamma,
            gamma > 0.0 && gamma <= 1.0,
            "above 0 and at most 1",
        )?;
        let variance = self.pressure_variance.value;
        let next = |area: f64| area_fraction(variance * (gamma + (1.0 - gamma) * area));
        // The right-hand side falls with A, so that it equals A once between 0 and 1; bisection finds this A.
        let [mut below, mut above] = [0.0, 1.0];
        for _ in 0..f64::MANTISSA_DIGITS {
            let middle = 0.5 * (below + above);
            if next(middle) > middle {
                below = middle;
            } else {
                above = middle;
            }
        }
        // The relative error of A is at most half that of V, because A changes at most with the square root of V.
        let area = next(above);
        let relative_variance_error = if variance > 0.0 {
            self.pressure_variance.error / variance
        } else {
            0.0
        };
        Ok(Estimate::new(
            area,
            0.5 * area * relative_variance_error + (area - above).abs(),
        ))
    }
}

/// Persson's area and friction of a sum of waves, which may be anisotropic.
///
/// Waves of the same wavelength count with the area fraction after half of them. The sums are exact up to rounding, so that
/// their errors are 0.
///
/// # Errors
/// [`FrictionError::InvalidParameter`] without waves, for an amplitude that is not finite, a wave vector without length, and a
/// mean pressure or velocity out of range; [`FrictionError::OutOfRange`] when a frequency or a result overflows.
pub fn persson_of_waves(
    waves: &[SurfaceWave],
    material: &dyn Material,
    load: RoughLoad,
) -> Result<PerssonSliding, FrictionError> {
    positive("number of waves", waves.len() as f64)?;
    let loaded = LoadedMaterial::new(material, load)?;
    // Each wave contributes to G and to the friction; the contributions are sorted by increasing wave number.
    let mut contributions = Vec::with_capacity(waves.len());
    for wave in waves {
        let [along, across] = wave.wave_vector;
        let wave_number = positive("length of a wave vector", along.hypot(across))?;
        let amplitude = numerics::finite("amplitude", wave.amplitude)?;
        let squared_slope = (0.5 * amplitude * wave_number) * (amplitude * wave_number);
        let response = loaded.response(along.abs() / wave_number, wave_number);
        contributions.push((wave_number, response.map(|rate| squared_slope * rate)));
    }
    contributions.sort_by(|(one, _), (other, _)| one.total_cmp(other));
    // Waves of equal wave numbers form a shell, whose friction counts with half of its own contribution to G.
    let mut integrals = SpectralIntegrals::default();
    for shell in contributions.chunk_by(|(one, _), (other, _)| other - one <= EQUAL_LENGTHS * one) {
        let total = |index: usize| shell.iter().map(|(_, rates)| rates[index]).sum::<f64>();
        integrals.g += 0.5 * total(0);
        integrals.add_friction(total(1));
        integrals.g += 0.5 * total(0);
    }
    sliding_with_errors(integrals.results(), [0.0; N_RESULTS])
}

/// Persson's area and friction of a self-affine spectrum, to a relative error of the quadrature between 1e-11 and 1.
///
/// # Errors
/// [`FrictionError::InvalidParameter`] for numbers out of range; [`FrictionError::OutOfRange`] when a frequency or a result
/// overflows; [`FrictionError::NotConverged`] when the quadrature does not reach the error.
pub fn persson_of_spectrum(
    spectrum: &SelfAffineSpectrum,
    material: &dyn Material,
    load: RoughLoad,
    relative_error: f64,
) -> Result<PerssonSliding, FrictionError> {
    let is_allowed = (1e-11..1.0).contains(&relative_error);
    let allowed = "at least 1e-11 and below 1";
    in_range("relative_error", relative_error, is_allowed, allowed)?;
    // Check the spectrum and the load.
    spectrum.validate()?;
    let loaded = LoadedMaterial::new(material, load)?;
    let mut steps = MIN_STEPS;
    let mut coarse = loaded.integrate(spectrum, steps, &mut 0.0);
    loop {
        // Integrate with half the step; the change is the error, with that of the integrals over the angle.
        steps *= 2;
        let mut angular_error = 0.0;
        let fine = loaded.integrate(spectrum, steps, &mut angular_error);
        // P⁵ changes at most with the power 5/2 of G.
        let error = |index: usize| {
            (fine[index] - coarse[index]).abs() + 4.0 * angular_error * fine[index].abs()
        };
        let result = sliding_with_errors(fine, std::array::from_fn(error))?;

        // Return when all results have the requested error.
        let area_and_variance = [
            ("area fraction", result.area_fraction),
            ("variance of the pressure", result.pressure_variance),
        ];
        let frictions = result.parts.map(|term| ("friction coefficient", term));
        let is_missed = |(_, estimate): &(_, Estimate)| !estimate.is_within(relative_error);
        let mut estimates = area_and_variance.into_iter().chain(frictions);
        match estimates.find(is_missed) {
            None => return Ok(result),
            Some((quantity, missed)) if steps >= MAX_STEPS => {
                return Err(FrictionError::NotConverged {
                    quantity,
                    value: missed.value,
                    error: missed.error,
                });
            }
            Some(_) => coarse = fine,
        }
    }
}

/// Number of terms of an energy factor, S = 1, P² and P⁴, and of the friction.
const N_TERMS: usize = 3;
/// Number of results: the area fraction, the variance of the pressure, and the terms of the friction.
const N_RESULTS: usize = N_TERMS + 2;
/// Relative difference up to which the lengths of two wave vectors count as equal. Chosen: some thousand units in the last place,
/// for the rounding of their components. Waves that are really so close act as one shell, which changes the friction by as
/// little.
const EQUAL_LENGTHS: f64 = 1e-12;
/// Number of steps of Simpson's rule on each of the two ranges below and above the roll-off, on the coarsest grid. Chosen: they
/// are doubled until the requested error is reached, so that fewer steps take one more doubling.
const MIN_STEPS: usize = 16;
/// Number of steps of Simpson's rule on each of the two ranges from which on they are not doubled. Chosen to limit the computing
/// time: a larger error than asked for is then [`FrictionError::NotConverged`].
const MAX_STEPS: usize = 1 << 14;
/// Requested relative error of the integrals over the angle. Chosen: 450 units in the last place, which the integrands allow. The
/// error that is reached is part of the error bar.
const ANGULAR_TOLERANCE: f64 = 1e-13;

impl SelfAffineSpectrum {
    /// Refuses an exponent, a slope or wavelengths that are no spectrum.
    fn validate(&self) -> Result<(), FrictionError> {
        between_zero_and_one("hurst_exponent", self.hurst_exponent)?;
        positive("rms_slope", self.rms_slope)?;
        let shortest = positive("shortest_wavelength", self.shortest_wavelength)?;
        let longest = positive("longest_wavelength", self.longest_wavelength)?;
        let allowed = "longer than the shortest one";
        in_range("longest_wavelength", longest, longest > shortest, allowed)?;
        let roll_off = self.roll_off_wavelength;
        let is_allowed = (shortest..=longest).contains(&roll_off);
        let allowed = "between the shortest and the longest wave length";
        in_range("roll_off_wavelength", roll_off, is_allowed, allowed)?;
        Ok(())
    }

    /// Squared slope of the waves per logarithm of the wave number over 2π, q⁴ C(q), at the wave number q \[1/m], normalised by
    /// 2π ∫ q³ C dq = ⟨|∇h|²⟩.
    fn squared_slope_density(&self, q: f64) -> f64 {
        let waves = [self.longest_wavelength, self.shortest_wavelength];
        let [ratio_long, ratio_short] = waves.map(|wave| self.roll_off_wavelength / wave);
        let power = 2.0 - 2.0 * self.hurst_exponent;
        // `total` is the integral of the shape over ln q: the part of the plateau below the roll-off, and that of the power law
        // above it.
        let falling = (power * ratio_short.ln()).exp_m1() / power;
        let total = 0.25 * (1.0 - ratio_long.powi(4)) + falling;
        let x = q * self.roll_off_wavelength / TAU;
        let shape = x.powf(if x < 1.0 { 4.0 } else { power });
        self.rms_slope * self.rms_slope * shape / (TAU * total)
    }
}

/// A material, with the pressure and the speed at which it is loaded.
struct LoadedMaterial {
    /// Relaxation spectrum in shear.
    relaxation: RelaxationSpectrum,
    /// Ratio E*/(G* σ₀) of the modulus of the half space to the shear modulus, divided by the mean pressure, \[1/Pa].
    factor: f64,
    /// Sliding speed, \[m/s].
    velocity: f64,
}

impl LoadedMaterial {
    /// The relaxation spectrum of a material with the mean pressure and the speed of a load, which are checked.
    fn new(material: &dyn Material, load: RoughLoad) -> Result<Self, FrictionError> {
        check_spectra(material)?;
        let mean_pressure = positive("mean_pressure", load.mean_pressure)?;
        Ok(Self {
            relaxation: material.relaxation(),
            factor: 4.0 / (material.half_space_factor() * mean_pressure),
            velocity: not_negative("velocity", load.velocity)?,
        })
    }

    /// Responses |E*/σ₀|²/8 and |cos φ| Im E*/(2 σ₀) of a wave of the wave number q \[1/m] at an angle φ to the motion, with its
    /// `cosine`; NaN if the frequency overflows.
    fn response(&self, cosine: f64, q: f64) -> [f64; 2] {
        let modulus = self.relaxation.complex_modulus(q * cosine * self.velocity);
        modulus.map_or([f64::NAN; 2], |modulus| {
            let [storage, loss] = [modulus.storage, modulus.loss].map(|part| part * self.factor);
            let square = storage * storage + loss * loss;
            [0.125 * square, 0.5 * cosine * loss]
        })
    }

    /// Integrals of both responses at the wave number q \[1/m] over all angles; `max_error` is raised to their relative error.
    fn angular_integrals(&self, q: f64, max_error: &mut f64) -> [f64; 2] {
        [0, 1].map(|index| {
            let integrand = |end: f64, distance: f64| {
                // Near its zero the cosine is resolved below the rounding of the angle.
                let cosine = if end > 0.0 {
                    (-distance).sin()
                } else {
                    distance.cos()
                };
                self.response(cosine, q)[index]
            };
            let quarter = integrate_from_ends(integrand, [0.0, FRAC_PI_2], ANGULAR_TOLERANCE);
            if quarter.value > 0.0 {
                *max_error = max_error.max(quarter.error / quarter.value);
            }
            4.0 * quarter.value
        })
    }

    /// Area fraction, variance and terms of the friction, by Simpson's rule with a number of steps on each range.
    ///
    /// At the odd points G is the integral of the parabola through three points. Within a range ln q grows like t³, because P
    /// falls from 1 like 1/√(ln q − ln q₀). `max_error` is raised to the relative error of the integrals over the angle.
    fn integrate(
        &self,
        spectrum: &SelfAffineSpectrum,
        steps: usize,
        max_error: &mut f64,
    ) -> [f64; N_RESULTS] {
        let mut integrals = SpectralIntegrals::default();
        // The integral is divided into two ranges, because the spectrum has a kink at the roll-off.
        let roll_off = TAU / spectrum.roll_off_wavelength;
        let longest = TAU / spectrum.longest_wavelength;
        let shortest = TAU / spectrum.shortest_wavelength;
        for [first, last] in [[longest, roll_off], [roll_off, shortest]] {
            let (range, step) = ((last / first).ln(), 1.0 / steps as f64);
            let mut integrands = |index: usize| {
                let t = step * index as f64;
                let q = first * (range * t * t * t).exp();
                let weight = 3.0 * range * t * t * spectrum.squared_slope_density(q);
                self.angular_integrals(q, max_error)
                    .map(|rate| weight * rate)
            };
            let mut start = [0.0; 2];
            for index in (0..steps).step_by(2).filter(|_| range > 0.0) {
                // Each Simpson step adds the friction at its three points, each with the G up to that point.
                let [middle, end] = [index + 1, index + 2].map(&mut integrands);
                let before = integrals.g;
                integrals.add_friction(step / 3.0 * start[1]);
                integrals.g = before + step / 12.0 * (5.0 * start[0] + 8.0 * middle[0] - end[0]);
                integrals.add_friction(step / 0.75 * middle[1]);
                integrals.g = before + step / 3.0 * (start[0] + 4.0 * middle[0] + end[0]);
                integrals.add_friction(step / 3.0 * end[1]);
                start = end;
            }
        }
        integrals.results()
    }
}

/// The integrals up to a wave number.
#[derive(Debug, Clone, Copy, Default)]
struct SpectralIntegrals {
    /// Integral G, half the variance of the pressure divided by the square of the mean pressure.
    g: f64,
    /// Friction coefficients with S = 1, P² and P⁴.
    friction_terms: [f64; N_TERMS],
}

impl SpectralIntegrals {
    /// Adds the friction of a wave, which is `in_full_contact` in full contact, to the terms with S = 1, P² and P⁴: in partial contact it is
    /// P S times as large, with the area fraction P up to the present G.
    fn add_friction(&mut self, in_full_contact: f64) {
        let area = area_fraction(2.0 * self.g);
        let mut added = area * in_full_contact;
        for term in &mut self.friction_terms {
            *term += added;
            added *= area * area;
        }
    }

    /// Area fraction, variance of the pressure and terms of the friction.
    fn results(&self) -> [f64; N_RESULTS] {
        let variance = 2.0 * self.g;
        let [one, two, three] = self.friction_terms;
        [area_fraction(variance), variance, one, two, three]
    }
}

/// Persson's area fraction erf(1/√(2V)) for a variance V of the pressure divided by the square of the mean pressure.
fn area_fraction(variance: f64) -> f64 {
    libm::erf((0.5 / variance).sqrt())
}

/// The results with their absolute errors, in the order of [`SpectralIntegrals::results`]; [`FrictionError::OutOfRange`] if they are
/// no numbers.
fn sliding_with_errors(
    results: [f64; N_RESULTS],
    errors: [f64; N_RESULTS],
) -> Result<PerssonSliding, FrictionError> {
    representable("area fraction", results[0])?;
    // The friction of an elastic material is exactly 0, which is not out of range.
    if results[2].to_bits() != 0 {
        representable("friction coefficient", results[2])?;
    }
    let estimate = |index: usize| Estimate::new(results[index], errors[index]);
    Ok(PerssonSliding {
        area_fraction: estimate(0),
        pressure_variance: estimate(1),
        parts: [2, 3, 4].map(estimate),
    })
}
