//! What a filter overwrites, divided into lanes that work side by side.

#[cfg(feature = "rayon")]
use rayon::prelude::{IndexedParallelIterator, IntoParallelRefMutIterator, ParallelIterator};
#[cfg(feature = "rayon")]
use rayon::slice::ParallelSliceMut;
use rustfft::num_complex::Complex;

use crate::bands::copies;
use crate::plane_transform::about_centre::Buffers;
use crate::plane_transform::{PlaneTransform, STRIP, TILE, ZERO};

/// Below this many elements threads cost more than they gain.
#[cfg(feature = "rayon")]
const MIN_ELEMENTS_PER_LANE: usize = 1 << 13;

/// What a filter of fields of one shape overwrites. With the feature `rayon`, buffers for the threads of the pool in
/// which it was made.
#[derive(Debug, Clone)]
pub(crate) struct Workspace {
    /// Rows and columns of the fields.
    pub(super) shape: [usize; 2],
    /// Transformed rows, [strip][tile][row of the strip].
    pub(super) strips: Vec<[Complex<f64>; TILE]>,
    /// Columns after the product, [tile][row].
    pub(super) tiles: Vec<[Complex<f64>; TILE]>,
    pub(super) lanes: Vec<Lane>,
}

/// The buffers of one lane.
#[derive(Debug, Clone)]
pub(super) struct Lane {
    pub(super) row: Vec<f64>,
    pub(super) half_row: Vec<Complex<f64>>,
    pub(super) columns: Vec<Complex<f64>>,
    pub(super) scratch: Vec<Complex<f64>>,
    /// Of rows in front of a mirror about a centre.
    pub(super) buffers: Buffers,
}

impl Workspace {
    /// For fields of `shape`, which the period of the transform holds.
    pub(crate) fn new(transform: &PlaneTransform, shape: [usize; 2]) -> Self {
        Self {
            shape,
            strips: copies(
                [ZERO; TILE],
                shape[0].next_multiple_of(STRIP) * transform.n_tiles(),
            ),
            tiles: copies([ZERO; TILE], tile_stride(shape) * transform.n_tiles()),
            lanes: (0..n_lanes(shape[0] * shape[1]))
                .map(|_| Lane::new(transform))
                .collect(),
        }
    }

    /// Number of pieces from one tile to the next.
    pub(super) const fn tile_stride(&self) -> usize {
        tile_stride(self.shape)
    }

    /// Rows and columns of the fields.
    pub(crate) const fn shape(&self) -> [usize; 2] {
        self.shape
    }
}

/// Pieces of a row at a distance of a power of two would compete for the same lines of the cache.
const fn tile_stride(shape: [usize; 2]) -> usize {
    shape[0] + 1
}

impl Lane {
    fn new(transform: &PlaneTransform) -> Self {
        let scratch = transform.rows.scratch_len();
        Self {
            row: vec![0.0; transform.rows.len()],
            half_row: vec![ZERO; transform.rows.len() / 2 + 1],
            columns: vec![ZERO; TILE * transform.column_stride()],
            scratch: vec![ZERO; scratch.max(transform.columns.scratch_len())],
            buffers: transform.rows.buffers(),
        }
    }
}

/// Lanes for each of several threads, of which one may be slower than another.
#[cfg(feature = "rayon")]
const LANES_PER_THREAD: usize = 4;

#[cfg(feature = "rayon")]
fn n_lanes(elements: usize) -> usize {
    match rayon::current_num_threads() {
        1 => 1,
        threads => (LANES_PER_THREAD * threads).min(1 + elements / MIN_ELEMENTS_PER_LANE),
    }
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
