//! How far the parameters of a fit are known.
//!
//! ```text
//! covariance = κ s² (JᵀJ)⁻¹,   κ = τ n/(n − p) mean ψ²/(mean ψ')²     (Huber & Ronchetti 2009, Sect. 7.6)
//! profile:  least Σρ with one parameter held − least Σρ = 3.84 τ n/(n − p) mean ψ²/mean ψ'
//! ```
//! with the loss ρ, ψ = ρ'/2, and τ points for every independent one, by the correlation of neighbouring ψ.

use numerics::Estimate;
use numerics::least_squares::{inverse, minimise};

use super::Finding;
use super::model::{Forces, Kind};
use super::search::{Found, HUBER};
use crate::mdr_core::MdrError;

/// 95 % of a normal distribution are within so many standard deviations.
const NORMAL: f64 = 1.959_963_984_540_054;
/// A logarithm with a larger standard error wants a profile.
const WIDE: f64 = 0.4;
/// Steps of the search for an end of a profile, and how close its distance has to be.
const STEPS: usize = 20;
const CLOSE: f64 = 0.01;

pub(super) struct Statistics {
    n: usize,
    covariance: Vec<f64>,
    /// Rise of the sum at the ends of an interval.
    rise: f64,
    pub(super) correlated_points: f64,
    pub(super) forces: Forces,
}

impl Statistics {
    pub(super) fn of(found: &Found) -> Result<Self, MdrError> {
        let forces = found.model.forces(&found.parameters)?;
        let n = found.parameters.len();
        let residuals = forces.residuals.iter();
        let psi = residuals.map(|one| (one / found.scale).clamp(-HUBER, HUBER));
        let psi: Vec<f64> = psi.collect();
        let n_points = psi.len() as f64;
        let square = psi.iter().map(|psi| psi * psi).sum::<f64>() / (n_points - n as f64);
        let curvature = psi.iter().filter(|psi| psi.abs() < HUBER).count() as f64 / n_points;
        let correlated_points = correlated_points(&psi);
        let dot = |at: usize| {
            let pairs = forces.rows[at / n].iter().zip(&forces.rows[at % n]);
            // A little more on the diagonal keeps what is not determined finite, and very wide.
            let ridge = if at / n == at % n { 1.0 + 1e-12 } else { 1.0 };
            ridge * pairs.map(|(a, b)| a * b).sum::<f64>()
        };
        let matrix: Vec<f64> = (0..n * n).map(dot).collect();
        let factor = correlated_points * square * (found.scale / curvature).powi(2);
        let covariance = inverse(&matrix, n).unwrap_or_else(|| vec![f64::INFINITY; n * n]);
        Ok(Self {
            n,
            covariance: covariance.iter().map(|entry| factor * entry).collect(),
            rise: NORMAL * NORMAL * correlated_points * square / curvature,
            correlated_points,
            forces,
        })
    }

    fn deviation(&self, parameter: usize) -> f64 {
        self.covariance[parameter * (self.n + 1)].sqrt()
    }

    pub(super) fn correlation(&self) -> Vec<Vec<f64>> {
        let entry = |j: usize, k: usize| {
            let entry = self.covariance[j * self.n + k] / self.deviation(j) / self.deviation(k);
            if entry.is_finite() { entry } else { 0.0 }
        };
        let row = |j: usize| (0..self.n).map(|k| entry(j, k)).collect();
        (0..self.n).map(row).collect()
    }

    pub(super) fn findings(&self, found: &Found, profile: bool) -> Vec<Finding> {
        let finding = |parameter: usize| self.finding(found, parameter, profile);
        (0..self.n).map(finding).collect()
    }

    fn finding(&self, found: &Found, parameter: usize, profile: bool) -> Finding {
        let is_logarithm = found.model.kind.is_logarithm(parameter);
        let [value, deviation] = [found.parameters[parameter], self.deviation(parameter)];
        let wide = is_logarithm && (deviation > WIDE || deviation.is_nan());
        let ends = [-1.0, 1.0].map(|side| {
            if profile || wide {
                self.profile_end(found, parameter, side)
            } else {
                Some(value + side * NORMAL * deviation).filter(|end| end.is_finite())
            }
        });
        let shown = |value: f64| if is_logarithm { value.exp() } else { value };
        let slope = if is_logarithm { value.exp() } else { 1.0 };
        let (value, error) = (shown(value), slope * deviation);
        let is_determined = ends.iter().all(Option::is_some) && error.is_finite();
        let (name, unit) = name(found.model.kind, parameter);
        Finding {
            name,
            unit,
            estimate: is_determined.then_some(Estimate::new(value, error)),
            interval: ends.map(|end| end.map(shown)),
        }
    }

    /// Where the least sum with a parameter held has risen; none up to the bound of its range.
    fn profile_end(&self, found: &Found, parameter: usize, side: f64) -> Option<f64> {
        let best = &found.parameters;
        let least = found.linearised(best)?.sum;
        let rise = |place: f64| {
            let mut ranges = found.ranges.clone();
            ranges[parameter].bounds = [place; 2];
            // Not from where another place has led, which may be another minimum.
            let mut start = best.clone();
            start[parameter] = place;
            let sum = |parameters: &[f64]| found.linearised(parameters);
            let held = minimise(sum, start, &ranges, 3e-3 * self.rise / least);
            let held = held.map(|held| held.linearised.sum);
            // Nearly linear in the distance from the best one; where there is no force, the end is before.
            held.map_or(f64::INFINITY, |sum| (sum - least).max(0.0) / self.rise)
                .sqrt()
        };
        let range = found.ranges[parameter];
        let end = range.bounds[usize::from(side > 0.0)];
        let room = side * (end - best[parameter]);
        let [mut inner, mut outer] = [[0.0; 2], [f64::INFINITY; 2]];
        let step = NORMAL * self.deviation(parameter);
        let mut step = step.min(range.largest_step).min(room);
        for _ in 0..STEPS {
            let at = rise(best[parameter] + side * step);
            if (at - 1.0).abs() < CLOSE {
                return Some(best[parameter] + side * step);
            }
            if at < 1.0 && step >= room {
                return None;
            }
            *(if at < 1.0 { &mut inner } else { &mut outer }) = [step, at];
            let part = (1.0 - inner[1]) / (outer[1] - inner[1]);
            step = if outer[0].is_infinite() {
                (2.0 * step).min(room)
            } else if outer[1].is_infinite() {
                0.5 * (inner[0] + outer[0])
            } else {
                inner[0] + part.clamp(0.02, 0.98) * (outer[0] - inner[0])
            };
        }
        // The nearest place where the sum has certainly risen enough.
        Some(best[parameter] + side * outer[0]).filter(|end| end.is_finite())
    }
}

/// 1 + 2 Σ of the correlations at the lags up to five times that sum (Sokal 1997, Sect. 3), at least 1.
fn correlated_points(values: &[f64]) -> f64 {
    let product = |lag: usize| {
        let pairs = values.iter().zip(&values[lag..]);
        pairs.map(|(one, other)| one * other).sum::<f64>()
    };
    let square = product(0);
    let mut sum = 1.0_f64;
    for lag in 1..values.len() {
        sum += 2.0 * product(lag) / square;
        if lag as f64 >= 5.0 * sum {
            break;
        }
    }
    if sum.is_finite() { sum.max(1.0) } else { 1.0 }
}

/// Name and unit of a parameter.
fn name(kind: Kind, parameter: usize) -> (String, &'static str) {
    let material = kind.n_parameters();
    let named = |name: &str, unit| (name.to_owned(), unit);
    match (kind, parameter) {
        (Kind::PowerLaw, 0) => named("G_1s", "Pa"),
        (Kind::PowerLaw, 1) => named("beta", ""),
        (Kind::Branches(_), 0) => named("G_inf", "Pa"),
        (_, place) if place == material => named("contact_point", "m"),
        (_, place) if place == material + 1 => named("baseline", "N"),
        (_, place) if place == material + 2 => named("tilt", "N/m"),
        (_, place) if place % 2 == 1 => (format!("G_{}", place.div_ceil(2)), "Pa"),
        (_, place) => (format!("tau_{}", place.div_ceil(2)), "s"),
    }
}
