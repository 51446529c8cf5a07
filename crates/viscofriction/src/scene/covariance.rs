//! Covariance of the moduli of a Prony series.

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use super::SceneError;

/// Covariance of the moduli of a series, as `fit-material` finds it.
#[derive(Debug, Clone, PartialEq, Deserialize, Serialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct Covariance {
    /// Covariances over the products of the two moduli, row by row: the equilibrium modulus, and the branches in their order.
    /// Symmetric and positive semidefinite.
    pub relative: Vec<Vec<f64>>,
    /// How it was found.
    pub method: Option<String>,
}

/// Largest relative asymmetry of a covariance, and largest size of a pivot of the correlation matrix that counts as 0 (chosen,
/// far above the rounding of f64).
const ROUNDING_TOLERANCE: f64 = 1e-9;
/// Largest size of an entry below a pivot that counts as 0: about three times √[`ROUNDING_TOLERANCE`]. By the Cauchy–Schwarz
/// inequality an entry is at most the square root of its pivot if the matrix is positive semidefinite.
const MAX_ENTRY_BELOW_ZERO_PIVOT: f64 = 1e-4;

impl Covariance {
    /// Rejects a matrix that is not a covariance of the moduli of a table with `n_branches` branches: size, finiteness, symmetry,
    /// positive semidefiniteness.
    pub(crate) fn check(&self, table: &str, n_branches: usize) -> Result<(), SceneError> {
        let key = format!("{table}.covariance.relative");
        let wrong =
            |place: String, problem: String| Err(SceneError::at(key.clone() + &place, problem));
        let n = n_branches + 1;
        let needed = "one for the equilibrium modulus and one for each branch";
        if self.relative.len() != n {
            let found = self.relative.len();
            return wrong(
                String::new(),
                format!("{n} rows are needed, {needed}, but there are {found}"),
            );
        }
        for (row, entries) in self.relative.iter().enumerate() {
            if entries.len() != n {
                let found = entries.len();
                let problem = format!("{n} numbers are needed, {needed}, but there are {found}");
                return wrong(format!("[{row}]"), problem);
            }
            for (column, entry) in entries.iter().enumerate() {
                let place = format!("[{row}][{column}]");
                let mirrored = self.relative[column].get(row).copied().unwrap_or(*entry);
                if !entry.is_finite() {
                    return wrong(
                        place,
                        format!("a finite number is needed, but it is {entry}"),
                    );
                }
                if row == column && *entry < 0.0 {
                    return wrong(
                        place,
                        format!("a variance is at least 0, but it is {entry:e}"),
                    );
                }
                let size = entry.abs().max(mirrored.abs());
                if (entry - mirrored).abs() > ROUNDING_TOLERANCE * size {
                    let problem = "a covariance is symmetric, but the mirrored number is";
                    return wrong(
                        place,
                        format!("{problem} {mirrored:e} instead of {entry:e}"),
                    );
                }
            }
        }
        // A symmetric matrix is positive semidefinite if and only if it has a Cholesky factor.
        match self.factor() {
            Ok(_) => Ok(()),
            Err(row) => {
                let problem = "the matrix is no covariance: it gives a sum of the moduli up to this row a variance below 0";
                wrong(format!("[{row}]"), problem.to_owned())
            }
        }
    }

    /// Lower triangular Cholesky factor L with L Lᵀ = C, as a list of rows, factorised as correlation matrix and scaled back.
    /// The error is the row, counted from 0, at which C is not positive semidefinite.
    pub(crate) fn factor(&self) -> Result<Vec<Vec<f64>>, usize> {
        let n = self.relative.len();
        // Scale to the correlation matrix.
        let deviations: Vec<f64> = (0..n).map(|k| self.relative[k][k].sqrt()).collect();
        let scale = |k: usize| {
            if deviations[k] > 0.0 {
                deviations[k].recip()
            } else {
                0.0
            }
        };
        let mut factor = vec![vec![0.0; n]; n];
        // Factorise column by column; pivots within rounding count as 0.
        for column in 0..n {
            for row in column..n {
                let known = (0..column).map(|k| factor[row][k] * factor[column][k]);
                let left =
                    self.relative[row][column] * scale(row) * scale(column) - known.sum::<f64>();
                let pivot: f64 = factor[column][column];
                if row == column {
                    if left < -ROUNDING_TOLERANCE {
                        return Err(row);
                    }
                    factor[row][column] = if left > ROUNDING_TOLERANCE {
                        left.sqrt()
                    } else {
                        0.0
                    };
                } else if pivot > 0.0 {
                    factor[row][column] = left / pivot;
                } else if left.abs() > MAX_ENTRY_BELOW_ZERO_PIVOT
                    || (deviations[row] * deviations[column] == 0.0
                        && self.relative[row][column] != 0.0)
                {
                    return Err(row);
                }
            }
        }
        // Scale back to the covariance.
        for (row, deviation) in factor.iter_mut().zip(deviations) {
            row.iter_mut().for_each(|entry| *entry *= deviation);
        }
        Ok(factor)
    }

    /// Relative standard uncertainty √(gᵀ C g) of a quantity with the derivatives g = d ln q/d ln G by the moduli in their order.
    pub(crate) fn uncertainty(&self, derivatives: &[f64]) -> f64 {
        let row = |(row, derivative): (&Vec<f64>, &f64)| {
            let product: f64 = row
                .iter()
                .zip(derivatives)
                .map(|(entry, other)| entry * other)
                .sum();
            product * derivative
        };
        let variance: f64 = self.relative.iter().zip(derivatives).map(row).sum();
        // A variance of 0 may be negative by rounding.
        variance.max(0.0).sqrt()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn covariance(rows: &[&[f64]]) -> Covariance {
        Covariance {
            relative: rows.iter().map(|row| row.to_vec()).collect(),
            method: None,
        }
    }

    #[test]
    fn what_is_no_covariance_is_refused_with_its_place() {
        for (rows, place) in [
            (&[&[0.01, 0.0][..]][..], "relative: 2 rows"),
            (&[&[0.01][..], &[0.0, 0.01]], "relative[0]: 2 numbers"),
            (
                &[&[0.01, f64::NAN], &[0.0, 0.01]],
                "relative[0][1]: a finite",
            ),
            (&[&[0.01, 0.0], &[0.0, -0.01]], "relative[1][1]: a variance"),
            (
                &[&[0.01, 0.002], &[0.001, 0.01]],
                "relative[0][1]: a covariance is symmetric",
            ),
            (&[&[0.01, 0.02], &[0.02, 0.01]], "relative[1]: the matrix"),
            (&[&[0.0, 0.02], &[0.02, 0.01]], "relative[1]: the matrix"),
        ] {
            let refused = covariance(rows).check("material.prony", 1);
            let refused = refused.expect_err(place).to_string();
            let place = format!("material.prony.covariance.{place}");
            assert!(refused.starts_with(&place), "{place}: {refused}");
        }
    }

    /// Two moduli with a known sum and unknown difference, and a third that is exact.
    #[test]
    fn a_covariance_without_full_rank_has_its_factor() {
        let known = covariance(&[&[0.04, -0.02, 0.0], &[-0.02, 0.01, 0.0], &[0.0, 0.0, 0.0]]);
        assert_eq!(known.check("material.prony", 2), Ok(()), "it is one");
        let factor = known.factor().expect("a factor");
        for row in 0..3 {
            for column in 0..3 {
                let product: f64 = (0..3).map(|k| factor[row][k] * factor[column][k]).sum();
                let off = (product - known.relative[row][column]).abs();
                assert!(off < 1e-15, "{row}, {column}: {product}");
            }
        }
        let uncertainties = [[1.0, 2.0, 5.0], [1.0, 0.0, 0.0]].map(|g| known.uncertainty(&g));
        assert!(
            uncertainties[0] < 1e-9 && (uncertainties[1] - 0.2).abs() < 1e-15,
            "{uncertainties:?}"
        );
    }
}
