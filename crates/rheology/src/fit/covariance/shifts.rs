//! Errors that the points of an isotherm share: a common factor, its shift and its temperature.

use std::f64::consts::LN_10;

use nalgebra::{DMatrix, DVector, Matrix2, RowDVector, Vector2};

use super::linear::Linear;
use super::scatter::Scatter;
use crate::WlfShift;
use crate::fit::curve::JoinedIsotherms;
use crate::fit::overlap::taper;
use crate::fit::superposition::{Link, LinkedBy};
use crate::fit::system::{Measurement, Quantity};

/// Linearised effects of the isotherms on the weighted data; matrices without columns for a single curve.
pub(super) struct ShiftEffects {
    /// Derivatives of the weighted data by ln of a common factor of each isotherm.
    pub(super) factors: DMatrix<f64>,
    /// Matrix D: derivatives of the weighted data by ln a of all isotherms, then by ln b.
    pub(super) slopes: DMatrix<f64>,
    /// Matrix B: derivatives of ln a, then ln b, of all isotherms by the weighted data.
    pub(super) shift_gain: DMatrix<f64>,
    /// Derivatives of the shifted data by each independent temperature, \[1/K].
    pub(super) by_temperature: DMatrix<f64>,
    /// Effect of undecided factors of the moduli; without a column if they are decided.
    pub(super) undecided: DMatrix<f64>,
    /// Deviations of the shifts from a law of temperature, for isotherms shifted onto one another.
    pub(super) law: Option<LawDeviations>,
}

/// Deviations of the shifts from a smooth law of temperature through the reference isotherm.
pub(super) struct LawDeviations {
    /// Deviations of ln a from the law, for all isotherms but the reference.
    pub(super) deviations: DVector<f64>,
    /// Projection onto deviations that the constants of the law cannot absorb.
    pub(super) left: DMatrix<f64>,
    /// Derivatives of the deviations by the temperatures of all isotherms, \[1/K].
    pub(super) by_temperature: DMatrix<f64>,
    /// Rows of the matrix B for these isotherms.
    pub(super) shift_gain: DMatrix<f64>,
}

impl ShiftEffects {
    /// Effects of the shifts of joined isotherms; without columns for a single curve.
    pub(super) fn new(
        fit: &Linear,
        rows: &[Measurement],
        isotherms: Option<&JoinedIsotherms>,
    ) -> Self {
        let n = isotherms.map_or(0, |joined| joined.temperatures.len());
        // Compute how the data change with the factor of each isotherm, and with its shift.
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
            shift_gain: DMatrix::zeros(2 * n, rows.len()),
            by_temperature: DMatrix::zeros(rows.len(), 0),
            undecided: DMatrix::zeros(rows.len(), 0),
            law: None,
        };
        // Compute how the shifts change with the data and with the temperatures, and the effect of undecided vertical shifts.
        if let Some(isotherms) = isotherms {
            joined.set_shift_gain(fit, rows, &isotherms.links);
            joined.set_temperature_effects(fit, isotherms);
            if !isotherms.undecided.is_empty() {
                let factors = DVector::from_column_slice(&isotherms.undecided);
                joined.undecided = DMatrix::from_columns(&[&joined.factors * factors]);
            }
        }
        joined
    }

    /// True if the temperatures change the shifted data.
    pub(super) fn has_temperature_effect(&self) -> bool {
        !self.by_temperature.is_empty()
    }

    /// Standard errors of ln a and ln b of all isotherms, in this order, from the scatter of points and factors.
    pub(super) fn shift_errors(&self, scatter: &Scatter) -> Vec<[f64; 2]> {
        let n = self.factors.ncols();
        let of_points = scatter.scaled(&self.shift_gain);
        let of_factors = &self.shift_gain * &self.factors;
        let error = |row: usize| {
            let [points, factors] =
                [&of_points, &of_factors].map(|all| all.row(row).norm_squared());
            (points + scatter.factor * factors).sqrt()
        };
        (0..n).map(|one| [error(one), error(n + one)]).collect()
    }

    /// Sets the matrix B by summing the errors of the pairs along the chain.
    fn set_shift_gain(&mut self, fit: &Linear, rows: &[Measurement], links: &[Link]) {
        let n = self.factors.ncols();
        let own = |link: &Link| pair_gain(fit, rows, link);
        let own: Vec<[RowDVector<f64>; 2]> = links.iter().map(own).collect();
        for (link, [shift, factor]) in links.iter().zip(&own) {
            let mut total = shift.clone();
            if let LinkedBy::Law(parts) = &link.by {
                for (other, part) in parts {
                    total += &own[*other][0] * *part;
                }
            }
            for (offset, own) in [(0, &total), (n, factor)] {
                let sum = self.shift_gain.row(offset + link.fixed) + own;
                self.shift_gain.row_mut(offset + link.moved).copy_from(&sum);
            }
        }
    }

    /// Sets the effects of the temperatures, and the deviations from a law.
    fn set_temperature_effects(&mut self, fit: &Linear, isotherms: &JoinedIsotherms) {
        let n = self.factors.ncols();
        let Some(reference) = isotherms.reference() else {
            // If the shifts are given, each isotherm has the error of its own temperature.
            let slopes = DMatrix::from_diagonal(&DVector::from_vec(isotherms.secants()));
            if n > 1 {
                self.by_temperature = self.slopes.columns(0, n) * slopes;
            }
            return;
        };
        let FittedLaw {
            slopes,
            deviations,
            constants,
        } = fit_law(isotherms, reference);
        let others: Vec<usize> = (0..slopes.nrows()).filter(|k| *k != reference).collect();
        // All isotherms share the error of the temperature of the reference isotherm.
        self.by_temperature = DMatrix::from_columns(&[&fit.slopes * slopes[reference]]);
        if isotherms
            .links
            .iter()
            .any(|link| matches!(link.by, LinkedBy::Law(_)))
        {
            let beyond =
                self.slopes.columns(0, n) * temperature_effect_on_shifts(isotherms, &slopes);
            let mut all = beyond;
            let mut column = all.column_mut(reference);
            column += self.by_temperature.column(0);
            self.by_temperature = all;
        }
        // Remove the part of the deviations that the constants of the fitted law absorb.
        let by_constants = constants.select_rows(&others);
        let n_others = others.len();
        let Some(inverse) = by_constants
            .tr_mul(&by_constants)
            .try_inverse()
            .filter(|_| n_others > by_constants.ncols())
        else {
            return;
        };
        let by_temperature = DMatrix::from_fn(n_others, n, |row, isotherm| match isotherm {
            _ if isotherm == reference => -slopes[reference],
            _ if isotherm == others[row] => slopes[isotherm],
            _ => 0.0,
        });
        self.law = Some(LawDeviations {
            deviations: deviations.select_rows(&others).column(0).into_owned(),
            left: DMatrix::identity(n_others, n_others)
                - &by_constants * inverse * by_constants.transpose(),
            by_temperature,
            shift_gain: self.shift_gain.select_rows(&others),
        });
    }
}

/// Derivatives of the shifts of all isotherms by the temperatures of all, \[1/K].
///
/// They differ from zero for isotherms that the law of others placed, and for those beyond them. The shift of a pair that
/// overlaps does not depend on the temperatures.
fn temperature_effect_on_shifts(
    isotherms: &JoinedIsotherms,
    slopes: &DMatrix<f64>,
) -> DMatrix<f64> {
    let n = isotherms.temperatures.len();
    let mut shifts = DMatrix::zeros(n, n);
    // The observed shift of a pair belongs to the true temperatures of its isotherms, so an error of either enters by the slope
    // of the law.
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

/// Derivatives of ln a and ln b of the moved isotherm of a link, relative to the fixed one, by the weighted data; 0 unless the overlap
/// decides.
fn pair_gain(fit: &Linear, rows: &[Measurement], link: &Link) -> [RowDVector<f64>; 2] {
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
                // Omit a modulus of zero, because it has no logarithm.
                row.isotherm == isotherm && row.quantity == quantity && row.value > 0.0
            };
            (0..rows.len()).filter(is_own).collect::<Vec<_>>()
        });
        for (own, other, sign) in [(&moved, &fixed, 1.0), (&fixed, &moved, -1.0)] {
            for &row in own {
                squares.add(fit, rows, row, other, sign / variance);
            }
        }
    }
    squares.solve(*finds_shift, *modulus_spread)
}

/// Normal equations of the weighted residuals in the overlap of two isotherms, for ln a and ln b in this order.
struct LeastSquares {
    /// Normal matrix.
    normal: Matrix2<f64>,
    /// Derivatives of the right-hand side by the weighted data.
    by_data: [RowDVector<f64>; 2],
}

impl LeastSquares {
    /// Adds the residual of the point `row` from the line through the points of the `other` isotherm, all of one quantity; none if
    /// the point lies outside that line.
    ///
    /// The weight is the inverse variance of the residual, negative for points of the fixed isotherm.
    fn add(
        &mut self,
        fit: &Linear,
        rows: &[Measurement],
        row: usize,
        other: &[usize],
        weight: f64,
    ) {
        // Find the two neighbouring points of the other isotherm, between which it is interpolated linearly in ln ω.
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
        // Convert weighted errors and slopes to those of ln of the modulus.
        let relative = |row: usize| (rows[row].weight * rows[row].value).recip();
        let by_shift = fit.slopes[row] * relative(row);
        let by_parameters = Vector2::new(by_shift, 1.0);
        self.normal += by_parameters * by_parameters.transpose() * weight.abs();
        for (place, part) in [(row, 1.0), (below, part - 1.0), (above, -part)] {
            self.by_data[0][place] += weight * part * by_shift * relative(place);
            self.by_data[1][place] += weight * part * relative(place);
        }
    }

    /// Derivatives of ln a and ln b by the weighted data; 0 for a shift that is given.
    ///
    /// `finds_shift` is true if ln a is fitted; `modulus_spread` is the prior standard deviation of ln b, `None` if b is given.
    fn solve(self, finds_shift: bool, modulus_spread: Option<f64>) -> [RowDVector<f64>; 2] {
        let [[squares, both], [_, moduli]] = self.normal.transpose().into();
        let [shift_by_data, modulus_by_data] = self.by_data;
        let prior = modulus_spread.map(|spread| spread.powi(-2));
        match (finds_shift, prior) {
            (true, None) if squares > 0.0 => [shift_by_data / squares, modulus_by_data * 0.0],
            (false, Some(prior)) => [shift_by_data * 0.0, modulus_by_data / (moduli + prior)],
            (true, Some(prior)) => {
                let moduli = moduli + prior;
                let determinant = squares * moduli - both * both;
                if determinant <= 0.0 {
                    return [shift_by_data * 0.0, modulus_by_data / moduli];
                }
                let shift = (&shift_by_data * moduli - &modulus_by_data * both) / determinant;
                let factor = (modulus_by_data * squares - shift_by_data * both) / determinant;
                [shift, factor]
            }
            _ => [shift_by_data * 0.0, modulus_by_data * 0.0],
        }
    }
}

/// A law of temperature fitted to the shifts; one row per isotherm.
struct FittedLaw {
    /// Derivatives d ln a/dT, \[1/K].
    slopes: DMatrix<f64>,
    /// Shifts ln a less the law.
    deviations: DMatrix<f64>,
    /// Derivatives of the deviations by the constants of the law, up to their sign.
    constants: DMatrix<f64>,
}

/// Fits the WLF law to the shifts ln a of all isotherms about the `reference`, or a straight line if no WLF law describes them.
fn fit_law(isotherms: &JoinedIsotherms, reference: usize) -> FittedLaw {
    // Measure temperatures and shifts from the reference isotherm.
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
    // Use the WLF law if it has no pole between the temperatures.
    let constants = WlfShift::fit(&in_decades, 0.0).map(|law| law.constants());
    let is_everywhere = |c2: f64| pairs.iter().all(|[t, _]| c2 + t > 0.0);
    if let Ok([c1, c2]) = constants
        && is_everywhere(c2)
    {
        let c1 = LN_10 * c1;
        return FittedLaw {
            slopes: of_all(1, &|[t, _], _| -c1 * c2 / (c2 + t).powi(2)),
            deviations: of_all(1, &|[t, log], _| log + c1 * t / (c2 + t)),
            constants: of_all(2, &|[t, _], column| match column {
                0 => -t / (c2 + t),
                _ => c1 * t / (c2 + t).powi(2),
            }),
        };
    }
    // Otherwise fit a straight line through the reference.
    let products: f64 = pairs.iter().map(|[t, log]| t * log).sum();
    let squares: f64 = pairs.iter().map(|[t, _]| t * t).sum();
    let slope = if squares > 0.0 {
        products / squares
    } else {
        0.0
    };
    FittedLaw {
        slopes: of_all(1, &|_, _| slope),
        deviations: of_all(1, &|[t, log], _| log - slope * t),
        constants: of_all(1, &|[t, _], _| t),
    }
}
