//! Division of a grid into blocks of rows, which are processed in parallel with results that do not depend on the threads.
//!
//! A *coarse block* is a square of 2, 4 or 8 by as many elements, an element of a coarser grid; row blocks never divide one.

use std::ops::Range;

use crate::parallel::chunks::{Chunked, MIN_ELEMENTS, Starts, fold_chunks};

/// Blocks of consecutive rows of a grid, which depend on the shape of the grid alone.
#[derive(Debug, Clone, Copy)]
pub(crate) struct RowBlocks {
    /// Rows and columns of the grid.
    shape: [usize; 2],
    /// Number of rows of a row block, except the last: a multiple of [`MAX_COARSE_BLOCK`](Self::MAX_COARSE_BLOCK).
    rows_per_block: usize,
}

impl RowBlocks {
    /// Largest edge, in elements, of coarse blocks that no row block divides. Chosen: the multilevel correction of contacts begins with
    /// blocks of this size.
    pub(crate) const MAX_COARSE_BLOCK: usize = 8;

    /// Divides a grid of the given numbers of rows and columns into row blocks of at least [`MIN_ELEMENTS`] elements each, except
    /// the last.
    pub(crate) const fn new(shape: [usize; 2]) -> Self {
        let blocks = MIN_ELEMENTS.div_ceil(Self::MAX_COARSE_BLOCK * shape[1]);
        Self {
            shape,
            rows_per_block: Self::MAX_COARSE_BLOCK * blocks,
        }
    }

    /// Division at the row blocks of a row-major field with one value per coarse block of `edge` by `edge` elements.
    pub(crate) const fn starts_of_coarse_blocks(&self, edge: usize) -> Starts<'static> {
        Starts::Every(self.rows_per_block / edge * self.shape[1].div_ceil(edge))
    }

    /// Number of row blocks.
    pub(crate) const fn n_blocks(&self) -> usize {
        self.shape[0].div_ceil(self.rows_per_block)
    }

    /// Rows of a row block.
    pub(crate) fn rows(&self, block: usize) -> Range<usize> {
        let start = block * self.rows_per_block;
        start..(start + self.rows_per_block).min(self.shape[0])
    }

    /// Row-major indices of the elements of a row block.
    pub(crate) fn elements(&self, block: usize) -> Range<usize> {
        let rows = self.rows(block);
        rows.start * self.shape[1]..rows.end * self.shape[1]
    }

    /// Calls `work(block, parts)` for each row block with its parts of the fields, in parallel, and combines the results pairwise.
    ///
    /// Each field comes with its own division at the row blocks.
    pub(crate) fn fold<const N: usize, T: Send, R: Send>(
        &self,
        fields: Chunked<T, N>,
        work: impl Fn(usize, [&mut [T]; N]) -> R + Sync,
        combine: impl Fn(R, R) -> R + Sync,
    ) -> R {
        fold_chunks(0..self.n_blocks(), fields, &work, &combine)
    }

    /// Calls `work(block, parts)` for each row block, in parallel, with its parts of fields that each have their own division.
    pub(crate) fn for_each_part<const N: usize, T: Send>(
        &self,
        fields: Chunked<T, N>,
        work: impl Fn(usize, [&mut [T]; N]) + Sync,
    ) {
        self.fold(fields, work, |(), ()| ());
    }

    /// Calls `work(block, parts)` for each row block, in parallel, with its parts of fields that have one value per element.
    pub(crate) fn for_each<const N: usize, T: Send>(
        &self,
        fields: [&mut [T]; N],
        work: impl Fn(usize, [&mut [T]; N]) + Sync,
    ) {
        self.for_each_part(
            fields.map(|field| (field, self.starts_of_coarse_blocks(1))),
            work,
        );
    }

    /// Calls `work(block)` for each row block, in parallel, and combines the results pairwise.
    pub(crate) fn gather<R: Send>(
        &self,
        work: impl Fn(usize) -> R + Sync,
        combine: impl Fn(R, R) -> R + Sync,
    ) -> R {
        self.fold::<0, (), R>([], |block, []| work(block), combine)
    }

    /// Pairwise sum of `work(block)` over all row blocks.
    pub(crate) fn sum(&self, work: impl Fn(usize) -> f64 + Sync) -> f64 {
        self.gather(work, |left, right| left + right)
    }
}

/// Calls `work(row, values)` for each row of a row-major field of `columns` columns, in parallel.
pub(crate) fn for_each_row<T: Send>(
    field: &mut [T],
    columns: usize,
    work: impl Fn(usize, &mut [T]) + Sync,
) {
    let row_blocks = RowBlocks::new([field.len().div_ceil(columns), columns]);
    row_blocks.for_each([field], |block, [field]| {
        for (row, values) in row_blocks.rows(block).zip(field.chunks_mut(columns)) {
            work(row, values);
        }
    });
}

/// A vector of `count` copies of `value`; its memory is first touched by the threads of the pool, for locality.
pub(crate) fn copies<T: Copy + Send + Sync>(value: T, count: usize) -> Vec<T> {
    let mut values = Vec::new();
    resize(&mut values, value, count);
    values
}

/// Sets the length of `values` to `count` by truncation or by copies of `value`, which are first touched by the threads of the pool.
#[cfg(feature = "rayon")]
pub(crate) fn resize<T: Copy + Send + Sync>(values: &mut Vec<T>, value: T, count: usize) {
    use rayon::prelude::{
        IndexedParallelIterator, IntoParallelIterator, ParallelExtend, ParallelIterator,
    };
    values.truncate(count);
    let missing = (values.len()..count).into_par_iter();
    values.par_extend(missing.with_min_len(MIN_ELEMENTS).map(|_| value));
}

/// Sets the length of `values` to `count` by truncation or by copies of `value`.
#[cfg(not(feature = "rayon"))]
pub(crate) fn resize<T: Copy>(values: &mut Vec<T>, value: T, count: usize) {
    values.resize(count, value);
}
