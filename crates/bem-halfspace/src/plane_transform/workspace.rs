//! What a filter overwrites, divided into lanes that work side by side.

use rustfft::num_complex::Complex;

use crate::bands::copies;
use crate::plane_transform::about_centre::Buffers;
use crate::plane_transform::{PlaneTransform, STRIP, TILE, ZERO};
use crate::sharing::{MIN_ELEMENTS, n_tasks, n_threads, share};

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

fn n_lanes(elements: usize) -> usize {
    n_threads().min(1 + elements / MIN_ELEMENTS)
}

/// Divides `values` into parts of whole units and does the work of each on one of the lanes: `work` gets the number of
/// the first unit of a part, the lane and the part. A unit is worked on the same way in any lane, so that the result does
/// not depend on their number.
pub(super) fn share_among_lanes<T: Send>(
    lanes: &mut [Lane],
    (values, unit): (&mut [T], usize),
    work: impl Fn(usize, &mut Lane, &mut [T]) + Sync,
) {
    let units = (values.len() / unit).div_ceil(n_tasks(lanes.len())).max(1);
    let parts = values.chunks_mut(units * unit).enumerate();
    share(lanes, parts, |lane, (part, values)| {
        work(part * units, lane, values);
    });
}
