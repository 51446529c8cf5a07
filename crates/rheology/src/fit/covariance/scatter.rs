//! Variance components: scatter of single points, of the factors of isotherms and of their temperatures.
//!
//! A few isotherms determine their scatter poorly. It has therefore a half-normal prior, and the posterior mean of its
//! square is used (Gelman 2006, DOI 10.1214/06-BA117A). Without information it is the prior; many isotherms override it.

use nalgebra::{DMatrix, DVector};

use super::linear::{Linear, Residuals};
use super::outer_square;
use super::shifts::ShiftEffects;
use crate::fit::system::{Measurement, Quantity};

/// Scale of the prior of the relative factor of an isotherm. Chosen: geometry, clamps and gauges of one instrument. It is the
/// standard deviation as far as the isotherms do not determine it.
pub(super) const FACTOR_SCALE: f64 = 0.01;
/// Scale of the prior of the temperature error of an isotherm, \[K]. Chosen: the temperature control of instruments is
/// specified so. It is the standard deviation as far as the isotherms do not determine it.
pub(super) const TEMPERATURE_SCALE: f64 = 0.5;

/// Variance components.
pub(super) struct Scatter {
    /// Variances of the weighted errors of all numbers, enlarged for the correlation of neighbours.
    noise: DVector<f64>,
    /// Variance of the weighted errors of single points of each measured quantity, in the order G', G'' or G(t) alone.
    quantities: Vec<f64>,
    /// Variance of the relative factor of an isotherm.
    pub(super) factor: f64,
    /// Variance of the temperature of an isotherm, \[K²].
    pub(super) temperature: f64,
}

impl Scatter {
    /// Estimates all components: first the noise, then the factors, then the temperatures.
    pub(super) fn new(
        fit: &Linear,
        rows: &[Measurement],
        effects: &ShiftEffects,
        residuals: &Residuals,
    ) -> Self {
        let mut scatter = Self {
            noise: DVector::zeros(rows.len()),
            quantities: Vec::new(),
            factor: 0.0,
            temperature: 0.0,
        };
        // Estimate the scatter of single points, because the other two estimates are relative to it.
        scatter.set_noise(fit, rows, effects, residuals);
        // If there are several isotherms, estimate the scatter of their factors from the residuals.
        if effects.factors.ncols() > 1 {
            let in_residuals =
                EffectInResiduals::new(&effects.factors, fit, effects, residuals, &scatter);
            scatter.factor = in_residuals.mean_square(FACTOR_SCALE);
        }
        // Estimate the scatter of the temperatures from the deviations of the shifts from a law, if there is one, else from the
        // residuals.
        scatter.temperature = match &effects.law {
            Some(law) => {
                let by_temperature = &law.left * &law.by_temperature;
                let shift_gain = scatter.scaled(&law.shift_gain);
                let factors = &law.shift_gain * &effects.factors;
                let others = outer_square(&shift_gain) + outer_square(&factors) * scatter.factor;
                let found = EffectInResiduals {
                    sum: &law.left * &law.deviations,
                    others: &law.left * others * &law.left,
                    own: outer_square(&by_temperature),
                };
                found.mean_square(TEMPERATURE_SCALE)
            }
            None if effects.by_temperature.ncols() > 1 => {
                let effect = &effects.by_temperature;
                EffectInResiduals::new(effect, fit, effects, residuals, &scatter)
                    .mean_square(TEMPERATURE_SCALE)
            }
            None => TEMPERATURE_SCALE * TEMPERATURE_SCALE,
        };
        scatter
    }

    /// Estimates the noise from the residuals without the common factor of each isotherm.
    ///
    /// The sum of squares is divided by the degrees of freedom that remain. Positive correlation of neighbours enlarges the
    /// variance, as for a smaller number of independent points.
    fn set_noise(
        &mut self,
        fit: &Linear,
        rows: &[Measurement],
        effects: &ShiftEffects,
        residuals: &Residuals,
    ) {
        let remaining = residuals.remaining_variances();
        let squares: Vec<f64> = effects
            .factors
            .column_iter()
            .map(|one| one.norm_squared())
            .collect();
        // Subtract from the residuals of each isotherm the relative factor that its points have in common.
        let of_isotherms = effects.factors.column_iter().zip(&squares);
        // Avoid a division by 0 for an isotherm all of whose points were averaged with those of others.
        let means = of_isotherms
            .map(|(factors, squares)| factors.dot(&fit.residuals) / squares.max(f64::MIN_POSITIVE));
        let means = DVector::from_vec(means.collect::<Vec<_>>());
        let without_factors = &fit.residuals - &effects.factors * means;
        let used_by_factor = |row: usize| {
            let isotherm = rows[row].isotherm;
            squares
                .get(isotherm)
                .map_or(0.0, |all| effects.factors[(row, isotherm)].powi(2) / all)
        };
        // For each measured quantity, estimate the variance and the correlation of neighbouring residuals of its points.
        for quantity in [Quantity::Storage, Quantity::Loss, Quantity::Relaxation] {
            let own: Vec<usize> = (0..rows.len())
                .filter(|row| rows[*row].quantity == quantity)
                .collect();
            if own.is_empty() {
                continue;
            }
            let sum: f64 = own.iter().map(|row| without_factors[*row].powi(2)).sum();
            let degrees: f64 = own
                .iter()
                .map(|row| remaining[*row] - used_by_factor(*row))
                .sum();
            let variance = sum / degrees.max(1.0);
            self.quantities.push(variance);
            let correlation = correlation(rows, &own, &without_factors);
            for row in own {
                self.noise[row] = variance * (1.0 + correlation) / (1.0 - correlation);
            }
        }
    }

    /// Product M Σ^½ of a matrix with one column per number and the diagonal matrix of their standard deviations.
    pub(super) fn scaled(&self, matrix: &DMatrix<f64>) -> DMatrix<f64> {
        let mut scaled = matrix.clone();
        for (mut column, variance) in scaled.column_iter_mut().zip(self.noise.iter()) {
            column.scale_mut(variance.sqrt());
        }
        scaled
    }

    /// Standard deviations of the measured quantities.
    pub(super) fn noise_by_quantity(&self) -> Vec<f64> {
        self.quantities
            .iter()
            .map(|variance| variance.sqrt())
            .collect()
    }
}

/// Correlation of the residuals of neighbouring points of an isotherm, from 0 to [`MAX_CORRELATION`].
///
/// `own` are the indices of the numbers of one quantity by increasing frequency or time.
fn correlation(rows: &[Measurement], own: &[usize], residuals: &DVector<f64>) -> f64 {
    let mut last: Vec<Option<f64>> = Vec::new();
    let [mut products, mut squares] = [0.0; 2];
    for &row in own {
        let isotherm = rows[row].isotherm;
        last.resize(last.len().max(isotherm + 1), None);
        if let Some(before) = last[isotherm] {
            products += before * residuals[row];
            squares += 0.5 * (before * before + residuals[row].powi(2));
        }
        last[isotherm] = Some(residuals[row]);
    }
    if squares > 0.0 {
        (products / squares).clamp(0.0, MAX_CORRELATION)
    } else {
        0.0
    }
}

/// Largest correlation of neighbouring residuals that counts as scatter. Chosen: beyond it they are a misfit of the series.
const MAX_CORRELATION: f64 = 0.9;

/// Sums of residuals to which an effect of unknown scale s contributes: their covariance is `others` + s² `own`.
struct EffectInResiduals {
    /// Sums of the residuals.
    sum: DVector<f64>,
    /// Covariance of the sums by everything else.
    others: DMatrix<f64>,
    /// Covariance of the sums by the effect, for s = 1.
    own: DMatrix<f64>,
}

impl EffectInResiduals {
    /// Sums of residuals over the columns of an effect on the weighted data, one unknown error for each column.
    ///
    /// The weights of the sums are the effect in the residuals, R times `effect`, divided by the variances of the noise.
    fn new(
        effect: &DMatrix<f64>,
        fit: &Linear,
        effects: &ShiftEffects,
        residuals: &Residuals,
        scatter: &Scatter,
    ) -> Self {
        // Weight the residuals by the effect divided by the variances, and find what else contributes to these sums.
        let left = residuals.apply(effect);
        let mut weights = left.clone();
        for (mut row, variance) in weights.row_iter_mut().zip(scatter.noise.iter()) {
            row.scale_mut(if *variance > 0.0 {
                variance.recip()
            } else {
                0.0
            });
        }
        let noise = scatter.scaled(&residuals.transpose_apply(&weights));
        let factors = weights.tr_mul(&residuals.apply(&effects.factors));
        Self {
            sum: weights.tr_mul(&fit.residuals),
            others: outer_square(&noise) + outer_square(&factors) * scatter.factor,
            own: outer_square(&weights.tr_mul(&left)),
        }
    }

    /// Posterior mean of s² for a half-normal prior of this `scale`, by the midpoint rule over s.
    fn mean_square(&self, scale: f64) -> f64 {
        let n = self.sum.len();
        let ridge = COVARIANCE_ROUNDING * (self.others.trace() + scale * scale * self.own.trace());
        let log_likelihood = |s: f64| {
            let covariance = &self.others + &self.own * (s * s) + DMatrix::identity(n, n) * ridge;
            let factor = covariance.cholesky()?;
            let log_determinant = 2.0 * factor.l_dirty().diagonal().map(f64::ln).sum();
            Some(
                -0.5 * (log_determinant
                    + self.sum.dot(&factor.solve(&self.sum))
                    + (s / scale).powi(2)),
            )
        };
        // Average s² over the posterior density of the scale s, which is divided by its maximum against underflow.
        let places = (0..INTEGRATION_POINTS)
            .map(|k| (f64::from(k) + 0.5) / f64::from(INTEGRATION_POINTS) * MAX_SCALES * scale);
        let known: Vec<[f64; 2]> = places
            .filter_map(|s| Some([s, log_likelihood(s).filter(|log| log.is_finite())?]))
            .collect();
        let highest = known
            .iter()
            .map(|[_, log]| *log)
            .fold(f64::NEG_INFINITY, f64::max);
        let [mut all, mut squares] = [0.0; 2];
        for [s, log] in known {
            let weight = (log - highest).exp();
            all += weight;
            squares += weight * s * s;
        }
        // Without a finite likelihood the prior remains.
        if all > 0.0 {
            squares / all
        } else {
            scale * scale
        }
    }
}

/// Ratio of the ridge of a covariance to its trace. Chosen, above rounding.
const COVARIANCE_ROUNDING: f64 = 1e-9;
/// Number of points of the integral over the scale s of a factor or temperature error. Chosen: their distance is 1/40 of the
/// scale of the prior, over which the density changes little.
const INTEGRATION_POINTS: u32 = 200;
/// Ratio of the upper limit of the integral over the scale s to the scale of its prior, which is below 1e-5 of its maximum there.
const MAX_SCALES: f64 = 5.0;
