//! Heat sources: a flux per element and its distribution over the depth, and the share of it that the elastomer receives.
//!
//! On an incompressible half space one pressure wave of the wave number q dissipates at the depth z in proportion to
//!
//! ```text
//! p(z) = 4 q³ z² e^(−2qz),   ∫ p dz = 1
//! ```
//!
//! Its temperature at the surface follows from two transforms of p, with c = qs:
//!
//! ```text
//! ∫ p e^(−βz) dz = 8q³/(2q + β)³,   ∫ p e^(−z²/s²) dz = 4c³ [(√π/4)(1 + 2c²) e^(c²) erfc c − c/2]
//! ```
//!
//! Theory: docs/theory/heat.md, "Depth of the sources".

use std::f64::consts::PI;

use numerics::{InvalidParameter, in_range, integrate, not_negative, positive};
use rustfft::num_complex::Complex;

/// Heat that a moving body causes on the elements of a grid.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct HeatSource<'a> {
    /// Heat flux ≥ 0 of each element, row-major, \[W/m²]; for sources below the surface their power per area.
    pub flux: &'a [f64],
    /// Distribution of the heat over the depth.
    pub depth: &'a SourceDepth,
}

/// Distribution of heat sources over the depth.
#[derive(Debug, Clone, PartialEq)]
pub enum SourceDepth {
    /// All heat arises at the interface, as that of interfacial shear; the counterface takes its share.
    Surface,
    /// Heat arises in the elastomer, which receives all of it.
    Bulk(DissipationProfile),
    /// Heat arises in the elastomer in a plane at this depth ≥ 0, \[m]. On a periodic surface the flux is a sum of the waves that the
    /// grid resolves, and not constant per element.
    Plane(f64),
}

/// Distribution of dissipated power over the depth: the mean of 4 q³ z² e^(−2qz) over the pressure waves, weighted with their power.
#[derive(Debug, Clone, PartialEq)]
pub struct DissipationProfile {
    /// Waves with weights whose sum is 1.
    waves: Vec<DissipatingWave>,
}

/// A pressure wave and its part of the dissipated power.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct DissipatingWave {
    /// Wave number q > 0, \[rad/m].
    pub wave_number: f64,
    /// Power ≥ 0 in any unit that all waves share.
    pub power: f64,
}

/// The body in contact, as far as it takes heat that arises at the interface. Outside the contact the surface is insulated.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Counterface {
    /// A thermal insulator: the elastomer receives all heat of the interface.
    Insulating,
    /// A perfect conductor: all heat of the interface flows into it, and only sources in the bulk heat the elastomer.
    Conducting,
    /// The elastomer receives this share of the heat of the interface, from 0 to 1.
    ElastomerShare(f64),
}

impl DissipationProfile {
    /// The profile of `waves` with their powers.
    ///
    /// # Errors
    /// [`InvalidParameter`] for a wave number that is not finite and greater than 0, a power that is not finite and at least 0, or
    /// powers whose sum is not finite and greater than 0.
    pub fn new(waves: &[DissipatingWave]) -> Result<Self, InvalidParameter> {
        for wave in waves {
            positive("wave number", wave.wave_number)?;
            not_negative("power of a wave", wave.power)?;
        }
        let sum = waves.iter().map(|wave| wave.power).sum();
        let total_power = positive("sum of the powers of all waves", sum)?;
        let normalised = |wave: &DissipatingWave| DissipatingWave {
            power: wave.power / total_power,
            ..*wave
        };
        Ok(Self {
            waves: waves.iter().map(normalised).collect(),
        })
    }

    /// Power-weighted mean of a function of the wave number.
    fn mean<T: std::iter::Sum + std::ops::Mul<f64, Output = T>>(
        &self,
        function: impl Fn(f64) -> T,
    ) -> T {
        let waves = self.waves.iter();
        waves
            .map(|wave| function(wave.wave_number) * wave.power)
            .sum()
    }
}

impl SourceDepth {
    /// Ratio ∫ p(z) e^(−z²/s²) dz of the temperature of a short pulse to that of a pulse at the surface, after the time in which heat
    /// diffuses over `length` = s = √(4Dt), \[m].
    pub(super) fn pulse_ratio(&self, length: f64) -> f64 {
        match self {
            Self::Surface => 1.0,
            Self::Bulk(profile) => profile.mean(|q| pulse_ratio_of_wave(q * length)),
            Self::Plane(depth) => (-(depth / length).powi(2)).exp(),
        }
    }

    /// Ratio ∫ p(z) e^(−βz) dz of the temperature of a wave with the decay constant `beta` \[1/m] to that of sources at the surface.
    pub(super) fn wave_ratio(&self, beta: Complex<f64>) -> Complex<f64> {
        match self {
            Self::Surface => Complex::new(1.0, 0.0),
            Self::Bulk(profile) => profile.mean(|q| {
                let ratio = (1.0 + beta * (0.5 / q)).inv();
                ratio * ratio * ratio
            }),
            Self::Plane(depth) => (-beta * *depth).exp(),
        }
    }

    /// Part of the stationary temperature of a standing wave of the wave number q \[rad/m] that is reached after the time in which heat
    /// diffuses over the length √(4Dt) \[m] (Carslaw & Jaeger 1959, § 2.5).
    ///
    /// A profile over the depth is taken to grow like a source at the surface.
    pub(super) fn grown_part(&self, wave_number: f64, length: f64) -> f64 {
        let time = 0.5 * wave_number * length;
        let Self::Plane(depth) = self else {
            return libm::erf(time);
        };
        let (exponent, arrival) = (2.0 * wave_number * depth, depth / length);
        let late = exponent.min(MAX_EXPONENT).exp() * libm::erfc(arrival + time);
        (0.5 * (libm::erfc(arrival - time) - late)).clamp(0.0, 1.0)
    }

    /// Mean rise k T̄/Q̄ by a uniform flux after the time in which heat diffuses over `length` = √(4Dt), \[m]: the integral
    /// (1/√π) ∫_0^length of [`pulse_ratio`](Self::pulse_ratio).
    pub(super) fn uniform_rise(&self, length: f64) -> f64 {
        let pulses = match self {
            Self::Surface => length,
            Self::Bulk(profile) => profile.mean(|q| {
                let ratio = |s: f64| pulse_ratio_of_wave(q * s);
                integrate(ratio, [0.0, length], UNIFORM_RISE_TOLERANCE).value
            }),
            Self::Plane(_) if length == 0.0 => 0.0,
            Self::Plane(depth) => {
                let ratio = depth / length;
                length * ((-ratio * ratio).exp() - PI.sqrt() * ratio * libm::erfc(ratio))
            }
        };
        pulses / PI.sqrt()
    }
}

impl Counterface {
    /// Share of the heat of the interface that the elastomer receives.
    pub(super) fn elastomer_share(self) -> Result<f64, InvalidParameter> {
        match self {
            Self::Insulating => Ok(1.0),
            Self::Conducting => Ok(0.0),
            Self::ElastomerShare(share) => {
                let holds = (0.0..=1.0).contains(&share);
                in_range("share of the elastomer", share, holds, "from 0 to 1")
            }
        }
    }
}

/// Largest exponent of e that is computed. Derived: above it the other factor is below the smallest number of f64.
const MAX_EXPONENT: f64 = 700.0;
/// Relative tolerance of the mean rise by a uniform flux. Chosen below the error 8e-9 of the time rule (`time_rule.rs`).
const UNIFORM_RISE_TOLERANCE: f64 = 1e-9;
/// Value of c = qs up to which the ratio of pulses is computed from its closed form. Chosen: the closed form loses 15 c⁴ units in
/// the last place, or 5e-14 here, and beyond it a continued fraction of [`FRACTION_LEVELS`] is accurate.
const CLOSED_FORM_LIMIT: f64 = 2.0;
/// Number of levels of the continued fraction beyond [`CLOSED_FORM_LIMIT`]. Derived: its relative error e^(−√(8n) c) at c = 2 is 3e-16.
const FRACTION_LEVELS: u32 = 40;

/// The integral ∫ 4q³z² e^(−2qz − z²/s²) dz as a function of c = qs; 1 for c → ∞.
fn pulse_ratio_of_wave(c: f64) -> f64 {
    if c <= CLOSED_FORM_LIMIT {
        let scaled_erfc = (c * c).exp() * libm::erfc(c);
        let integral = 0.25 * PI.sqrt() * (1.0 + 2.0 * c * c) * scaled_erfc - 0.5 * c;
        return 4.0 * c.powi(3) * integral;
    }
    // The integral is a product of three ratios of repeated integrals of erfc, t_n = 2c iⁿerfc(c)/iⁿ⁻¹erfc(c), whose backward
    // recurrence (NIST DLMF 7.18.7) has positive terms only.
    let inverse_square = 0.5 / c / c;
    let mut ratio = 1.0;
    let mut product = 1.0;
    for level in (1..=FRACTION_LEVELS).rev() {
        ratio = 1.0 / (1.0 + f64::from(level) * inverse_square * ratio);
        if level <= 3 {
            product *= ratio;
        }
    }
    product
}
