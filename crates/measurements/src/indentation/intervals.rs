//! Covariance and confidence intervals of the parameters of a fit.
//!
//! ```text
//! covariance = (JᵀJ)⁻¹ Jᵀ V J (JᵀJ)⁻¹
//! profile:     min Σr² with one parameter fixed − min Σr² = 3.84 v Σr²/(n − p)
//! ```
//! Residuals r of outliers are replaced by those of their neighbours. V is the covariance of the points, averaged over the
//! posterior distribution of the noise. The factor v is the ratio of the variance of the parameter to that for independent
//! points. The error of a smoothed depth is added to both.

use numerics::Estimate;
use numerics::least_squares::{IntervalEnd, Minimum, inverse, profile_end};

use super::IndentationCurve;
use super::model::{Forces, Kind, Model};
use super::noise::{DIAGONAL_FACTOR, Linear, Noise, correlated_points, normal_matrix};
use super::search::Found;
use crate::{Finding, MeasurementError};

/// Two-sided 95 % quantile of the standard normal distribution: half the length of a 95 % interval in standard deviations.
const NORMAL_QUANTILE: f64 = 1.959_963_984_540_054;
/// Largest standard error of a logarithm with which its interval follows from the covariance. Chosen: the interval then
/// extends by a factor of e^(1.96 · 0.4) = 2.2 either way. Wider intervals are asymmetric, and follow from the profile of
/// the sum of squares.
const MAX_COVARIANCE_DEVIATION: f64 = 0.4;
/// Largest ratio of the upper to the lower end of an interval with which a modulus, time or thickness counts as determined.
/// Chosen: its order of magnitude is then known. Beyond this ratio the standard error of the logarithm exceeds 0.6.
const MAX_INTERVAL_RATIO: f64 = 10.0;
/// Relative tolerance of the rise of the sum of squares at an end of an interval from its profile. Chosen: the sum is nearly
/// quadratic in the parameter, so that 1 % of the rise move an end by 0.5 % of its distance from the best fit.
const PROFILE_TOLERANCE: f64 = 0.01;
/// Ratio of the shift of the depth at a knot, in a difference quotient of the forces, to the range of depths. Chosen: forces
/// are linear over so small a shift, and their differences far above rounding.
const KNOT_SHIFT: f64 = 1e-4;

/// Covariance of the parameters and statistics of the residuals.
pub(super) struct Statistics {
    /// Number of parameters.
    n: usize,
    /// Covariance matrix of the parameters (of logarithms where they are fitted as such), row by row.
    covariance: Vec<f64>,
    /// Rise of the sum at the ends of the interval of each parameter.
    rises: Vec<f64>,
    /// Number of correlated points per independent one, at least 1.
    pub(super) correlated_points: f64,
    /// Root mean square error of the force due to that of a smoothed depth, \[N].
    pub(super) path_error: f64,
    /// Residuals, derivatives and contact forces at the minimum.
    pub(super) forces: Forces,
}

impl Statistics {
    /// Covariance and statistics at a minimum, by the formula at the head of this file.
    pub(super) fn of(found: &Found) -> Result<Self, MeasurementError> {
        let forces = found.model.forces(&found.parameters)?;
        let n = found.parameters.len();
        let squares = &found.squares;
        let known = squares.weighted(&squares.without_outliers(&forces.residuals));
        let sum: f64 = known.iter().map(|one| one * one).sum();
        let variance = sum / (known.len() - n) as f64;
        let rows: Vec<Vec<f64>> = forces
            .rows
            .iter()
            .map(|row| squares.weighted(row))
            .collect();
        let mut matrix = normal_matrix(&rows);
        (0..n).for_each(|k| matrix[k * (n + 1)] *= DIAGONAL_FACTOR);
        let inverse = inverse(&matrix, n).unwrap_or_else(|| vec![f64::INFINITY; n * n]);
        let unscaled = matrix_product(
            &inverse,
            &matrix_product(&noise_product(found, &rows), &inverse, n),
            n,
        );
        let (path_error, path_covariance) = path_covariance(found, &forces, &rows, &inverse)?;
        let pairs = unscaled.iter().zip(path_covariance);
        let covariance: Vec<f64> = pairs.map(|(entry, path)| variance * entry + path).collect();
        let rise = |k: usize| {
            let diagonal = k * (n + 1);
            let ratio = covariance[diagonal] / inverse[diagonal];
            // If parameters are not identifiable, rounding decides the sign of this ratio; then the variance without it is used.
            let is_known = ratio.is_finite() && ratio > 0.0;
            let ratio = if is_known { ratio } else { variance };
            NORMAL_QUANTILE * NORMAL_QUANTILE * ratio
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

    /// Standard error of the parameter with this index, or of its logarithm.
    fn deviation(&self, parameter: usize) -> f64 {
        self.covariance[parameter * (self.n + 1)].sqrt()
    }

    /// Correlation matrix of the parameters as a list of rows; entries that are not finite are 0.
    pub(super) fn correlation(&self) -> Vec<Vec<f64>> {
        let entry = |j: usize, k: usize| {
            let entry = self.covariance[j * self.n + k] / self.deviation(j) / self.deviation(k);
            if entry.is_finite() { entry } else { 0.0 }
        };
        let row = |j: usize| (0..self.n).map(|k| entry(j, k)).collect();
        (0..self.n).map(row).collect()
    }

    /// Estimates and intervals of all parameters; `profile` requests all intervals from the profile of the sum.
    pub(super) fn findings(&self, found: &Found, profile: bool) -> Vec<Finding> {
        let finding = |parameter: usize| self.finding(found, parameter, profile);
        let mut findings: Vec<Finding> = (0..self.n).map(finding).collect();
        if let Kind::Branches(n) = found.model.kind {
            (0..n).for_each(|branch| open_split(&mut findings, branch));
        }
        findings
    }

    /// Estimate and 95 % interval of a parameter. There is no estimate if an end is open, or if the ends of a logarithm are
    /// more than a factor [`MAX_INTERVAL_RATIO`] apart.
    fn finding(&self, found: &Found, parameter: usize, profile: bool) -> Finding {
        let is_logarithm = found.model.is_logarithm(parameter);
        let [value, deviation] = [found.parameters[parameter], self.deviation(parameter)];
        let wide = is_logarithm && (deviation > MAX_COVARIANCE_DEVIATION || deviation.is_nan());
        let ends = [-1.0, 1.0].map(|side| {
            if profile || wide {
                self.profile_end(found, parameter, side)
            } else {
                Some(value + side * NORMAL_QUANTILE * deviation).filter(|end| end.is_finite())
            }
        });
        let shown = |value: f64| if is_logarithm { value.exp() } else { value };
        let slope = if is_logarithm { value.exp() } else { 1.0 };
        let bounds = ends.map(|end| end.map(shown));
        // State half the interval divided by the normal quantile as the error, if the interval follows from the profile and not
        // from the covariance.
        let error = match bounds {
            [Some(lower), Some(upper)] if profile || wide => {
                (upper - lower) / (2.0 * NORMAL_QUANTILE)
            }
            _ => slope * deviation,
        };
        let value = shown(value);
        let is_narrow = match bounds {
            [Some(lower), Some(upper)] => !is_logarithm || upper <= MAX_INTERVAL_RATIO * lower,
            _ => false,
        };
        let is_determined = is_narrow && error.is_finite();
        let (name, unit) = name_and_unit(&found.model, parameter);
        Finding {
            name,
            unit,
            estimate: is_determined.then_some(Estimate::new(value, error)),
            interval: bounds,
        }
    }

    /// Value of a parameter, below (`side` −1) or above (1) the minimum, at which the sum minimised over all others has risen
    /// as required; `None` if it does not within the range.
    fn profile_end(&self, found: &Found, parameter: usize, side: f64) -> Option<f64> {
        let best = Minimum {
            model: found.linearise(&found.parameters)?,
            parameters: found.parameters.clone(),
        };
        let interval_end = IntervalEnd {
            parameter,
            side,
            rise: self.rises[parameter],
            initial_step: NORMAL_QUANTILE * self.deviation(parameter),
            relative_tolerance: PROFILE_TOLERANCE,
        };
        let sum = |parameters: &[f64]| found.linearise(parameters);
        profile_end(sum, &best, &found.ranges, interval_end)
    }
}

/// Opens the intervals of moduli that a relaxation time without a bound leaves undetermined.
///
/// A branch that relaxes after the end of the curve may have any larger modulus, at the cost of the equilibrium modulus. For
/// a branch that relaxes before its first step, only G τ is determined.
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

/// Matrix JᵀVJ, row by row, averaged over the noises by their probabilities. `rows` is J in units of the standard deviation of
/// each point, and V is the covariance in these units, 1 for white noise.
fn noise_product(found: &Found, rows: &[Vec<f64>]) -> Vec<f64> {
    let n = rows.len();
    let Linear { time, counts, .. } = found.linear;
    let white = Noise::WHITE.likelihood(&found.linear).variance();
    let weighted = |values: &Vec<f64>| -> Vec<f64> {
        let pairs = values.iter().zip(counts);
        pairs.map(|(value, count)| value * count.sqrt()).collect()
    };
    let columns: Vec<Vec<f64>> = rows.iter().map(weighted).collect();
    let mut noise_product = vec![0.0; n * n];
    for &(noise, weight) in &found.noises {
        let variance = noise.likelihood(&found.linear).variance();
        let factor = weight * variance / white;
        for (k, column) in columns.iter().enumerate() {
            let spread = noise.covariance(time, counts, column);
            for (j, other) in columns.iter().enumerate() {
                let product: f64 = other.iter().zip(&spread).map(|(a, b)| a * b).sum();
                noise_product[j * n + k] += factor * product;
            }
        }
    }
    noise_product
}

/// Product of two matrices of `n` rows and columns, row by row.
fn matrix_product(one: &[f64], other: &[f64], n: usize) -> Vec<f64> {
    let entry = |at: usize| {
        (0..n)
            .map(|k| one[at / n * n + k] * other[k * n + at % n])
            .sum()
    };
    (0..n * n).map(entry).collect()
}

/// Product of a matrix, row by row, with a vector.
fn matrix_vector(matrix: &[f64], vector: &[f64]) -> Vec<f64> {
    let rows = matrix.chunks(vector.len());
    rows.map(|row| row.iter().zip(vector).map(|(a, b)| a * b).sum())
        .collect()
}

/// Effect of the error of a smoothed depth: root mean square error of the force \[N], and covariance of the parameters, row by
/// row. Both are 0 if the depth was not smoothed. `rows` and `inverse` are J in units of the noise and (JᵀJ)⁻¹.
fn path_covariance(
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
    // Raise the smoothed depth around one knot after the other. Differences give the changes of the residuals, and linear least
    // squares those of the parameters.
    let [low, high] = super::depth::min_max(&curve.depth);
    let shift = KNOT_SHIFT * (high - low);
    let mut effects = vec![Vec::new(); n];
    let mut slopes = vec![Vec::new(); curve.time.len()];
    for knot in 0..path.len() {
        let places = curve.depth.iter().zip(&curve.time);
        let moved = places.map(|(depth, time)| depth + shift * path.hat_function(knot, *time));
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
        let effect = matrix_vector(
            inverse,
            &matrix_vector(&rows.concat(), &found.squares.weighted(&forces)),
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
    // Propagate the covariance of the knots to the parameters, and to the force of each point.
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

/// Name and unit of the parameter with this index.
fn name_and_unit(model: &Model, parameter: usize) -> (String, &'static str) {
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
