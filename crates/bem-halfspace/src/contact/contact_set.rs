//! The elements in contact.

use std::ops::Range;

use crate::bands::Bands;

/// Elements in contact, as runs of neighbours, so that what concerns the contact costs as much as the contact is large.
#[derive(Debug, Clone)]
pub(super) struct ContactSet {
    in_contact: Vec<bool>,
    columns: usize,
    bands: Bands,
    /// Each in one row; with room for as many as there can be, so that a change does not allocate.
    runs: Vec<Range<usize>>,
    /// Number of runs before each row, and of all.
    runs_before: Vec<usize>,
    n_elements: usize,
}

impl ContactSet {
    /// The empty contact on a grid of the given shape.
    pub(super) fn new([rows, columns]: [usize; 2]) -> Self {
        Self {
            in_contact: vec![false; rows * columns],
            columns,
            bands: Bands::new([rows, columns]),
            runs: Vec::with_capacity(rows * columns.div_ceil(2)),
            runs_before: vec![0; rows + 1],
            n_elements: 0,
        }
    }

    /// Takes the elements for which `in_contact` says so.
    pub(super) fn assign(&mut self, in_contact: impl Fn(usize) -> bool + Sync) {
        self.change(|element, is| in_contact(element) != is);
        self.find_runs();
    }

    /// Moves elements into the contact or out of it; `changes` is asked whether, and told where the element is.
    ///
    /// [`find_runs`](Self::find_runs) must follow.
    pub(super) fn change(&mut self, changes: impl Fn(usize, bool) -> bool + Sync) {
        let bands = self.bands;
        bands.for_each([&mut self.in_contact], |band, [in_contact]| {
            for (element, is) in bands.elements(band).zip(in_contact) {
                *is ^= changes(element, *is);
            }
        });
    }

    /// Finds the runs after changes.
    pub(super) fn find_runs(&mut self) {
        self.runs.clear();
        let mut end = 0;
        let rows = self.in_contact.chunks_exact(self.columns);
        for (row, runs_before) in rows.zip(&mut self.runs_before[1..]) {
            for run in row.chunk_by(|left, right| left == right) {
                if run[0] {
                    self.runs.push(end..end + run.len());
                }
                end += run.len();
            }
            *runs_before = self.runs.len();
        }
        self.n_elements = self.runs.iter().map(ExactSizeIterator::len).sum();
    }

    pub(super) const fn len(&self) -> usize {
        self.n_elements
    }

    pub(super) const fn bands(&self) -> Bands {
        self.bands
    }

    /// The elements of a band in contact as ranges of neighbours in one row, increasing.
    pub(super) fn runs(&self, band: usize) -> &[Range<usize>] {
        let rows = self.bands.rows(band);
        &self.runs[self.runs_before[rows.start]..self.runs_before[rows.end]]
    }

    /// The elements of a band outside the contact as ranges, increasing.
    pub(super) fn gaps(&self, band: usize) -> impl Iterator<Item = Range<usize>> {
        let Range { start, end } = self.bands.elements(band);
        let runs = self.runs(band);
        let starts = std::iter::once(start).chain(runs.iter().map(|run| run.end));
        let ends = runs.iter().map(|run| run.start);
        let ends = ends.chain(std::iter::once(end));
        starts.zip(ends).map(|(start, end)| start..end)
    }

    /// Sum over the elements in contact of what a run of them contributes.
    pub(super) fn sum(&self, of_run: impl Fn(Range<usize>) -> f64 + Sync) -> f64 {
        self.bands
            .sum(|band| self.runs(band).iter().cloned().map(&of_run).sum())
    }

    /// Number of elements for which `is` says so, told where they are, and the last of them.
    pub(super) fn find_last(&self, is: impl Fn(usize, bool) -> bool + Sync) -> (usize, usize) {
        let in_band = |band| {
            let found = |&element: &usize| is(element, self.in_contact[element]);
            let found = self.bands.elements(band).filter(found);
            found.fold((0, 0), |(count, _), element| (count + 1, element))
        };
        let both =
            |left: (usize, usize), right: (usize, usize)| (left.0 + right.0, left.1.max(right.1));
        self.bands.gather(in_band, both)
    }

    pub(super) fn contains(&self, element: usize) -> bool {
        self.in_contact[element]
    }
}
