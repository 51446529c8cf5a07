//! Least squares, and intervals of the profile likelihood.
//!
//! ```text
//! S(θ) = Σ r_i² + s² (ln θ − m)ᵀ P (ln θ − m),    least S with θ_k held − least S = t² s²
//! ```
//! with residuals r in units of given standard errors (s = 1, t = 1.96), or else of ln μ or μ (s² the least Σ r² over the degrees
//! of freedom, t of Student's distribution), and a prior of the mean m and the precision P.

use numerics::Estimate;
use numerics::least_squares::{
    IntervalEnd, Minimum, ParameterRange, QuadraticModel, inverse, minimise_by_model, profile_end,
    student_quantile,
};

use super::{FreeParameter, FrictionModel, FrictionNoise, FrictionPoint, ModelledPoint, Prior};
use crate::{Finding, MeasurementError};

/// 95 % of a normal distribution are within so many standard deviations.
const NORMAL: f64 = 1.959_963_984_540_054;
const COVERAGE: f64 = 0.95;
/// How close the distance of an end of a profile has to be before it is interpolated.
const CLOSE: f64 = 0.1;
/// Fall of the sum, in variances of a point, by which the last step is taken by the model alone.
const ENOUGH: f64 = 0.05;
/// What noise is taken to be before the first fit, in parts of the friction.
const FIRST_NOISE: f64 = 0.05;
/// Standard deviations of χ² up to which a start is good.
const EXPLAINED: f64 = 3.0;
/// Rounds in which the size of the noise is found beside priors.
const ROUNDS: usize = 3;
/// Computations of the friction of all points with which the end of an interval is sought at most; it needs two to ten where the
/// parameter is determined.
const MOST_COMPUTATIONS: usize = 60;
/// Standard deviations of χ², or of the correlation of neighbours, from which residuals are no noise.
const SIGNIFICANT: f64 = 4.0;

/// Points and the parameters that are to explain them.
#[derive(Debug, Clone, Copy)]
pub struct FrictionFitting<'a> {
    points: &'a [FrictionPoint],
    parameters: &'a [FreeParameter],
    prior: Option<&'a Prior>,
    /// None where standard errors are given.
    noise: Option<FrictionNoise>,
}

/// What points say about parameters.
#[derive(Debug, Clone, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize))]
#[must_use]
pub struct FrictionFit {
    /// The parameters, in their order.
    pub findings: Vec<Finding>,
    /// Their values, also where they are not determined.
    pub values: Vec<f64>,
    /// Friction coefficients of the fit, by point.
    pub fitted: Vec<f64>,
    /// Standard deviation of the residuals: over the standard errors, where they are given, else relative to the friction, or of
    /// the friction.
    pub residual: f64,
    /// Degrees of freedom: points and priors less parameters.
    pub freedom: usize,
    /// What is doubtful about it.
    pub flags: Vec<String>,
}

impl<'a> FrictionFitting<'a> {
    /// The noise is that of the standard errors, where all points have one, and else of the kind that is named.
    ///
    /// # Errors
    /// [`MeasurementError::TooFewPoints`] where nothing is left to judge the noise by, and for no points at all.
    pub fn new(
        points: &'a [FrictionPoint],
        parameters: &'a [FreeParameter],
        prior: Option<&'a Prior>,
        noise: FrictionNoise,
    ) -> Result<Self, MeasurementError> {
        let is_given = points.iter().all(|point| point.standard_error.is_some());
        let fitting = Self {
            points,
            parameters,
            prior,
            noise: (!is_given).then_some(noise),
        };
        let unknown = parameters.len().saturating_sub(fitting.n_priors());
        let needed = unknown + usize::from(!is_given);
        if points.len() < needed.max(1) {
            return Err(MeasurementError::TooFewPoints {
                needed: needed.max(1),
                given: points.len(),
            });
        }
        Ok(fitting)
    }

    /// The same of some of the points.
    #[must_use]
    pub const fn of(&self, points: &'a [FrictionPoint]) -> Self {
        Self { points, ..*self }
    }

    fn n_priors(&self) -> usize {
        self.prior.map_or(0, |prior| prior.rank)
    }

    fn freedom(&self) -> usize {
        let known = self.points.len() + self.n_priors();
        known.saturating_sub(self.parameters.len())
    }

    /// The parameters of least squares nearest to a start; none where the model has no friction there.
    pub fn minimum(&self, model: &dyn FrictionModel, start: &[f64]) -> Option<FrictionMinimum> {
        let mut variance = self.first_variance();
        let mut start = start.to_vec();
        loop_rounds(
            if self.n_priors() > 0 && self.noise.is_some() {
                ROUNDS
            } else {
                1
            },
            || {
                let enough = ENOUGH * variance;
                let sum = |parameters: &[f64]| self.linearised(model, parameters, variance);
                let ranges = self.ranges();
                let minimum = minimise_by_model(sum, start.clone(), &ranges, enough)?;
                start.clone_from(&minimum.parameters);
                if self.noise.is_some() {
                    variance = minimum.model.sum / self.freedom().max(1) as f64;
                }
                Some(FrictionMinimum { minimum, variance })
            },
        )
    }

    /// The sum that is least at the minimum; none where the model has no friction.
    pub fn sum(&self, model: &dyn FrictionModel, parameters: &[f64]) -> Option<f64> {
        let linearised = self.linearised(model, parameters, self.first_variance())?;
        Some(linearised.sum).filter(|sum| sum.is_finite())
    }

    /// The root mean square residual of a minimum, with what a prior adds; `None` if it is not finite.
    pub fn mean_residual(&self, found: &FrictionMinimum) -> Option<f64> {
        let mean = found.minimum.model.sum / self.points.len() as f64;
        Some(mean.max(0.0).sqrt()).filter(|mean| mean.is_finite())
    }

    /// Whether a sum is that of noise: of the standard errors that are given, or of a twentieth of the friction.
    pub fn explains(&self, sum: f64) -> bool {
        let n = self.points.len() as f64;
        sum <= self.first_variance() * (n + EXPLAINED * (2.0 * n).sqrt())
    }

    fn first_variance(&self) -> f64 {
        let square = |point: &FrictionPoint| point.friction_coefficient.powi(2);
        let squares: f64 = self.points.iter().map(square).sum();
        match self.noise {
            None => 1.0,
            Some(FrictionNoise::Relative) => FIRST_NOISE * FIRST_NOISE,
            Some(FrictionNoise::Absolute) => {
                FIRST_NOISE * FIRST_NOISE * squares / self.points.len() as f64
            }
        }
    }

    fn ranges(&self) -> Vec<ParameterRange> {
        self.parameters.iter().map(|one| one.range).collect()
    }

    /// Residual and derivative of a point by the logarithm of its friction.
    fn residual(&self, point: &FrictionPoint, modelled: f64) -> [f64; 2] {
        let measured = point.friction_coefficient;
        let unit = match self.noise {
            None => point.standard_error.unwrap_or(f64::NAN),
            Some(FrictionNoise::Absolute) => 1.0,
            Some(FrictionNoise::Relative) => return [(measured / modelled).ln(), 1.0],
        };
        [(measured - modelled) / unit, modelled / unit]
    }

    fn linearised(
        &self,
        model: &dyn FrictionModel,
        parameters: &[f64],
        variance: f64,
    ) -> Option<QuadraticModel> {
        let modelled = model.friction(parameters)?;
        let rows = self.points.iter().zip(modelled).map(|(point, modelled)| {
            let ModelledPoint {
                friction_coefficient,
                slopes,
            } = modelled;
            let [residual, slope] = self.residual(point, friction_coefficient);
            let row = slopes.into_iter().map(|one| slope * one).collect();
            (residual, row)
        });
        let mut linearised = normal(rows, parameters.len());
        if let Some(prior) = self.prior {
            prior.add_to(&mut linearised, parameters, variance);
        }
        Some(linearised)
    }

    /// What the points say, about a minimum of the model; `watch` is called with the number of parameters whose intervals are
    /// known.
    ///
    /// # Errors
    /// [`MeasurementError::NotConverged`] where the model has no friction there.
    pub fn fit(
        &self,
        model: &dyn FrictionModel,
        found: &FrictionMinimum,
        watch: &dyn Fn(usize),
    ) -> Result<FrictionFit, MeasurementError> {
        let best = &found.minimum;
        let modelled = model.friction(&best.parameters);
        let modelled = modelled.ok_or(MeasurementError::NotConverged)?;
        let fitted: Vec<f64> = modelled
            .iter()
            .map(|one| one.friction_coefficient)
            .collect();
        let pairs = self.points.iter().zip(&fitted);
        let residuals: Vec<f64> = pairs
            .map(|(point, fitted)| self.residual(point, *fitted)[0])
            .collect();
        let freedom = self.freedom();
        let square: f64 = residuals.iter().map(|one| one * one).sum();
        let mut n_unfinished = 0;
        let findings = (0..self.parameters.len()).map(|k| {
            watch(k);
            self.finding(model, found, k, &mut n_unfinished)
        });
        let findings: Vec<Finding> = findings.collect();
        let mut flags = self.flags(&residuals, square, &best.parameters);
        if n_unfinished > 0 {
            flags.push(format!(
                "{n_unfinished} ends of intervals were not found in {MOST_COMPUTATIONS} computations of the friction each, and are left \
                 open: give fewer branches, more points, or a prior"
            ));
        }
        Ok(FrictionFit {
            findings,
            values: best.parameters.iter().map(|value| value.exp()).collect(),
            flags,
            residual: (square / freedom.max(1) as f64).sqrt(),
            fitted,
            freedom,
        })
    }

    /// The interval of a parameter; ends that take too long are counted, and left open.
    fn finding(
        &self,
        model: &dyn FrictionModel,
        found: &FrictionMinimum,
        k: usize,
        n_unfinished: &mut usize,
    ) -> Finding {
        let (best, variance) = (&found.minimum, found.variance);
        let n = self.parameters.len();
        let deviations = match self.noise {
            None => Some(NORMAL),
            Some(_) => student_quantile(COVERAGE, self.freedom()),
        };
        let deviations = deviations.unwrap_or(f64::INFINITY);
        let rise = deviations * deviations * variance;
        let deviation = inverse(&best.model.matrix, n).map_or(f64::INFINITY, |inverse| {
            (inverse[k * (n + 1)] * rise).sqrt()
        });
        let ranges = self.ranges();
        let ends = [-1.0, 1.0].map(|side| {
            let interval_end = IntervalEnd {
                parameter: k,
                side,
                rise,
                initial_step: deviation,
                relative_tolerance: CLOSE,
            };
            let mut n_computed = 0;
            let sum = |parameters: &[f64]| {
                n_computed += 1;
                let may_go_on = n_computed <= MOST_COMPUTATIONS;
                may_go_on.then(|| self.linearised(model, parameters, variance))?
            };
            let end = profile_end(sum, best, &ranges, interval_end).map(f64::exp);
            if n_computed > MOST_COMPUTATIONS {
                *n_unfinished += 1;
                return None;
            }
            end
        });
        let estimate = match ends {
            [Some(lower), Some(upper)] => Some(Estimate::new(
                best.parameters[k].exp(),
                (upper - lower) / (2.0 * deviations),
            )),
            _ => None,
        };
        Finding {
            name: self.parameters[k].name.clone(),
            unit: self.parameters[k].unit,
            estimate,
            interval: ends,
        }
    }

    /// Residuals that are no noise.
    fn flags(&self, residuals: &[f64], square: f64, parameters: &[f64]) -> Vec<String> {
        let mut flags = Vec::new();
        if let Some(prior) = self.prior
            && let n = prior.rank as f64
            && let distance = prior.squared_distance(parameters)
            && distance > n + SIGNIFICANT * (2.0 * n).sqrt()
        {
            let ratio = (distance / n).sqrt();
            flags.push(format!(
                "the parameters are {ratio:.1} times as far from what was known of them as its errors allow: friction and prior \
                 contradict each other, and the intervals do not hold"
            ));
        }
        let freedom = self.freedom() as f64;
        if self.noise.is_none() && square > freedom + SIGNIFICANT * (2.0 * freedom).sqrt() {
            let ratio = (square / freedom).sqrt();
            flags.push(format!(
                "the residuals are {ratio:.1} times as large as the standard errors: the model does not explain the points, \
                 or the errors are too small, and the intervals do not hold"
            ));
        }
        let mut order: Vec<usize> = (0..residuals.len()).collect();
        order.sort_by(|&one, &other| {
            let speed = |at: usize| self.points[at].velocity;
            speed(one).total_cmp(&speed(other))
        });
        let neighbours = order.windows(2);
        let products: f64 = neighbours
            .map(|pair| residuals[pair[0]] * residuals[pair[1]])
            .sum();
        let correlation = products / square;
        if correlation > SIGNIFICANT / (residuals.len() as f64).sqrt() {
            flags.push(format!(
                "the residuals of neighbouring speeds go together (correlation {correlation:.2}): the model does not explain the \
                 points, and the intervals do not hold"
            ));
        }
        flags
    }
}

impl Prior {
    /// (ln θ − m)ᵀ P (ln θ − m).
    fn squared_distance(&self, parameters: &[f64]) -> f64 {
        let pairs = parameters.iter().zip(self.pull(parameters));
        let pairs = pairs.zip(&self.mean);
        pairs
            .map(|((parameter, pull), mean)| (mean - parameter) * pull)
            .sum()
    }

    /// P (m − ln θ).
    fn pull(&self, parameters: &[f64]) -> Vec<f64> {
        let rows = self.precision.chunks(self.mean.len());
        let row = |row: &[f64]| {
            let pairs = row.iter().zip(&self.mean).zip(parameters);
            pairs
                .map(|((entry, mean), parameter)| entry * (mean - parameter))
                .sum()
        };
        rows.map(row).collect()
    }

    /// Adds the prior to the normal equations of residuals of this variance.
    fn add_to(&self, linearised: &mut QuadraticModel, parameters: &[f64], variance: f64) {
        linearised.sum += variance * self.squared_distance(parameters);
        for (entry, known) in linearised.matrix.iter_mut().zip(&self.precision) {
            *entry += variance * known;
        }
        for (entry, pull) in linearised.descent.iter_mut().zip(self.pull(parameters)) {
            *entry += variance * pull;
        }
    }
}

/// A minimum, with the variance of a residual.
#[derive(Debug, Clone, PartialEq)]
pub struct FrictionMinimum {
    /// The logarithms of the parameters, and the sum.
    pub minimum: Minimum,
    /// 1 where standard errors are given.
    pub variance: f64,
}

/// The last of some rounds.
fn loop_rounds<T>(rounds: usize, mut round: impl FnMut() -> Option<T>) -> Option<T> {
    let mut last = None;
    for _ in 0..rounds {
        last = Some(round()?);
    }
    last
}

/// Normal equations of residuals and their rows of derivatives of what is computed.
fn normal(rows: impl Iterator<Item = (f64, Vec<f64>)>, n: usize) -> QuadraticModel {
    let mut linearised = QuadraticModel {
        sum: 0.0,
        matrix: vec![0.0; n * n],
        descent: vec![0.0; n],
    };
    for (residual, row) in rows {
        linearised.sum += residual * residual;
        for (j, one) in row.iter().enumerate() {
            linearised.descent[j] += residual * one;
            for (k, other) in row.iter().enumerate() {
                linearised.matrix[j * n + k] += one * other;
            }
        }
    }
    linearised
}
