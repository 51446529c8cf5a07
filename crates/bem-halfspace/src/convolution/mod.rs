//! Fast convolution of a pressure field with the influence of the elements.
//!
//! ```text
//! (K P)_ij = Σ K(x_i − x_k, y_j − y_l) P_kl
//! ```
//!
//! Rows are transformed only where they carry pressure and back only where the result is wanted, and each column passes
//! through forward transform, kernel and inverse transform while it is in the cache. The kernel is even along both
//! axes, so its spectrum is real and one quarter of it is stored.

mod spectrum;
mod workspace;

use std::fmt;
use std::ops::Range;
use std::sync::Arc;

use realfft::{ComplexToReal, RealFftPlanner, RealToComplex};
use rustfft::num_complex::Complex;
use rustfft::{Fft, FftPlanner};

use crate::Grid;
use crate::fast_length::fast_length;
pub use workspace::ConvolutionWorkspace;
use workspace::{Lane, for_each_lane};

/// Columns that pass together: eight complex numbers fill two cache lines.
const TILE: usize = 8;
const ZERO: Complex<f64> = Complex { re: 0.0, im: 0.0 };

/// What surrounds the elements of the grid.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum Surroundings {
    /// A half space without load.
    Free,
    /// Copies of the grid without end.
    Periodic,
}

/// What the convolution on one grid needs and no pressure changes; may be shared between threads.
#[derive(Clone)]
pub struct Convolution {
    grid: Grid,
    surroundings: Surroundings,
    padded: [usize; 2],
    /// Real spectrum, [column][0..=padded_x / 2], with the normalisation of the transforms folded in.
    spectrum: Vec<f64>,
    /// Displacement of an element under its own unit load, [m].
    self_influence: f64,
    row_forward: Arc<dyn RealToComplex<f64>>,
    row_inverse: Arc<dyn ComplexToReal<f64>>,
    column_forward: Arc<dyn Fft<f64>>,
    column_inverse: Arc<dyn Fft<f64>>,
}

impl fmt::Debug for Convolution {
    fn fmt(&self, formatter: &mut fmt::Formatter<'_>) -> fmt::Result {
        formatter
            .debug_struct("Convolution")
            .field("grid", &self.grid)
            .field("surroundings", &self.surroundings)
            .field("padded", &self.padded)
            .finish_non_exhaustive()
    }
}

impl Convolution {
    /// Influence on a half space that is free of load outside the grid.
    ///
    /// Zero padding to at least 2n − 1 makes the circular convolution of the Fourier transform the free one.
    #[must_use]
    pub fn new(grid: &Grid) -> Self {
        let padded = grid.shape().map(|n| fast_length(2 * n - 1));
        let mut convolution = Self::planned(grid, Surroundings::Free, padded);
        convolution.spectrum = convolution.free_spectrum();
        convolution.self_influence = crate::influence([0.0, 0.0], grid.spacing());
        convolution
    }

    /// Influence on a half space whose load repeats itself with the edges of the grid as periods.
    ///
    /// A wave of pressure with the wave vector q moves the surface by the same wave times `2π/|q|`
    /// (Johnson 1985, eq. 13.7). The mean pressure moves an infinite half space by an infinite amount; displacements
    /// are measured from their own mean instead.
    #[must_use]
    pub fn periodic(grid: &Grid) -> Self {
        let mut convolution = Self::planned(grid, Surroundings::Periodic, grid.shape());
        convolution.spectrum = convolution.periodic_spectrum();
        convolution.self_influence = convolution.sum_of_spectrum();
        convolution
    }

    /// A convolution on the blocks of two by two elements of a grid that multiplies a wave by the `symbol` of its wave
    /// vector \[rad/m], and the mean and all waves with a symbol below zero like the longest wave or not at all.
    pub(crate) fn on_blocks(grid: &Grid, symbol: impl Fn([f64; 2]) -> f64 + Sync) -> Self {
        let blocks = grid.blocks();
        let padded = blocks.shape().map(fast_length);
        let mut convolution = Self::planned(&blocks, Surroundings::Periodic, padded);
        convolution.spectrum = convolution.positive_spectrum(symbol);
        convolution
    }

    /// The same influence between elements of another grid.
    pub(crate) fn on_grid(&self, grid: &Grid) -> Self {
        match self.surroundings {
            Surroundings::Free => Self::new(grid),
            Surroundings::Periodic => Self::periodic(grid),
        }
    }

    fn planned(grid: &Grid, surroundings: Surroundings, padded: [usize; 2]) -> Self {
        let mut real = RealFftPlanner::new();
        let mut complex = FftPlanner::new();
        Self {
            grid: *grid,
            surroundings,
            padded,
            spectrum: Vec::new(),
            self_influence: 0.0,
            row_forward: real.plan_fft_forward(padded[1]),
            row_inverse: real.plan_fft_inverse(padded[1]),
            column_forward: complex.plan_fft_forward(padded[0]),
            column_inverse: complex.plan_fft_inverse(padded[0]),
        }
    }

    /// The grid of the pressure and of the result.
    #[must_use]
    pub const fn grid(&self) -> &Grid {
        &self.grid
    }

    pub(crate) const fn surroundings(&self) -> Surroundings {
        self.surroundings
    }

    pub(crate) const fn self_influence(&self) -> f64 {
        self.self_influence
    }

    /// Buffers for [`apply`](Self::apply). With the feature `rayon`, one set per thread of the current pool.
    #[must_use]
    pub fn workspace(&self) -> ConvolutionWorkspace {
        ConvolutionWorkspace::new(self)
    }

    /// Computes `K P` in the rows `wanted` of `result` from the rows `loaded` of `pressure`; the pressure outside
    /// these rows counts as zero and the other rows of the result are left as they are.
    ///
    /// Both fields have one value per element of the grid, row-major; the result has the unit of the pressure times
    /// metre. Does not allocate.
    ///
    /// # Panics
    /// When a field or the workspace does not belong to this grid.
    pub fn apply(
        &self,
        workspace: &mut ConvolutionWorkspace,
        (pressure, loaded): (&[f64], Range<usize>),
        (result, wanted): (&mut [f64], Range<usize>),
    ) {
        let elements = self.grid.n_elements();
        assert_eq!(pressure.len(), elements, "one pressure per element");
        assert_eq!(result.len(), elements, "one displacement per element");
        self.transform_rows(workspace, pressure, &loaded);
        self.pass_columns(workspace, &loaded, &wanted);
        self.transform_rows_back(workspace, result, &wanted);
    }

    const fn n_columns(&self) -> usize {
        self.padded[1] / 2 + 1
    }

    const fn n_tiles(&self) -> usize {
        self.n_columns().div_ceil(TILE)
    }

    fn transform_rows(
        &self,
        workspace: &mut ConvolutionWorkspace,
        pressure: &[f64],
        loaded: &Range<usize>,
    ) {
        let (n_y, n_columns) = (self.grid.shape()[1], self.n_columns());
        let ConvolutionWorkspace { rows, lanes, .. } = workspace;
        let rows = &mut rows[loaded.start * n_columns..loaded.end * n_columns];
        for_each_lane(lanes, (rows, n_columns), |first, lane, rows| {
            for (row, transformed) in (loaded.start + first..).zip(rows.chunks_exact_mut(n_columns))
            {
                lane.row[..n_y].copy_from_slice(&pressure[row * n_y..(row + 1) * n_y]);
                lane.row[n_y..].fill(0.0);
                let scratch = &mut lane.scratch;
                let done =
                    self.row_forward
                        .process_with_scratch(&mut lane.row, transformed, scratch);
                debug_assert!(done.is_ok(), "the buffers fit the plan: {done:?}");
            }
        });
    }

    /// Multiplies the columns by the spectrum of the kernel, a tile at a time.
    fn pass_columns(
        &self,
        workspace: &mut ConvolutionWorkspace,
        loaded: &Range<usize>,
        wanted: &Range<usize>,
    ) {
        let ConvolutionWorkspace { rows, tiles, lanes } = workspace;
        let n_x = self.grid.shape()[0];
        for_each_lane(lanes, (tiles, n_x), |first, lane, tiles| {
            for (tile, pieces) in (first..).zip(tiles.chunks_exact_mut(n_x)) {
                let columns = tile * TILE..((tile + 1) * TILE).min(self.n_columns());
                self.gather_columns(lane, rows, (&columns, loaded));
                self.convolve_columns(lane, &columns);
                for (row, piece) in wanted.clone().zip(&mut pieces[wanted.clone()]) {
                    for (column, value) in piece[..columns.len()].iter_mut().enumerate() {
                        *value = lane.columns[column * self.column_stride() + row];
                    }
                }
            }
        });
    }

    /// Columns one beside the other at a distance of a power of two would compete for the same lines of the cache.
    const fn column_stride(&self) -> usize {
        self.padded[0] + TILE
    }

    fn gather_columns(
        &self,
        lane: &mut Lane,
        rows: &[Complex<f64>],
        (columns, loaded): (&Range<usize>, &Range<usize>),
    ) {
        let stride = self.column_stride();
        for column in lane.columns.chunks_exact_mut(stride) {
            column[..loaded.start].fill(ZERO);
            column[loaded.end..].fill(ZERO);
        }
        for row in loaded.clone() {
            let values = &rows[row * self.n_columns()..][columns.clone()];
            for (column, value) in values.iter().enumerate() {
                lane.columns[column * stride + row] = *value;
            }
        }
    }

    fn convolve_columns(&self, lane: &mut Lane, columns: &Range<usize>) {
        let stored = lane.columns.chunks_exact_mut(self.column_stride());
        for (column, values) in columns.clone().zip(stored) {
            let values = &mut values[..self.padded[0]];
            let scratch = &mut lane.scratch;
            self.column_forward.process_with_scratch(values, scratch);
            self.multiply_column(values, column);
            self.column_inverse.process_with_scratch(values, scratch);
        }
    }

    fn multiply_column(&self, values: &mut [Complex<f64>], column: usize) {
        let half = self.padded[0] / 2;
        let spectrum = &self.spectrum[column * (half + 1)..][..=half];
        let (lower, upper) = values.split_at_mut(half + 1);
        for (value, factor) in lower.iter_mut().zip(spectrum) {
            *value *= factor;
        }
        for (value, factor) in upper.iter_mut().rev().zip(&spectrum[1..]) {
            *value *= factor;
        }
    }

    fn transform_rows_back(
        &self,
        workspace: &mut ConvolutionWorkspace,
        result: &mut [f64],
        wanted: &Range<usize>,
    ) {
        let [n_x, n_y] = self.grid.shape();
        let ConvolutionWorkspace { tiles, lanes, .. } = workspace;
        let result = &mut result[wanted.start * n_y..wanted.end * n_y];
        for_each_lane(lanes, (result, n_y), |first, lane, result| {
            for (row, values) in (wanted.start + first..).zip(result.chunks_exact_mut(n_y)) {
                let mut pieces = tiles[row..].iter().step_by(n_x);
                let (whole, rest) = lane.half_row.as_chunks_mut::<TILE>();
                for (values, piece) in whole.iter_mut().zip(&mut pieces) {
                    *values = *piece;
                }
                for (value, found) in rest.iter_mut().zip(pieces.flatten()) {
                    *value = *found;
                }
                self.transform_half_row(lane);
                values.copy_from_slice(&lane.row[..n_y]);
            }
        });
    }

    fn transform_half_row(&self, lane: &mut Lane) {
        // Rounding leaves imaginary parts where a real row has none, and the transform refuses them.
        lane.half_row[0].im = 0.0;
        if self.padded[1].is_multiple_of(2) {
            lane.half_row[self.n_columns() - 1].im = 0.0;
        }
        let scratch = &mut lane.scratch;
        let done =
            self.row_inverse
                .process_with_scratch(&mut lane.half_row, &mut lane.row, scratch);
        debug_assert!(done.is_ok(), "the buffers fit the plan: {done:?}");
    }
}
