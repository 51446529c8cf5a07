//! Two-dimensional real Fourier transforms of fields on a rectangle of elements, and products in Fourier space.
//!
//! Rows are transformed only if they are loaded, and transformed back only if the result is wanted there. Each column has its
//! forward transform, product and inverse transform while it is in the cache, so that the padded field is never stored.
//!
//! If a field is its own mirror image, only the symmetry-reduced domain is stored and transformed; see [`about_centre`] and
//! [`about_edge`].
//!
//! Theory: docs/theory/contact.md, "Mirrors".

mod about_centre;
mod about_edge;
mod columns;
pub(crate) mod complex_product;
mod even_product;
mod real_rows;
mod rows;
mod workspace;

use std::fmt;
use std::ops::Range;

use numerics::transforms::Real;
use rustfft::num_complex::Complex;

use crate::elements::mirror::{Mirror, NO_MIRRORS};
use crate::parallel::chunks::join;
use columns::ColumnTransform;
use rows::RowTransform;
pub(crate) use workspace::Workspace;
use workspace::{Buffers, for_each_chunk};

/// Number of columns of a tile, which are gathered together. Chosen: eight complex numbers fill two cache lines of 64 bytes. It changes
/// the time only.
const COLUMNS_PER_TILE: usize = 8;
/// Number of rows of a strip, whose pieces of a tile are contiguous, so that columns are gathered from few places of memory. Chosen; it
/// changes the time only.
const ROWS_PER_STRIP: usize = 8;
/// The complex number 0.
pub(crate) const ZERO: Complex<f64> = Complex { re: 0.0, im: 0.0 };

/// Plans of the transforms of fields within a period of `padded` elements along x and y; may be shared between threads.
#[derive(Clone)]
pub(crate) struct PlaneTransform<T = f64> {
    /// Elements of the period along x and y.
    pub(crate) padded: [usize; 2],
    /// Plans of the real transforms along y.
    rows: RowTransform<T>,
    /// Plans of the complex transforms along x.
    columns: ColumnTransform<T>,
}

impl<T> fmt::Debug for PlaneTransform<T> {
    /// Writes the period only, because plans have no readable form.
    fn fmt(&self, formatter: &mut fmt::Formatter<'_>) -> fmt::Result {
        formatter
            .debug_struct("PlaneTransform")
            .field("padded", &self.padded)
            .finish_non_exhaustive()
    }
}

impl<T: Real> PlaneTransform<T> {
    /// Plans for real fields on a period of `padded` elements along x and y, without mirrors.
    pub(crate) fn new(padded: [usize; 2]) -> Self {
        Self::folded(padded, NO_MIRRORS)
    }

    /// Plans the transforms of fields that are their own images about `mirrors` and are given on the symmetry-reduced domain. The period must be even
    /// along the axes with a mirror.
    pub(crate) fn folded(padded: [usize; 2], mirrors: [Mirror; 2]) -> Self {
        let (columns, rows) = join(
            || ColumnTransform::new(padded[0], mirrors[0]),
            || RowTransform::new(padded[1], mirrors[1]),
        );
        Self {
            padded,
            rows,
            columns,
        }
    }

    /// Reciprocal of the factor by which forward and inverse transform together multiply a field.
    pub(crate) const fn normalisation(&self) -> f64 {
        1.0 / (self.padded[0] as f64 * self.padded[1] as f64)
    }

    /// Number of stored columns of a transformed field; the rest of the period follows by symmetry.
    pub(crate) fn n_columns(&self) -> usize {
        self.rows.n_coefficients()
    }

    /// Number of tiles of the transformed columns.
    fn n_tiles(&self) -> usize {
        self.n_columns().div_ceil(COLUMNS_PER_TILE)
    }

    /// Distance between the beginnings of neighbouring columns in their buffer, in numbers; padded, because at a power of two they
    /// would compete for the same cache lines.
    fn column_stride(&self) -> usize {
        self.columns.len() + COLUMNS_PER_TILE
    }

    /// Transforms a real row of the whole period along y into its `transformed` half of the period; `row` is overwritten.
    pub(crate) fn transform_row(&self, row: &mut [T], transformed: &mut [Complex<T>]) {
        self.rows.forward_whole(row, transformed);
    }

    /// Transforms columns of the whole period along x in place, without normalisation; one or several, one after the other.
    pub(crate) fn column_forward(&self, columns: &mut [Complex<T>]) {
        let mut scratch = vec![Complex::default(); self.columns.scratch_len()];
        self.columns.forward(&mut scratch, columns);
    }

    /// Transforms columns of the whole period back along x in place, without normalisation; one or several, one after the other.
    pub(crate) fn column_inverse(&self, columns: &mut [Complex<T>]) {
        let mut scratch = vec![Complex::default(); self.columns.scratch_len()];
        self.columns.inverse(&mut scratch, columns);
    }

    /// Transforms the rows `loaded` of a row-major field of the shape of the workspace into the workspace; other rows count as
    /// zero.
    pub(crate) fn forward_rows<F: Real>(
        &self,
        workspace: &mut Workspace<T>,
        field: &[F],
        loaded: &Range<usize>,
    ) {
        let width = workspace.shape[1];
        let (strips, buffers) = (&mut workspace.strips, &mut workspace.buffers);
        let unit = self.n_tiles() * ROWS_PER_STRIP;
        let used = loaded.start / ROWS_PER_STRIP..loaded.end.div_ceil(ROWS_PER_STRIP);
        let strips = &mut strips[used.start * unit..used.end * unit];
        for_each_chunk(buffers, strips, unit, |first, buffers, strips| {
            for (strip, pieces) in (used.start + first..).zip(strips.chunks_exact_mut(unit)) {
                for row in rows_of_strip(strip, loaded) {
                    // Transform the row, and distribute its coefficients over the tiles.
                    self.rows
                        .forward(buffers, &field[row * width..(row + 1) * width]);
                    let coefficients = &buffers.half_row[..self.n_columns()];
                    let mut pieces = pieces[row % ROWS_PER_STRIP..]
                        .iter_mut()
                        .step_by(ROWS_PER_STRIP);
                    let (whole, rest) = coefficients.as_chunks::<COLUMNS_PER_TILE>();
                    for (values, piece) in whole.iter().zip(&mut pieces) {
                        *piece = *values;
                    }
                    for (value, stored) in rest.iter().zip(pieces.flatten()) {
                        *stored = *value;
                    }
                }
            }
        });
    }

    /// Transforms all columns along x, calls `multiply(column, values)` for each, transforms them back and keeps the rows `wanted`.
    ///
    /// Only the rows `loaded`, those of [`forward_rows`](Self::forward_rows), are read; others count as zero.
    pub(crate) fn filter_columns(
        &self,
        workspace: &mut Workspace<T>,
        loaded: &Range<usize>,
        wanted: &Range<usize>,
        multiply: impl Fn(usize, &mut [Complex<T>]) + Sync,
    ) {
        let stride = workspace.tile_stride();
        let (strips, tiles) = (&workspace.strips, &mut workspace.tiles[..]);
        let buffers = &mut workspace.buffers;
        for_each_chunk(buffers, tiles, stride, |first, buffers, tiles| {
            for (tile, pieces) in (first..).zip(tiles.chunks_exact_mut(stride)) {
                let columns =
                    tile * COLUMNS_PER_TILE..((tile + 1) * COLUMNS_PER_TILE).min(self.n_columns());
                self.gather_columns(buffers, strips, tile, loaded);
                self.multiply_columns(buffers, &columns, &multiply);
                // Keep only the wanted rows of the columns of the tile.
                for (row, piece) in wanted.clone().zip(&mut pieces[wanted.clone()]) {
                    let index = self.columns.index_of_row(row);
                    let columns = buffers.columns.chunks_exact(self.column_stride());
                    for (value, column) in piece.iter_mut().zip(columns) {
                        *value = column[index];
                    }
                }
            }
        });
    }

    /// Collects the columns of a tile from the transformed rows `loaded` into the column buffers, padded with zeros.
    fn gather_columns(
        &self,
        buffers: &mut Buffers<T>,
        strips: &[[Complex<T>; COLUMNS_PER_TILE]],
        tile: usize,
        loaded: &Range<usize>,
    ) {
        // Gather the columns strip by strip, because the pieces of a tile within one strip are contiguous.
        let stride = self.column_stride();
        buffers.columns.fill(Complex::default());
        for strip in loaded.start / ROWS_PER_STRIP..loaded.end.div_ceil(ROWS_PER_STRIP) {
            let pieces =
                &strips[(strip * self.n_tiles() + tile) * ROWS_PER_STRIP..][..ROWS_PER_STRIP];
            for row in rows_of_strip(strip, loaded) {
                let index = self.columns.index_of_row(row);
                let columns = buffers.columns.chunks_exact_mut(stride);
                for (column, value) in columns.zip(&pieces[row % ROWS_PER_STRIP]) {
                    column[index] = *value;
                }
            }
        }
    }

    /// Forward transform, product and inverse transform of the buffered columns, whose numbers are `columns`.
    fn multiply_columns(
        &self,
        buffers: &mut Buffers<T>,
        columns: &Range<usize>,
        multiply: impl Fn(usize, &mut [Complex<T>]),
    ) {
        let stored = buffers.columns.chunks_exact_mut(self.column_stride());
        for (column, values) in columns.clone().zip(stored) {
            let values = &mut values[..self.columns.len()];
            self.columns.forward(&mut buffers.scratch, values);
            multiply(column, values);
            self.columns.inverse(&mut buffers.scratch, values);
        }
    }

    /// Transforms the rows `wanted` back from the workspace into `result`, without normalisation; other rows are not changed.
    pub(crate) fn inverse_rows<F: Real>(
        &self,
        workspace: &mut Workspace<T>,
        result: &mut [F],
        wanted: &Range<usize>,
    ) {
        let (stride, width) = (workspace.tile_stride(), workspace.shape[1]);
        let Workspace { tiles, buffers, .. } = workspace;
        let result = &mut result[wanted.start * width..wanted.end * width];
        for_each_chunk(buffers, result, width, |first, buffers, result| {
            for (row, values) in (wanted.start + first..).zip(result.chunks_exact_mut(width)) {
                // Collect the coefficients of the row from all tiles, and transform them back.
                let mut pieces = tiles[row..].iter().step_by(stride);
                let coefficients = &mut buffers.half_row[..self.n_columns()];
                let (whole, rest) = coefficients.as_chunks_mut::<COLUMNS_PER_TILE>();
                for (values, piece) in whole.iter_mut().zip(&mut pieces) {
                    *values = *piece;
                }
                for (value, stored) in rest.iter_mut().zip(pieces.flatten()) {
                    *value = *stored;
                }
                self.rows.inverse(buffers, values);
            }
        });
    }
}

/// A complex number rounded to the precision `T` of a transform.
pub(crate) fn rounded<T: Real>(value: Complex<f64>) -> Complex<T> {
    Complex::new(T::rounded(value.re), T::rounded(value.im))
}

/// The rows of `rows` that lie in strip number `strip`.
fn rows_of_strip(strip: usize, rows: &Range<usize>) -> Range<usize> {
    rows.start.max(strip * ROWS_PER_STRIP)..rows.end.min((strip + 1) * ROWS_PER_STRIP)
}
