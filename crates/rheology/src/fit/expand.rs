//! Prony series of a relaxation function, with its error.
//!
//! G* at one frequency depends on all times. Therefore the function is sampled beyond the requested range until its tail
//! changes G* by less than a fraction of the tolerance. The difference ΔG of function and series gives that of the moduli.
//! With ΔG linear between samples t_0, t_1, … and constant beyond them,
//!
//! ```text
//! ΔG*(ω) = iω ∫ ΔG e^(−iωt) dt = ΔG(t_0) + Σ [ΔG(t_k+1) − ΔG(t_k)] e^(−iωm) sin(ωh)/(ωh)
//! ```
//! where m is the middle and 2h the length of the interval from t_k to t_k+1.

use std::f64::consts::LN_10;

use super::curve::{MeasuredCurve, RelaxationPoint};
use super::identify::{Control, IdentifyOptions, LongTimeLimit, MAX_BRANCHES, series_of};
use crate::fractional::{PronyExpansion, validate};
use crate::{RelaxationSpectrum, RheologyError};

/// Numbers of branches per decade, which are tried in this order until the error is small enough. Chosen: they begin with
/// the cheapest series; in the last one the times of neighbours differ by a factor of 1.2 only, and their responses are
/// nearly alike.
const BRANCHES_PER_DECADE: [f64; 7] = [1.0, 2.0, 3.0, 4.0, 6.0, 8.0, 12.0];
/// Number of samples per decade of time, and of frequencies at which the error is found. Chosen: more than two for each branch of
/// the densest series.
const SAMPLES_PER_DECADE: f64 = 32.0;
/// Fraction of the tolerance that is allowed for each tail of the function, at times that are not sampled. Chosen: both
/// tails leave four fifths of the tolerance to the series.
const TAIL_ERROR_FRACTION: f64 = 0.1;
/// Largest number of sampled decades beyond an end of the range; what is left then counts as error. Chosen: tails that
/// matter decay over far fewer decades, and the samples bound the time.
const MAX_TAIL_DECADES: i32 = 30;

/// Prony series within `relative_error` of a relaxation function G(t) \[Pa] over a range of times \[s].
///
/// The error bounds G(t) in the range and G* at the frequencies 1/t. The function is also evaluated beyond the range, as far
/// as it matters for G*. It must be completely monotone: a sum or an integral of decaying exponentials.
///
/// # Errors
/// - [`RheologyError::InvalidParameter`] when the range is empty or the error outside 1e-12 to 0.1;
/// - [`RheologyError::InvalidElement`] for a sample that is not finite, or not greater than 0 within the range;
/// - [`RheologyError::ExpansionNotReached`] when the function is not completely monotone, when it is as sharp as a single
///   exponential, or when rounding exceeds the error asked for;
/// - [`RheologyError::FitNotConverged`] when a fit does not converge.
pub fn expand(
    relaxation_modulus: &dyn Fn(f64) -> f64,
    time_range: [f64; 2],
    relative_error: f64,
) -> Result<PronyExpansion, RheologyError> {
    let [shortest, longest] = time_range;
    validate([longest.recip(), shortest.recip()], relative_error)?;
    let function = RelaxationFunction {
        relaxation_modulus,
        time_range,
    };
    // Sample the function over the range and as far into both tails as they matter.
    let [before, after] = [(shortest, 0.1), (longest, 10.0)]
        .map(|(end, factor)| function.tail(end, factor, TAIL_ERROR_FRACTION * relative_error));
    let ends = [before.time, after.time];
    let samples = function.samples(ends);
    let curve = function.curve(&samples)?;
    // Fit series with more and more branches until one has the requested error.
    let mut reached = f64::INFINITY;
    for per_decade in BRANCHES_PER_DECADE {
        let n_branches = log_spaced(ends, per_decade).count();
        if n_branches > MAX_BRANCHES {
            break;
        }
        let spectrum = series_of(&curve, &fixed_branches(n_branches))?.spectrum;
        let error = function.error_of(&spectrum, &samples)? + before.error + after.error;
        if error <= relative_error {
            return Ok(PronyExpansion {
                spectrum,
                relative_error: error,
                time_range,
            });
        }
        reached = reached.min(error);
    }
    Err(RheologyError::ExpansionNotReached {
        asked: relative_error,
        reached,
    })
}

/// Options for branches at fixed times, without smoothing.
const fn fixed_branches(n_branches: usize) -> IdentifyOptions {
    IdentifyOptions {
        long_time_limit: LongTimeLimit::Solid,
        control: Control::Smooth {
            n_branches,
            weight: 0.0,
        },
    }
}

/// Numbers equally spaced in the logarithm, at least `per_decade` per decade, with both ends.
fn log_spaced([first, last]: [f64; 2], per_decade: f64) -> impl Iterator<Item = f64> {
    let log_ratio = (last / first).ln();
    let n = (per_decade * log_ratio / LN_10).ceil();
    let part = move |k: &f64| k / n;
    let indices = std::iter::successors(Some(0.0), |k| Some(k + 1.0));
    let parts = indices.take_while(move |k| *k <= n);
    parts.map(move |k| first * (log_ratio * part(&k)).exp())
}

/// A relaxation function and its range of times.
struct RelaxationFunction<'a> {
    /// Relaxation modulus \[Pa] at a time \[s].
    relaxation_modulus: &'a dyn Fn(f64) -> f64,
    /// Shortest and longest time, \[s].
    time_range: [f64; 2],
}

/// The end of the sampled times on one side, and the effect of the neglected tail.
struct Tail {
    /// First or last sampled time, \[s].
    time: f64,
    /// Estimated change of G* by the neglected tail, relative to G at the end of the range.
    error: f64,
}

impl RelaxationFunction<'_> {
    /// How far beyond an `end` of the range to sample G(t) so that the neglected tail changes G*(1/end) by less than
    /// `tolerance`.
    ///
    /// A change of G at the time t contributes to G*(1/end) with the factor t/end before the range, or end/t after it.
    /// `factor` is 0.1 before the range and 10 after it.
    fn tail(&self, end: f64, factor: f64, tolerance: f64) -> Tail {
        let modulus = |decade: i32| (self.relaxation_modulus)(end * factor.powi(decade));
        let effect = |decade: i32| {
            let change = modulus(decade + 1) - modulus(decade);
            (change / modulus(0)).abs() * 0.1_f64.powi(decade)
        };
        // Estimate the sum of the effects from this decade on by a geometric series, whose ratio is that of two decades.
        let tail = |decade: i32| {
            let [this, next] = [effect(decade), effect(decade + 1)];
            let falls = this > next;
            if falls {
                this * this / (this - next)
            } else {
                this + next
            }
        };
        let decades = 1..MAX_TAIL_DECADES;
        let found = decades.clone().find(|&decade| {
            let falls_or_nothing = effect(decade + 1) <= effect(decade);
            falls_or_nothing && tail(decade) <= tolerance
        });
        let decade = found.unwrap_or(MAX_TAIL_DECADES);
        Tail {
            time: end * factor.powi(decade),
            error: tail(decade),
        }
    }

    /// Samples of the function between two times \[s], equally spaced in the logarithm.
    fn samples(&self, ends: [f64; 2]) -> Vec<RelaxationPoint> {
        let point = |time| RelaxationPoint {
            time,
            modulus: (self.relaxation_modulus)(time),
        };
        log_spaced(ends, SAMPLES_PER_DECADE).map(point).collect()
    }

    /// Samples as a curve for the fit.
    ///
    /// Errors are relative to G. After the range the scale is at least that of the effect on G*(1/longest), because the
    /// function of a fluid vanishes.
    fn curve(&self, samples: &[RelaxationPoint]) -> Result<MeasuredCurve, RheologyError> {
        let [_, longest] = self.time_range;
        let last = (self.relaxation_modulus)(longest);
        MeasuredCurve::relaxation_with_sizes(samples, |point| {
            let min_size = last * longest / point.time;
            if point.time <= longest {
                point.modulus
            } else {
                point.modulus.max(min_size)
            }
        })
    }

    /// Largest relative error of G at the samples within the range, and of G* at its frequencies.
    fn error_of(
        &self,
        series: &RelaxationSpectrum,
        samples: &[RelaxationPoint],
    ) -> Result<f64, RheologyError> {
        let [shortest, longest] = self.time_range;
        let mut worst = 0.0_f64;
        // Compute the errors of G(t) at the samples, and the largest of them relative to G(t) within the range.
        let mut differences = Vec::new();
        for point in samples {
            let difference = point.modulus - series.relaxation_modulus(point.time)?;
            differences.push([point.time, difference]);
            if (shortest..=longest).contains(&point.time) {
                worst = worst.max((difference / point.modulus).abs());
            }
        }
        // Compute the relative errors of G* at the frequencies of the range. The exact G* is the sum of that of the series and
        // the difference.
        for time in log_spaced(self.time_range, SAMPLES_PER_DECADE) {
            let omega = time.recip();
            let [storage, loss] = modulus_difference(&differences, omega);
            let found = series.complex_modulus(omega)?;
            let exact = (found.storage + storage).hypot(found.loss + loss);
            worst = worst.max(storage.hypot(loss) / exact);
        }
        Ok(worst)
    }
}

/// Real and imaginary part of ΔG*(ω) \[Pa] at an angular frequency \[rad/s], from pairs of time \[s] and ΔG \[Pa].
fn modulus_difference(differences: &[[f64; 2]], omega: f64) -> [f64; 2] {
    let mut sum = [differences[0][1], 0.0];
    for pair in differences.windows(2) {
        let [[start, before], [end, after]] = [pair[0], pair[1]];
        let half = 0.5 * omega * (end - start);
        let amplitude = (after - before) * if half > 0.0 { half.sin() / half } else { 1.0 };
        let (sine, cosine) = (0.5 * omega * (start + end)).sin_cos();
        sum[0] += amplitude * cosine;
        sum[1] -= amplitude * sine;
    }
    sum
}
