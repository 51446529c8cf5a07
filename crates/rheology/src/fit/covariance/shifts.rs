//! What the points of an isotherm have in common.

use std::f64::consts::LN_10;

use nalgebra::{DMatrix, DVector};

use super::linear::Linear;
use crate::WlfShift;
use crate::fit::curve::JoinedIsotherms;
use crate::fit::system::{Measurement, Quantity};

/// Isotherms on one curve; of a single curve matrices without columns.
pub(super) struct Joined {
    /// What a common factor of each isotherm adds to the weighted data, relative to its change.
    pub(super) factors: DMatrix<f64>,
    /// D: what a shift of each isotherm adds, by ln of the factor.
    pub(super) slopes: DMatrix<f64>,
    /// B: how far errors of the data shift each isotherm astray, where neighbours were shifted onto one another.
    pub(super) astray: DMatrix<f64>,
    /// What 1 K of each independent temperature adds to the data as they were joined.
    pub(super) by_temperature: DMatrix<f64>,
    /// How far the isotherms are from a law of temperature, where they were shifted onto one another.
    pub(super) law: Option<Law>,
}

/// Shifts around a smooth law of temperature that passes through the isotherm that stays where it is.
pub(super) struct Law {
    /// ln of every factor less the law, by all other isotherms.
    pub(super) deviations: DVector<f64>,
    /// What the constants of the law leave of deviations.
    pub(super) left: DMatrix<f64>,
    /// What 1 K of every isotherm adds to the deviations.
    pub(super) by_temperature: DMatrix<f64>,
    /// B of these isotherms.
    pub(super) astray: DMatrix<f64>,
}

impl Joined {
    pub(super) fn new(
        fit: &Linear,
        rows: &[Measurement],
        isotherms: Option<&JoinedIsotherms>,
    ) -> Self {
        let n_isotherms = isotherms.map_or(0, |joined| joined.temperatures.len());
        let of_isotherm = |value: &dyn Fn(usize) -> f64| {
            DMatrix::from_fn(rows.len(), n_isotherms, |row, isotherm| {
                let is_own = rows[row].isotherm == isotherm;
                if is_own { value(row) } else { 0.0 }
            })
        };
        let mut joined = Self {
            factors: of_isotherm(&|row| rows[row].weight * rows[row].value),
            slopes: of_isotherm(&|row| fit.slopes[row]),
            astray: DMatrix::zeros(n_isotherms, rows.len()),
            by_temperature: DMatrix::zeros(rows.len(), 0),
            law: None,
        };
        if let Some(isotherms) = isotherms {
            for [fixed, moved] in &isotherms.chain {
                let pair = astray(fit, rows, [*fixed, *moved]);
                let sum = joined.astray.row(*fixed) + pair;
                joined.astray.row_mut(*moved).copy_from(&sum);
            }
            joined.know_temperatures(fit, isotherms);
        }
        joined
    }

    pub(super) fn knows_temperature(&self) -> bool {
        !self.by_temperature.is_empty()
    }

    fn know_temperatures(&mut self, fit: &Linear, isotherms: &JoinedIsotherms) {
        let Some([reference, _]) = isotherms.chain.first().copied() else {
            // Each isotherm is off by the error of its own temperature.
            let slopes = DMatrix::from_diagonal(&DVector::from_vec(isotherms.secants()));
            if isotherms.temperatures.len() > 1 {
                self.by_temperature = &self.slopes * slopes;
            }
            return;
        };
        let [slopes, deviations, constants] = law(isotherms, reference);
        let others: Vec<usize> = (0..slopes.nrows()).filter(|k| *k != reference).collect();
        // All of them are off by the error of the temperature of the one that stays where it is.
        self.by_temperature = DMatrix::from_columns(&[&fit.slopes * slopes[reference]]);
        let constants = constants.select_rows(&others);
        let n = others.len();
        let Some(inverse) = constants
            .tr_mul(&constants)
            .try_inverse()
            .filter(|_| n > constants.ncols())
        else {
            return;
        };
        let by_temperature = DMatrix::from_fn(n, slopes.nrows(), |row, isotherm| match isotherm {
            _ if isotherm == reference => -slopes[reference],
            _ if isotherm == others[row] => slopes[isotherm],
            _ => 0.0,
        });
        self.law = Some(Law {
            deviations: deviations.select_rows(&others).column(0).into_owned(),
            left: DMatrix::identity(n, n) - &constants * inverse * constants.transpose(),
            by_temperature,
            astray: self.astray.select_rows(&others),
        });
    }
}

/// How far errors of the data shift one isotherm astray that is shifted onto another so that their storage moduli lie on one line.
fn astray(fit: &Linear, rows: &[Measurement], pair: [usize; 2]) -> nalgebra::RowDVector<f64> {
    let [fixed, moved] = pair.map(|isotherm| {
        let is_own = |row: &usize| {
            let row = &rows[*row];
            // A modulus of zero has no logarithm.
            row.isotherm == isotherm && row.quantity == Quantity::Storage && row.value > 0.0
        };
        (0..rows.len()).filter(is_own).collect::<Vec<_>>()
    });
    // Relative errors, of which the weighted ones are this part, and slopes of ln G'.
    let relative = |row: usize| (rows[row].weight * rows[row].value).recip();
    let slope = |row: usize| fit.slopes[row] * relative(row);
    let log = |row: usize| rows[row].at.ln();
    let mut shift = nalgebra::RowDVector::zeros(rows.len());
    let mut squares = 0.0;
    for (own, other, sign) in [(&moved, &fixed, 1.0), (&fixed, &moved, -1.0)] {
        for &row in own {
            let next = other.partition_point(|place| rows[*place].at < rows[row].at);
            let Some((&below, &above)) = next
                .checked_sub(1)
                .and_then(|k| other.get(k))
                .zip(other.get(next))
            else {
                continue;
            };
            let part = (log(row) - log(below)) / (log(above) - log(below));
            squares += slope(row).powi(2);
            for (place, part) in [(row, 1.0), (below, part - 1.0), (above, -part)] {
                shift[place] += sign * part * slope(row) * relative(place);
            }
        }
    }
    if squares > 0.0 {
        shift / squares
    } else {
        shift * 0.0
    }
}

/// d ln a/dT of all isotherms, ln a less the law, and its derivatives by the constants of the law: that of Williams, Landel and
/// Ferry, or a straight line where no such law describes the shifts.
fn law(isotherms: &JoinedIsotherms, reference: usize) -> [DMatrix<f64>; 3] {
    let [about, origin] = [
        isotherms.temperatures[reference],
        isotherms.log_factors[reference],
    ];
    let pairs = isotherms.temperatures.iter().zip(&isotherms.log_factors);
    let pairs: Vec<[f64; 2]> = pairs.map(|(t, log)| [t - about, log - origin]).collect();
    let in_decades: Vec<[f64; 2]> = pairs.iter().map(|[t, log]| [*t, log / LN_10]).collect();
    let of_all = |columns: usize, value: &dyn Fn([f64; 2], usize) -> f64| {
        DMatrix::from_fn(pairs.len(), columns, |k, column| value(pairs[k], column))
    };
    let constants = WlfShift::through(&in_decades, 0.0).map(|law| law.constants());
    let is_everywhere = |c2: f64| pairs.iter().all(|[t, _]| c2 + t > 0.0);
    if let Ok([c1, c2]) = constants
        && is_everywhere(c2)
    {
        let c1 = LN_10 * c1;
        return [
            of_all(1, &|[t, _], _| -c1 * c2 / (c2 + t).powi(2)),
            of_all(1, &|[t, log], _| log + c1 * t / (c2 + t)),
            of_all(2, &|[t, _], column| match column {
                0 => -t / (c2 + t),
                _ => c1 * t / (c2 + t).powi(2),
            }),
        ];
    }
    let products: f64 = pairs.iter().map(|[t, log]| t * log).sum();
    let squares: f64 = pairs.iter().map(|[t, _]| t * t).sum();
    let slope = if squares > 0.0 {
        products / squares
    } else {
        0.0
    };
    [
        of_all(1, &|_, _| slope),
        of_all(1, &|[t, log], _| log - slope * t),
        of_all(1, &|[t, _], _| t),
    ]
}
