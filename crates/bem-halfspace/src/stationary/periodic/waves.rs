//! Products with symbols of waves on a periodic grid.

use std::f64::consts::PI;

use rustfft::num_complex::Complex;

use crate::parallel::bands::{copies, for_each_row};
use crate::transform::plane_transform::{PlaneTransform, Workspace};
use crate::{Base, Grid};

/// The waves that fit on a grid, with buffers for their transforms.
pub(super) struct Waves {
    transform: PlaneTransform,
    workspace: Workspace,
    /// q_x of the rows of a transformed field, \[rad/m]: that of the shortest wave is positive.
    pub(super) along_x: Vec<f64>,
    /// Wave number of the longest wave along y, \[rad/m].
    unit_y: f64,
    /// That of the longest wave, which stands for the mean, \[rad/m].
    longest: f64,
    /// |q|/M of all waves by column and row of the transform, where M is not 1.
    stiffness: Option<Vec<f64>>,
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
        let stiffness = (!base.is_half_space()).then(|| {
            let n_columns = columns / 2 + 1;
            let mut stiffness = copies(0.0, n_columns * rows);
            for_each_row(&mut stiffness, rows, |column, values| {
                for (value, q_x) in values.iter_mut().zip(&along_x) {
                    let q = q_x.hypot(column as f64 * unit_y);
                    *value = base.stiffness(if q > 0.0 { q } else { longest });
                }
            });
            stiffness
        });
        Self {
            workspace: Workspace::new(&transform, grid.shape()),
            transform,
            along_x,
            unit_y,
            longest,
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
        let (transform, along_x) = (&self.transform, &self.along_x);
        let (unit_y, longest, stiffness) = (self.unit_y, self.longest, &self.stiffness);
        let normalisation = transform.normalisation();
        let rows = 0..along_x.len();
        transform.load(&mut self.workspace, field, &rows);
        transform.pass(&mut self.workspace, (&rows, &rows), |column, values| {
            let q_y = column as f64 * unit_y;
            for (row, (value, &q_x)) in values.iter_mut().zip(along_x).enumerate() {
                let q = match stiffness {
                    Some(stiffness) => stiffness[column * along_x.len() + row],
                    None if row == 0 && column == 0 => longest,
                    None => (q_x * q_x + q_y * q_y).sqrt(),
                };
                *value *= symbol(row, [q_x, q]) * normalisation;
            }
        });
        transform.read(&mut self.workspace, result, &rows);
    }
}
