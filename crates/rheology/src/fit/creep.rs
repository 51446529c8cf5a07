//! Conversion of a measured creep compliance into a relaxation modulus.
//!
//! ```text
//! J(t) = J₀ + t/η + Σ J_k (1 − e^(−t/λ_k)),    J₀, 1/η, J_k ≥ 0
//! ```
//! The series is fitted to the relative errors of J, with retardation times equally spaced in the logarithm. Its exact
//! [`RelaxationSpectrum`](crate::RelaxationSpectrum) gives G(t) at the same times.

use nalgebra::{DMatrix, DVector};
use numerics::{in_range, positive};

use super::curve::RelaxationPoint;
use super::nnls::nnls;
use crate::error::with_list_index;
use crate::{CreepSpectrum, RetardationElement, RheologyError};

/// Creep compliance at one time after a step of stress.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct CreepPoint {
    /// Time t, \[s].
    pub time: f64,
    /// Creep compliance J(t), \[1/Pa].
    pub compliance: f64,
}

/// Number of retardation times per decade. Chosen: neighbouring times differ by a factor of 1.33, less than the width of the
/// response of one element, so that their sum is smooth.
const TIMES_PER_DECADE: f64 = 8.0;
/// Root mean square relative error of the series above which the curve is refused as that of no creeping material. Chosen:
/// creep is measured to some per cent; a wrong column or unit makes a far larger error.
const MAX_RMS_ERROR: f64 = 0.2;

/// Relaxation moduli at the times of measured creep compliances.
///
/// # Errors
/// [`RheologyError::TooFewPoints`] below two points; [`RheologyError::InvalidElement`] when a time is not greater than the one
/// before it, or a compliance is not finite and greater than zero; [`RheologyError::WrongTrend`] when no creeping material has these
/// compliances.
pub fn relaxation_of_creep(points: &[CreepPoint]) -> Result<Vec<RelaxationPoint>, RheologyError> {
    // Check the points, then convert the fitted creep spectrum exactly.
    let mut last = 0.0;
    for (index, point) in points.iter().enumerate() {
        let is_increasing = point.time.is_finite() && point.time > last;
        let allowed = "finite, greater than 0 and greater than the one before";
        in_range("time", point.time, is_increasing, allowed)
            .map_err(with_list_index("points", index))?;
        positive("compliance", point.compliance).map_err(with_list_index("points", index))?;
        last = point.time;
    }
    let [first, .., _] = points else {
        return Err(RheologyError::TooFewPoints {
            needed: 2,
            given: points.len(),
        });
    };
    let relaxation = creep_spectrum(points, [first.time, last])?.to_relaxation()?;
    let point = |&CreepPoint { time, .. }: &CreepPoint| {
        let modulus = relaxation.relaxation_modulus(time)?;
        Ok(RelaxationPoint { time, modulus })
    };
    points.iter().map(point).collect()
}

/// Nonnegative least-squares fit of the creep series, with retardation times from the shortest to the longest time \[s].
fn creep_spectrum(
    points: &[CreepPoint],
    [shortest, longest]: [f64; 2],
) -> Result<CreepSpectrum, RheologyError> {
    // Choose retardation times at equal distances in the logarithm, from the shortest to the longest measured time.
    let steps = (TIMES_PER_DECADE * (longest / shortest).log10()).ceil();
    let places = std::iter::successors(Some(0.0), |k| Some(k + 1.0)).take_while(|k| *k <= steps);
    let times: Vec<f64> = places
        .map(|k| shortest * (longest / shortest).powf(k / steps))
        .collect();
    // Fit the instantaneous compliance, the flow, and a compliance for each time.
    let matrix = DMatrix::from_fn(points.len(), times.len() + 2, |row, k| {
        let CreepPoint { time, compliance } = points[row];
        let response = match k.checked_sub(2).map(|k| times[k]) {
            Some(retardation_time) => -(-time / retardation_time).exp_m1(),
            None if k == 0 => 1.0,
            None => time / longest,
        };
        response / compliance
    });
    let compliances = nnls(&matrix, &DVector::from_element(points.len(), 1.0))?;
    // Refuse a curve that the series does not describe.
    let error = (&matrix * &compliances).add_scalar(-1.0).norm() / (points.len() as f64).sqrt();
    if error > MAX_RMS_ERROR {
        let what =
            "no sum of retarded compliances comes near to J(t), which rises ever more slowly";
        return Err(RheologyError::WrongTrend { what });
    }
    // Keep the retarded elements whose fitted compliance is not zero.
    let elements = times
        .iter()
        .zip(compliances.iter().skip(2))
        .filter(|(_, compliance)| **compliance > 0.0)
        .map(|(retardation_time, compliance)| RetardationElement {
            compliance: *compliance,
            retardation_time: *retardation_time,
        });
    CreepSpectrum::new(compliances[0], compliances[1] / longest, elements.collect())
}

#[cfg(test)]
mod tests {
    use super::*;

    /// J = 1/G_∞ − (1/G_∞ − 1/(G_∞ + G)) e^(−t/λ) with λ = τ (G_∞ + G)/G_∞ of the standard solid, whose G(t) is known.
    #[test]
    fn relaxation_of_the_standard_solid_is_that_of_its_creep() {
        let [soft, stiff, time] = [1e6, 4e6, 0.3_f64];
        let retardation = time * (soft + stiff) / soft;
        let point = |k: i32| {
            let t = 10_f64.powf(0.1 * f64::from(k) - 3.0);
            let retarded = (soft.recip() - (soft + stiff).recip()) * (-t / retardation).exp();
            CreepPoint {
                time: t,
                compliance: soft.recip() - retarded,
            }
        };
        let points: Vec<CreepPoint> = (0..=50).map(point).collect();
        for found in relaxation_of_creep(&points).expect("moduli") {
            let exact = soft + stiff * (-found.time / time).exp();
            let off = (found.modulus / exact - 1.0).abs();
            assert!(off < 0.02, "{found:?}, exact {exact:e}");
        }
    }

    #[test]
    fn compliances_that_fall_are_refused() {
        let point = |k: i32| CreepPoint {
            time: 10_f64.powi(k),
            compliance: 10_f64.powi(-k),
        };
        let points: Vec<CreepPoint> = (0..5).map(point).collect();
        let found = relaxation_of_creep(&points);
        assert!(
            matches!(found, Err(RheologyError::WrongTrend { .. })),
            "{found:?}"
        );
    }
}
