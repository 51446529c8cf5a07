//! Linearisation of the fit around its solution.

use nalgebra::{DMatrix, DVector};

use super::outer_square;
use super::scatter::Scatter;
use super::shifts::ShiftEffects;
use crate::RelaxationSpectrum;
use crate::fit::system::Measurement;

/// Smallest ratio of the ridge to the trace of the matrix XᵀX of the normal equations. Chosen, above rounding.
const TRACE_ROUNDING: f64 = 1e-12;

/// Weighted data, linearised around the series; data are in the order of the measured numbers, moduli begin with that of the
/// spring if there is one.
pub(super) struct Linear {
    /// Matrix X, data by moduli: derivatives of the weighted data by the relative changes of the moduli.
    pub(super) columns: DMatrix<f64>,
    /// Matrix A, moduli by data: derivatives of the relative changes of the moduli by the weighted data.
    pub(super) gain: DMatrix<f64>,
    /// Derivatives of the weighted data by ln ω, or by ln t of a relaxation with the opposite sign.
    pub(super) slopes: DVector<f64>,
    /// Weighted residuals, data less series.
    pub(super) residuals: DVector<f64>,
}

/// Equilibrium modulus and moduli of the branches, \[Pa].
pub(super) fn moduli(spectrum: &RelaxationSpectrum) -> Vec<f64> {
    let branches = spectrum.branches().iter().map(|branch| branch.modulus);
    std::iter::once(spectrum.equilibrium_modulus())
        .chain(branches)
        .collect()
}

impl Linear {
    /// Linearises the weighted data around a series; `None` if the normal matrix is not positive definite.
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
        // Least squares with a ridge λ turn changes of the weighted data into relative changes of the moduli by the matrix A =
        // (XᵀX + λ)⁻¹ Xᵀ. The columns of X are the contributions of the moduli to the weighted fit.
        let values = rows.iter().map(|row| row.weight * row.value);
        let residuals = DVector::from_iterator(rows.len(), values) - columns.column_sum();
        let normal = columns.tr_mul(&columns);
        let degrees = rows.len().saturating_sub(n_columns).max(1) as f64;
        // The ridge represents the prior knowledge that a modulus is not negative: its relative change is 0 ± 1.
        let scatter = residuals.norm_squared() / degrees;
        let ridge = scatter.max(TRACE_ROUNDING * normal.trace());
        let regularised = normal + DMatrix::identity(n_columns, n_columns) * ridge;
        let gain = regularised.cholesky()?.solve(&columns.transpose());
        Some(Self {
            columns,
            gain,
            slopes,
            residuals,
        })
    }

    /// Covariance matrix C of the relative changes of the moduli, with all terms of the parent module.
    pub(super) fn covariance(&self, effects: &ShiftEffects, scatter: &Scatter) -> DMatrix<f64> {
        let n = self.gain.nrows();
        let unknown = DMatrix::identity(n, n) - &self.gain * &self.columns;
        let gain = &self.gain - (&self.gain * &effects.slopes) * &effects.shift_gain;
        let of_factors = &gain * &effects.factors;
        let of_temperatures = &self.gain * &effects.by_temperature;
        let of_undecided = &gain * &effects.undecided;
        outer_square(&unknown)
            + outer_square(&scatter.scaled(&gain))
            + outer_square(&of_factors) * scatter.factor
            + outer_square(&of_temperatures) * scatter.temperature
            // A vertical shift that the data do not decide is present with the probability 1/2, so its square counts half.
            + outer_square(&of_undecided) * 0.5
    }
}

/// Residual operator R = 1 − D B − X A T, which maps errors of the data to residuals of shifted isotherms and fitted series.
///
/// It is stored as 1 less the product of two narrow matrices.
pub(super) struct Residuals {
    /// Matrix (D, X), by which shifts and moduli change the data.
    left: DMatrix<f64>,
    /// Matrix (B, A T), by which the data change shifts and moduli.
    right: DMatrix<f64>,
}

impl Residuals {
    /// Operator from the errors of the data to the residuals, for a fit whose data were shifted.
    pub(super) fn new(fit: &Linear, effects: &ShiftEffects) -> Self {
        let [n_shifts, n_moduli] = [effects.shift_gain.nrows(), fit.gain.nrows()];
        let gain = &fit.gain - (&fit.gain * &effects.slopes) * &effects.shift_gain;
        let n_rows = fit.columns.nrows();
        let mut left = DMatrix::zeros(n_rows, n_shifts + n_moduli);
        left.columns_mut(0, n_shifts).copy_from(&effects.slopes);
        left.columns_mut(n_shifts, n_moduli).copy_from(&fit.columns);
        let mut right = DMatrix::zeros(n_shifts + n_moduli, n_rows);
        right.rows_mut(0, n_shifts).copy_from(&effects.shift_gain);
        right.rows_mut(n_shifts, n_moduli).copy_from(&gain);
        Self { left, right }
    }

    /// Product R M with a matrix M of errors of the data, one column for each.
    pub(super) fn apply(&self, errors: &DMatrix<f64>) -> DMatrix<f64> {
        errors - &self.left * (&self.right * errors)
    }

    /// Product Mᵀ R with a matrix M of weights of the residuals, one column for each sum.
    pub(super) fn transpose_apply(&self, weights: &DMatrix<f64>) -> DMatrix<f64> {
        weights.transpose() - weights.tr_mul(&self.left) * &self.right
    }

    /// Diagonal of R Rᵀ: the fraction of the variance of every number that remains in its residual.
    pub(super) fn remaining_variances(&self) -> Vec<f64> {
        // With R = 1 − L M, where L and M are the matrices `left` and `right`, the diagonal is 1 − 2 (L M)_ii + (L M Mᵀ Lᵀ)_ii.
        // It needs no square matrix R.
        let products = &self.left * outer_square(&self.right);
        let part = |row: usize| {
            let left = self.left.row(row);
            let own = (left * self.right.column(row))[(0, 0)];
            1.0 - 2.0 * own + products.row(row).dot(&left)
        };
        (0..self.left.nrows()).map(part).collect()
    }
}
