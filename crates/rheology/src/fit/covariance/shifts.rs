//! What the points of an isotherm have in common.

use std::f64::consts::LN_10;

use nalgebra::{DMatrix, DVector, Matrix2, RowDVector, Vector2};

use super::linear::Linear;
use super::scatter::Scatter;
use crate::WlfShift;
use crate::fit::curve::JoinedIsotherms;
use crate::fit::overlap::taper;
use crate::fit::superposition::{Link, LinkedBy};
use crate::fit::system::{Measurement, Quantity};

/// Isotherms on one curve; of a single curve matrices without columns.
pub(super) struct Joined {
    /// What a common factor of each isotherm adds to the weighted data, relative to its change.
    pub(super) factors: DMatrix<f64>,
    /// D: what a shift of each isotherm adds, by ln of the factor of its frequencies, and after these by that of its moduli.
    pub(super) slopes: DMatrix<f64>,
    /// B: how far errors of the data shift each isotherm astray, in the same order.
    pub(super) astray: DMatrix<f64>,
    /// What 1 K of each independent temperature adds to the data as they were joined.
    pub(super) by_temperature: DMatrix<f64>,
    /// What factors of the moduli add that are as likely as not; without a column where it is known whether they are there.
    pub(super) undecided: DMatrix<f64>,
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
        let n = isotherms.map_or(0, |joined| joined.temperatures.len());
        let of_isotherm = |value: &dyn Fn(usize) -> f64| {
            DMatrix::from_fn(rows.len(), n, |row, isotherm| {
                let is_own = rows[row].isotherm == isotherm;
                if is_own { value(row) } else { 0.0 }
            })
        };
        let factors = of_isotherm(&|row| rows[row].weight * rows[row].value);
        let mut slopes = DMatrix::zeros(rows.len(), 2 * n);
        slopes
            .columns_mut(0, n)
            .copy_from(&of_isotherm(&|row| fit.slopes[row]));
        slopes.columns_mut(n, n).copy_from(&factors);
        let mut joined = Self {
            factors,
            slopes,
            astray: DMatrix::zeros(2 * n, rows.len()),
            by_temperature: DMatrix::zeros(rows.len(), 0),
            undecided: DMatrix::zeros(rows.len(), 0),
            law: None,
        };
        if let Some(isotherms) = isotherms {
            joined.know_shifts(fit, rows, &isotherms.links);
            joined.know_temperatures(fit, isotherms);
            if !isotherms.undecided.is_empty() {
                let factors = DVector::from_column_slice(&isotherms.undecided);
                joined.undecided = DMatrix::from_columns(&[&joined.factors * factors]);
            }
        }
        joined
    }

    pub(super) fn knows_temperature(&self) -> bool {
        !self.by_temperature.is_empty()
    }

    /// Standard errors of ln a and ln b of all isotherms by the scatter of points and factors.
    pub(super) fn shift_errors(&self, scatter: &Scatter) -> Vec<[f64; 2]> {
        let n = self.factors.ncols();
        let of_points = scatter.scaled(&self.astray);
        let of_factors = &self.astray * &self.factors;
        let error = |row: usize| {
            let [points, factors] =
                [&of_points, &of_factors].map(|all| all.row(row).norm_squared());
            (points + scatter.factor * factors).sqrt()
        };
        (0..n).map(|one| [error(one), error(n + one)]).collect()
    }

    fn know_shifts(&mut self, fit: &Linear, rows: &[Measurement], links: &[Link]) {
        let n = self.factors.ncols();
        let own = |link: &Link| astray(fit, rows, link);
        let own: Vec<[RowDVector<f64>; 2]> = links.iter().map(own).collect();
        for (link, [shift, factor]) in links.iter().zip(&own) {
            let mut shift = shift.clone();
            if let LinkedBy::Law(parts) = &link.by {
                for (other, part) in parts {
                    shift += &own[*other][0] * *part;
                }
            }
            for (offset, own) in [(0, &shift), (n, factor)] {
                let sum = self.astray.row(offset + link.fixed) + own;
                self.astray.row_mut(offset + link.moved).copy_from(&sum);
            }
        }
    }

    fn know_temperatures(&mut self, fit: &Linear, isotherms: &JoinedIsotherms) {
        let n = self.factors.ncols();
        let Some(reference) = isotherms.reference() else {
            // Each isotherm is off by the error of its own temperature.
            let slopes = DMatrix::from_diagonal(&DVector::from_vec(isotherms.secants()));
            if n > 1 {
                self.by_temperature = self.slopes.columns(0, n) * slopes;
            }
            return;
        };
        let [slopes, deviations, constants] = law(isotherms, reference);
        let others: Vec<usize> = (0..slopes.nrows()).filter(|k| *k != reference).collect();
        // All of them are off by the error of the temperature of the one that stays where it is.
        self.by_temperature = DMatrix::from_columns(&[&fit.slopes * slopes[reference]]);
        if isotherms
            .links
            .iter()
            .any(|link| matches!(link.by, LinkedBy::Law(_)))
        {
            let beyond = self.slopes.columns(0, n) * placed_by_law(isotherms, &slopes);
            let mut all = beyond;
            let mut column = all.column_mut(reference);
            column += self.by_temperature.column(0);
            self.by_temperature = all;
        }
        let constants = constants.select_rows(&others);
        let n_others = others.len();
        let Some(inverse) = constants
            .tr_mul(&constants)
            .try_inverse()
            .filter(|_| n_others > constants.ncols())
        else {
            return;
        };
        let by_temperature = DMatrix::from_fn(n_others, n, |row, isotherm| match isotherm {
            _ if isotherm == reference => -slopes[reference],
            _ if isotherm == others[row] => slopes[isotherm],
            _ => 0.0,
        });
        self.law = Some(Law {
            deviations: deviations.select_rows(&others).column(0).into_owned(),
            left: DMatrix::identity(n_others, n_others)
                - &constants * inverse * constants.transpose(),
            by_temperature,
            astray: self.astray.select_rows(&others),
        });
    }
}

/// What 1 K of every isotherm shifts each that the law of others placed, or that is beyond one of these: in a pair that overlaps an
/// error of a temperature changes nothing but the temperature that stands beside the shift.
fn placed_by_law(isotherms: &JoinedIsotherms, slopes: &DMatrix<f64>) -> DMatrix<f64> {
    let n = isotherms.temperatures.len();
    let mut shifts = DMatrix::zeros(n, n);
    // An isotherm that is warmer than it was thought was shifted by what belongs to its own temperature.
    let observed = |link: &Link| {
        let mut row = RowDVector::zeros(n);
        row[link.moved] += slopes[link.moved];
        row[link.fixed] -= slopes[link.fixed];
        row
    };
    for link in &isotherms.links {
        let mut row = shifts.row(link.fixed).into_owned();
        if let LinkedBy::Law(parts) = &link.by {
            row -= observed(link);
            for (other, part) in parts {
                row += observed(&isotherms.links[*other]) * *part;
            }
        }
        shifts.row_mut(link.moved).copy_from(&row);
    }
    shifts
}

/// How far errors of the data shift the isotherm of a link astray, in ln of its frequencies and in ln of its moduli.
fn astray(fit: &Linear, rows: &[Measurement], link: &Link) -> [RowDVector<f64>; 2] {
    let nothing = || RowDVector::zeros(rows.len());
    let LinkedBy::Overlap {
        variances,
        finds_shift,
        modulus_spread,
    } = &link.by
    else {
        return [nothing(), nothing()];
    };
    let mut squares = LeastSquares {
        normal: Matrix2::zeros(),
        by_data: [nothing(), nothing()],
    };
    for (quantity, variance) in [Quantity::Storage, Quantity::Loss]
        .into_iter()
        .zip(variances)
    {
        let [fixed, moved] = [link.fixed, link.moved].map(|isotherm| {
            let is_own = |row: &usize| {
                let row = &rows[*row];
                // A modulus of zero has no logarithm.
                row.isotherm == isotherm && row.quantity == quantity && row.value > 0.0
            };
            (0..rows.len()).filter(is_own).collect::<Vec<_>>()
        });
        for (own, other, sign) in [(&moved, &fixed, 1.0), (&fixed, &moved, -1.0)] {
            for &row in own {
                squares.add(fit, rows, (row, other), sign / variance);
            }
        }
    }
    squares.solved(*finds_shift, *modulus_spread)
}

/// Least squares of the residuals where two isotherms overlap, for ln of the factors of frequencies and moduli.
struct LeastSquares {
    normal: Matrix2<f64>,
    /// By the weighted data.
    by_data: [RowDVector<f64>; 2],
}

impl LeastSquares {
    /// The residual of a point beside the line of the other isotherm, by the sign of the one that is moved.
    fn add(
        &mut self,
        fit: &Linear,
        rows: &[Measurement],
        (row, other): (usize, &[usize]),
        weight: f64,
    ) {
        let next = other.partition_point(|place| rows[*place].at < rows[row].at);
        let neighbours = next
            .checked_sub(1)
            .and_then(|k| other.get(k))
            .zip(other.get(next));
        let Some((&below, &above)) = neighbours else {
            return;
        };
        let log = |row: usize| rows[row].at.ln();
        let part = (log(row) - log(below)) / (log(above) - log(below));
        let weight = weight * taper(next, other.len(), part);
        // Relative errors, of which the weighted ones are this part, and the slope of ln of the modulus.
        let relative = |row: usize| (rows[row].weight * rows[row].value).recip();
        let by_shift = fit.slopes[row] * relative(row);
        let by_parameters = Vector2::new(by_shift, 1.0);
        self.normal += by_parameters * by_parameters.transpose() * weight.abs();
        for (place, part) in [(row, 1.0), (below, part - 1.0), (above, -part)] {
            self.by_data[0][place] += weight * part * by_shift * relative(place);
            self.by_data[1][place] += weight * part * relative(place);
        }
    }

    fn solved(self, finds_shift: bool, modulus_spread: Option<f64>) -> [RowDVector<f64>; 2] {
        let [[squares, both], [_, moduli]] = self.normal.transpose().into();
        let [of_shift, of_modulus] = self.by_data;
        let prior = modulus_spread.map(|spread| spread.powi(-2));
        match (finds_shift, prior) {
            (true, None) if squares > 0.0 => [of_shift / squares, of_modulus * 0.0],
            (false, Some(prior)) => [of_shift * 0.0, of_modulus / (moduli + prior)],
            (true, Some(prior)) => {
                let moduli = moduli + prior;
                let determinant = squares * moduli - both * both;
                if determinant <= 0.0 {
                    return [of_shift * 0.0, of_modulus / moduli];
                }
                let shift = (&of_shift * moduli - &of_modulus * both) / determinant;
                let factor = (of_modulus * squares - of_shift * both) / determinant;
                [shift, factor]
            }
            _ => [of_shift * 0.0, of_modulus * 0.0],
        }
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
