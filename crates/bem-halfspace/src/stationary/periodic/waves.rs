//! Products with symbols of waves on a periodic grid.

use std::f64::consts::PI;

use rustfft::num_complex::Complex;

use crate::parallel::bands::{copies, for_each_row};
use crate::transform::plane_transform::{PlaneTransform, Workspace, ZERO};
use crate::{Base, Grid};

/// The waves that fit on a grid, with buffers for their transforms.
pub(super) struct Waves {
    transform: PlaneTransform,
    workspace: Workspace,
    /// q_x of the rows of a transformed field, \[rad/m]: that of the shortest wave is positive.
    pub(super) along_x: Vec<f64>,
    /// |q|/M of all waves by column and row of the transform, \[rad/m]; that of the longest wave stands for the mean.
    stiffness: Vec<f64>,
}

impl Waves {
    pub(super) fn new(grid: &Grid, base: &Base) -> Self {
        let transform = PlaneTransform::new(grid.shape());
        let [rows, columns] = grid.shape();
        let [dx, dy] = grid.spacing();
        let unit_x = 2.0 * PI / (rows as f64 * dx);
        let unit_y = 2.0 * PI / (columns as f64 * dy);
        let number = |row: usize| {
            let back = if 2 * row > rows { rows as f64 } else { 0.0 };
            (row as f64 - back) * unit_x
        };
        let along_x: Vec<f64> = (0..rows).map(number).collect();
        let longest = unit_x.min(unit_y);
        let mut stiffness = copies(0.0, (columns / 2 + 1) * rows);
        for_each_row(&mut stiffness, rows, |column, values| {
            for (value, q_x) in values.iter_mut().zip(&along_x) {
                let q = q_x.hypot(column as f64 * unit_y);
                *value = base.stiffness(if q > 0.0 { q } else { longest });
            }
        });
        Self {
            workspace: Workspace::new(&transform, grid.shape()),
            transform,
            along_x,
            stiffness,
        }
    }

    /// Multiplies every wave of a field by a symbol of its row in the transform, its q_x and its |q|/M \[rad/m], which is
    /// that of the longest wave for the mean. Does not allocate.
    pub(super) fn apply(
        &mut self,
        field: &[f64],
        result: &mut [f64],
        symbol: impl Fn(usize, [f64; 2]) -> Complex<f64> + Sync,
    ) {
        let (along_x, stiffness) = (&self.along_x, &self.stiffness);
        let normalisation = self.transform.normalisation();
        let multiply = |column: usize, values: &mut [Complex<f64>]| {
            let stiffness = &stiffness[column * along_x.len()..];
            let waves = along_x.iter().zip(stiffness).enumerate();
            for (value, (row, (&q_x, &q))) in values.iter_mut().zip(waves) {
                *value *= symbol(row, [q_x, q]) * normalisation;
            }
        };
        pass(
            &self.transform,
            &mut self.workspace,
            (field, result),
            multiply,
        );
    }

    /// Symbols of all waves for [`apply_all`](Self::apply_all).
    pub(super) fn symbols(
        &self,
        symbol: impl Fn(usize, f64) -> Complex<f64> + Sync,
    ) -> Vec<Complex<f64>> {
        let (rows, stiffness) = (self.along_x.len(), &self.stiffness);
        let normalisation = self.transform.normalisation();
        let mut symbols = copies(ZERO, stiffness.len());
        for_each_row(&mut symbols, rows, |column, symbols| {
            let waves = stiffness[column * rows..].iter().enumerate();
            for (place, (row, &q)) in symbols.iter_mut().zip(waves) {
                *place = symbol(row, q) * normalisation;
            }
        });
        symbols
    }

    /// Multiplies every wave of a field by its symbol. Does not allocate.
    pub(super) fn apply_all(
        &mut self,
        field: &[f64],
        result: &mut [f64],
        symbols: &[Complex<f64>],
    ) {
        let rows = self.along_x.len();
        let multiply = |column: usize, values: &mut [Complex<f64>]| {
            for (value, symbol) in values.iter_mut().zip(&symbols[column * rows..]) {
                *value *= symbol;
            }
        };
        pass(
            &self.transform,
            &mut self.workspace,
            (field, result),
            multiply,
        );
    }
}

/// Multiplies the columns of the transform of a whole field.
fn pass(
    transform: &PlaneTransform,
    workspace: &mut Workspace,
    (field, result): (&[f64], &mut [f64]),
    multiply: impl Fn(usize, &mut [Complex<f64>]) + Sync,
) {
    let rows = 0..transform.padded[0];
    transform.load(workspace, field, &rows);
    transform.pass(workspace, (&rows, &rows), multiply);
    transform.read(workspace, result, &rows);
}
