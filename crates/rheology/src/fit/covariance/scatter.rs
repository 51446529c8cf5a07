//! How much single points, the factors of isotherms and their temperatures scatter.
//!
//! The scatter of a few isotherms is hardly known, and least of all that it is 0. It has therefore a distribution beforehand,
//! half of a normal one, and what counts is the mean of its square when the residuals are known (Gelman 2006, DOI
//! 10.1214/06-BA117A): without information that is what is assumed, and with many isotherms what they show.

use nalgebra::{DMatrix, DVector};

use super::linear::{Linear, Residuals};
use super::shifts::Joined;
use super::squared;
use crate::fit::system::{Measurement, Quantity};

/// What geometry, clamps and gauges of one instrument make of the same sample from one isotherm to the next, relative.
pub(super) const FACTOR: f64 = 0.01;
/// How well the temperature of a sample is known, \[K].
pub(super) const TEMPERATURE: f64 = 0.5;

/// Variances.
pub(super) struct Scatter {
    /// Of the weighted error of every number, as of independent ones.
    noise: DVector<f64>,
    /// The same of each quantity that was measured.
    quantities: Vec<f64>,
    /// Of the relative factor of an isotherm.
    pub(super) factor: f64,
    /// Of the temperature of an isotherm, \[K²].
    pub(super) temperature: f64,
}

impl Scatter {
    pub(super) fn new(
        fit: &Linear,
        rows: &[Measurement],
        joined: &Joined,
        residuals: &Residuals,
    ) -> Self {
        let mut scatter = Self {
            noise: DVector::zeros(rows.len()),
            quantities: Vec::new(),
            factor: 0.0,
            temperature: 0.0,
        };
        scatter.know_noise(fit, rows, joined, residuals);
        if joined.factors.ncols() > 1 {
            let seen = Seen::new(&joined.factors, fit, joined, residuals, &scatter);
            scatter.factor = seen.mean_square(FACTOR);
        }
        scatter.temperature = match &joined.law {
            Some(law) => {
                let by_temperature = &law.left * &law.by_temperature;
                let astray = scatter.scaled(&law.astray);
                let factors = &law.astray * &joined.factors;
                let others = squared(&astray) + squared(&factors) * scatter.factor;
                let found = Seen {
                    sum: &law.left * &law.deviations,
                    others: &law.left * others * &law.left,
                    own: squared(&by_temperature),
                };
                found.mean_square(TEMPERATURE)
            }
            None if joined.by_temperature.ncols() > 1 => {
                let effect = &joined.by_temperature;
                Seen::new(effect, fit, joined, residuals, &scatter).mean_square(TEMPERATURE)
            }
            None => TEMPERATURE * TEMPERATURE,
        };
        scatter
    }

    /// What of the residuals is not common to an isotherm, over the part that is left of it; where neighbouring points are alike,
    /// as if there were fewer.
    fn know_noise(
        &mut self,
        fit: &Linear,
        rows: &[Measurement],
        joined: &Joined,
        residuals: &Residuals,
    ) {
        let parts = residuals.parts();
        let squares: Vec<f64> = joined
            .factors
            .column_iter()
            .map(|one| one.norm_squared())
            .collect();
        let of_isotherms = joined.factors.column_iter().zip(&squares);
        // All points of an isotherm may have been averaged with those of others; its sums are then 0.
        let means = of_isotherms
            .map(|(factors, squares)| factors.dot(&fit.residuals) / squares.max(f64::MIN_POSITIVE));
        let means = DVector::from_vec(means.collect::<Vec<_>>());
        let alone = &fit.residuals - &joined.factors * means;
        let taken = |row: usize| {
            let isotherm = rows[row].isotherm;
            squares
                .get(isotherm)
                .map_or(0.0, |all| joined.factors[(row, isotherm)].powi(2) / all)
        };
        for quantity in [Quantity::Storage, Quantity::Loss, Quantity::Relaxation] {
            let own: Vec<usize> = (0..rows.len())
                .filter(|row| rows[*row].quantity == quantity)
                .collect();
            if own.is_empty() {
                continue;
            }
            let sum: f64 = own.iter().map(|row| alone[*row].powi(2)).sum();
            let degrees: f64 = own.iter().map(|row| parts[*row] - taken(*row)).sum();
            let variance = sum / degrees.max(1.0);
            self.quantities.push(variance);
            let correlation = correlation(rows, &own, &alone);
            for row in own {
                self.noise[row] = variance * (1.0 + correlation) / (1.0 - correlation);
            }
        }
    }

    /// M with the standard deviation of every number, M Σ^½.
    pub(super) fn scaled(&self, matrix: &DMatrix<f64>) -> DMatrix<f64> {
        let mut scaled = matrix.clone();
        for (mut column, variance) in scaled.column_iter_mut().zip(self.noise.iter()) {
            column.scale_mut(variance.sqrt());
        }
        scaled
    }

    /// Standard deviations of the quantities that were measured.
    pub(super) fn noise_by_quantity(&self) -> Vec<f64> {
        self.quantities
            .iter()
            .map(|variance| variance.sqrt())
            .collect()
    }
}

/// Of the residuals of neighbouring points of an isotherm, where it is above 0.
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
        (products / squares).clamp(0.0, MOST_ALIKE)
    } else {
        0.0
    }
}

/// Neighbours that are more alike than this are one curve that the series does not follow, and no scatter.
const MOST_ALIKE: f64 = 0.9;

/// A sum of residuals that an effect of unknown size is seen in: its covariance is `others` + s² `own`.
struct Seen {
    sum: DVector<f64>,
    others: DMatrix<f64>,
    own: DMatrix<f64>,
}

impl Seen {
    /// The sums of residuals that an effect on the weighted data changes most, its columns independent and of one variance.
    fn new(
        effect: &DMatrix<f64>,
        fit: &Linear,
        joined: &Joined,
        residuals: &Residuals,
        scatter: &Scatter,
    ) -> Self {
        let left = residuals.of(effect);
        let mut weights = left.clone();
        for (mut row, variance) in weights.row_iter_mut().zip(scatter.noise.iter()) {
            row.scale_mut(if *variance > 0.0 {
                variance.recip()
            } else {
                0.0
            });
        }
        let noise = scatter.scaled(&residuals.seen_by(&weights));
        let factors = weights.tr_mul(&residuals.of(&joined.factors));
        Self {
            sum: weights.tr_mul(&fit.residuals),
            others: squared(&noise) + squared(&factors) * scatter.factor,
            own: squared(&weights.tr_mul(&left)),
        }
    }

    /// The mean of s² when the sum is known, where s has half of a normal distribution of this scale beforehand.
    fn mean_square(&self, scale: f64) -> f64 {
        let n = self.sum.len();
        let ridge = ROUNDING * (self.others.trace() + scale * scale * self.own.trace());
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
        let places =
            (0..N_PLACES).map(|k| (f64::from(k) + 0.5) / f64::from(N_PLACES) * FARTHEST * scale);
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
        // Without a residual nothing is known but what was assumed.
        if all > 0.0 {
            squares / all
        } else {
            scale * scale
        }
    }
}

/// Part of the trace of a covariance that is rounding.
const ROUNDING: f64 = 1e-9;
/// Places of the integral over s, up to so many times the scale, where e^(−s²/2) is below 1e-5.
const N_PLACES: u32 = 200;
const FARTHEST: f64 = 5.0;
