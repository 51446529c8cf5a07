//! Products with the transform of a kernel that is even along y, but not along x, and therefore complex.

use rustfft::num_complex::Complex;

use crate::transform::plane_transform::{PlaneTransform, Workspace, ZERO};

/// Fourier transform of a kernel, `[column][row]`, multiplied by the normalisation of the transforms.
pub(crate) type Spectrum = Vec<Complex<f64>>;

impl PlaneTransform {
    /// Spectrum of a kernel that is even along y.
    ///
    /// `kernel(row, column)` is evaluated on the whole period along x, where offsets above half of it are negative, and on half of the
    /// period along y. `column_step` may change each column of the transform before it is normalised and stored.
    pub(crate) fn spectrum(
        &self,
        kernel: impl Fn(usize, usize) -> f64,
        column_step: impl Fn(&Self, &mut [Complex<f64>]),
    ) -> Spectrum {
        let [length, width] = self.padded;
        let n_columns = self.n_columns();
        let mut values = vec![0.0; width];
        let mut transformed = vec![ZERO; n_columns];
        let mut spectrum = vec![ZERO; n_columns * length];
        // The kernel is even along y. Mirror each of its rows, and transform it.
        for row in 0..length {
            for column in 0..n_columns {
                let value = kernel(row, column);
                values[column] = value;
                values[(width - column) % width] = value;
            }
            self.transform_row(&mut values, &mut transformed);
            for (column, value) in transformed.iter().enumerate() {
                spectrum[column * length + row] = *value;
            }
        }
        // Transform each column along x, and multiply it by the normalisation of the transforms.
        let normalisation = self.normalisation();
        for column in spectrum.chunks_exact_mut(length) {
            self.column_forward(column);
            column_step(self, column);
            for value in column {
                *value *= normalisation;
            }
        }
        spectrum
    }

    /// Convolves a field of the shape of the workspace with the kernel of a spectrum, in place. Does not allocate.
    pub(crate) fn filter(
        &self,
        workspace: &mut Workspace,
        field: &mut [f64],
        spectrum: &[Complex<f64>],
    ) {
        let rows = 0..workspace.shape[0];
        self.forward_rows(workspace, field, &rows);
        let length = self.padded[0];
        self.filter_columns(workspace, &rows, &rows, |column, values| {
            let factors = &spectrum[column * length..][..length];
            for (value, factor) in values.iter_mut().zip(factors) {
                *value *= factor;
            }
        });
        self.inverse_rows(workspace, field, &rows);
    }
}

/// Offset of an index within a period, negative in its upper half.
pub(crate) const fn signed_offset(index: usize, period: usize) -> isize {
    let is_lower = index <= period / 2;
    index.cast_signed() - if is_lower { 0 } else { period.cast_signed() }
}
