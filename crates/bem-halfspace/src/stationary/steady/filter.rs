//! Filters with kernels that are even along y, but not along x.

use std::sync::Arc;

use rustfft::num_complex::Complex;

use crate::stationary::steady::region::Region;
use crate::transform::plane_transform::{PlaneTransform, Workspace, ZERO};

/// Fourier transform of a kernel, by column, with the normalisation of the transforms folded in.
pub(super) type Spectrum = Vec<Complex<f64>>;

/// Filters of one period.
#[derive(Debug)]
pub(super) struct Filters<const N: usize> {
    pub(super) transform: PlaneTransform,
    pub(super) spectra: [Spectrum; N],
}

/// Filters of fields on the bounding box of a region.
pub(super) struct RegionFilter<const N: usize> {
    filters: Arc<Filters<N>>,
    workspace: Workspace,
    field: Vec<f64>,
}

/// The product of the stationary kernel with loads: displacements of the elements of a region.
pub(super) type KernelOperator = RegionFilter<1>;

impl<const N: usize> RegionFilter<N> {
    pub(super) fn new(filters: Arc<Filters<N>>, region: &Region) -> Self {
        Self {
            workspace: Workspace::new(&filters.transform, region.shape),
            field: vec![0.0; region.n_places()],
            filters,
        }
    }

    /// One of the filters of values on the elements of `region`, which are 0 elsewhere.
    pub(super) fn apply(&mut self, filter: usize, values: &[f64], region: &Region) -> Vec<f64> {
        region.scatter(values, &mut self.field);
        let Filters { transform, spectra } = &*self.filters;
        transform.filter(&mut self.workspace, &mut self.field, &spectra[filter]);
        region.gather(&self.field)
    }
}

impl PlaneTransform {
    /// Spectrum of a kernel that is even along y; `kernel(row, column)` is asked for the whole period along x and half
    /// of it along y, offsets above half the period along x being negative ones. `column_step` may change each column
    /// of the transform before it is stored.
    pub(super) fn spectrum(
        &self,
        kernel: impl Fn(usize, usize) -> f64,
        column_step: impl Fn(&Self, &mut [Complex<f64>]),
    ) -> Spectrum {
        let [length, width] = self.padded;
        let n_columns = self.n_columns();
        let mut values = vec![0.0; width];
        let mut transformed = vec![ZERO; n_columns];
        let mut spectrum = vec![ZERO; n_columns * length];
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

    /// Replaces a field of the shape of the workspace by its product with a spectrum, in Fourier space. Does not
    /// allocate.
    fn filter(&self, workspace: &mut Workspace, field: &mut [f64], spectrum: &Spectrum) {
        let rows = 0..workspace.shape[0];
        self.load(workspace, field, &rows);
        let length = self.padded[0];
        self.pass(workspace, (&rows, &rows), |column, values| {
            let factors = &spectrum[column * length..][..length];
            for (value, factor) in values.iter_mut().zip(factors) {
                *value *= factor;
            }
        });
        self.read(workspace, field, &rows);
    }
}

/// Offset of an index within a period, negative in its upper half.
pub(super) const fn signed_offset(index: usize, period: usize) -> isize {
    let is_lower = index <= period / 2;
    index.cast_signed() - if is_lower { 0 } else { period.cast_signed() }
}
