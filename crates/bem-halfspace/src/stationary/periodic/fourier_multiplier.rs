//! Fourier multipliers on a periodic grid, in double and in single precision: each wave of a field is multiplied by its *symbol*.
//!
//! The transform of a field is stored as `[column][row]`: a column has the waves of one q_y ≥ 0, and a *row of the transform* those of one q_x.
//! With the compliance ratio M of a layer (1 on a half space) the *reduced wave number* of a wave is |q|/M; the half space has there the
//! stiffness that the layer has at |q|.
//!
//! The mean, q = 0, has no compliance on a half space. It is given the reduced wave number of the longest wave, so that symbols and their
//! inverses are finite; functions whose result has a meaningful mean set it afterwards.

use std::f64::consts::PI;

use numerics::transforms::Real;
use rustfft::num_complex::Complex;

use crate::parallel::row_blocks::{copies, for_each_row};
use crate::transform::plane_transform::{PlaneTransform, Workspace, rounded};
use crate::{Base, Grid};

/// A wave of the transform of a field.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Wave {
    /// Row of the transform. The waves of a row have the same q_x, and thus the same material frequency.
    pub(crate) row: usize,
    /// Index among all waves, `[column][row]`.
    pub(crate) index: usize,
    /// Wave number along x, \[rad/m]; positive for the shortest wave.
    pub(crate) q_x: f64,
    /// Reduced wave number |q|/M, \[rad/m]; for the mean see the head of this file.
    pub(crate) reduced_wave_number: f64,
}

/// Transform plans and wave numbers of a periodic grid, for products of fields with symbols.
pub(crate) struct FourierMultiplier {
    /// Rows and columns of the grid.
    shape: [usize; 2],
    /// Transforms in double precision, planned at their first use.
    double: Option<Transforms<f64>>,
    /// Transforms in single precision, planned at their first use.
    single: Option<Transforms<f32>>,
    /// Wave number q_x of each row of a transformed field, \[rad/m]; positive for the shortest wave.
    pub(crate) along_x: Vec<f64>,
    /// Wave number q_y of the second column of a transformed field, \[rad/m].
    step_y: f64,
    /// Reduced wave numbers |q|/M of all waves, `[column][row]`, \[rad/m]; for the mean see the head of this file.
    reduced: Vec<f64>,
}

impl FourierMultiplier {
    /// Wave numbers of the discrete Fourier transform on a grid, and reduced ones on a `base` with lengths in \[m].
    pub(crate) fn new(grid: &Grid, base: &Base) -> Self {
        let [rows, columns] = grid.shape();
        let [dx, dy] = grid.spacing();
        // The wave numbers q_x of the second half of the rows are negative.
        let unit_x = 2.0 * PI / (rows as f64 * dx);
        let unit_y = 2.0 * PI / (columns as f64 * dy);
        let number = |row: usize| {
            let back = if 2 * row > rows { rows as f64 } else { 0.0 };
            (row as f64 - back) * unit_x
        };
        let along_x: Vec<f64> = (0..rows).map(number).collect();
        // Compute the reduced wave number of each wave. The mean has that of the longest wave (head of this file).
        let longest = unit_x.min(unit_y);
        let mut reduced = copies(0.0, (columns / 2 + 1) * rows);
        for_each_row(&mut reduced, rows, |column, values| {
            for (value, q_x) in values.iter_mut().zip(&along_x) {
                let q = q_x.hypot(column as f64 * unit_y);
                *value = base.reduced_wave_number(if q > 0.0 { q } else { longest });
            }
        });
        Self {
            shape: grid.shape(),
            double: None,
            single: None,
            along_x,
            step_y: unit_y,
            reduced,
        }
    }

    /// Wave numbers q_x and |q| of all waves, `[column][row]`, \[rad/m].
    pub(super) fn wave_numbers(&self) -> impl ExactSizeIterator<Item = [f64; 2]> + '_ {
        let rows = self.along_x.len();
        (0..self.reduced.len()).map(move |index| {
            let q_x = self.along_x[index % rows];
            [q_x, q_x.hypot((index / rows) as f64 * self.step_y)]
        })
    }

    /// Multiplies every wave of a field by its symbol. Allocates only at the first call.
    pub(crate) fn apply(
        &mut self,
        field: &[f64],
        result: &mut [f64],
        symbol: impl Fn(&Wave) -> Complex<f64> + Sync,
    ) {
        let (along_x, reduced) = (&self.along_x, &self.reduced);
        let transforms = Transforms::get_or_plan(&mut self.double, self.shape);
        let normalisation = transforms.plans.normalisation();
        transforms.multiply(field, result, |column, values| {
            for (value, wave) in values.iter_mut().zip(waves_of(along_x, reduced, column)) {
                *value *= symbol(&wave) * normalisation;
            }
        });
    }

    /// Trigonometric interpolation of a field at the points that lie at `offset` from the centres, in elements along x and y. The field
    /// must not contain the shortest wave of the grid.
    #[cfg(feature = "rough")]
    pub(crate) fn shift(&mut self, field: &[f64], result: &mut [f64], offset: [f64; 2]) {
        let turns = [0, 1].map(|axis| 2.0 * PI * offset[axis] / self.shape[axis] as f64);
        let rows = self.shape[0];
        let number = |row: usize| row as f64 - if 2 * row > rows { rows as f64 } else { 0.0 };
        let along: Vec<Complex<f64>> = (0..rows)
            .map(|row| Complex::cis(turns[0] * number(row)))
            .collect();
        let transforms = Transforms::get_or_plan(&mut self.double, self.shape);
        let normalisation = transforms.plans.normalisation();
        transforms.multiply(field, result, |column, values| {
            let across = Complex::cis(turns[1] * column as f64) * normalisation;
            for (value, along) in values.iter_mut().zip(&along) {
                *value *= along * across;
            }
        });
    }

    /// Symbols of all waves for [`apply_single_precision`](Self::apply_single_precision), `[column][row]`.
    ///
    /// The symbol of the mean is `mean`, or that of the longest wave for `None`. Symbols contain the normalisation of the transforms.
    pub(crate) fn symbols(
        &self,
        mean: Option<f64>,
        symbol: impl Fn(&Wave) -> Complex<f64> + Sync,
    ) -> Vec<Complex<f32>> {
        let (along_x, reduced) = (&self.along_x, &self.reduced);
        let normalisation = 1.0 / (self.shape[0] as f64 * self.shape[1] as f64);
        let mut symbols = copies(Complex::default(), reduced.len());
        for_each_row(&mut symbols, along_x.len(), |column, symbols| {
            for (place, wave) in symbols.iter_mut().zip(waves_of(along_x, reduced, column)) {
                *place = rounded(symbol(&wave) * normalisation);
            }
        });
        if let Some(mean) = mean {
            symbols[0] = rounded(Complex::from(mean * normalisation));
        }
        symbols
    }

    /// Multiplies every wave of a field by its symbol, in single precision; `symbols` are those of [`symbols`](Self::symbols).
    /// Allocates only at the first call.
    pub(crate) fn apply_single_precision(
        &mut self,
        field: &[f32],
        result: &mut [f32],
        symbols: &[Complex<f32>],
    ) {
        let rows = self.along_x.len();
        let transforms = Transforms::get_or_plan(&mut self.single, self.shape);
        transforms.multiply(field, result, |column, values| {
            for (value, symbol) in values.iter_mut().zip(&symbols[column * rows..]) {
                *value *= symbol;
            }
        });
    }
}

/// The waves of one column of the transform.
fn waves_of<'w>(
    along_x: &'w [f64],
    reduced: &'w [f64],
    column: usize,
) -> impl Iterator<Item = Wave> + 'w {
    let first = column * along_x.len();
    let of_column = along_x.iter().zip(&reduced[first..]).enumerate();
    of_column.map(move |(row, (q_x, reduced))| Wave {
        row,
        index: first + row,
        q_x: *q_x,
        reduced_wave_number: *reduced,
    })
}

/// Transforms of whole fields with their buffers.
struct Transforms<T> {
    /// Plans of the transforms along both axes.
    plans: PlaneTransform<T>,
    /// Buffers of the transforms.
    workspace: Workspace<T>,
}

impl<T: Real> Transforms<T> {
    /// The transforms in `slot`, which are planned at the first call.
    fn get_or_plan(slot: &mut Option<Self>, shape: [usize; 2]) -> &mut Self {
        slot.get_or_insert_with(|| {
            let plans = PlaneTransform::new(shape);
            Self {
                workspace: Workspace::new(&plans, shape),
                plans,
            }
        })
    }

    /// Transforms a whole field, calls `multiply(column, values)` for each column of its transform, and transforms back without
    /// normalisation.
    fn multiply(
        &mut self,
        field: &[T],
        result: &mut [T],
        multiply: impl Fn(usize, &mut [Complex<T>]) + Sync,
    ) {
        let Self { plans, workspace } = self;
        let rows = 0..plans.padded[0];
        plans.forward_rows(workspace, field, &rows);
        plans.filter_columns(workspace, &rows, &rows, multiply);
        plans.inverse_rows(workspace, result, &rows);
    }
}
