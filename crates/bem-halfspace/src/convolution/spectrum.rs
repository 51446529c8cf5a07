//! Spectra of the kernels.

use std::f64::consts::PI;

use rustfft::num_complex::Complex;

use crate::plane_transform::ZERO;
use crate::{Convolution, influence};

impl Convolution {
    fn spectrum_of(&self, symbol: impl Fn([f64; 2]) -> f64) -> Vec<f64> {
        let [unit_x, unit_y] = self.wave_numbers();
        let normalisation = self.transform.normalisation();
        let column = |column: usize| {
            let (symbol, q_y) = (&symbol, column as f64 * unit_y);
            (0..=self.transform.padded()[0] / 2)
                .map(move |row| symbol([row as f64 * unit_x, q_y]) * normalisation)
        };
        (0..self.transform.n_columns()).flat_map(column).collect()
    }

    /// Wave numbers of the longest waves along x and y, \[rad/m].
    fn wave_numbers(&self) -> [f64; 2] {
        [0, 1].map(|axis| {
            2.0 * PI / (self.transform.padded()[axis] as f64 * self.grid.spacing()[axis])
        })
    }

    /// Spectrum of waves on an infinite half space, without their mean.
    pub(super) fn periodic_spectrum(&self) -> Vec<f64> {
        self.spectrum_of(|[q_x, q_y]| {
            let q = q_x.hypot(q_y);
            if q > 0.0 { 2.0 * PI / q } else { 0.0 }
        })
    }

    /// Spectrum of a symbol where that is positive, for the mean that of the longest wave.
    pub(super) fn positive_spectrum(&self, symbol: impl Fn([f64; 2]) -> f64) -> Vec<f64> {
        let [unit_x, unit_y] = self.wave_numbers();
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

    /// Value of the kernel at the origin.
    pub(super) fn sum_of_spectrum(&self) -> f64 {
        let length = self.transform.padded()[0] / 2 + 1;
        let [twice_x, twice_y] = self.transform.padded().map(|n| n.div_ceil(2));
        let weight = |index: usize, twice: usize| {
            if (1..twice).contains(&index) {
                2.0
            } else {
                1.0
            }
        };
        let column = |(column, values): (usize, &[f64])| {
            let values = values.iter().enumerate();
            weight(column, twice_y)
                * values
                    .map(|(row, value)| weight(row, twice_x) * value)
                    .sum::<f64>()
        };
        self.spectrum.chunks(length).enumerate().map(column).sum()
    }

    /// Spectrum of Love's influence coefficients.
    ///
    /// The kernel is even and its transform real, so that two columns pass as the real and the imaginary part of one.
    pub(super) fn free_spectrum(&self) -> Vec<f64> {
        let rows = self.transformed_kernel_rows();
        let [length, half] = [self.transform.padded()[0], self.transform.padded()[0] / 2];
        let mut values = vec![ZERO; length];
        let mut spectrum = vec![0.0; self.transform.n_columns() * (half + 1)];
        let normalisation = self.transform.normalisation();
        for (pair, spectrum) in spectrum.chunks_mut(2 * (half + 1)).enumerate() {
            values.fill(ZERO);
            for (row, transformed) in rows.chunks_exact(self.transform.n_columns()).enumerate() {
                let second = transformed.get(2 * pair + 1).copied();
                let value = Complex::new(transformed[2 * pair], second.map_or(0.0, |value| value));
                values[row] = value;
                values[(length - row) % length] = value;
            }
            self.transform.column_forward(&mut values);
            let (first, second) = spectrum.split_at_mut(half + 1);
            for (spectrum, value) in first.iter_mut().zip(&values) {
                *spectrum = value.re * normalisation;
            }
            for (spectrum, value) in second.iter_mut().zip(&values) {
                *spectrum = value.im * normalisation;
            }
        }
        spectrum
    }

    /// Transforms of the kernel along y, [offset along x][column]; the kernel is even, so they are real.
    fn transformed_kernel_rows(&self) -> Vec<f64> {
        let [n_x, n_y] = self.grid.shape();
        let [dx, dy] = self.grid.spacing();
        let mut values = vec![0.0; self.transform.padded()[1]];
        let mut transformed = vec![ZERO; self.transform.n_columns()];
        let mut rows = Vec::with_capacity(n_x * self.transform.n_columns());
        for row in 0..n_x {
            values.fill(0.0);
            for column in 0..n_y {
                let coefficient = influence([row as f64 * dx, column as f64 * dy], [dx, dy]);
                values[column] = coefficient;
                values[(self.transform.padded()[1] - column) % self.transform.padded()[1]] =
                    coefficient;
            }
            self.transform.transform_row(&mut values, &mut transformed);
            rows.extend(transformed.iter().map(|value| value.re));
        }
        rows
    }
}
