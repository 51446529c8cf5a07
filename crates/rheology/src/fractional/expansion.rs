//! A continuous relaxation spectrum as a Prony series, with its error.
//!
//! ```text
//! G*(ω) = ∫ H(ln s) iω/(s + iω) d ln s    ≈    h Σ_j H(j h) iω/(s_j + iω),    s_j = s_0 e^(j h) = 1/τ_j
//! ```
//! with s_0 in the middle of the band, so that the series does not depend on the unit of time.
//!
//! The integrand is analytic in a strip of half-width d ≤ π/2 around the real axis of ln s, up to the pole s = −iω. The error
//! of the trapezoidal rule is about 2 e^(−2π d/h) (Trefethen & Weideman 2014, SIAM Rev. 56, 385, DOI 10.1137/130932132).
//! Branches much slower than the band act as a spring, much faster ones as a dashpot.

use std::f64::consts::PI;
use std::iter::successors;

use crate::{ComplexModulus, RelaxationBranch, RelaxationSpectrum, RheologyError};
use numerics::{InvalidParameter, in_range, positive};

/// A Prony series of a continuous spectrum or of a measured curve, with its error.
#[derive(Debug, Clone, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize))]
pub struct PronyExpansion {
    /// Relaxation spectrum of the series.
    pub spectrum: RelaxationSpectrum,
    /// Largest |G*/G*_exact − 1| over the frequencies 1/t of the range, from 32 frequencies per decade.
    ///
    /// For a relaxation function it also bounds |G/G_exact − 1| in the range; for a measured curve it is the largest error at
    /// the points.
    pub relative_error: f64,
    /// Shortest and longest time of validity, 1/ω, \[s].
    pub time_range: [f64; 2],
}

/// A continuous spectrum with its exact modulus and the properties that determine the expansion.
pub(super) struct ContinuousSpectrum<'a> {
    /// Logarithm of the density H \[Pa] as a function of ln s, with the rate s \[1/s].
    ///
    /// Logarithms, because the sums over slow and fast branches extend to rates that overflow or underflow.
    pub(super) log_density: &'a dyn Fn(f64) -> f64,
    /// Exact complex modulus at ω > 0.
    pub(super) exact: &'a dyn Fn(f64) -> Result<ComplexModulus, RheologyError>,
    /// Half-width of the strip around real ln s in which the density is analytic.
    pub(super) strip_half_width: f64,
    /// Exponent a of the density towards slow rates, H ~ s^a.
    pub(super) exponent: f64,
    /// Whether the moduli of all fast branches have a finite sum.
    pub(super) has_glass_modulus: bool,
}

/// Largest number of refinements, each with denser nodes over a wider range. Chosen: the last one aims at 4⁻¹¹ = 2e-7 of the
/// requested error.
const MAX_REFINEMENTS: u32 = 12;
/// Number of frequencies per decade at which the error of the series is found. Chosen: the error oscillates with the spacing
/// of the nodes, which are fewer in a decade.
const SAMPLES_PER_DECADE: f64 = 32.0;

impl ContinuousSpectrum<'_> {
    /// Series within `relative_error` of the exact modulus over a band of angular frequencies \[rad/s].
    pub(super) fn expand(
        &self,
        band: [f64; 2],
        relative_error: f64,
    ) -> Result<PronyExpansion, RheologyError> {
        validate(band, relative_error)?;
        let mut best = f64::INFINITY;
        for round in 0..MAX_REFINEMENTS {
            // Aim at a quarter of the error before: the estimates of the step and of the range are asymptotic.
            let target = relative_error * 0.25_f64.powf(f64::from(round));
            let spectrum = self.series(band, target)?;
            let reached = self.error_of(&spectrum, band)?;
            if reached <= relative_error {
                return Ok(PronyExpansion {
                    spectrum,
                    relative_error: reached,
                    time_range: [band[1].recip(), band[0].recip()],
                });
            }
            best = best.min(reached);
        }
        Err(RheologyError::ExpansionNotReached {
            asked: relative_error,
            reached: best,
        })
    }

    /// The series of the trapezoidal rule over the logarithm of the rate, for a band of angular frequencies \[rad/s] and a relative
    /// error `target`.
    fn series(
        &self,
        [low, high]: [f64; 2],
        target: f64,
    ) -> Result<RelaxationSpectrum, RheologyError> {
        let step = 2.0 * PI * self.strip_half_width.min(0.5 * PI) / (2.0 / target).ln();
        // Choose the range of the rates s: at a frequency ω slow branches act as a spring with the error (s/ω)^(1 + a), fast ones
        // as a dashpot with (ω/s)^(2 − a). Here a is the exponent.
        let slowest = low * target.powf(1.0 / (1.0 + self.exponent));
        let fastest = high * target.powf(-1.0 / (2.0 - self.exponent));
        let middle = 0.5 * (low.ln() + high.ln());
        let [first, last] = [slowest, fastest].map(|rate| (rate.ln() - middle) / step);
        let [first, last] = [first.floor(), last.ceil()];
        let log_rate = |index: f64| middle + index * step;
        // Compute the modulus (k = 0) or the viscosity (k = 1) of the branch at a node: the density times the step and the k-th
        // power of the relaxation time.
        let moment = |k: f64, index: f64| {
            let log_rate = log_rate(index);
            step * ((self.log_density)(log_rate) - k * log_rate).exp()
        };
        let branch =
            |index: f64| RelaxationBranch::new(moment(0.0, index), (-log_rate(index)).exp());
        let indices = successors(Some(first), |index| Some(index + 1.0));
        let inner = indices.take_while(|&index| index <= last).map(branch);
        let mut branches: Vec<RelaxationBranch> = inner.collect();
        // Add up the branches beyond both ends: slow ones are a spring, fast ones a dashpot or a branch of the same viscosity.
        let slow = sum_of_series(|k| moment(0.0, first - f64::from(k)));
        let viscosity = sum_of_series(|k| moment(1.0, last + f64::from(k)));
        if !self.has_glass_modulus {
            return RelaxationSpectrum::new(slow, viscosity, branches);
        }
        let modulus = sum_of_series(|k| moment(0.0, last + f64::from(k)));
        branches.push(RelaxationBranch::new(modulus, viscosity / modulus));
        RelaxationSpectrum::new(slow, 0.0, branches)
    }

    /// Largest |G*/G*_exact − 1| of a series in a band of angular frequencies, \[rad/s].
    fn error_of(
        &self,
        series: &RelaxationSpectrum,
        [low, high]: [f64; 2],
    ) -> Result<f64, RheologyError> {
        let factor = 10_f64.powf(SAMPLES_PER_DECADE.recip());
        let samples = successors(Some(low), |omega| Some(omega * factor));
        let inner = samples.take_while(|&omega| omega < high);
        let mut worst = 0.0_f64;
        for omega in inner.chain([high]) {
            let (exact, series) = ((self.exact)(omega)?, series.complex_modulus(omega)?);
            let error = (series.storage - exact.storage).hypot(series.loss - exact.loss);
            worst = worst.max(error / exact.storage.hypot(exact.loss));
        }
        Ok(worst)
    }
}

/// Sum over k = 1, 2, … of positive terms that eventually decrease at least geometrically, up to a term below rounding.
fn sum_of_series(term: impl Fn(u32) -> f64) -> f64 {
    let mut sum = 0.0;
    for k in 1..=MAX_TERMS {
        let next = term(k);
        sum += next;
        if next <= 1e-18 * sum {
            break;
        }
    }
    sum
}

/// Largest number of terms of the sum. Derived: the slowest decay is e^(−0.01 h) per term, with the step h > 0.1.
const MAX_TERMS: u32 = 100_000;

/// Refuses a band of angular frequencies \[rad/s] that is empty or not positive, and a relative error outside 1e-12 to 0.1.
pub(crate) fn validate([low, high]: [f64; 2], relative_error: f64) -> Result<(), RheologyError> {
    positive("lowest_frequency", low)?;
    positive("highest_frequency", high)?;
    let is_valid = high > low;
    let allowed = "greater than the lowest frequency";
    in_range("highest_frequency", high, is_valid, allowed)?;
    let is_valid = (1e-12..=0.1).contains(&relative_error);
    in_range(
        "relative_error",
        relative_error,
        is_valid,
        "from 1e-12 to 0.1",
    )?;
    Ok(())
}

/// Returns the exponent of a fractional element from 0.01 to 0.99, and refuses one that is nearly that of a spring or a dashpot.
pub(super) fn fractional_exponent(exponent: f64) -> Result<f64, InvalidParameter> {
    let is_valid = (0.01..=0.99).contains(&exponent);
    in_range("exponent", exponent, is_valid, "from 0.01 to 0.99")
}
