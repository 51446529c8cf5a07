//! Persson's theory of rough surfaces that slide: real area of contact and friction, from the spectrum alone.
//!
//! ```text
//! G(q) = (1/8) ∫ d²q' q'² C |E*(q'ₓ v)/σ₀|²  over |q'| < q,      P(q) = erf(1/(2 √G)),      A/A₀ = P(q₁)
//! μ = (1/2) ∫ d²q |q| |qₓ| C S P Im E*(|qₓ| v)/σ₀,               E* = 2 G*/(1 − ν)
//! ```
//!
//! with ⟨h²⟩ = ∫ C d²q. S, a polynomial in P², is how much energy a wave holds in contact, as a part of that which it holds in
//! full contact, P = S = 1; there the friction is exact. Otherwise the theory is an approximation whose error the bars here do not
//! contain.

use std::f64::consts::{FRAC_PI_2, TAU};

use numerics::{
    Estimate, between_zero_and_one, in_range, integrate_from_ends, not_negative, positive,
};
use rheology::{Material, RelaxationSpectrum, check_spectra};

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

/// Part S = c₀ + c₁ P² + c₂ P⁴ of the energy in full contact that a wave holds in contact, where P is the area fraction with all
/// longer waves. The coefficients add up to 1.
#[derive(Debug, Clone, Copy, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize))]
pub struct EnergyFactor([f64; N_PARTS]);

impl EnergyFactor {
    /// S = 1, Persson (2001), J. Chem. Phys. 115, 3840.
    pub const PERSSON_2001: Self = Self([1.0, 0.0, 0.0]);
    /// S = (1 + P²)/2, Persson (2006), Surf. Sci. Rep. 61, 201.
    pub const PERSSON_2006: Self = Self([0.5, 0.5, 0.0]);
    /// S = (5 − 2 P² + 6 P⁴)/9, Wang and Müser (2017), Tribol. Lett. 65, 103.
    pub const WANG_MUSER_2017: Self = Self([5.0 / 9.0, -2.0 / 9.0, 2.0 / 3.0]);

    /// S = γ + (1 − γ) P².
    ///
    /// # Errors
    /// [`FrictionError::InvalidParameter`] for a γ that is not finite.
    pub fn interpolated(gamma: f64) -> Result<Self, FrictionError> {
        let gamma = numerics::finite("gamma", gamma)?;
        Ok(Self([gamma, 1.0 - gamma, 0.0]))
    }
}

/// What Persson's theory says about a rough surface. The errors are those of the quadrature, not of the theory.
#[derive(Debug, Clone, Copy, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize))]
#[must_use]
pub struct PerssonSliding {
    /// Real area of contact as a part of the nominal one.
    pub area_fraction: Estimate,
    /// Variance of the pressure in full contact, divided by the square of the mean pressure: 2 G of all waves.
    pub pressure_variance: Estimate,
    /// Frictions with S = 1, P² and P⁴.
    parts: [Estimate; N_PARTS],
}

impl PerssonSliding {
    /// Friction coefficient.
    pub fn friction_coefficient(&self, factor: EnergyFactor) -> Estimate {
        let pairs = factor.0.into_iter().zip(self.parts);
        let pairs = pairs.map(|(weight, part)| [weight * part.value, weight.abs() * part.error]);
        let [value, error] =
            pairs.fold([0.0; 2], |sums, pair| [0, 1].map(|at| sums[at] + pair[at]));
        Estimate::new(value, error)
    }

    /// Area fraction A of Xu and others (2024), Int. J. Solids Struct. 290, 112684, where pressures differ less where less is in contact:
    ///
    /// ```text
    /// A = erf(1/√(2 V (γ + (1 − γ) A)))
    /// ```
    ///
    /// V is the [variance](Self::pressure_variance). With γ = 1 it is that of Persson; of elastic surfaces they find γ = 0.42 to 0.45.
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
        // The right-hand side falls with A, so that it cuts the left-hand side once, between 0 and 1.
        let [mut below, mut above] = [0.0, 1.0];
        for _ in 0..f64::MANTISSA_DIGITS {
            let middle = 0.5 * (below + above);
            if next(middle) > middle {
                below = middle;
            } else {
                above = middle;
            }
        }
        // A changes at most with the square root of V.
        let area = next(above);
        let change = if variance > 0.0 {
            self.pressure_variance.error / variance
        } else {
            0.0
        };
        Ok(Estimate::new(
            area,
            0.5 * area * change + (area - above).abs(),
        ))
    }
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
    finished(sums.results(), [0.0; N_RESULTS])
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
        // P⁵ changes at most with the power 5/2 of G.
        let error =
            |index: usize| (fine[index] - coarse[index]).abs() + 4.0 * worst * fine[index].abs();
        let result = finished(fine, std::array::from_fn(error))?;
        let bars = [
            ("area fraction", result.area_fraction),
            ("variance of the pressure", result.pressure_variance),
        ];
        let frictions = result.parts.map(|part| ("friction coefficient", part));
        let is_missed = |(_, bar): &(_, Estimate)| !bar.is_within(relative_error);
        match bars.into_iter().chain(frictions).find(is_missed) {
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

/// Parts of the friction, and results of the theory.
const N_PARTS: usize = 3;
const N_RESULTS: usize = N_PARTS + 2;
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
        check_spectra(material)?;
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
    fn integrate(
        &self,
        spectrum: &SelfAffineSpectrum,
        steps: usize,
        worst: &mut f64,
    ) -> [f64; N_RESULTS] {
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

/// G and the parts of the friction up to a wave number.
#[derive(Debug, Clone, Copy, Default)]
struct Sums {
    spread: f64,
    parts: [f64; N_PARTS],
}

impl Sums {
    /// Adds what would be friction in full contact.
    fn rub(&mut self, friction: f64) {
        let area = area_fraction(2.0 * self.spread);
        let mut added = area * friction;
        for part in &mut self.parts {
            *part += added;
            added *= area * area;
        }
    }

    /// Area fraction, variance of the pressure and parts of the friction.
    fn results(&self) -> [f64; N_RESULTS] {
        let variance = 2.0 * self.spread;
        let [one, two, three] = self.parts;
        [area_fraction(variance), variance, one, two, three]
    }
}

/// Area fraction of a variance of the pressure.
fn area_fraction(variance: f64) -> f64 {
    libm::erf((0.5 / variance).sqrt())
}

fn finished(
    results: [f64; N_RESULTS],
    errors: [f64; N_RESULTS],
) -> Result<PerssonSliding, FrictionError> {
    representable("area fraction", results[0])?;
    // An elastic material has no friction.
    if results[2].to_bits() != 0 {
        representable("friction coefficient", results[2])?;
    }
    let known = |index: usize| Estimate::new(results[index], errors[index]);
    Ok(PerssonSliding {
        area_fraction: known(0),
        pressure_variance: known(1),
        parts: [2, 3, 4].map(known),
    })
}
