//! Prony series that approximate fractional elements, or laws that users have expanded themselves.
//!
//! Over the frequencies of the time range the series differs from its element by up to δ |G*|. The largest relative error is that
//! of the relaxation modulus, 2 δ Γ(1 − a) ≤ 2 δ/(1 − a), because an element of exponent a relaxes to |G*(1/t)|/Γ(1 − a).

use std::f64::consts::FRAC_2_PI;

use numerics::{in_range, not_negative, positive};
use rheology::{Prony, PronyExpansion, RelaxationSpectrum, RheologyError};

use crate::scene::Approximation;

/// Relative error of the complex modulus that is requested when a Prony series approximates the material. Chosen, far below the
/// errors of the methods.
const MODULUS_ERROR: f64 = 1e-7;

/// Accuracy of a Prony series that approximates another law.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Expansion {
    /// Relative error of relaxation modulus, creep compliance and complex modulus within the range.
    pub relative_error: f64,
    /// Shortest and longest time of validity, \[s].
    pub time_range: [f64; 2],
    /// Exponent of the element, or of the power law with the phase angle of the series at the longest time.
    pub exponent: f64,
    /// Longest time up to which the series creeps about as the element does, \[s]; infinite if a parallel spring ends the creep
    /// earlier.
    pub creeps_until: f64,
}

impl Expansion {
    /// Upper bound (t/T)^(1 − a) of the fraction of the friction of a line contact from waves that are slower than T =
    /// [`Self::creeps_until`]; `contact_time` t \[s] is contact length over velocity. Waves in dq dissipate |p̂|² ω J''(ω)/q dq
    /// ∼ q^−a dq from q = 0 to the reciprocal of the contact length.
    pub(super) fn slow_wave_fraction(&self, contact_time: f64) -> f64 {
        (contact_time / self.creeps_until).powf(1.0 - self.exponent)
    }
}

/// The Prony series of a fractional element of exponent a in parallel with a spring of `equilibrium_modulus` \[Pa], valid for
/// times from the first to the second of `time_range` \[s]. `expand` returns the series of the element from a range of angular
/// frequencies \[rad/s] and a relative error.
pub(crate) fn expanded(
    expand: impl FnOnce([f64; 2], f64) -> Result<PronyExpansion, RheologyError>,
    exponent: f64,
    equilibrium_modulus: f64,
    time_range: [f64; 2],
) -> Result<(Prony, Expansion), RheologyError> {
    let series = expand(band(time_range)?, MODULUS_ERROR)?;
    let modulus = not_negative("equilibrium_modulus", equilibrium_modulus)?;
    let sum = RelaxationSpectrum::new(
        modulus + series.spectrum.equilibrium_modulus(),
        series.spectrum.viscosity(),
        series.spectrum.branches().to_vec(),
    )?;
    // The creep of the series ends with its slowest branch, because the equilibrium modulus of the series represents all slower
    // ones.
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
    /// Accuracy and range of a Prony series that a user has expanded. Its exponent a is that of the power law with the phase
    /// angle of the series at the longest time T, (2/π) arctan(G''/G') at ω = 1/T.
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

/// The range [1/T, 1/t] of angular frequencies \[rad/s] for times from t to T \[s]; an error unless 0 < t < T.
fn band([shortest, longest]: [f64; 2]) -> Result<[f64; 2], RheologyError> {
    positive("time_range[0]", shortest)?;
    positive("time_range[1]", longest)?;
    let allowed = "longer than the shortest time";
    in_range("time_range[1]", longest, longest > shortest, allowed)?;
    Ok([longest.recip(), shortest.recip()])
}
