//! The Prony series that stands for a relaxation function, with its error.
//!
//! G* at one frequency depends on all times, so the function is sampled beyond the range of times that matters, until the rest
//! matters no more. The difference ΔG of function and series gives that of the moduli: with ΔG linear between samples t_0,
//! t_1, … and constant beyond them,
//!
//! ```text
//! ΔG*(ω) = iω ∫ ΔG e^(−iωt) dt = ΔG(t_0) + Σ [ΔG(t_k+1) − ΔG(t_k)] e^(−iωm) sin(ωh)/(ωh)
//! ```
//! where m is the middle and 2h the length of the interval from t_k to t_k+1.

use std::f64::consts::LN_10;

use super::curve::{MeasuredCurve, RelaxationPoint};
use super::identify::{Control, Ending, IdentifyOptions, MAX_BRANCHES, series_of};
use crate::fractional::{PronyExpansion, validate};
use crate::{RelaxationSpectrum, RheologyError};

/// Branches per decade that are tried.
const DENSITIES: [f64; 7] = [1.0, 2.0, 3.0, 4.0, 6.0, 8.0, 12.0];
const SAMPLES_PER_DECADE: f64 = 32.0;
/// Part of the error that may come from times that are not sampled.
const BEYOND: f64 = 0.1;
const MAX_DECADES_BEYOND: i32 = 30;

/// The series that is within `relative_error` of a relaxation function G(t) \[Pa] over a range of times, the shortest and
/// the longest for which it is needed \[s]: in G(t) there, and in G* at the frequencies 1/t.
///
/// The function is asked for times beyond the range too, as far as they matter for G*. It must fall as that of a material
/// does, as a sum or an integral of decaying exponentials.
///
/// # Errors
/// [`RheologyError::InvalidParameter`] when the range is empty or the error outside 1e-12 to 0.1;
/// [`RheologyError::InvalidElement`] for a sample that is not finite, or not greater than 0 within the range;
/// [`RheologyError::ExpansionNotReached`] when the function is that of no material, when it is as sharp as a single
/// exponential, or when rounding is larger than the error asked for; [`RheologyError::FitNotConverged`].
pub fn expand(
    relaxation_modulus: &dyn Fn(f64) -> f64,
    time_range: [f64; 2],
    relative_error: f64,
) -> Result<PronyExpansion, RheologyError> {
    let [shortest, longest] = time_range;
    validate([longest.recip(), shortest.recip()], relative_error)?;
    let law = Law {
        relaxation_modulus,
        time_range,
    };
    let [(first, before), (last, after)] = [(shortest, 0.1), (longest, 10.0)]
        .map(|(end, factor)| law.rest(end, factor, BEYOND * relative_error));
    let samples = law.samples([first, last]);
    let curve = law.curve(&samples)?;
    let mut reached = f64::INFINITY;
    for per_decade in DENSITIES {
        let n_branches = spaced([first, last], per_decade).count();
        if n_branches > MAX_BRANCHES {
            break;
        }
        let spectrum = series_of(&curve, &equally_spaced(n_branches))?.spectrum;
        let error = law.error_of(&spectrum, &samples)? + before + after;
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

const fn equally_spaced(n_branches: usize) -> IdentifyOptions {
    IdentifyOptions {
        ending: Ending::Solid,
        control: Control::Smooth {
            n_branches,
            weight: 0.0,
        },
    }
}

/// Numbers equally spaced in the logarithm, at least so many in every decade, with both ends.
fn spaced([first, last]: [f64; 2], per_decade: f64) -> impl Iterator<Item = f64> {
    let log_ratio = (last / first).ln();
    let n = (per_decade * log_ratio / LN_10).ceil();
    let part = move |k: &f64| k / n;
    let indices = std::iter::successors(Some(0.0), |k| Some(k + 1.0));
    let parts = indices.take_while(move |k| *k <= n);
    parts.map(move |k| first * (log_ratio * part(&k)).exp())
}

/// A relaxation function, and the times for which it is needed.
struct Law<'a> {
    relaxation_modulus: &'a dyn Fn(f64) -> f64,
    time_range: [f64; 2],
}

impl Law<'_> {
    /// The first time after decades beyond an end of the range whose rest adds less than a tolerance to the modulus at 1/end,
    /// and this rest, relative to G at the end: of a change of G at t, G*(1/end) feels the part t/end, or end/t.
    fn rest(&self, end: f64, factor: f64, tolerance: f64) -> (f64, f64) {
        let modulus = |decade: i32| (self.relaxation_modulus)(end * factor.powi(decade));
        let felt = |decade: i32| {
            let change = modulus(decade + 1) - modulus(decade);
            (change / modulus(0)).abs() * 0.1_f64.powi(decade)
        };
        // The changes of all decades from this one on, if they go on to fall in this ratio.
        let rest = |decade: i32| {
            let [this, next] = [felt(decade), felt(decade + 1)];
            let falls = this > next;
            if falls {
                this * this / (this - next)
            } else {
                this + next
            }
        };
        let decades = 1..MAX_DECADES_BEYOND;
        let found = decades.clone().find(|&decade| {
            let falls_or_nothing = felt(decade + 1) <= felt(decade);
            falls_or_nothing && rest(decade) <= tolerance
        });
        let decade = found.unwrap_or(MAX_DECADES_BEYOND);
        (end * factor.powi(decade), rest(decade))
    }

    fn samples(&self, ends: [f64; 2]) -> Vec<RelaxationPoint> {
        let point = |time| RelaxationPoint {
            time,
            modulus: (self.relaxation_modulus)(time),
        };
        spaced(ends, SAMPLES_PER_DECADE).map(point).collect()
    }

    /// Errors within the range and before it are relative to G; after it to what G*(1/longest) feels of them, if that is larger,
    /// because the function of a fluid vanishes.
    fn curve(&self, samples: &[RelaxationPoint]) -> Result<MeasuredCurve, RheologyError> {
        let [_, longest] = self.time_range;
        let last = (self.relaxation_modulus)(longest);
        MeasuredCurve::relaxing(samples, |point| {
            let felt = last * longest / point.time;
            if point.time <= longest {
                point.modulus
            } else {
                point.modulus.max(felt)
            }
        })
    }

    /// The largest relative error of G at the samples within the range, and of G* at its frequencies.
    fn error_of(
        &self,
        series: &RelaxationSpectrum,
        samples: &[RelaxationPoint],
    ) -> Result<f64, RheologyError> {
        let [shortest, longest] = self.time_range;
        let mut worst = 0.0_f64;
        let mut differences = Vec::new();
        for point in samples {
            let difference = point.modulus - series.relaxation_modulus(point.time)?;
            differences.push([point.time, difference]);
            if (shortest..=longest).contains(&point.time) {
                worst = worst.max((difference / point.modulus).abs());
            }
        }
        for time in spaced(self.time_range, SAMPLES_PER_DECADE) {
            let omega = time.recip();
            let [storage, loss] = transformed(&differences, omega);
            let found = series.complex_modulus(omega)?;
            let exact = (found.storage + storage).hypot(found.loss + loss);
            worst = worst.max(storage.hypot(loss) / exact);
        }
        Ok(worst)
    }
}

/// Real and imaginary part of ΔG*(ω), of pairs of time and ΔG.
fn transformed(differences: &[[f64; 2]], omega: f64) -> [f64; 2] {
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
