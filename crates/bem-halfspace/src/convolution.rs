//! Fast convolution of a pressure field with the influence of the elements.
//!
//! ```text
//! (K P)_ij = Σ K(x_i − x_k, y_j − y_l) P_kl
//! ```
//!
//! Zero padding to at least 2n − 1 makes the circular convolution of the Fourier transform the free one. Rows are
//! transformed only where they carry pressure and back only where the result is wanted, and each column passes
//! through forward transform, kernel and inverse transform while it is in the cache. The kernel is even along both
//! axes, so its spectrum is real and one quarter of it is stored.

use std::fmt;
use std::ops::Range;
use std::sync::Arc;

use realfft::{ComplexToReal, RealFftPlanner, RealToComplex};
use rustfft::num_complex::Complex;
use rustfft::{Fft, FftPlanner};

use crate::fast_length::fast_length;
use crate::{Grid, influence};

/// Columns that pass together: eight complex numbers fill two cache lines.
const TILE: usize = 8;
const ZERO: Complex<f64> = Complex { re: 0.0, im: 0.0 };

/// What the convolution on one grid needs and no pressure changes; may be shared between threads.
#[derive(Clone)]
pub struct Convolution {
    grid: Grid,
    padded: [usize; 2],
    /// Real spectrum, [column][0..=padded_x / 2], with the normalisation of the transforms folded in.
    spectrum: Vec<f64>,
    row_forward: Arc<dyn RealToComplex<f64>>,
    row_inverse: Arc<dyn ComplexToReal<f64>>,
    column_forward: Arc<dyn Fft<f64>>,
    column_inverse: Arc<dyn Fft<f64>>,
}

/// What a convolution overwrites; one per thread, made by [`Convolution::workspace`].
#[derive(Debug, Clone)]
pub struct ConvolutionWorkspace {
    row: Vec<f64>,
    half_row: Vec<Complex<f64>>,
    rows: Vec<Complex<f64>>,
    tile: Vec<Complex<f64>>,
    scratch: Vec<Complex<f64>>,
}

impl fmt::Debug for Convolution {
    fn fmt(&self, formatter: &mut fmt::Formatter<'_>) -> fmt::Result {
        formatter
            .debug_struct("Convolution")
            .field("grid", &self.grid)
            .field("padded", &self.padded)
            .finish_non_exhaustive()
    }
}

impl Convolution {
    /// Plans the transforms of `grid` and computes the spectrum of its influence coefficients.
    #[must_use]
    pub fn new(grid: &Grid) -> Self {
        let padded = grid.shape().map(|n| fast_length(2 * n - 1));
        let mut real = RealFftPlanner::new();
        let mut complex = FftPlanner::new();
        let mut convolution = Self {
            grid: *grid,
            padded,
            spectrum: Vec::new(),
            row_forward: real.plan_fft_forward(padded[1]),
            row_inverse: real.plan_fft_inverse(padded[1]),
            column_forward: complex.plan_fft_forward(padded[0]),
            column_inverse: complex.plan_fft_inverse(padded[0]),
        };
        convolution.spectrum = convolution.kernel_spectrum();
        convolution
    }

    /// The grid of the pressure and of the result.
    #[must_use]
    pub const fn grid(&self) -> &Grid {
        &self.grid
    }

    /// Buffers for [`apply`](Self::apply).
    #[must_use]
    pub fn workspace(&self) -> ConvolutionWorkspace {
        let scratch = [
            self.row_forward.get_scratch_len(),
            self.row_inverse.get_scratch_len(),
            self.column_forward.get_inplace_scratch_len(),
            self.column_inverse.get_inplace_scratch_len(),
        ];
        ConvolutionWorkspace {
            row: self.row_forward.make_input_vec(),
            half_row: self.row_forward.make_output_vec(),
            rows: vec![ZERO; self.grid.shape()[0] * self.n_columns()],
            tile: vec![ZERO; TILE * self.padded[0]],
            scratch: vec![ZERO; scratch.into_iter().max().unwrap_or_default()],
        }
    }

    /// Computes `K P` in the rows `wanted` of `result` from the rows `loaded` of `pressure`; the pressure outside
    /// these rows counts as zero and the other rows of the result are left as they are.
    ///
    /// Both fields have one value per element of the grid, row-major; the result has the unit of the pressure times
    /// metre. Does not allocate.
    ///
    /// # Panics
    /// When a field or the workspace does not belong to this grid.
    pub fn apply(
        &self,
        workspace: &mut ConvolutionWorkspace,
        (pressure, loaded): (&[f64], Range<usize>),
        (result, wanted): (&mut [f64], Range<usize>),
    ) {
        assert_eq!(
            pressure.len(),
            self.grid.n_elements(),
            "one pressure per element"
        );
        assert_eq!(
            result.len(),
            self.grid.n_elements(),
            "one displacement per element"
        );
        for row in loaded.clone() {
            self.transform_row(workspace, pressure, row);
        }
        for first in (0..self.n_columns()).step_by(TILE) {
            let columns = first..(first + TILE).min(self.n_columns());
            self.pass_columns(workspace, columns, &loaded, &wanted);
        }
        for row in wanted {
            self.transform_row_back(workspace, result, row);
        }
    }

    const fn n_columns(&self) -> usize {
        self.padded[1] / 2 + 1
    }

    fn transform_row(&self, workspace: &mut ConvolutionWorkspace, pressure: &[f64], row: usize) {
        let n_y = self.grid.shape()[1];
        let ConvolutionWorkspace {
            row: values,
            half_row,
            rows,
            scratch,
            ..
        } = workspace;
        values[..n_y].copy_from_slice(&pressure[row * n_y..(row + 1) * n_y]);
        values[n_y..].fill(0.0);
        let done = self
            .row_forward
            .process_with_scratch(values, half_row, scratch);
        debug_assert!(
            done.is_ok(),
            "the buffers have the lengths of the plan: {done:?}"
        );
        rows[row * self.n_columns()..(row + 1) * self.n_columns()].copy_from_slice(half_row);
    }

    fn transform_row_back(
        &self,
        workspace: &mut ConvolutionWorkspace,
        result: &mut [f64],
        row: usize,
    ) {
        let n_y = self.grid.shape()[1];
        let ConvolutionWorkspace {
            row: values,
            half_row,
            rows,
            scratch,
            ..
        } = workspace;
        half_row.copy_from_slice(&rows[row * self.n_columns()..(row + 1) * self.n_columns()]);
        // Rounding leaves imaginary parts where a real row has none, and the transform refuses them.
        half_row[0].im = 0.0;
        half_row[self.n_columns() - 1].im = 0.0;
        let done = self
            .row_inverse
            .process_with_scratch(half_row, values, scratch);
        debug_assert!(
            done.is_ok(),
            "the buffers have the lengths of the plan: {done:?}"
        );
        result[row * n_y..(row + 1) * n_y].copy_from_slice(&values[..n_y]);
    }

    /// Multiplies a tile of columns by the spectrum of the kernel.
    fn pass_columns(
        &self,
        workspace: &mut ConvolutionWorkspace,
        columns: Range<usize>,
        loaded: &Range<usize>,
        wanted: &Range<usize>,
    ) {
        let length = self.padded[0];
        let ConvolutionWorkspace {
            rows,
            tile,
            scratch,
            ..
        } = workspace;
        let tile = &mut tile[..columns.len() * length];
        tile.fill(ZERO);
        for row in loaded.clone() {
            let values = &rows[row * self.n_columns()..][columns.clone()];
            for (column, value) in values.iter().enumerate() {
                tile[column * length + row] = *value;
            }
        }
        self.column_forward.process_with_scratch(tile, scratch);
        for (values, column) in tile.chunks_exact_mut(length).zip(columns.clone()) {
            self.multiply_column(values, column);
        }
        self.column_inverse.process_with_scratch(tile, scratch);
        for row in wanted.clone() {
            let values = &mut rows[row * self.n_columns()..][columns.clone()];
            for (column, value) in values.iter_mut().enumerate() {
                *value = tile[column * length + row];
            }
        }
    }

    fn multiply_column(&self, values: &mut [Complex<f64>], column: usize) {
        let half = self.padded[0] / 2;
        let spectrum = &self.spectrum[column * (half + 1)..][..=half];
        let (lower, upper) = values.split_at_mut(half + 1);
        for (value, factor) in lower.iter_mut().zip(spectrum) {
            *value *= factor;
        }
        for (value, factor) in upper.iter_mut().rev().zip(&spectrum[1..half]) {
            *value *= factor;
        }
    }

    fn kernel_spectrum(&self) -> Vec<f64> {
        let rows = self.transformed_kernel_rows();
        let [length, half] = [self.padded[0], self.padded[0] / 2];
        let normalisation = 1.0 / (self.padded[0] as f64 * self.padded[1] as f64);
        let mut column_values = vec![ZERO; length];
        let mut scratch = vec![ZERO; self.column_forward.get_inplace_scratch_len()];
        let mut spectrum = Vec::with_capacity(self.n_columns() * (half + 1));
        for column in 0..self.n_columns() {
            column_values.fill(ZERO);
            for (row, values) in rows.iter().enumerate() {
                column_values[row] = values[column];
                column_values[(length - row) % length] = values[column];
            }
            self.column_forward
                .process_with_scratch(&mut column_values, &mut scratch);
            spectrum.extend(
                column_values[..=half]
                    .iter()
                    .map(|value| value.re * normalisation),
            );
        }
        spectrum
    }

    /// Transforms of the kernel along y, one per offset along x that can occur.
    fn transformed_kernel_rows(&self) -> Vec<Vec<Complex<f64>>> {
        let [n_x, n_y] = self.grid.shape();
        let [dx, dy] = self.grid.spacing();
        let mut values = self.row_forward.make_input_vec();
        let mut scratch = self.row_forward.make_scratch_vec();
        let transform = |row: usize| {
            values.fill(0.0);
            for column in 0..n_y {
                let coefficient = influence([row as f64 * dx, column as f64 * dy], [dx, dy]);
                values[column] = coefficient;
                values[(self.padded[1] - column) % self.padded[1]] = coefficient;
            }
            let mut transformed = self.row_forward.make_output_vec();
            let done =
                self.row_forward
                    .process_with_scratch(&mut values, &mut transformed, &mut scratch);
            debug_assert!(
                done.is_ok(),
                "the buffers have the lengths of the plan: {done:?}"
            );
            transformed
        };
        (0..n_x).map(transform).collect()
    }
}
