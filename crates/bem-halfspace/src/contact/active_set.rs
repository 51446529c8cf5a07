//! The active set: the elements in contact, with packed vectors over them.
//!
//! A field holds one value per element of the grid, row-major. A packed vector holds one value per active element, in the same
//! order. The work on it is proportional to the number of active elements, however porous the contact is. Both are divided at
//! the row blocks ([`RowBlocks`]), groups of consecutive rows that threads process independently.

use std::ops::Range;

use crate::parallel::chunks::Starts;
use crate::parallel::row_blocks::RowBlocks;

/// A maximal run of active elements in one row.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Run {
    /// Index of the first element in the field.
    element: usize,
    /// Index of its first value in the part of a packed vector that belongs to the row block.
    packed_start: usize,
    /// Number of elements.
    length: usize,
}

impl Run {
    /// Row-major indices of the elements of the run in a field of the grid.
    pub(crate) fn elements(&self) -> Range<usize> {
        self.element..self.element + self.length
    }

    /// Indices of its elements in a part of the field that begins with the element `first`.
    pub(crate) fn elements_from(&self, first: usize) -> Range<usize> {
        self.element - first..self.element - first + self.length
    }

    /// Range of its values in the part of a packed vector that belongs to the row block.
    pub(crate) fn packed_range(&self) -> Range<usize> {
        self.packed_start..self.packed_start + self.length
    }
}

/// Result of [`ActiveSet::find_matches`]: number and last index of the elements that satisfy a condition.
pub(crate) struct Matches {
    /// Number of these elements.
    pub(crate) count: usize,
    /// Index of the last of these elements; 0 if there are none.
    pub(crate) last: usize,
}

/// The elements in contact, as flags and as runs.
#[derive(Debug, Clone)]
pub(crate) struct ActiveSet {
    /// Flag of each element of the grid, row-major: true in contact.
    is_active: Vec<bool>,
    /// Number of columns of the grid.
    pub(crate) columns: usize,
    /// Division of the rows of the grid among threads.
    pub(crate) row_blocks: RowBlocks,
    /// Runs of each row block, with capacity for as many as are possible, so that a change does not allocate.
    runs: Vec<Vec<Run>>,
    /// Number of active elements before each row block, and in total; `n_blocks + 1` values.
    starts: Vec<usize>,
}

impl ActiveSet {
    /// An active set without elements, on a grid of the given numbers of rows and columns.
    pub(crate) fn new(shape: [usize; 2]) -> Self {
        let row_blocks = RowBlocks::new(shape);
        // At most every other element of a row begins a run.
        let most_runs = |row_block| row_blocks.rows(row_block).len() * shape[1].div_ceil(2);
        let runs =
            (0..row_blocks.n_blocks()).map(|row_block| Vec::with_capacity(most_runs(row_block)));
        Self {
            is_active: vec![false; shape[0] * shape[1]],
            columns: shape[1],
            row_blocks,
            runs: runs.collect(),
            starts: vec![0; row_blocks.n_blocks() + 1],
        }
    }

    /// Replaces the active set by the elements for which `is_active` is true.
    ///
    /// [`find_runs`](Self::find_runs) must follow.
    pub(crate) fn assign(&mut self, is_active: impl Fn(usize) -> bool + Sync) {
        self.toggle(|element, was_active| is_active(element) != was_active);
    }

    /// Exchanges the elements for which `changes(element, is_active)` is true between the set and its complement.
    ///
    /// [`find_runs`](Self::find_runs) must follow.
    pub(crate) fn toggle(&mut self, changes: impl Fn(usize, bool) -> bool + Sync) {
        let row_blocks = self.row_blocks;
        row_blocks.for_each([&mut self.is_active], |row_block, [flags]| {
            for (element, is_active) in row_blocks.elements(row_block).zip(flags) {
                *is_active ^= changes(element, *is_active);
            }
        });
    }

    /// Recomputes the runs, and the numbers of active elements before each row block, from the flags.
    pub(crate) fn find_runs(&mut self) {
        // Find the runs of active elements in the rows of each row block, in parallel.
        let (row_blocks, columns, is_active) = (self.row_blocks, self.columns, &self.is_active);
        let in_row_block = |row_block, [runs]: [&mut [Vec<Run>]; 1]| {
            let elements = row_blocks.elements(row_block);
            let rows = is_active[elements.clone()].chunks_exact(columns);
            find_runs_in(rows, elements.start, &mut runs[0]);
        };
        let runs = [(&mut self.runs[..], Starts::Every(1))];
        row_blocks.for_each_part(runs, in_row_block);
        // Count the active elements before each row block: the index at which its part of a packed vector begins.
        let mut before = 0;
        for (runs, start) in self.runs.iter().zip(&mut self.starts[1..]) {
            before += runs.last().map_or(0, |run| run.packed_range().end);
            *start = before;
        }
    }

    /// Number of active elements.
    pub(crate) fn len(&self) -> usize {
        self.starts[self.row_blocks.n_blocks()]
    }

    /// The runs of a row block, in increasing order.
    pub(crate) fn runs(&self, row_block: usize) -> &[Run] {
        &self.runs[row_block]
    }

    /// Index range of a row block in a packed vector.
    pub(crate) fn packed_range(&self, row_block: usize) -> Range<usize> {
        self.starts[row_block]..self.starts[row_block + 1]
    }

    /// The inactive elements of a row block as ranges, in increasing order.
    pub(crate) fn inactive_ranges(&self, row_block: usize) -> impl Iterator<Item = Range<usize>> {
        // The inactive elements are those in the gaps between the runs; a gap may be empty.
        let Range { start, end } = self.row_blocks.elements(row_block);
        let runs = self.runs(row_block).iter().map(Run::elements);
        let starts = std::iter::once(start).chain(runs.clone().map(|run| run.end));
        let ends = runs.map(|run| run.start).chain(std::iter::once(end));
        starts.zip(ends).map(|(start, end)| start..end)
    }

    /// Argument of [`RowBlocks::fold`] for a packed vector: the vector with its division at the row blocks.
    pub(crate) fn packed<'a, T>(&'a self, vector: &'a mut [T]) -> (&'a mut [T], Starts<'a>) {
        (vector, Starts::Listed(&self.starts))
    }

    /// Argument of [`RowBlocks::fold`] for a field with one value per element: the field with its division at the row blocks.
    pub(crate) fn field<'a, T>(&self, field: &'a mut [T]) -> (&'a mut [T], Starts<'a>) {
        (field, self.row_blocks.starts_of_coarse_blocks(1))
    }

    /// Argument of [`RowBlocks::fold`] for a field with one value per block of `edge` × `edge` elements, row-major: the field with its
    /// division at the row blocks. `edge` is a power of two of at most [`RowBlocks::MAX_COARSE_BLOCK`].
    pub(crate) fn blocks<'a, T>(
        &self,
        edge: usize,
        field: &'a mut [T],
    ) -> (&'a mut [T], Starts<'a>) {
        (field, self.row_blocks.starts_of_coarse_blocks(edge))
    }

    /// Sum of `of_range(packed range)` over all row blocks, pairwise, so that it does not depend on the threads.
    pub(crate) fn sum(&self, of_range: impl Fn(Range<usize>) -> f64 + Sync) -> f64 {
        self.row_blocks
            .sum(|row_block| of_range(self.packed_range(row_block)))
    }

    /// Gathers the values of a field into a packed vector.
    pub(crate) fn gather<T: Copy + Send + Sync>(&self, field: &[T], vector: &mut [T]) {
        self.row_blocks
            .for_each_part([self.packed(vector)], |row_block, [vector]| {
                self.gather_in(row_block, field, vector);
            });
    }

    /// Gathers the values of a field into the part of a packed vector that belongs to a row block.
    pub(crate) fn gather_in<T: Copy>(&self, row_block: usize, field: &[T], vector: &mut [T]) {
        for run in self.runs(row_block) {
            vector[run.packed_range()].copy_from_slice(&field[run.elements()]);
        }
    }

    /// Scatters a packed vector into a field; inactive elements keep their values.
    pub(crate) fn scatter<T: Copy + Send + Sync>(&self, vector: &[T], field: &mut [T]) {
        self.row_blocks
            .for_each_part([self.field(field)], |row_block, [field]| {
                self.scatter_in(row_block, &vector[self.packed_range(row_block)], field);
            });
    }

    /// Scatters a packed vector into the part of a field that belongs to a row block.
    pub(crate) fn scatter_in<T: Copy>(&self, row_block: usize, vector: &[T], field: &mut [T]) {
        let first = self.row_blocks.elements(row_block).start;
        for run in self.runs(row_block) {
            field[run.elements_from(first)].copy_from_slice(&vector[run.packed_range()]);
        }
    }

    /// Counts the elements of the grid for which `matches(element, is_active)` is true, and finds the last of them.
    pub(crate) fn find_matches(&self, matches: impl Fn(usize, bool) -> bool + Sync) -> Matches {
        let in_row_block = |row_block| {
            let mut found = Matches { count: 0, last: 0 };
            for element in self.row_blocks.elements(row_block) {
                if matches(element, self.is_active[element]) {
                    found.count += 1;
                    found.last = element;
                }
            }
            found
        };
        self.row_blocks
            .gather(in_row_block, |left: Matches, right| Matches {
                count: left.count + right.count,
                last: left.last.max(right.last),
            })
    }

    /// True if the element is active.
    pub(crate) fn contains(&self, element: usize) -> bool {
        self.is_active[element]
    }
}

/// Replaces `runs` by the runs of true flags in consecutive rows. The first flag is that of the element `first`; runs do not
/// continue from one row to the next.
fn find_runs_in<'a>(rows: impl Iterator<Item = &'a [bool]>, first: usize, runs: &mut Vec<Run>) {
    runs.clear();
    let (mut end, mut packed) = (first, 0);
    for equal in rows.flat_map(|row| row.chunk_by(|left, right| left == right)) {
        let (element, length) = (end, equal.len());
        end += length;
        if equal[0] {
            runs.push(Run {
                element,
                packed_start: packed,
                length,
            });
            packed += length;
        }
    }
}

/// Sums of terms over the active elements of each block of `EDGE` × `EDGE` elements in a row block: restriction to a coarser grid.
///
/// `term` gets the index of an element in the part of a packed vector that belongs to the row block. `sums` has one value per block
/// of elements, row-major; a block without active elements has the sum 0.
pub(crate) fn sum_blocks<const EDGE: usize>(
    active: &ActiveSet,
    row_block: usize,
    term: impl Fn(usize) -> f64,
    sums: &mut [f64],
) {
    let columns = active.columns;
    let first_row = active.row_blocks.rows(row_block).start;
    sums.fill(0.0);
    for run in active.runs(row_block) {
        let Range { start, end } = run.elements();
        let row = start / columns;
        let sums = &mut sums[(row - first_row) / EDGE * columns.div_ceil(EDGE)..];
        let (mut column, end) = (start - row * columns, end - row * columns);
        let mut packed = run.packed_range().start;
        while column < end {
            let block = column / EDGE;
            // Add the terms of that part of the run that lies in one block of elements.
            let length = ((block + 1) * EDGE).min(end) - column;
            sums[block] += (packed..packed + length).map(&term).sum::<f64>();
            (column, packed) = (column + length, packed + length);
        }
    }
}
