//! Complex transforms along x.

use std::ops::Range;
use std::sync::Arc;

use rustfft::num_complex::Complex;
use rustfft::{Fft, FftPlanner};

use crate::mirror::Mirror;
use crate::plane_transform::{ZERO, about_centre, about_edge};

/// The transforms of a column, or of the part of it in front of a mirror.
#[derive(Clone)]
pub(super) struct ColumnTransform {
    forward: Arc<dyn Fft<f64>>,
    inverse: Arc<dyn Fft<f64>>,
    mirror: Mirror,
    /// Of [`about_centre`] or [`about_edge`]; empty without a mirror.
    turns: Vec<Complex<f64>>,
}

impl ColumnTransform {
    /// For a period of so many elements.
    pub(super) fn new(period: usize, mirror: Mirror) -> Self {
        let (length, turns) = match mirror {
            Mirror::None => (period, Vec::new()),
            Mirror::Centre => (period / 2, about_centre::turns(period / 2)),
            Mirror::Edge => (period / 2, about_edge::turns(period / 2)),
        };
        let mut planner = FftPlanner::new();
        Self {
            forward: planner.plan_fft_forward(length),
            inverse: planner.plan_fft_inverse(length),
            mirror,
            turns,
        }
    }

    /// Number of elements that are transformed.
    pub(super) fn len(&self) -> usize {
        match self.mirror {
            Mirror::Centre => self.forward.len() + 1,
            Mirror::None | Mirror::Edge => self.forward.len(),
        }
    }

    pub(super) const fn mirror(&self) -> Mirror {
        self.mirror
    }

    pub(super) fn turns(&self) -> &[Complex<f64>] {
        &self.turns
    }

    pub(super) fn scratch_len(&self) -> usize {
        let plans = [&self.forward, &self.inverse];
        let [forward, inverse] = plans.map(|plan| plan.get_inplace_scratch_len());
        let of_copy = match self.mirror {
            Mirror::Centre => self.forward.len(),
            Mirror::None | Mirror::Edge => 0,
        };
        of_copy + forward.max(inverse)
    }

    /// Where the element of a row stands in a column.
    pub(super) fn place(&self, row: usize) -> usize {
        match self.mirror {
            Mirror::Edge => about_edge::place(row, self.len()),
            Mirror::None | Mirror::Centre => row,
        }
    }

    /// Clears a column where no loaded row fills it.
    pub(super) fn clear_beside(&self, loaded: &Range<usize>, column: &mut [Complex<f64>]) {
        if self.mirror == Mirror::Edge {
            column.fill(ZERO);
        } else {
            column[..loaded.start].fill(ZERO);
            column[loaded.end..].fill(ZERO);
        }
    }

    pub(super) fn forward(&self, scratch: &mut [Complex<f64>], column: &mut [Complex<f64>]) {
        if self.mirror == Mirror::Centre {
            column[0] *= 2.0;
            return self.cosines(scratch, column);
        }
        self.forward.process_with_scratch(column, scratch);
    }

    pub(super) fn inverse(&self, scratch: &mut [Complex<f64>], column: &mut [Complex<f64>]) {
        if self.mirror == Mirror::Centre {
            return self.cosines(scratch, column);
        }
        self.inverse.process_with_scratch(column, scratch);
    }

    /// The sums F of [`about_centre`].
    fn cosines(&self, scratch: &mut [Complex<f64>], column: &mut [Complex<f64>]) {
        let (copy, scratch) = scratch.split_at_mut(self.forward.len());
        let first = about_centre::fold(&self.turns, column);
        copy.copy_from_slice(&column[..copy.len()]);
        self.forward.process_with_scratch(copy, scratch);
        about_centre::unfold_complex(first, copy, column);
    }
}
