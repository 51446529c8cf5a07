//! The elements in contact.

use std::ops::Range;

/// Elements in contact, as runs of neighbours, so that what concerns the contact costs as much as the contact is large.
#[derive(Debug, Clone)]
pub(super) struct ContactSet {
    in_contact: Vec<bool>,
    columns: usize,
    /// Each in one row.
    runs: Vec<Range<usize>>,
    n_elements: usize,
}

impl ContactSet {
    /// The empty contact on a grid of the given shape.
    pub(super) fn new([rows, columns]: [usize; 2]) -> Self {
        Self {
            in_contact: vec![false; rows * columns],
            columns,
            runs: Vec::new(),
            n_elements: 0,
        }
    }

    /// Takes the elements for which `in_contact` says so.
    pub(super) fn assign(&mut self, in_contact: impl Fn(usize) -> bool) {
        for (element, is) in self.in_contact.iter_mut().enumerate() {
            *is = in_contact(element);
        }
        self.find_runs();
    }

    /// Moves an element into the contact or out of it; [`find_runs`](Self::find_runs) must follow.
    pub(super) fn flip(&mut self, element: usize) {
        self.in_contact[element] ^= true;
    }

    /// Finds the runs after changes.
    pub(super) fn find_runs(&mut self) {
        self.runs.clear();
        let rows = self.in_contact.chunks_exact(self.columns);
        let mut end = 0;
        for run in rows.flat_map(|row| row.chunk_by(|left, right| left == right)) {
            if run[0] {
                self.runs.push(end..end + run.len());
            }
            end += run.len();
        }
        self.n_elements = self.runs.iter().map(ExactSizeIterator::len).sum();
    }

    pub(super) const fn len(&self) -> usize {
        self.n_elements
    }

    /// The elements in contact as ranges of neighbours in one row, increasing.
    pub(super) fn runs(&self) -> &[Range<usize>] {
        &self.runs
    }

    /// The elements in contact, increasing.
    pub(super) fn elements(&self) -> impl Iterator<Item = usize> {
        self.runs.iter().flat_map(Clone::clone)
    }

    /// The runs of elements outside the contact.
    pub(super) fn outside(&self) -> impl Iterator<Item = Range<usize>> {
        let starts = std::iter::once(0).chain(self.runs.iter().map(|run| run.end));
        let ends = self.runs.iter().map(|run| run.start);
        let ends = ends.chain(std::iter::once(self.in_contact.len()));
        starts.zip(ends).map(|(start, end)| start..end)
    }

    pub(super) fn contains(&self, element: usize) -> bool {
        self.in_contact[element]
    }
}
