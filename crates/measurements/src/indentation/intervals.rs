//! How far the parameters of a fit are known.
//!
//! ```text
//! covariance = (JᵀJ)⁻¹ Jᵀ V J (JᵀJ)⁻¹
//! profile:     least Σr² with one parameter held − least Σr² = 3.84 v Σr²/(n − p)
//! ```
//! with the residuals r, of wild points those of their neighbours, the covariance V of the points, which is the mean over all
//! noises that are likely, and v, by how much the variance of the parameter is larger than if they were independent. The error
//! of a smoothed depth is added to both.

use numerics::Estimate;
use numerics::least_squares::{IntervalEnd, Minimum, inverse, profile_end};

use super::IndentationCurve;
use super::model::{Forces, Kind, Model};
use super::noise::{Linear, Noise, RIDGE, correlated_points, normal_matrix};
use super::search::Found;
use crate::{Finding, MeasurementError};

/// 95 % of a normal distribution are within so many standard deviations.
const NORMAL: f64 = 1.959_963_984_540_054;
/// A logarithm with a larger standard error wants a profile.
const WIDE: f64 = 0.4;
/// Largest ratio of the ends of an interval within which a modulus, a time or a thickness is determined: beyond it the standard error of
/// the logarithm is above 0.6, and a value would be an arbitrary one of the interval. Chosen.
const UNDETERMINED: f64 = 10.0;
/// How close the distance of an end of a profile has to be.
const CLOSE: f64 = 0.01;
/// Part of the range of depths by which a knot is moved to see what it does.
const SHIFT: f64 = 1e-4;

pub(super) struct Statistics {
    n: usize,
    covariance: Vec<f64>,
    /// Rise of the sum at the ends of the interval of each parameter.
    rises: Vec<f64>,
    pub(super) correlated_points: f64,
    /// Root of the mean squared error of the force that comes from a smoothed depth, \[N].
    pub(super) path_error: f64,
    pub(super) forces: Forces,
}

impl Statistics {
    pub(super) fn of(found: &Found) -> Result<Self, MeasurementError> {
        let forces = found.model.forces(&found.parameters)?;
        let n = found.parameters.len();
        let squares = &found.squares;
        let known = squares.weighed(&squares.known(&forces.residuals));
        let sum: f64 = known.iter().map(|one| one * one).sum();
        let variance = sum / (known.len() - n) as f64;
        let rows: Vec<Vec<f64>> = forces.rows.iter().map(|row| squares.weighed(row)).collect();
        let mut matrix = normal_matrix(&rows);
        (0..n).for_each(|k| matrix[k * (n + 1)] *= RIDGE);
        let inverse = inverse(&matrix, n).unwrap_or_else(|| vec![f64::INFINITY; n * n]);
        let lasting = product(&inverse, &product(&middle(found, &rows), &inverse, n), n);
        let (path_error, of_path) = of_path(found, &forces, &rows, &inverse)?;
        let pairs = lasting.iter().zip(of_path);
        let covariance: Vec<f64> = pairs.map(|(entry, path)| variance * entry + path).collect();
        let rise = |k: usize| {
            let diagonal = k * (n + 1);
            let ratio = covariance[diagonal] / inverse[diagonal];
            // Where parameters cannot be told apart, rounding decides about the sign.
            let is_known = ratio.is_finite() && ratio > 0.0;
            let ratio = if is_known { ratio } else { variance };
            NORMAL * NORMAL * ratio
        };
        Ok(Self {
            n,
            rises: (0..n).map(rise).collect(),
            covariance,
            correlated_points: correlated_points(&known),
            path_error,
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
        let mut findings: Vec<Finding> = (0..self.n).map(finding).collect();
        if let Kind::Branches(n) = found.model.kind {
            (0..n).for_each(|branch| open_split(&mut findings, branch));
        }
        findings
    }

    fn finding(&self, found: &Found, parameter: usize, profile: bool) -> Finding {
        let is_logarithm = found.model.is_logarithm(parameter);
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
        let bounds = ends.map(|end| end.map(shown));
        // Where the interval is not that of the covariance, the error is what it says.
        let error = match bounds {
            [Some(lower), Some(upper)] if profile || wide => (upper - lower) / (2.0 * NORMAL),
            _ => slope * deviation,
        };
        let value = shown(value);
        let is_narrow = match bounds {
            [Some(lower), Some(upper)] => !is_logarithm || upper <= UNDETERMINED * lower,
            _ => false,
        };
        let is_determined = is_narrow && error.is_finite();
        let (name, unit) = name(&found.model, parameter);
        Finding {
            name,
            unit,
            estimate: is_determined.then_some(Estimate::new(value, error)),
            interval: bounds,
        }
    }

    /// Where the least sum with a parameter held has risen; none up to the bound of its range.
    fn profile_end(&self, found: &Found, parameter: usize, side: f64) -> Option<f64> {
        let best = Minimum {
            model: found.linearised(&found.parameters)?,
            parameters: found.parameters.clone(),
        };
        let interval_end = IntervalEnd {
            parameter,
            side,
            rise: self.rises[parameter],
            initial_step: NORMAL * self.deviation(parameter),
            relative_tolerance: CLOSE,
        };
        let sum = |parameters: &[f64]| found.linearised(parameters);
        profile_end(sum, &best, &found.ranges, interval_end)
    }
}

/// Opens the intervals of the moduli between which a relaxation time divides the stiffness, where that time has no bound: a branch that
/// relaxes after the curve has any modulus above what it has lost within it, at the cost of the spring, and one that relaxes before its
/// first step any modulus that G τ leaves.
fn open_split(findings: &mut [Finding], branch: usize) {
    let [modulus, time] = [2 * branch + 1, 2 * branch + 2];
    let [is_fast, is_slow] = findings[time].interval.map(|end| end.is_none());
    let mut open = |parameter: usize, side: usize| {
        findings[parameter].interval[side] = None;
        findings[parameter].estimate = None;
    };
    if is_fast || is_slow {
        open(modulus, 1);
    }
    if is_slow {
        open(0, 0);
    }
}

/// JᵀVJ, where V is 1 for white noise.
fn middle(found: &Found, rows: &[Vec<f64>]) -> Vec<f64> {
    let n = rows.len();
    let Linear { time, counts, .. } = found.linear;
    let white = Noise::WHITE.likelihood(&found.linear).variance();
    let weighed = |values: &Vec<f64>| -> Vec<f64> {
        let pairs = values.iter().zip(counts);
        pairs.map(|(value, count)| value * count.sqrt()).collect()
    };
    let columns: Vec<Vec<f64>> = rows.iter().map(weighed).collect();
    let mut middle = vec![0.0; n * n];
    for &(noise, weight) in &found.noises {
        let variance = noise.likelihood(&found.linear).variance();
        let factor = weight * variance / white;
        for (k, column) in columns.iter().enumerate() {
            let spread = noise.covariance(time, counts, column);
            for (j, other) in columns.iter().enumerate() {
                let product: f64 = other.iter().zip(&spread).map(|(a, b)| a * b).sum();
                middle[j * n + k] += factor * product;
            }
        }
    }
    middle
}

/// Of two square matrices.
fn product(one: &[f64], other: &[f64], n: usize) -> Vec<f64> {
    let entry = |at: usize| {
        (0..n)
            .map(|k| one[at / n * n + k] * other[k * n + at % n])
            .sum()
    };
    (0..n * n).map(entry).collect()
}

/// A matrix, row by row, times a vector.
fn times(matrix: &[f64], vector: &[f64]) -> Vec<f64> {
    let rows = matrix.chunks(vector.len());
    rows.map(|row| row.iter().zip(vector).map(|(a, b)| a * b).sum())
        .collect()
}

/// The error of the force that comes from that of a smoothed depth, and the covariance of what the fit makes of it.
fn of_path(
    found: &Found,
    forces: &Forces,
    rows: &[Vec<f64>],
    inverse: &[f64],
) -> Result<(f64, Vec<f64>), MeasurementError> {
    let n = rows.len();
    let curve = found.model.curve;
    let Some(path) = &found.measured.path else {
        return Ok((0.0, vec![0.0; n * n]));
    };
    let [low, high] = super::depth::ends(&curve.depth);
    let shift = SHIFT * (high - low);
    let mut effects = vec![Vec::new(); n];
    let mut slopes = vec![Vec::new(); curve.time.len()];
    for knot in 0..path.len() {
        let places = curve.depth.iter().zip(&curve.time);
        let moved = places.map(|(depth, time)| depth + shift * path.hat(knot, *time));
        let curve = IndentationCurve {
            depth: moved.collect(),
            ..curve.clone()
        };
        let model = Model {
            curve: &curve,
            ..found.model.clone()
        };
        let other = model.forces(&found.parameters)?.residuals;
        let pairs = other.iter().zip(&forces.residuals);
        let forces: Vec<f64> = pairs.map(|(other, own)| (own - other) / shift).collect();
        let effect = times(
            inverse,
            &times(&rows.concat(), &found.squares.weighed(&forces)),
        );
        slopes
            .iter_mut()
            .zip(forces)
            .for_each(|(all, one)| all.push(one));
        effects
            .iter_mut()
            .zip(effect)
            .for_each(|(all, one)| all.push(one));
    }
    let dot = |one: &[f64], other: &[f64]| one.iter().zip(other).map(|(a, b)| a * b).sum::<f64>();
    let spread: Vec<Vec<f64>> = effects
        .iter()
        .map(|one| path.covariance(one.clone()))
        .collect();
    let entries = (0..n * n)
        .map(|at| dot(&effects[at / n], &spread[at % n]))
        .collect();
    let squares = slopes
        .iter()
        .map(|one| dot(one, &path.covariance(one.clone())));
    let square = squares.sum::<f64>() / curve.time.len() as f64;
    Ok((square.sqrt(), entries))
}

/// Name and unit of a parameter.
fn name(model: &Model, parameter: usize) -> (String, &'static str) {
    let kind = model.kind;
    let material = kind.n_parameters();
    let named = |name: &str, unit| (name.to_owned(), unit);
    if model.thickness() == Some(parameter) {
        return named("thickness", "m");
    }
    match (kind, parameter) {
        (Kind::Branches(0), 0) => named("G", "Pa"),
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
