//! Buffers of the transforms, and their division among threads.

use numerics::transforms::Real;
use rustfft::num_complex::Complex;

use crate::parallel::chunks::{MIN_ELEMENTS, PerThread, Starts, fold_chunks};
use crate::parallel::row_blocks::copies;
use crate::transform::plane_transform::{COLUMNS_PER_TILE, PlaneTransform, ROWS_PER_STRIP};

/// Buffers for transforms of fields of one shape; with the feature `rayon`, for the threads of the pool in which they were made.
#[derive(Debug, Clone)]
pub(crate) struct Workspace<T = f64> {
    /// Rows and columns of the fields.
    pub(crate) shape: [usize; 2],
    /// Coefficients of the transformed rows in pieces of a tile's columns, `[strip][tile][row of the strip]`.
    pub(super) strips: Vec<[Complex<T>; COLUMNS_PER_TILE]>,
    /// Columns after the product in Fourier space in the same pieces, `[tile][row]`, padded by one row per tile.
    pub(super) tiles: Vec<[Complex<T>; COLUMNS_PER_TILE]>,
    /// Buffers of each thread.
    pub(super) buffers: PerThread<Buffers<T>>,
}

/// Buffers of the transforms on one thread.
#[derive(Debug, Clone)]
pub(super) struct Buffers<T> {
    /// A row of real values.
    pub(super) row: Vec<T>,
    /// Fourier coefficients of a row; for a row with a mirror, real coefficients in pairs.
    pub(super) half_row: Vec<Complex<T>>,
    /// Columns of a tile, at the distance of the column stride.
    pub(super) columns: Vec<Complex<T>>,
    /// Scratch of the one-dimensional transforms.
    pub(super) scratch: Vec<Complex<T>>,
    /// Input of the transform of a row with a mirror through the centre of an element.
    pub(super) folded: Vec<T>,
}

impl<T: Real> Workspace<T> {
    /// Buffers for fields of `shape`, which must fit into the period of the transform.
    pub(crate) fn new(transform: &PlaneTransform<T>, shape: [usize; 2]) -> Self {
        let n_in_strips = shape[0].next_multiple_of(ROWS_PER_STRIP) * transform.n_tiles();
        Self {
            shape,
            strips: copies([Complex::default(); COLUMNS_PER_TILE], n_in_strips),
            tiles: copies(
                [Complex::default(); COLUMNS_PER_TILE],
                (shape[0] + 1) * transform.n_tiles(),
            ),
            buffers: PerThread::new(shape[0] * shape[1], || Buffers::new(transform)),
        }
    }

    /// Number of pieces from the beginning of one tile to that of the next; padded, because at a power of two tiles would compete
    /// for the same cache lines.
    pub(super) const fn tile_stride(&self) -> usize {
        self.shape[0] + 1
    }
}

impl<T: Real> Buffers<T> {
    /// Buffers of one thread for the transforms of rows and columns.
    fn new(transform: &PlaneTransform<T>) -> Self {
        let scratch = transform.rows.scratch_len();
        Self {
            row: vec![T::default(); transform.rows.len()],
            half_row: vec![Complex::default(); transform.rows.n_reals() / 2 + 1],
            columns: vec![Complex::default(); COLUMNS_PER_TILE * transform.column_stride()],
            scratch: vec![Complex::default(); scratch.max(transform.columns.scratch_len())],
            folded: vec![T::default(); transform.rows.n_reals()],
        }
    }
}

/// Divides `values` into chunks of whole units of `unit` values, and processes them in parallel with the buffers of their threads.
///
/// Calls `work(number of the first unit of the chunk, buffers, chunk)`.
pub(super) fn for_each_chunk<R: Real, T: Send>(
    buffers: &PerThread<Buffers<R>>,
    values: &mut [T],
    unit: usize,
    work: impl Fn(usize, &mut Buffers<R>, &mut [T]) + Sync,
) {
    // Put as many units into a chunk as make it worth handing to another thread.
    let numbers_per_unit = unit * size_of::<T>() / size_of::<f64>();
    let units = MIN_ELEMENTS.div_ceil(numbers_per_unit);
    let n_chunks = values.len().div_ceil(units * unit);
    let in_chunk = |chunk, [values]: [&mut [T]; 1]| {
        buffers.with(|buffers| work(chunk * units, buffers, values));
    };
    let values = [(values, Starts::Every(units * unit))];
    fold_chunks(0..n_chunks, values, &in_chunk, &|(), ()| ());
}
