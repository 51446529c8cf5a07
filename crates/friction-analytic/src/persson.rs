//! Persson's theory of rough surfaces that slide: real area of contact and friction, from the spectrum alone.
//!
//! ```text
//! G(q) = (1/8) ∫ d²q' q'² C |E*(q'ₓ v)/σ₀|²  over |q'| < q,      P(q) = erf(1/(2 √G)),      A/A₀ = P(q₁)
//! μ = (1/2) ∫ d²q |q| |qₓ| C S P Im E*(|qₓ| v)/σ₀,               E* = 2 G*/(1 − ν)
//! ```
//!
//! with ⟨h²⟩ = ∫ C d²q, S = 1 in Persson (2001), J. Chem. Phys. 115, 3840, and S = (1 + P²)/2 in Persson (2006), Surf. Sci.
//! Rep. 61, 201. In full contact, S = P = 1, the friction is exact; otherwise the theory is an approximation whose error the
//! bars here do not contain.

use std::f64::consts::{FRAC_PI_2, TAU};

use numerics::{
    Estimate, between_zero_and_one, in_range, integrate_from_ends, not_negative, positive,
};
use rheology::{Material, RelaxationSpectrum};

use crate::error::representable;
use crate::{FrictionError, SurfaceWave};

/// Pressing and motion of a rough surface.
#[derive(Debug, Clone, Copy, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize))]
pub struct RoughLoad {
    /// Mean pressure σ₀ > 0, \[Pa].
    pub mean_pressure: f64,
    /// Sliding speed v ≥ 0, \[m/s].
    pub velocity: f64,
}

/// An isotropic self-affine spectrum: constant from the longest wave to the roll-off, then C ∝ q^(−2 (1 + H)).
#[derive(Debug, Clone, Copy, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize))]
pub struct SelfAffineSpectrum {
    /// Hurst exponent H, between 0 and 1.
    pub hurst_exponent: f64,
    /// Root mean square of |∇h| > 0.
    pub rms_slope: f64,
    /// Longest wave length, \[m].
    pub longest_wavelength: f64,
    /// Wave length of the roll-off, \[m]; the longest one for a spectrum without.
    pub roll_off_wavelength: f64,
    /// Shortest wave length, \[m].
    pub shortest_wavelength: f64,
}

/// What Persson's theory says about a rough surface. The errors are those of the quadrature, not of the theory.
#[derive(Debug, Clone, Copy, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize))]
#[must_use]
pub struct PerssonSliding {
    /// Real area of contact as a part of the nominal one.
    pub area_fraction: Estimate,
    /// Friction coefficient with S = 1, as in 2001.
    pub friction_coefficient: Estimate,
    /// Friction coefficient with S = (1 + P²)/2, as in 2006.
    pub friction_coefficient_2006: Estimate,
}

/// Persson's area and friction of a sum of waves, which may be anisotropic; waves of one length count with the area fraction
/// after half of them.
///
/// The sums are exact up to rounding, so that their errors are 0.
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
    let sliding = Sliding::new(material, load)?;
    let mut parts = Vec::with_capacity(waves.len());
    for wave in waves {
        let [along, across] = wave.wave_vector;
        let length = positive("length of a wave vector", along.hypot(across))?;
        let amplitude = numerics::finite("amplitude", wave.amplitude)?;
        let steepness = (0.5 * amplitude * length) * (amplitude * length);
        let part = sliding.part(along.abs() / length, length);
        parts.push((length, part.map(|rate| steepness * rate)));
    }
    parts.sort_by(|(one, _), (other, _)| one.total_cmp(other));
    let mut sums = Sums::default();
    for shell in parts.chunk_by(|(one, _), (other, _)| other - one <= SAME_LENGTH * one) {
        let total = |index: usize| shell.iter().map(|(_, part)| part[index]).sum::<f64>();
        sums.spread += 0.5 * total(0);
        sums.rub(total(1));
        sums.spread += 0.5 * total(0);
    }
    finished(sums.results(), [0.0; 3])
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
    let holds = (1e-11..1.0).contains(&relative_error);
    let allowed = "at least 1e-11 and below 1";
    in_range("relative_error", relative_error, holds, allowed)?;
    spectrum.validate()?;
    let sliding = Sliding::new(material, load)?;
    let mut steps = FEWEST_STEPS;
    let mut coarse = sliding.integrate(spectrum, steps, &mut 0.0);
    loop {
        steps *= 2;
        let mut worst = 0.0;
        let fine = sliding.integrate(spectrum, steps, &mut worst);
        // P and S P change at most with the power 3/2 of G.
        let error =
            |index: usize| (fine[index] - coarse[index]).abs() + 3.0 * worst * fine[index].abs();
        let result = finished(fine, [0, 1, 2].map(error))?;
        let bars = [
            ("area fraction", result.area_fraction),
            ("friction coefficient", result.friction_coefficient),
            ("friction coefficient", result.friction_coefficient_2006),
        ];
        let is_missed = |(_, bar): &(_, Estimate)| !bar.is_within(relative_error);
        match bars.into_iter().find(is_missed) {
            None => return Ok(result),
            Some((quantity, known)) if steps >= MOST_STEPS => {
                return Err(FrictionError::NotConverged {
                    quantity,
                    value: known.value,
                    error: known.error,
                });
            }
            Some(_) => coarse = fine,
        }
    }
}

/// Wave vectors whose lengths differ by less, relatively, differ by rounding.
const SAME_LENGTH: f64 = 1e-12;
/// Steps of Simpson's rule between the longest wave and the roll-off, and from there to the shortest wave.
const FEWEST_STEPS: usize = 16;
const MOST_STEPS: usize = 1 << 14;
/// Relative error of the integrals over the angle.
const ANGULAR_ERROR: f64 = 1e-13;

impl SelfAffineSpectrum {
    fn validate(&self) -> Result<(), FrictionError> {
        between_zero_and_one("hurst_exponent", self.hurst_exponent)?;
        positive("rms_slope", self.rms_slope)?;
        let shortest = positive("shortest_wavelength", self.shortest_wavelength)?;
        let longest = positive("longest_wavelength", self.longest_wavelength)?;
        let allowed = "longer than the shortest one";
        in_range("longest_wavelength", longest, longest > shortest, allowed)?;
        let roll_off = self.roll_off_wavelength;
        let holds = (shortest..=longest).contains(&roll_off);
        let allowed = "between the shortest and the longest wave length";
        in_range("roll_off_wavelength", roll_off, holds, allowed)?;
        Ok(())
    }

    /// q⁴ C(q) at some q, from 2π ∫ q³ C dq = ⟨|∇h|²⟩.
    fn steepness(&self, q: f64) -> f64 {
        let waves = [self.longest_wavelength, self.shortest_wavelength];
        let [ratio_long, ratio_short] = waves.map(|wave| self.roll_off_wavelength / wave);
        let power = 2.0 - 2.0 * self.hurst_exponent;
        let falling = (power * ratio_short.ln()).exp_m1() / power;
        let total = 0.25 * (1.0 - ratio_long.powi(4)) + falling;
        let x = q * self.roll_off_wavelength / TAU;
        let shape = x.powf(if x < 1.0 { 4.0 } else { power });
        self.rms_slope * self.rms_slope * shape / (TAU * total)
    }
}

/// A material under a load.
struct Sliding {
    relaxation: RelaxationSpectrum,
    /// E*/(G* σ₀), \[1/Pa].
    factor: f64,
    velocity: f64,
}

impl Sliding {
    fn new(material: &dyn Material, load: RoughLoad) -> Result<Self, FrictionError> {
        let mean_pressure = positive("mean_pressure", load.mean_pressure)?;
        Ok(Self {
            relaxation: material.relaxation(),
            factor: 4.0 / (material.half_space_factor() * mean_pressure),
            velocity: not_negative("velocity", load.velocity)?,
        })
    }

    /// |E*/σ₀|²/8 and |cos φ| Im E*/(2 σ₀) of a wave; not a number where the frequency overflows.
    fn part(&self, cosine: f64, q: f64) -> [f64; 2] {
        let modulus = self.relaxation.complex_modulus(q * cosine * self.velocity);
        modulus.map_or([f64::NAN; 2], |modulus| {
            let [storage, loss] = [modulus.storage, modulus.loss].map(|part| part * self.factor);
            let square = storage * storage + loss * loss;
            [0.125 * square, 0.5 * cosine * loss]
        })
    }

    /// The integrals of both over all angles; `worst` is raised to their relative error.
    fn around(&self, q: f64, worst: &mut f64) -> [f64; 2] {
        [0, 1].map(|index| {
            let quarter = |end: f64, distance: f64| {
                // Where the cosine vanishes it is resolved below the rounding of the angle.
                let cosine = if end > 0.0 {
                    (-distance).sin()
                } else {
                    distance.cos()
                };
                self.part(cosine, q)[index]
            };
            let quarter = integrate_from_ends(quarter, [0.0, FRAC_PI_2], ANGULAR_ERROR);
            if quarter.value > 0.0 {
                *worst = worst.max(quarter.error / quarter.value);
            }
            4.0 * quarter.value
        })
    }

    /// By Simpson's rule, and at the odd points by that of the parabola through three points.
    ///
    /// Between the ends of a range ln q grows like t³, because P falls from 1 like 1/√(ln q − ln q₀).
    fn integrate(&self, spectrum: &SelfAffineSpectrum, steps: usize, worst: &mut f64) -> [f64; 3] {
        let mut sums = Sums::default();
        let roll_off = TAU / spectrum.roll_off_wavelength;
        let longest = TAU / spectrum.longest_wavelength;
        let shortest = TAU / spectrum.shortest_wavelength;
        for [first, last] in [[longest, roll_off], [roll_off, shortest]] {
            let (range, step) = ((last / first).ln(), 1.0 / steps as f64);
            let mut at = |index: usize| {
                let t = step * index as f64;
                let q = first * (range * t * t * t).exp();
                let weight = 3.0 * range * t * t * spectrum.steepness(q);
                self.around(q, worst).map(|rate| weight * rate)
            };
            let mut start = [0.0; 2];
            for index in (0..steps).step_by(2).filter(|_| range > 0.0) {
                let [middle, end] = [index + 1, index + 2].map(&mut at);
                let before = sums.spread;
                sums.rub(step / 3.0 * start[1]);
                sums.spread = before + step / 12.0 * (5.0 * start[0] + 8.0 * middle[0] - end[0]);
                sums.rub(step / 0.75 * middle[1]);
                sums.spread = before + step / 3.0 * (start[0] + 4.0 * middle[0] + end[0]);
                sums.rub(step / 3.0 * end[1]);
                start = end;
            }
        }
        sums.results()
    }
}

/// G and both frictions up to a wave number.
#[derive(Debug, Clone, Copy, Default)]
struct Sums {
    spread: f64,
    friction: f64,
    friction_2006: f64,
}

impl Sums {
    fn area_fraction(&self) -> f64 {
        libm::erf(0.5 / self.spread.sqrt())
    }

    /// Adds what would be friction in full contact.
    fn rub(&mut self, friction: f64) {
        let area = self.area_fraction();
        self.friction += area * friction;
        self.friction_2006 += 0.5 * (1.0 + area * area) * area * friction;
    }

    /// Area fraction and both frictions.
    fn results(&self) -> [f64; 3] {
        [self.area_fraction(), self.friction, self.friction_2006]
    }
}

fn finished(results: [f64; 3], errors: [f64; 3]) -> Result<PerssonSliding, FrictionError> {
    representable("area fraction", results[0])?;
    // An elastic material has no friction.
    if results[1].to_bits() != 0 {
        representable("friction coefficient", results[1])?;
    }
    let known = |index: usize| Estimate::new(results[index], errors[index]);
    Ok(PerssonSliding {
        area_fraction: known(0),
        friction_coefficient: known(1),
        friction_coefficient_2006: known(2),
    })
}
