//! The fit near its end, where it is linear in the data.

use nalgebra::{DMatrix, DVector};

use super::scatter::Scatter;
use super::shifts::Joined;
use super::squared;
use crate::RelaxationSpectrum;
use crate::fit::system::Measurement;

/// Part of the trace of XᵀX below which it is rounding.
const ROUNDING: f64 = 1e-12;

/// Weighted data near the series.
pub(super) struct Linear {
    /// X: what a relative change of each modulus adds to the weighted data.
    pub(super) columns: DMatrix<f64>,
    /// A: the relative changes of the moduli that errors of the data make.
    pub(super) gain: DMatrix<f64>,
    /// Of the weighted data, by ln ω.
    pub(super) slopes: DVector<f64>,
    /// Data less series, weighted.
    pub(super) residuals: DVector<f64>,
}

/// The spring and the branches.
pub(super) fn moduli(spectrum: &RelaxationSpectrum) -> Vec<f64> {
    let branches = spectrum.branches().iter().map(|branch| branch.modulus);
    std::iter::once(spectrum.equilibrium_modulus())
        .chain(branches)
        .collect()
}

impl Linear {
    pub(super) fn new(rows: &[Measurement], spectrum: &RelaxationSpectrum) -> Option<Self> {
        let spring = Some(spectrum.equilibrium_modulus()).filter(|modulus| *modulus > 0.0);
        let first = usize::from(spring.is_some());
        let branches = spectrum.branches();
        let response = |row: &Measurement, k: usize| match (spring, k) {
            (Some(modulus), 0) => modulus * row.spring(),
            _ => branches[k - first].modulus * row.branch(branches[k - first].relaxation_time)[0],
        };
        let n_columns = first + branches.len();
        let columns = DMatrix::from_fn(rows.len(), n_columns, |row, k| {
            rows[row].weight * response(&rows[row], k)
        });
        let slope = |row: &Measurement| -> f64 {
            let parts = branches
                .iter()
                .map(|branch| branch.modulus * row.branch(branch.relaxation_time)[1]);
            row.weight * parts.sum::<f64>()
        };
        let slopes = DVector::from_iterator(rows.len(), rows.iter().map(slope));
        let values = rows.iter().map(|row| row.weight * row.value);
        let residuals = DVector::from_iterator(rows.len(), values) - columns.column_sum();
        let normal = columns.tr_mul(&columns);
        let degrees = rows.len().saturating_sub(n_columns).max(1) as f64;
        // A modulus is known to itself: its relative change is 0 ± 1.
        let scatter = residuals.norm_squared() / degrees;
        let ridge = scatter.max(ROUNDING * normal.trace());
        let normal = normal + DMatrix::identity(n_columns, n_columns) * ridge;
        let gain = normal.cholesky()?.solve(&columns.transpose());
        Some(Self {
            columns,
            gain,
            slopes,
            residuals,
        })
    }

    /// C of the relative changes of the moduli.
    pub(super) fn covariance(&self, joined: &Joined, scatter: &Scatter) -> DMatrix<f64> {
        let n = self.gain.nrows();
        let unknown = DMatrix::identity(n, n) - &self.gain * &self.columns;
        let gain = &self.gain - (&self.gain * &joined.slopes) * &joined.astray;
        let of_factors = &gain * &joined.factors;
        let of_temperatures = &self.gain * &joined.by_temperature;
        let of_undecided = &gain * &joined.undecided;
        squared(&unknown)
            + squared(&scatter.scaled(&gain))
            + squared(&of_factors) * scatter.factor
            + squared(&of_temperatures) * scatter.temperature
            // They are there or not, which is equally likely.
            + squared(&of_undecided) * 0.5
    }
}

/// R = 1 − D B − X A T: what is left of errors of the data when the isotherms are shifted and the series is fitted, as 1 less the
/// product of two narrow matrices.
pub(super) struct Residuals {
    left: DMatrix<f64>,
    right: DMatrix<f64>,
}

impl Residuals {
    pub(super) fn new(fit: &Linear, joined: &Joined) -> Self {
        let [n_shifts, n_moduli] = [joined.astray.nrows(), fit.gain.nrows()];
        let gain = &fit.gain - (&fit.gain * &joined.slopes) * &joined.astray;
        let n_rows = fit.columns.nrows();
        let mut left = DMatrix::zeros(n_rows, n_shifts + n_moduli);
        left.columns_mut(0, n_shifts).copy_from(&joined.slopes);
        left.columns_mut(n_shifts, n_moduli).copy_from(&fit.columns);
        let mut right = DMatrix::zeros(n_shifts + n_moduli, n_rows);
        right.rows_mut(0, n_shifts).copy_from(&joined.astray);
        right.rows_mut(n_shifts, n_moduli).copy_from(&gain);
        Self { left, right }
    }

    /// R M.
    pub(super) fn of(&self, errors: &DMatrix<f64>) -> DMatrix<f64> {
        errors - &self.left * (&self.right * errors)
    }

    /// Mᵀ R.
    pub(super) fn seen_by(&self, weights: &DMatrix<f64>) -> DMatrix<f64> {
        weights.transpose() - weights.tr_mul(&self.left) * &self.right
    }

    /// The diagonal of R Rᵀ: the part of the variance of every number that is left.
    pub(super) fn parts(&self) -> Vec<f64> {
        let products = &self.left * squared(&self.right);
        let part = |row: usize| {
            let left = self.left.row(row);
            let own = (left * self.right.column(row))[(0, 0)];
            1.0 - 2.0 * own + products.row(row).dot(&left)
        };
        (0..self.left.nrows()).map(part).collect()
    }
}
