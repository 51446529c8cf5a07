//! Spectra of the influence coefficients: the factors by which a product K P multiplies the waves of P.
//!
//! A spectrum has the layout \[column]\[row], with the wave numbers 0, 1, 2 … along y for columns and 0 … n_x/2 along x for rows, in
//! units of the longest waves. The other wave vectors follow by symmetry.

use std::f64::consts::PI;

use rustfft::num_complex::Complex;

use crate::Convolution;
use crate::parallel::row_blocks::{copies, for_each_row};
use crate::transform::plane_transform::ZERO;

impl Convolution {
    /// Spectrum of a `symbol`, a function of the wave vector \[rad/m], at the discrete wave vectors of the period, times the
    /// normalisation of the transforms.
    fn spectrum_of(&self, symbol: impl Fn([f64; 2]) -> f64 + Sync) -> Vec<f64> {
        let [unit_x, unit_y] = self.fundamental_wave_numbers();
        let normalisation = self.transform.normalisation();
        let length = self.transform.padded[0] / 2 + 1;
        let mut spectrum = copies(0.0, self.transform.n_columns() * length);
        for_each_row(&mut spectrum, length, |column, values| {
            let q_y = column as f64 * unit_y;
            for (row, value) in values.iter_mut().enumerate() {
                *value = symbol([row as f64 * unit_x, q_y]) * normalisation;
            }
        });
        spectrum
    }

    /// Wave numbers of the longest waves of the period along x and y, \[rad/m]; all others are multiples of them.
    fn fundamental_wave_numbers(&self) -> [f64; 2] {
        [0, 1]
            .map(|axis| 2.0 * PI / (self.transform.padded[axis] as f64 * self.grid.spacing()[axis]))
    }

    /// Spectrum 2π M(|q|t)/|q| of a periodic load on a layer of thickness t, with M = 1 on a half space. The mean has the compliance to
    /// uniform pressure on a rigid base, and zero on others.
    pub(super) fn periodic_spectrum(&self) -> Vec<f64> {
        self.spectrum_of(|[q_x, q_y]| {
            let q = q_x.hypot(q_y);
            2.0 * PI
                * if q > 0.0 {
                    self.base.reduced_wave_number(q).recip()
                } else {
                    self.base.uniform_compliance()
                }
        })
    }

    /// Spectrum of a symbol, with negative values replaced by zero and the mean by the value for the longest wave.
    pub(super) fn positive_spectrum(&self, symbol: impl Fn([f64; 2]) -> f64 + Sync) -> Vec<f64> {
        let [unit_x, unit_y] = self.fundamental_wave_numbers();
        let longest = if unit_x < unit_y {
            [unit_x, 0.0]
        } else {
            [0.0, unit_y]
        };
        self.spectrum_of(|q| {
            let q = if q == [0.0, 0.0] { longest } else { q };
            symbol(q).max(0.0)
        })
    }

    /// Value of the kernel at the origin, the self-influence: the sum of its spectrum over the whole period.
    pub(super) fn sum_of_spectrum(&self) -> f64 {
        let length = self.transform.padded[0] / 2 + 1;
        let [twice_x, twice_y] = self.transform.padded.map(|n| n.div_ceil(2));
        // Waves strictly inside the stored quarter stand for their mirror images too.
        let weight = |index: usize, twice: usize| {
            let is_twice = (1..twice).contains(&index);
            if is_twice { 2.0 } else { 1.0 }
        };
        let column = |(column, values): (usize, &[f64])| {
            let rows = values.iter().enumerate();
            weight(column, twice_y)
                * rows
                    .map(|(row, value)| weight(row, twice_x) * value)
                    .sum::<f64>()
        };
        self.spectrum.chunks(length).enumerate().map(column).sum()
    }

    /// Spectrum of the influence coefficients without load outside the grid.
    ///
    /// The kernel is even and its transform real, so that two columns are transformed as real and imaginary part of one.
    pub(super) fn free_spectrum(&self) -> Vec<f64> {
        // Transform the kernel along y, then two columns at a time along x.
        let rows = self.transformed_kernel_rows();
        let length = self.transform.padded[0] / 2 + 1;
        let mut spectrum = copies(0.0, self.transform.n_columns() * length);
        for_each_row(&mut spectrum, 2 * length, |pair, spectrum| {
            let mut values = self.kernel_columns(&rows, 2 * pair);
            self.transform.column_forward(&mut values);
            self.separate_columns(&values, spectrum);
        });
        spectrum
    }

    /// Columns number `column` and `column + 1` of the row-transformed kernel over the period, as real and imaginary parts; zero for a
    /// column beyond the last. `rows` has the layout of [`transformed_kernel_rows`](Self::transformed_kernel_rows).
    fn kernel_columns(&self, rows: &[f64], column: usize) -> Vec<Complex<f64>> {
        let period = self.transform.padded[0];
        let mut values = vec![ZERO; period];
        for (row, transformed) in rows.chunks_exact(self.transform.n_columns()).enumerate() {
            let second = transformed.get(column + 1).copied();
            let value = Complex::new(transformed[column], second.map_or(0.0, |value| value));
            values[row] = value;
            values[(period - row) % period] = value;
        }
        values
    }

    /// Splits a transformed pair of columns into the spectra of both, one after the other in `spectrum`, times the normalisation.
    fn separate_columns(&self, values: &[Complex<f64>], spectrum: &mut [f64]) {
        let normalisation = self.transform.normalisation();
        let (first, second) = spectrum.split_at_mut(self.transform.padded[0] / 2 + 1);
        for (spectrum, value) in first.iter_mut().zip(values) {
            *spectrum = value.re * normalisation;
        }
        for (spectrum, value) in second.iter_mut().zip(values) {
            *spectrum = value.im * normalisation;
        }
    }

    /// Fourier transforms of the kernel along y, with the layout [offset along x][column]; real, because the kernel is even.
    fn transformed_kernel_rows(&self) -> Vec<f64> {
        let n_columns = self.transform.n_columns();
        let mut rows = copies(0.0, self.grid.shape()[0] * n_columns);
        for_each_row(&mut rows, n_columns, |row, result| {
            let mut transformed = vec![ZERO; n_columns];
            self.transform
                .transform_row(&mut self.kernel_row(row), &mut transformed);
            for (result, value) in result.iter_mut().zip(&transformed) {
                *result = value.re;
            }
        });
        rows
    }

    /// Influence coefficients at the offset of `row` elements along x and all offsets of the period along y.
    fn kernel_row(&self, row: usize) -> Vec<f64> {
        // The kernel is even along y, so that each offset also gives the value at its negative, at the end of the period.
        let [dx, dy] = self.grid.spacing();
        let period = self.transform.padded[1];
        let mut values = vec![0.0; period];
        for column in 0..self.grid.shape()[1] {
            let offset = [row as f64 * dx, column as f64 * dy];
            let coefficient = self.base.influence(offset, [dx, dy]);
            values[column] = coefficient;
            values[(period - column) % period] = coefficient;
        }
        values
    }
}
