//! Complex transforms of columns, along x.

use std::sync::Arc;

use numerics::transforms::Real;
use rustfft::Fft;
use rustfft::num_complex::Complex;

use crate::elements::mirror::Mirror;
use crate::transform::plane_transform::{about_centre, about_edge};

/// Plans of the transforms of a column, or of the half of a column that is its own mirror image.
#[derive(Clone)]
pub(super) struct ColumnTransform<T> {
    /// Forward transform, of the period or of half of it.
    forward: Arc<dyn Fft<T>>,
    /// Inverse transform of the same length, without normalisation.
    inverse: Arc<dyn Fft<T>>,
    /// Mirror at the first element of the column.
    pub(super) mirror: Mirror,
    /// Twiddle factors of [`about_edge`]; empty for other mirrors.
    pub(super) twiddles: Vec<Complex<T>>,
}

impl<T: Real> ColumnTransform<T> {
    /// Plans for columns of a period of `period` elements.
    pub(super) fn new(period: usize, mirror: Mirror) -> Self {
        // With a mirror about a centre the whole period is transformed, with one about an edge half of it.
        let (length, twiddles) = match mirror {
            Mirror::None | Mirror::Centre => (period, Vec::new()),
            Mirror::Edge => (period / 2, about_edge::twiddles(period / 2)),
        };
        Self {
            forward: T::forward(length),
            inverse: T::inverse(length),
            mirror,
            twiddles,
        }
    }

    /// Number of elements of a stored column: the period, or the part of it in the symmetry-reduced domain.
    pub(super) fn len(&self) -> usize {
        match self.mirror {
            Mirror::None | Mirror::Edge => self.forward.len(),
            Mirror::Centre => self.forward.len() / 2 + 1,
        }
    }

    /// Number of complex numbers of scratch that both transforms need.
    pub(super) fn scratch_len(&self) -> usize {
        let plans = [&self.forward, &self.inverse];
        let [forward, inverse] = plans.map(|plan| plan.get_inplace_scratch_len());
        let period_len = match self.mirror {
            Mirror::Centre => self.forward.len(),
            Mirror::None | Mirror::Edge => 0,
        };
        period_len + forward.max(inverse)
    }

    /// Index in the stored column of the element of a row: columns with a mirror at an edge are stored in the order of [`about_edge`].
    pub(super) fn index_of_row(&self, row: usize) -> usize {
        match self.mirror {
            Mirror::None | Mirror::Centre => row,
            Mirror::Edge => about_edge::ordered_index(row, self.len()),
        }
    }

    /// Transforms a column in place, along x.
    pub(super) fn forward(&self, scratch: &mut [Complex<T>], column: &mut [Complex<T>]) {
        if self.mirror == Mirror::Centre {
            // The half element in the symmetry-reduced domain counts on both sides of the mirror.
            column[0] *= T::rounded(2.0);
            return self.sum_of_period(scratch, column);
        }
        self.forward.process_with_scratch(column, scratch);
    }

    /// Transforms a column back in place, without normalisation.
    pub(super) fn inverse(&self, scratch: &mut [Complex<T>], column: &mut [Complex<T>]) {
        if self.mirror == Mirror::Centre {
            return self.sum_of_period(scratch, column);
        }
        self.inverse.process_with_scratch(column, scratch);
    }

    /// The sums F of [`about_centre`], in both directions, by the Fourier transform of the whole period: along x a mirror through
    /// centres saves only the work on rows.
    fn sum_of_period(&self, scratch: &mut [Complex<T>], column: &mut [Complex<T>]) {
        let (period, scratch) = scratch.split_at_mut(self.forward.len());
        about_centre::unfold(column, period);
        self.forward.process_with_scratch(period, scratch);
        column.copy_from_slice(&period[..column.len()]);
    }
}
