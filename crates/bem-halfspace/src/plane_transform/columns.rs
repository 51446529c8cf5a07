//! Complex transforms along x.

use std::ops::Range;
use std::sync::Arc;

use rustfft::num_complex::Complex;
use rustfft::{Fft, FftPlanner};

use crate::plane_transform::{ZERO, mirrored};

/// The transforms of a column, or of the half of it beside a mirror.
#[derive(Clone)]
pub(super) struct ColumnTransform {
    forward: Arc<dyn Fft<f64>>,
    inverse: Arc<dyn Fft<f64>>,
    /// Of [`mirrored`]; none without a mirror.
    pub(super) turns: Option<Vec<Complex<f64>>>,
}

impl ColumnTransform {
    /// For a period of so many elements.
    pub(super) fn new(period: usize, has_mirror: bool) -> Self {
        let length = if has_mirror { period / 2 } else { period };
        let mut planner = FftPlanner::new();
        Self {
            forward: planner.plan_fft_forward(length),
            inverse: planner.plan_fft_inverse(length),
            turns: has_mirror.then(|| mirrored::turns(length)),
        }
    }

    /// Number of elements that are transformed.
    pub(super) fn len(&self) -> usize {
        self.forward.len()
    }

    pub(super) fn scratch_len(&self) -> usize {
        let inverse = self.inverse.get_inplace_scratch_len();
        self.forward.get_inplace_scratch_len().max(inverse)
    }

    /// Where the element of a row stands in a column.
    pub(super) fn place(&self, row: usize) -> usize {
        match self.turns {
            Some(_) => mirrored::place(row, self.len()),
            None => row,
        }
    }

    /// Clears a column where no loaded row fills it.
    pub(super) fn clear_beside(&self, loaded: &Range<usize>, column: &mut [Complex<f64>]) {
        if self.turns.is_some() {
            column.fill(ZERO);
        } else {
            column[..loaded.start].fill(ZERO);
            column[loaded.end..].fill(ZERO);
        }
    }

    pub(super) fn forward(&self, scratch: &mut [Complex<f64>], columns: &mut [Complex<f64>]) {
        self.forward.process_with_scratch(columns, scratch);
    }

    pub(super) fn inverse(&self, scratch: &mut [Complex<f64>], columns: &mut [Complex<f64>]) {
        self.inverse.process_with_scratch(columns, scratch);
    }
}
