//! Products with symbols of waves on a periodic grid.

use std::f64::consts::PI;

use rustfft::num_complex::Complex;

use crate::Grid;
use crate::plane_transform::{PlaneTransform, Workspace};

/// The waves that fit on a grid, with buffers for their transforms.
#[derive(Debug)]
pub(super) struct Waves {
    transform: PlaneTransform,
    workspace: Workspace,
    numbers: WaveNumbers,
}

/// Wave numbers of the rows and columns of a transformed field.
#[derive(Debug, Clone)]
pub(super) struct WaveNumbers {
    /// q_x, \[rad/m]: that of the shortest wave is positive.
    pub(super) along_x: Vec<f64>,
    /// Wave number of the longest wave along y, \[rad/m].
    unit_y: f64,
    /// That of the longest wave, which stands for the mean, \[rad/m].
    longest: f64,
}

impl WaveNumbers {
    pub(super) fn new(grid: &Grid) -> Self {
        let [rows, columns] = grid.shape();
        let [dx, dy] = grid.spacing();
        let unit_x = 2.0 * PI / (rows as f64 * dx);
        let unit_y = 2.0 * PI / (columns as f64 * dy);
        let number = |row: usize| {
            let back = if 2 * row > rows { rows as f64 } else { 0.0 };
            (row as f64 - back) * unit_x
        };
        Self {
            along_x: (0..rows).map(number).collect(),
            unit_y,
            longest: unit_x.min(unit_y),
        }
    }

    /// |q| of a row and column of the transform; for the mean that of the longest wave.
    fn magnitude(&self, row: usize, column: usize) -> f64 {
        if row == 0 && column == 0 {
            return self.longest;
        }
        let [q_x, q_y] = [self.along_x[row], column as f64 * self.unit_y];
        (q_x * q_x + q_y * q_y).sqrt()
    }
}

impl Waves {
    pub(super) fn new(grid: &Grid) -> Self {
        let transform = PlaneTransform::new(grid.shape());
        Self {
            workspace: Workspace::new(&transform, grid.shape()),
            transform,
            numbers: WaveNumbers::new(grid),
        }
    }

    /// Multiplies every wave of a field by a symbol of its row in the transform and its |q| \[rad/m], which is that of the
    /// longest wave for the mean. Does not allocate.
    pub(super) fn apply(
        &mut self,
        field: &[f64],
        result: &mut [f64],
        symbol: impl Fn(usize, f64) -> Complex<f64> + Sync,
    ) {
        let Self {
            transform,
            workspace,
            numbers,
        } = self;
        let normalisation = transform.normalisation();
        let rows = 0..workspace.shape[0];
        transform.load(workspace, field, &rows);
        transform.pass(workspace, (&rows, &rows), |column, values| {
            for (row, value) in values.iter_mut().enumerate() {
                *value *= symbol(row, numbers.magnitude(row, column)) * normalisation;
            }
        });
        transform.read(workspace, result, &rows);
    }
}
