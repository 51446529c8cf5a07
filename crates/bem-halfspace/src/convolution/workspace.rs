//! What a convolution overwrites, divided into lanes that work side by side.

#[cfg(feature = "rayon")]
use rayon::prelude::{IndexedParallelIterator, IntoParallelRefMutIterator, ParallelIterator};
#[cfg(feature = "rayon")]
use rayon::slice::ParallelSliceMut;
use rustfft::num_complex::Complex;

use crate::Convolution;
use crate::bands::copies;
use crate::convolution::{TILE, ZERO};

/// Below this many elements threads cost more than they gain.
#[cfg(feature = "rayon")]
const MIN_ELEMENTS_PER_LANE: usize = 1 << 13;

/// What a convolution overwrites; one per caller, made by [`Convolution::workspace`].
#[derive(Debug, Clone)]
pub struct ConvolutionWorkspace {
    /// Transformed rows, [row][column].
    pub(super) rows: Vec<Complex<f64>>,
    /// Columns after the kernel, [tile][row].
    pub(super) tiles: Vec<[Complex<f64>; TILE]>,
    pub(super) lanes: Vec<Lane>,
}

/// The buffers of one thread.
#[derive(Debug, Clone)]
pub(super) struct Lane {
    pub(super) row: Vec<f64>,
    pub(super) half_row: Vec<Complex<f64>>,
    pub(super) columns: Vec<Complex<f64>>,
    pub(super) scratch: Vec<Complex<f64>>,
}

impl ConvolutionWorkspace {
    pub(super) fn new(convolution: &Convolution) -> Self {
        let n_x = convolution.grid.shape()[0];
        let n_lanes = n_lanes(convolution.grid.n_elements());
        Self {
            rows: copies(ZERO, n_x * convolution.n_columns()),
            tiles: copies([ZERO; TILE], n_x * convolution.n_tiles()),
            lanes: (0..n_lanes).map(|_| Lane::new(convolution)).collect(),
        }
    }
}

impl Lane {
    pub(super) fn new(convolution: &Convolution) -> Self {
        let scratch = [
            convolution.row_forward.get_scratch_len(),
            convolution.row_inverse.get_scratch_len(),
            convolution.column_forward.get_inplace_scratch_len(),
            convolution.column_inverse.get_inplace_scratch_len(),
        ];
        Self {
            row: convolution.row_forward.make_input_vec(),
            half_row: convolution.row_forward.make_output_vec(),
            columns: vec![ZERO; TILE * convolution.column_stride()],
            scratch: vec![ZERO; scratch.into_iter().fold(0, usize::max)],
        }
    }
}

#[cfg(feature = "rayon")]
fn n_lanes(elements: usize) -> usize {
    rayon::current_num_threads().clamp(1, 1 + elements / MIN_ELEMENTS_PER_LANE)
}

#[cfg(not(feature = "rayon"))]
const fn n_lanes(_elements: usize) -> usize {
    1
}

/// Divides `values` into one part per lane, each of whole units, and does the work of each part: `work` gets the number
/// of its first unit, its lane and its part. A unit is worked on the same way in any lane, so that the result does not
/// depend on their number.
pub(super) fn for_each_lane<T: Send>(
    lanes: &mut [Lane],
    (values, unit): (&mut [T], usize),
    work: impl Fn(usize, &mut Lane, &mut [T]) + Sync,
) {
    if let [lane] = lanes {
        work(0, lane, values);
        return;
    }
    #[cfg(feature = "rayon")]
    {
        let units = (values.len() / unit).div_ceil(lanes.len()).max(1);
        lanes
            .par_iter_mut()
            .zip(values.par_chunks_mut(units * unit))
            .enumerate()
            .for_each(|(part, (lane, values))| work(part * units, lane, values));
    }
    #[cfg(not(feature = "rayon"))]
    debug_assert!(lanes.len() == 1, "one lane of units of {unit}");
}
