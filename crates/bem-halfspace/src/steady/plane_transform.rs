//! Filtering of a real field on a rectangle of elements by a product in Fourier space.
//!
//! Rows are transformed one by one; each column then passes through forward transform, product and inverse transform
//! while it is in the cache, so that the padded field never exists as a whole.

use std::fmt;
use std::sync::Arc;

use realfft::{ComplexToReal, RealFftPlanner, RealToComplex};
use rustfft::num_complex::Complex;
use rustfft::{Fft, FftPlanner};

/// Columns that pass together: eight complex numbers fill two cache lines.
const TILE: usize = 8;
const ZERO: Complex<f64> = Complex { re: 0.0, im: 0.0 };

/// Fourier transform of a kernel, by column, with the normalisation of the transforms folded in.
pub(super) type Spectrum = Vec<Complex<f64>>;

/// The transforms of fields within a period of `padded` elements along x and y.
pub(super) struct PlaneTransform {
    padded: [usize; 2],
    row_forward: Arc<dyn RealToComplex<f64>>,
    row_inverse: Arc<dyn ComplexToReal<f64>>,
    column_forward: Arc<dyn Fft<f64>>,
    column_inverse: Arc<dyn Fft<f64>>,
}

/// What a filter overwrites.
#[derive(Debug)]
pub(super) struct Scratch {
    row: Vec<f64>,
    half_row: Vec<Complex<f64>>,
    rows: Vec<Complex<f64>>,
    tile: Vec<Complex<f64>>,
    transform: Vec<Complex<f64>>,
}

impl fmt::Debug for PlaneTransform {
    fn fmt(&self, formatter: &mut fmt::Formatter<'_>) -> fmt::Result {
        formatter
            .debug_struct("PlaneTransform")
            .field("padded", &self.padded)
            .finish_non_exhaustive()
    }
}

impl PlaneTransform {
    /// Plans the transforms; the period is even along y.
    pub(super) fn new(padded: [usize; 2]) -> Self {
        let mut real = RealFftPlanner::new();
        let mut complex = FftPlanner::new();
        Self {
            padded,
            row_forward: real.plan_fft_forward(padded[1]),
            row_inverse: real.plan_fft_inverse(padded[1]),
            column_forward: complex.plan_fft_forward(padded[0]),
            column_inverse: complex.plan_fft_inverse(padded[0]),
        }
    }

    pub(super) const fn padded(&self) -> [usize; 2] {
        self.padded
    }

    const fn n_columns(&self) -> usize {
        self.padded[1] / 2 + 1
    }

    /// What a filter of fields of `n_rows` rows overwrites.
    pub(super) fn scratch(&self, n_rows: usize) -> Scratch {
        let lengths = [
            self.row_forward.get_scratch_len(),
            self.row_inverse.get_scratch_len(),
            self.column_forward.get_inplace_scratch_len(),
            self.column_inverse.get_inplace_scratch_len(),
        ];
        Scratch {
            row: self.row_forward.make_input_vec(),
            half_row: self.row_forward.make_output_vec(),
            rows: vec![ZERO; n_rows * self.n_columns()],
            tile: vec![ZERO; TILE * self.padded[0]],
            transform: vec![ZERO; lengths.into_iter().max().unwrap_or_default()],
        }
    }

    /// Spectrum of a kernel that is even along y; `kernel(row, column)` is asked for the whole period along x and half
    /// of it along y, offsets above half the period along x being negative ones. `column_step` may change each column
    /// of the transform before it is stored.
    pub(super) fn spectrum(
        &self,
        kernel: impl Fn(usize, usize) -> f64,
        column_step: impl Fn(&Self, &mut Scratch, &mut [Complex<f64>]),
    ) -> Spectrum {
        let [length, width] = self.padded;
        let n_columns = self.n_columns();
        let mut scratch = self.scratch(0);
        let mut spectrum = vec![ZERO; n_columns * length];
        for row in 0..length {
            for column in 0..n_columns {
                let value = kernel(row, column);
                scratch.row[column] = value;
                scratch.row[(width - column) % width] = value;
            }
            self.transform_row(&mut scratch);
            for (column, value) in scratch.half_row.iter().enumerate() {
                spectrum[column * length + row] = *value;
            }
        }
        let normalisation = 1.0 / (length as f64 * width as f64);
        for column in spectrum.chunks_exact_mut(length) {
            self.column_forward(&mut scratch, column);
            column_step(self, &mut scratch, column);
            for value in column {
                *value *= normalisation;
            }
        }
        spectrum
    }

    /// Transforms columns along x, without normalisation.
    pub(super) fn column_forward(&self, scratch: &mut Scratch, columns: &mut [Complex<f64>]) {
        self.column_forward
            .process_with_scratch(columns, &mut scratch.transform);
    }

    /// The way back of [`column_forward`](Self::column_forward).
    pub(super) fn column_back(&self, scratch: &mut Scratch, columns: &mut [Complex<f64>]) {
        self.column_inverse
            .process_with_scratch(columns, &mut scratch.transform);
    }

    /// Replaces a field with `width` elements along y by its product with a spectrum, in Fourier space. Does not
    /// allocate.
    pub(super) fn filter(
        &self,
        scratch: &mut Scratch,
        (field, width): (&mut [f64], usize),
        spectrum: &Spectrum,
    ) {
        let n_columns = self.n_columns();
        for (row, values) in field.chunks_exact(width).enumerate() {
            scratch.row[..width].copy_from_slice(values);
            scratch.row[width..].fill(0.0);
            self.transform_row(scratch);
            scratch.rows[row * n_columns..][..n_columns].copy_from_slice(&scratch.half_row);
        }
        for first in (0..n_columns).step_by(TILE) {
            self.pass_columns(scratch, first..(first + TILE).min(n_columns), spectrum);
        }
        for (row, values) in field.chunks_exact_mut(width).enumerate() {
            scratch
                .half_row
                .copy_from_slice(&scratch.rows[row * n_columns..][..n_columns]);
            self.transform_row_back(scratch);
            values.copy_from_slice(&scratch.row[..width]);
        }
    }

    fn transform_row(&self, scratch: &mut Scratch) {
        let done = self.row_forward.process_with_scratch(
            &mut scratch.row,
            &mut scratch.half_row,
            &mut scratch.transform,
        );
        debug_assert!(
            done.is_ok(),
            "the buffers have the lengths of the plan: {done:?}"
        );
    }

    fn transform_row_back(&self, scratch: &mut Scratch) {
        // Rounding leaves imaginary parts where a real row has none, and the transform refuses them.
        let last = scratch.half_row.len() - 1;
        scratch.half_row[0].im = 0.0;
        scratch.half_row[last].im = 0.0;
        let done = self.row_inverse.process_with_scratch(
            &mut scratch.half_row,
            &mut scratch.row,
            &mut scratch.transform,
        );
        debug_assert!(
            done.is_ok(),
            "the buffers have the lengths of the plan: {done:?}"
        );
    }

    /// Multiplies a tile of columns by the spectrum.
    fn pass_columns(
        &self,
        scratch: &mut Scratch,
        columns: std::ops::Range<usize>,
        spectrum: &Spectrum,
    ) {
        let [length, n_columns] = [self.padded[0], self.n_columns()];
        let n_rows = scratch.rows.len() / n_columns;
        let tile = &mut scratch.tile[..columns.len() * length];
        tile.fill(ZERO);
        for row in 0..n_rows {
            let values = &scratch.rows[row * n_columns..][columns.clone()];
            for (column, value) in values.iter().enumerate() {
                tile[column * length + row] = *value;
            }
        }
        self.column_forward
            .process_with_scratch(tile, &mut scratch.transform);
        let factors = &spectrum[columns.start * length..columns.end * length];
        for (value, factor) in tile.iter_mut().zip(factors) {
            *value *= factor;
        }
        self.column_inverse
            .process_with_scratch(tile, &mut scratch.transform);
        for row in 0..n_rows {
            let values = &mut scratch.rows[row * n_columns..][columns.clone()];
            for (column, value) in values.iter_mut().enumerate() {
                *value = tile[column * length + row];
            }
        }
    }
}
