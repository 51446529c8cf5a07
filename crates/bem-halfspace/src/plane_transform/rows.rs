//! Real transforms along y.

use std::sync::Arc;

use realfft::{ComplexToReal, RealFftPlanner, RealToComplex};
use rustfft::num_complex::Complex;

use crate::plane_transform::mirrored;
use crate::plane_transform::workspace::Lane;

/// The transforms of a row, or of the half of it beside a mirror.
///
/// The coefficients of a whole row are complex, and those of the other half of the period their conjugates; those beside
/// a mirror are real, and two of them side by side are stored as one complex number.
#[derive(Clone)]
pub(super) struct RowTransform {
    forward: Arc<dyn RealToComplex<f64>>,
    inverse: Arc<dyn ComplexToReal<f64>>,
    /// Of [`mirrored`]; none without a mirror.
    turns: Option<Vec<Complex<f64>>>,
}

impl RowTransform {
    /// For a period of so many elements.
    pub(super) fn new(period: usize, has_mirror: bool) -> Self {
        let length = if has_mirror { period / 2 } else { period };
        let mut planner = RealFftPlanner::new();
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

    pub(super) const fn has_mirror(&self) -> bool {
        self.turns.is_some()
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
        let Some(turns) = &self.turns else {
            lane.row[..values.len()].copy_from_slice(values);
            lane.row[values.len()..].fill(0.0);
            return self.forward_whole(&mut lane.scratch, &mut lane.row, &mut lane.half_row);
        };
        lane.row.fill(0.0);
        let odd = values.iter().skip(1).step_by(2);
        let even = values.iter().step_by(2);
        for (place, value) in lane.row.iter_mut().zip(even) {
            *place = *value;
        }
        for (place, value) in lane.row.iter_mut().rev().zip(odd) {
            *place = *value;
        }
        self.forward_whole(&mut lane.scratch, &mut lane.row, &mut lane.half_row);
        let length = lane.row.len();
        for (k, (value, turn)) in lane.half_row.iter().zip(turns).enumerate() {
            let turned = 2.0 * value * turn;
            if k > 0 {
                lane.row[length - k] = -turned.im;
            }
            lane.row[k] = turned.re;
        }
        let (pairs, last) = lane.row.as_chunks::<2>();
        let alone = last.iter().map(|&real| Complex::new(real, 0.0));
        let pairs = pairs.iter().map(|&[re, im]| Complex::new(re, im));
        for (coefficient, pair) in lane.half_row.iter_mut().zip(pairs.chain(alone)) {
            *coefficient = pair;
        }
    }

    /// The way back, without normalisation, of the coefficients in the half row of the lane.
    pub(super) fn inverse(&self, lane: &mut Lane, values: &mut [f64]) {
        let Some(turns) = &self.turns else {
            self.inverse_whole(lane);
            values.copy_from_slice(&lane.row[..values.len()]);
            return;
        };
        for (reals, pair) in lane.row.chunks_mut(2).zip(&lane.half_row) {
            for (real, value) in reals.iter_mut().zip([pair.re, pair.im]) {
                *real = value;
            }
        }
        let length = lane.row.len();
        for (k, (value, turn)) in lane.half_row.iter_mut().zip(turns).enumerate() {
            let opposite = if k > 0 { lane.row[length - k] } else { 0.0 };
            *value = turn.conj() * Complex::new(lane.row[k], -opposite);
        }
        self.inverse_whole(lane);
        for (value, place) in values.iter_mut().step_by(2).zip(&lane.row) {
            *value = *place;
        }
        let odd = values.iter_mut().skip(1).step_by(2);
        for (value, place) in odd.zip(lane.row.iter().rev()) {
            *value = *place;
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
}
