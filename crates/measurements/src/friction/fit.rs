//! Least-squares fit of friction, with confidence intervals of the profile likelihood.
//!
//! ```text
//! S(θ) = Σ r_i² + s² (ln θ − m)ᵀ P (ln θ − m),    min S with θ_k fixed − min S = t² s²        (ends of an interval)
//! ```
//! With given standard errors, residuals r are in their units, s = 1 and t = 1.96. Otherwise they are residuals of ln μ or μ,
//! s² is min Σ r² divided by the degrees of freedom, and t a quantile of Student's distribution. The prior has the mean m and
//! the precision P.

use numerics::Estimate;
use numerics::least_squares::{
    IntervalEnd, Minimum, ParameterRange, QuadraticModel, inverse, minimise_by_model, profile_end,
    student_quantile,
};

use super::{FreeParameter, FrictionModel, FrictionNoise, FrictionPoint, ModelledPoint, Prior};
use crate::{Finding, MeasurementError};

/// Two-sided 95 % quantile of the standard normal distribution: half the length of a 95 % interval in standard deviations.
const NORMAL_QUANTILE: f64 = 1.959_963_984_540_054;
/// Probability with which an interval of a parameter contains its true value.
const COVERAGE: f64 = 0.95;
/// Relative tolerance of the rise of the sum of squares at an end of an interval. Within it the end is interpolated between
/// two trials. Chosen: the sum is nearly quadratic in the parameter, so that 10 % of the rise move an end by 5 % of its
/// distance from the best fit.
const PROFILE_TOLERANCE: f64 = 0.1;
/// Predicted decrease of the sum of squares, in variances of a point, below which the least squares take their last step without
/// computing the model again. Chosen, far below the rise by t² = 3.8 that ends an interval.
const SUFFICIENT_DECREASE: f64 = 0.05;
/// Relative noise of the friction that is assumed until a fit estimates it, if the noise is not known. Chosen: it is a
/// common scatter of measured friction; the next rounds replace it by the scatter of the residuals.
const INITIAL_RELATIVE_NOISE: f64 = 0.05;
/// Largest excess of the sum of squares over its expectation with which a fit counts as good and the search for better
/// starts ends. Its unit is the standard deviation of χ². Chosen: in one of 700 fits of a right model noise alone exceeds
/// it.
const GOOD_FIT_DEVIATIONS: f64 = 3.0;
/// Number of rounds of fitting the parameters and estimating the noise anew from the residuals, if there is a prior. Chosen:
/// the first round takes [`INITIAL_RELATIVE_NOISE`], the second the noise of the first residuals, and the third one of
/// residuals that were weighted rightly. Convergence is not tested.
const NOISE_ROUNDS: usize = 3;
/// Largest number of evaluations of the model for one end of an interval; after them the end is left open. Chosen: a parameter
/// that the points determine needs 2 to 10.
const MAX_COMPUTATIONS: usize = 60;
/// Excess of χ², or of the correlation of neighbouring residuals, over its expectation, above which a misfit is flagged. Its
/// unit is the standard deviation of that number. Chosen: in one of 30 000 fits of a right model noise alone exceeds it.
const MISFIT_DEVIATIONS: f64 = 4.0;

/// A fitting problem: measured points, free parameters, prior and noise.
#[derive(Debug, Clone, Copy)]
pub struct FrictionFitting<'a> {
    /// Measured points.
    points: &'a [FrictionPoint],
    /// Free parameters, in the order of all vectors of their logarithms.
    parameters: &'a [FreeParameter],
    /// Prior of these logarithms; `None` without prior knowledge.
    prior: Option<&'a Prior>,
    /// Kind of the noise of unknown size; `None` if standard errors are given.
    noise: Option<FrictionNoise>,
}

/// Result of a friction fit.
#[derive(Debug, Clone, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize))]
#[must_use]
pub struct FrictionFit {
    /// Estimates of the parameters, in their order.
    pub findings: Vec<Finding>,
    /// Best-fit values of the parameters, including undetermined ones.
    pub values: Vec<f64>,
    /// Friction coefficients of the fit, in the order of the points.
    pub fitted: Vec<f64>,
    /// Standard deviation of the residuals: in units of given standard errors, or relative or absolute, by the kind of noise.
    pub residual: f64,
    /// Degrees of freedom: number of points and known parameters less number of parameters.
    pub freedom: usize,
    /// Warnings about the fit.
    pub flags: Vec<String>,
}

impl<'a> FrictionFitting<'a> {
    /// Fitting problem; `noise` is the kind of the noise unless all points have a standard error.
    ///
    /// # Errors
    /// [`MeasurementError::TooFewPoints`] without points, or without a degree of freedom for the noise.
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

    /// A fit with the same parameters, prior and noise, and with other points.
    #[must_use]
    pub const fn of(&self, points: &'a [FrictionPoint]) -> Self {
        Self { points, ..*self }
    }

    /// Number of parameters that the prior knows.
    fn n_priors(&self) -> usize {
        self.prior.map_or(0, |prior| prior.rank)
    }

    /// Number of points and of parameters with a prior, less that of all parameters; at least 0.
    fn degrees_of_freedom(&self) -> usize {
        let known = self.points.len() + self.n_priors();
        known.saturating_sub(self.parameters.len())
    }

    /// Local minimum of the sum of squares from a start; `None` if the model has no friction there.
    pub fn minimum(&self, model: &dyn FrictionModel, start: &[f64]) -> Option<FrictionMinimum> {
        let mut variance = self.initial_variance();
        let mut start = start.to_vec();
        repeat(
            if self.n_priors() > 0 && self.noise.is_some() {
                NOISE_ROUNDS
            } else {
                1
            },
            || {
                let sufficient_decrease = SUFFICIENT_DECREASE * variance;
                let sum = |parameters: &[f64]| self.linearise(model, parameters, variance);
                let ranges = self.ranges();
                let minimum = minimise_by_model(sum, start.clone(), &ranges, sufficient_decrease)?;
                start.clone_from(&minimum.parameters);
                if self.noise.is_some() {
                    variance = minimum.model.sum / self.degrees_of_freedom().max(1) as f64;
                }
                Some(FrictionMinimum { minimum, variance })
            },
        )
    }

    /// Sum of squares S at the logarithms of the parameters; `None` if the model has no friction there.
    pub fn sum(&self, model: &dyn FrictionModel, parameters: &[f64]) -> Option<f64> {
        let linearised = self.linearise(model, parameters, self.initial_variance())?;
        Some(linearised.sum).filter(|sum| sum.is_finite())
    }

    /// Root mean square residual at a minimum, including the prior; `None` if it is not finite.
    pub fn mean_residual(&self, found: &FrictionMinimum) -> Option<f64> {
        let mean = found.minimum.model.sum / self.points.len() as f64;
        Some(mean.max(0.0).sqrt()).filter(|mean| mean.is_finite())
    }

    /// Whether a sum of squares is explained by noise: the given standard errors, or 5 % of the friction.
    pub fn explains(&self, sum: f64) -> bool {
        let n = self.points.len() as f64;
        sum <= self.initial_variance() * (n + GOOD_FIT_DEVIATIONS * (2.0 * n).sqrt())
    }

    /// Variance s² of a residual before the first fit: 1 with standard errors, else that of 5 % of the friction, in the unit of
    /// the residuals.
    fn initial_variance(&self) -> f64 {
        let square = |point: &FrictionPoint| point.friction_coefficient.powi(2);
        let squares: f64 = self.points.iter().map(square).sum();
        match self.noise {
            None => 1.0,
            Some(FrictionNoise::Relative) => INITIAL_RELATIVE_NOISE * INITIAL_RELATIVE_NOISE,
            Some(FrictionNoise::Absolute) => {
                INITIAL_RELATIVE_NOISE * INITIAL_RELATIVE_NOISE * squares / self.points.len() as f64
            }
        }
    }

    /// Bounds and largest steps of the logarithms of all parameters.
    fn ranges(&self) -> Vec<ParameterRange> {
        self.parameters.iter().map(|one| one.range).collect()
    }

    /// Residual r of a point, and −∂r/∂ ln μ by the modelled friction μ: (μ_i − μ)/σ_i with standard errors σ_i, else ln(μ_i/μ)
    /// for relative noise or μ_i − μ for absolute noise.
    fn residual(&self, point: &FrictionPoint, modelled: f64) -> [f64; 2] {
        let measured = point.friction_coefficient;
        let unit = match self.noise {
            None => point.standard_error.unwrap_or(f64::NAN),
            Some(FrictionNoise::Absolute) => 1.0,
            Some(FrictionNoise::Relative) => return [(measured / modelled).ln(), 1.0],
        };
        [(measured - modelled) / unit, modelled / unit]
    }

    /// The sum S at the logarithms of the parameters with its Gauss–Newton model, for the variance s² of a residual. `None` if
    /// the model has no friction there.
    fn linearise(
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
        let mut linearised = normal_equations(rows, parameters.len());
        if let Some(prior) = self.prior {
            prior.add_to(&mut linearised, parameters, variance);
        }
        Some(linearised)
    }

    /// Estimates and intervals of the parameters around a minimum.
    ///
    /// `watch` is called with the number of parameters whose intervals are known.
    ///
    /// # Errors
    /// [`MeasurementError::NotConverged`] if the model has no friction at the minimum.
    pub fn fit(
        &self,
        model: &dyn FrictionModel,
        found: &FrictionMinimum,
        watch: &dyn Fn(usize),
    ) -> Result<FrictionFit, MeasurementError> {
        let best = &found.minimum;
        let modelled = model
            .friction(&best.parameters)
            .ok_or(MeasurementError::NotConverged)?;
        let fitted: Vec<f64> = modelled
            .iter()
            .map(|one| one.friction_coefficient)
            .collect();
        let pairs = self.points.iter().zip(&fitted);
        let residuals: Vec<f64> = pairs
            .map(|(point, fitted)| self.residual(point, *fitted)[0])
            .collect();
        let degrees_of_freedom = self.degrees_of_freedom();
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
                "{n_unfinished} ends of intervals were not found in {MAX_COMPUTATIONS} computations of the friction each, and are left \
                 open: let fewer parameters be free, give more points, or a prior"
            ));
        }
        Ok(FrictionFit {
            findings,
            values: best.parameters.iter().map(|value| value.exp()).collect(),
            flags,
            residual: (square / degrees_of_freedom.max(1) as f64).sqrt(),
            fitted,
            freedom: degrees_of_freedom,
        })
    }

    /// Estimate and 95 % interval of parameter `k` around a minimum. Ends that need more than [`MAX_COMPUTATIONS`] are left
    /// open and counted in `n_unfinished`; without both ends there is no estimate.
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
            None => Some(NORMAL_QUANTILE),
            Some(_) => student_quantile(COVERAGE, self.degrees_of_freedom()),
        }
        .unwrap_or(f64::INFINITY);
        // At the ends of the interval the smallest sum of squares with this parameter fixed is larger by `rise` than at the
        // minimum. For a linear model each is one standard `deviation` times the quantile away; the search starts there.
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
                relative_tolerance: PROFILE_TOLERANCE,
            };
            let mut n_computed = 0;
            let sum = |parameters: &[f64]| {
                n_computed += 1;
                let is_allowed = n_computed <= MAX_COMPUTATIONS;
                is_allowed.then(|| self.linearise(model, parameters, variance))?
            };
            let end = profile_end(sum, best, &ranges, interval_end).map(f64::exp);
            if n_computed > MAX_COMPUTATIONS {
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

    /// Warnings if parameters and prior contradict each other, if the sum of squares of the residuals, `square`, exceeds that
    /// of the standard errors, and if residuals of neighbouring speeds are correlated.
    fn flags(&self, residuals: &[f64], square: f64, parameters: &[f64]) -> Vec<String> {
        let mut flags = Vec::new();
        if let Some(prior) = self.prior
            && let n = prior.rank as f64
            && let distance = prior.squared_distance(parameters)
            && distance > n + MISFIT_DEVIATIONS * (2.0 * n).sqrt()
        {
            let ratio = (distance / n).sqrt();
            flags.push(format!(
                "the parameters are {ratio:.1} times as far from what was known of them as its errors allow: friction and prior \
                 contradict each other, and the intervals do not hold"
            ));
        }
        let degrees_of_freedom = self.degrees_of_freedom() as f64;
        if self.noise.is_none()
            && square > degrees_of_freedom + MISFIT_DEVIATIONS * (2.0 * degrees_of_freedom).sqrt()
        {
            let ratio = (square / degrees_of_freedom).sqrt();
            flags.push(format!(
                "the residuals are {ratio:.1} times as large as the standard errors: the model does not explain the points, \
                 or the errors are too small, and the intervals do not hold"
            ));
        }
        // Flag a misfit if residuals at neighbouring speeds are correlated. The correlation of n independent residuals has the
        // standard deviation 1/√n.
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
        if correlation > MISFIT_DEVIATIONS / (residuals.len() as f64).sqrt() {
            flags.push(format!(
                "the residuals of neighbouring speeds go together (correlation {correlation:.2}): the model does not explain the \
                 points, and the intervals do not hold"
            ));
        }
        flags
    }
}

impl Prior {
    /// Squared distance (ln θ − m)ᵀ P (ln θ − m) from the prior mean.
    fn squared_distance(&self, parameters: &[f64]) -> f64 {
        parameters
            .iter()
            .zip(self.pull(parameters))
            .zip(&self.mean)
            .map(|((parameter, pull), mean)| (mean - parameter) * pull)
            .sum()
    }

    /// The vector P (m − ln θ): half the negative gradient of the squared distance from the prior mean.
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

    /// Adds the prior, multiplied by the variance s² of a residual, to sum, matrix and right-hand side of the normal equations.
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

/// A minimum of the sum of squares.
#[derive(Debug, Clone, PartialEq)]
pub struct FrictionMinimum {
    /// Logarithms of the parameters, and the sum of squares with its quadratic model.
    pub minimum: Minimum,
    /// Variance of a residual; 1 if standard errors are given.
    pub variance: f64,
}

/// Result of the last of several rounds; `None` if one fails, and for no rounds.
fn repeat<T>(rounds: usize, mut round: impl FnMut() -> Option<T>) -> Option<T> {
    let mut last = None;
    for _ in 0..rounds {
        last = Some(round()?);
    }
    last
}

/// Normal equations Jᵀ J x = Jᵀ r of residuals r and their rows J of derivatives by `n` parameters; matrix row by row.
fn normal_equations(rows: impl Iterator<Item = (f64, Vec<f64>)>, n: usize) -> QuadraticModel {
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
