//! Complex transforms along x.

use std::sync::Arc;

use numerics::transforms::Real;
use rustfft::Fft;
use rustfft::num_complex::Complex;

use crate::elements::mirror::Mirror;
use crate::transform::plane_transform::{about_centre, about_edge};

/// The transforms of a column, or of the part of it in front of a mirror.
#[derive(Clone)]
pub(super) struct ColumnTransform<T> {
    forward: Arc<dyn Fft<T>>,
    inverse: Arc<dyn Fft<T>>,
    pub(super) mirror: Mirror,
    /// Of [`about_edge`]; empty without a mirror there.
    pub(super) twiddles: Vec<Complex<T>>,
}

impl<T: Real> ColumnTransform<T> {
    /// For a period of so many elements.
    pub(super) fn new(period: usize, mirror: Mirror) -> Self {
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

    /// Number of elements that are transformed.
    pub(super) fn len(&self) -> usize {
        match self.mirror {
            Mirror::None | Mirror::Edge => self.forward.len(),
            Mirror::Centre => self.forward.len() / 2 + 1,
        }
    }

    pub(super) fn scratch_len(&self) -> usize {
        let plans = [&self.forward, &self.inverse];
        let [forward, inverse] = plans.map(|plan| plan.get_inplace_scratch_len());
        let of_period = match self.mirror {
            Mirror::Centre => self.forward.len(),
            Mirror::None | Mirror::Edge => 0,
        };
        of_period + forward.max(inverse)
    }

    /// Where the element of a row stands in a column.
    pub(super) fn index_of_row(&self, row: usize) -> usize {
        match self.mirror {
            Mirror::None | Mirror::Centre => row,
            Mirror::Edge => about_edge::ordered_index(row, self.len()),
        }
    }

    pub(super) fn forward(&self, scratch: &mut [Complex<T>], column: &mut [Complex<T>]) {
        if self.mirror == Mirror::Centre {
            column[0] *= T::rounded(2.0);
            return self.sum_of_period(scratch, column);
        }
        self.forward.process_with_scratch(column, scratch);
    }

    pub(super) fn inverse(&self, scratch: &mut [Complex<T>], column: &mut [Complex<T>]) {
        if self.mirror == Mirror::Centre {
            return self.sum_of_period(scratch, column);
        }
        self.inverse.process_with_scratch(column, scratch);
    }

    /// The sums F of [`about_centre`], in both directions, as the Fourier transform of the period: here a mirror halves
    /// the rows only.
    fn sum_of_period(&self, scratch: &mut [Complex<T>], column: &mut [Complex<T>]) {
        let (period, scratch) = scratch.split_at_mut(self.forward.len());
        about_centre::unfold(column, period);
        self.forward.process_with_scratch(period, scratch);
        column.copy_from_slice(&period[..column.len()]);
    }
}
