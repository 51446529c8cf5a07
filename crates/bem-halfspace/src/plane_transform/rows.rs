//! Real transforms along y.

use std::sync::Arc;

use realfft::{ComplexToReal, RealFftPlanner, RealToComplex};
use rustfft::num_complex::Complex;

use crate::mirror::Mirror;
use crate::plane_transform::workspace::Lane;
use crate::plane_transform::{about_centre, about_edge};

/// The transforms of a row, or of the part of it in front of a mirror.
///
/// The coefficients of a whole row are complex, and those of the other half of the period their conjugates; those beside
/// a mirror are real, and two of them side by side are stored as one complex number.
#[derive(Clone)]
pub(super) struct RowTransform {
    forward: Arc<dyn RealToComplex<f64>>,
    inverse: Arc<dyn ComplexToReal<f64>>,
    mirror: Mirror,
    /// Of [`about_centre`] or [`about_edge`]; empty without a mirror.
    turns: Vec<Complex<f64>>,
}

impl RowTransform {
    /// For a period of so many elements.
    pub(super) fn new(period: usize, mirror: Mirror) -> Self {
        let (length, turns) = match mirror {
            Mirror::None => (period, Vec::new()),
            Mirror::Centre => (period / 2, about_centre::turns(period / 2)),
            Mirror::Edge => (period / 2, about_edge::turns(period / 2)),
        };
        let mut planner = RealFftPlanner::new();
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

    pub(super) const fn has_mirror(&self) -> bool {
        !self.mirror.is_none()
    }

    /// Number of complex numbers that hold the coefficients.
    pub(super) fn n_coefficients(&self) -> usize {
        if self.has_mirror() {
            self.len().div_ceil(2)
        } else {
            self.len() / 2 + 1
        }
    }

    pub(super) fn scratch_len(&self) -> usize {
        let inverse = self.inverse.get_scratch_len();
        self.forward.get_scratch_len().max(inverse)
    }

    /// Transforms all elements of a row without a mirror; they are overwritten.
    pub(super) fn forward_whole(
        &self,
        scratch: &mut [Complex<f64>],
        row: &mut [f64],
        transformed: &mut [Complex<f64>],
    ) {
        let done = self.forward.process_with_scratch(row, transformed, scratch);
        debug_assert!(done.is_ok(), "the buffers fit the plan: {done:?}");
    }

    /// Transforms the values at the beginning of a row that is zero behind them; the coefficients are in the half row of
    /// the lane.
    pub(super) fn forward(&self, lane: &mut Lane, values: &[f64]) {
        match self.mirror {
            Mirror::None => {
                lane.row[..values.len()].copy_from_slice(values);
                lane.row[values.len()..].fill(0.0);
                self.forward_whole(&mut lane.scratch, &mut lane.row, &mut lane.half_row);
            }
            Mirror::Centre => {
                lane.row[..values.len()].copy_from_slice(values);
                lane.row[values.len()..].fill(0.0);
                lane.row[0] *= 2.0;
                self.cosines(lane);
                pair(&lane.row, &mut lane.half_row);
            }
            Mirror::Edge => {
                about_edge::order(values, &mut lane.row);
                self.forward_whole(&mut lane.scratch, &mut lane.row, &mut lane.half_row);
                about_edge::turn(&self.turns, &lane.half_row, &mut lane.row);
                pair(&lane.row, &mut lane.half_row);
            }
        }
    }

    /// The way back, without normalisation, of the coefficients in the half row of the lane.
    pub(super) fn inverse(&self, lane: &mut Lane, values: &mut [f64]) {
        match self.mirror {
            Mirror::None => {
                self.inverse_whole(lane);
                values.copy_from_slice(&lane.row[..values.len()]);
            }
            Mirror::Centre => {
                unpair(&lane.half_row, &mut lane.row);
                self.cosines(lane);
                values.copy_from_slice(&lane.row[..values.len()]);
            }
            Mirror::Edge => {
                unpair(&lane.half_row, &mut lane.row);
                about_edge::turn_back(&self.turns, &lane.row, &mut lane.half_row);
                self.inverse_whole(lane);
                about_edge::order_back(&lane.row, values);
            }
        }
    }

    fn inverse_whole(&self, lane: &mut Lane) {
        // Rounding leaves imaginary parts where a real row has none, and the transform refuses them.
        lane.half_row[0].im = 0.0;
        let length = lane.row.len();
        if length.is_multiple_of(2) {
            lane.half_row[length / 2].im = 0.0;
        }
        let (row, half_row, scratch) = (&mut lane.row, &mut lane.half_row, &mut lane.scratch);
        let done = self.inverse.process_with_scratch(half_row, row, scratch);
        debug_assert!(done.is_ok(), "the buffers fit the plan: {done:?}");
    }

    /// The sums F of [`about_centre`] of the row of the lane; overwrites its half row.
    fn cosines(&self, lane: &mut Lane) {
        let length = self.forward.len();
        let first = about_centre::fold(&self.turns, &mut lane.row);
        let half_row = &mut lane.half_row[..=length / 2];
        self.forward_whole(&mut lane.scratch, &mut lane.row[..length], half_row);
        about_centre::unfold_real(first, half_row, &mut lane.row);
    }
}

/// Stores two real numbers each as one complex number.
fn pair(reals: &[f64], pairs: &mut [Complex<f64>]) {
    let (whole, rest) = reals.as_chunks::<2>();
    let alone = rest.iter().map(|&real| Complex::new(real, 0.0));
    let whole = whole.iter().map(|&[re, im]| Complex::new(re, im));
    for (place, pair) in pairs.iter_mut().zip(whole.chain(alone)) {
        *place = pair;
    }
}

/// The way back.
fn unpair(pairs: &[Complex<f64>], reals: &mut [f64]) {
    for (reals, pair) in reals.chunks_mut(2).zip(pairs) {
        for (real, value) in reals.iter_mut().zip([pair.re, pair.im]) {
            *real = value;
        }
    }
}
