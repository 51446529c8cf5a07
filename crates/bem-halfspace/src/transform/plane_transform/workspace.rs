//! Buffers of a filter.

use rustfft::num_complex::Complex;

use crate::parallel::bands::copies;
use crate::parallel::chunks::{MIN_ELEMENTS, PerThread, Starts, fold_chunks};
use crate::transform::plane_transform::{PlaneTransform, STRIP, TILE, ZERO};

/// Buffers of a filter of fields of one shape; with the feature `rayon` for the threads of the pool in which they were
/// made.
#[derive(Debug, Clone)]
pub(crate) struct Workspace {
    /// Rows and columns of the fields.
    pub(crate) shape: [usize; 2],
    /// Transformed rows, [strip][tile][row of the strip].
    pub(super) strips: Vec<[Complex<f64>; TILE]>,
    /// Columns after the product, [tile][row].
    pub(super) tiles: Vec<[Complex<f64>; TILE]>,
    pub(super) buffers: PerThread<Buffers>,
}

/// Buffers of the transforms on one thread.
#[derive(Debug, Clone)]
pub(super) struct Buffers {
    pub(super) row: Vec<f64>,
    pub(super) half_row: Vec<Complex<f64>>,
    pub(super) columns: Vec<Complex<f64>>,
    pub(super) scratch: Vec<Complex<f64>>,
    /// What is transformed of rows in front of a mirror about a centre.
    pub(super) folded: Vec<f64>,
}

impl Workspace {
    /// For fields of `shape`, which the period of the transform holds.
    pub(crate) fn new(transform: &PlaneTransform, shape: [usize; 2]) -> Self {
        let n_in_strips = shape[0].next_multiple_of(STRIP) * transform.n_tiles();
        Self {
            shape,
            strips: copies([ZERO; TILE], n_in_strips),
            tiles: copies([ZERO; TILE], (shape[0] + 1) * transform.n_tiles()),
            buffers: PerThread::new(shape[0] * shape[1], || Buffers::new(transform)),
        }
    }

    /// Number of pieces from one tile to the next; at a distance of a power of two they would compete for the same lines of
    /// the cache.
    pub(super) const fn tile_stride(&self) -> usize {
        self.shape[0] + 1
    }
}

impl Buffers {
    fn new(transform: &PlaneTransform) -> Self {
        let scratch = transform.rows.scratch_len();
        Self {
            row: vec![0.0; transform.rows.len()],
            half_row: vec![ZERO; transform.rows.n_reals() / 2 + 1],
            columns: vec![ZERO; TILE * transform.column_stride()],
            scratch: vec![ZERO; scratch.max(transform.columns.scratch_len())],
            folded: vec![0.0; transform.rows.n_reals()],
        }
    }
}

/// Divides `values` into chunks of whole units and does the work of each with the buffers of its thread: `work` gets the
/// number of the first unit of a chunk, the buffers and the chunk.
pub(super) fn for_each_chunk<T: Send>(
    buffers: &PerThread<Buffers>,
    (values, unit): (&mut [T], usize),
    work: impl Fn(usize, &mut Buffers, &mut [T]) + Sync,
) {
    let numbers_per_unit = unit * size_of::<T>() / size_of::<f64>();
    let units = MIN_ELEMENTS.div_ceil(numbers_per_unit);
    let n_chunks = values.len().div_ceil(units * unit);
    let in_chunk = |chunk, [values]: [&mut [T]; 1]| {
        buffers.with(|buffers| work(chunk * units, buffers, values));
    };
    let values = [(values, Starts::Every(units * unit))];
    fold_chunks(0..n_chunks, values, &in_chunk, &|(), ()| ());
}
