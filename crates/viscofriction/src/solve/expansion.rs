//! Prony series that stand for fractional elements, and for laws that users have expanded themselves.
//!
//! At the frequencies of a range of times a series differs from its element by up to δ |G*|. At those times its relaxation
//! modulus differs the most of all functions, by up to 2 δ Γ(1 − a) ≤ 2 δ/(1 − a) of itself: an element of the exponent a
//! relaxes to |G*(1/t)|/Γ(1 − a).

use std::f64::consts::FRAC_2_PI;

use numerics::{in_range, not_negative, positive};
use rheology::{Prony, PronyExpansion, RelaxationSpectrum, RheologyError};

use crate::scene::Approximation;

/// Error of the modulus δ that a series is expanded to.
const RELATIVE_ERROR: f64 = 1e-7;

/// How well a Prony series stands for another law.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Expansion {
    /// Relative error of relaxation modulus, creep compliance and complex modulus within the range.
    pub relative_error: f64,
    /// Shortest and longest time for which it holds, \[s].
    pub time_range: [f64; 2],
    /// Exponent of the element, or of the power law that has the phase angle of the series after the longest time.
    pub exponent: f64,
    /// Longest relaxation time, up to which it creeps about as the element does, \[s]; infinite where a spring in parallel has
    /// ended the creep before.
    pub creeps_until: f64,
}

impl Expansion {
    /// The part of the friction of a line contact that waves make which strain the element for longer than its series creeps,
    /// at most: the power of the waves in dq is |p̂|² ω J''(ω)/q dq ∼ q^−a dq from q = 0 to the reciprocal of the contact length.
    pub(super) fn beyond(&self, contact_time: f64) -> f64 {
        (contact_time / self.creeps_until).powf(1.0 - self.exponent)
    }
}

/// The series that stands for a fractional element, which is expanded over a band of frequencies to an error, and for a
/// spring beside it.
pub(crate) fn expanded(
    expand: impl FnOnce([f64; 2], f64) -> Result<PronyExpansion, RheologyError>,
    exponent: f64,
    equilibrium_modulus: f64,
    time_range: [f64; 2],
) -> Result<(Prony, Expansion), RheologyError> {
    let series = expand(band(time_range)?, RELATIVE_ERROR)?;
    let modulus = not_negative("equilibrium_modulus", equilibrium_modulus)?;
    let sum = RelaxationSpectrum::new(
        modulus + series.spectrum.equilibrium_modulus(),
        series.spectrum.viscosity(),
        series.spectrum.branches().to_vec(),
    )?;
    // The spring of the series stands for its slower branches.
    let creeps_until = match series.spectrum.branches().last() {
        Some(slowest) if modulus < series.spectrum.equilibrium_modulus() => slowest.relaxation_time,
        _ => f64::INFINITY,
    };
    let expansion = Expansion {
        relative_error: 2.0 * series.relative_error / (1.0 - exponent),
        time_range,
        exponent,
        creeps_until,
    };
    Ok((Prony::new(sum)?, expansion))
}

impl Approximation {
    /// As of an element whose exponent is that of the power law with the phase angle at the end of the range.
    pub(crate) fn of(self, series: &RelaxationSpectrum) -> Result<Expansion, RheologyError> {
        let [lowest, _] = band(self.time_range)?;
        let holds = (0.0..=0.1).contains(&self.relative_error);
        in_range(
            "relative_error",
            self.relative_error,
            holds,
            "from 0 to 0.1",
        )?;
        Ok(Expansion {
            relative_error: self.relative_error,
            time_range: self.time_range,
            exponent: FRAC_2_PI * series.loss_tangent(lowest)?.atan(),
            creeps_until: self.time_range[1],
        })
    }
}

fn band([shortest, longest]: [f64; 2]) -> Result<[f64; 2], RheologyError> {
    positive("time_range[0]", shortest)?;
    positive("time_range[1]", longest)?;
    let allowed = "longer than the shortest time";
    in_range("time_range[1]", longest, longest > shortest, allowed)?;
    Ok([longest.recip(), shortest.recip()])
}
