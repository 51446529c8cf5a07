//! Work on parts of fields, side by side where there are threads, with results that do not depend on their number.

use std::ops::Range;

use crate::parallel::chunks::{Chunked, MIN_ELEMENTS, Starts, fold_chunks};

/// The rows of a grid in bands, which depend on the shape of the grid alone.
#[derive(Debug, Clone, Copy)]
pub(crate) struct RowBlocks {
    shape: [usize; 2],
    /// A multiple of [`MAX_COARSE_BLOCK`](Self::MAX_COARSE_BLOCK).
    rows_per_block: usize,
}

impl RowBlocks {
    /// Blocks of so many elements along an edge, or of a half of them and so on, lie in one band.
    pub(crate) const MAX_COARSE_BLOCK: usize = 8;

    pub(crate) const fn new(shape: [usize; 2]) -> Self {
        let blocks = MIN_ELEMENTS.div_ceil(Self::MAX_COARSE_BLOCK * shape[1]);
        Self {
            shape,
            rows_per_block: Self::MAX_COARSE_BLOCK * blocks,
        }
    }

    /// How a field with one value per block of so many elements along an edge is divided.
    pub(crate) const fn starts_of_coarse_blocks(&self, edge: usize) -> Starts<'static> {
        Starts::Every(self.rows_per_block / edge * self.shape[1].div_ceil(edge))
    }

    pub(crate) const fn n_blocks(&self) -> usize {
        self.shape[0].div_ceil(self.rows_per_block)
    }

    pub(crate) fn rows(&self, block: usize) -> Range<usize> {
        let start = block * self.rows_per_block;
        start..(start + self.rows_per_block).min(self.shape[0])
    }

    pub(crate) fn elements(&self, block: usize) -> Range<usize> {
        let rows = self.rows(block);
        rows.start * self.shape[1]..rows.end * self.shape[1]
    }

    /// Does the work of every band on its part of fields that may be divided in different ways.
    pub(crate) fn fold<const N: usize, T: Send, R: Send>(
        &self,
        fields: Chunked<T, N>,
        work: impl Fn(usize, [&mut [T]; N]) -> R + Sync,
        combine: impl Fn(R, R) -> R + Sync,
    ) -> R {
        fold_chunks(0..self.n_blocks(), fields, &work, &combine)
    }

    /// Does the work of every band on its part of fields that may be divided in different ways.
    pub(crate) fn for_each_part<const N: usize, T: Send>(
        &self,
        fields: Chunked<T, N>,
        work: impl Fn(usize, [&mut [T]; N]) + Sync,
    ) {
        self.fold(fields, work, |(), ()| ());
    }

    /// Does the work of every band on its part of the fields, which have one value per element.
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

    /// Results of the bands, combined pairwise.
    pub(crate) fn gather<R: Send>(
        &self,
        work: impl Fn(usize) -> R + Sync,
        combine: impl Fn(R, R) -> R + Sync,
    ) -> R {
        self.fold::<0, (), R>([], |block, []| work(block), combine)
    }

    /// Sum of the results of the bands.
    pub(crate) fn sum(&self, work: impl Fn(usize) -> f64 + Sync) -> f64 {
        self.gather(work, |left, right| left + right)
    }
}

/// Does work on every row of a field of so many columns, side by side; it gets the number of the row.
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

/// Copies of a value, first touched by the threads that share the memory from then on.
pub(crate) fn copies<T: Copy + Send + Sync>(value: T, count: usize) -> Vec<T> {
    let mut values = Vec::new();
    resize(&mut values, value, count);
    values
}

/// Removes values from the end, or adds copies of a value, first touched by the threads that share the memory from then
/// on.
#[cfg(feature = "rayon")]
pub(crate) fn resize<T: Copy + Send + Sync>(values: &mut Vec<T>, value: T, count: usize) {
    use rayon::prelude::{
        IndexedParallelIterator, IntoParallelIterator, ParallelExtend, ParallelIterator,
    };
    values.truncate(count);
    let missing = (values.len()..count).into_par_iter();
    values.par_extend(missing.with_min_len(MIN_ELEMENTS).map(|_| value));
}

/// Removes values from the end, or adds copies of a value.
#[cfg(not(feature = "rayon"))]
pub(crate) fn resize<T: Copy>(values: &mut Vec<T>, value: T, count: usize) {
    values.resize(count, value);
}
