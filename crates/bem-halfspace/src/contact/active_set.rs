//! The active set: the elements in contact.
//!
//! Their values are kept in lists, in the order of the field, so that the work on a contact is proportional to the number of
//! its elements, however porous it is.

use std::ops::Range;

use crate::parallel::bands::Bands;
use crate::parallel::chunks::Starts;

/// Neighbours in contact, in one row and not continued in it.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Run {
    /// The first element.
    element: usize,
    /// Its place in the part of a list that belongs to the band.
    packed_start: usize,
    length: usize,
}

impl Run {
    pub(crate) fn elements(&self) -> Range<usize> {
        self.element..self.element + self.length
    }

    /// Counted from the element `first`.
    pub(crate) fn elements_from(&self, first: usize) -> Range<usize> {
        self.element - first..self.element - first + self.length
    }

    pub(crate) fn packed_range(&self) -> Range<usize> {
        self.packed_start..self.packed_start + self.length
    }
}

/// Elements in contact, as runs of neighbours.
#[derive(Debug, Clone)]
pub(crate) struct ActiveSet {
    is_active: Vec<bool>,
    pub(crate) columns: usize,
    pub(crate) bands: Bands,
    /// Of each band, with room for as many as there can be, so that a change does not allocate.
    runs: Vec<Vec<Run>>,
    /// Number of elements in contact before each band, and of all.
    starts: Vec<usize>,
}

impl ActiveSet {
    /// The empty contact on a grid of the given shape.
    pub(crate) fn new(shape: [usize; 2]) -> Self {
        let bands = Bands::new(shape);
        let most_runs = |band| bands.rows(band).len() * shape[1].div_ceil(2);
        let runs = (0..bands.n_bands()).map(|band| Vec::with_capacity(most_runs(band)));
        Self {
            is_active: vec![false; shape[0] * shape[1]],
            columns: shape[1],
            bands,
            runs: runs.collect(),
            starts: vec![0; bands.n_bands() + 1],
        }
    }

    /// Replaces the active set by the elements for which `in_contact` is true.
    ///
    /// [`find_runs`](Self::find_runs) must follow.
    pub(crate) fn assign(&mut self, is_active: impl Fn(usize) -> bool + Sync) {
        self.toggle(|element, is| is_active(element) != is);
    }

    /// Moves the elements for which `changes` is true into the contact or out of it; it gets the element and whether that is
    /// in contact.
    ///
    /// [`find_runs`](Self::find_runs) must follow.
    pub(crate) fn toggle(&mut self, changes: impl Fn(usize, bool) -> bool + Sync) {
        let bands = self.bands;
        bands.for_each([&mut self.is_active], |band, [is_active]| {
            for (element, is) in bands.elements(band).zip(is_active) {
                *is ^= changes(element, *is);
            }
        });
    }

    /// Finds the runs after changes.
    pub(crate) fn find_runs(&mut self) {
        let (bands, columns, is_active) = (self.bands, self.columns, &self.is_active);
        let in_band = |band, [runs]: [&mut [Vec<Run>]; 1]| {
            let elements = bands.elements(band);
            let rows = is_active[elements.clone()].chunks_exact(columns);
            find_runs_in(rows, elements.start, &mut runs[0]);
        };
        let runs = [(&mut self.runs[..], Starts::Every(1))];
        bands.for_each_part(runs, in_band);
        let mut before = 0;
        for (runs, start) in self.runs.iter().zip(&mut self.starts[1..]) {
            before += runs.last().map_or(0, |run| run.packed_range().end);
            *start = before;
        }
    }

    pub(crate) fn len(&self) -> usize {
        self.starts[self.bands.n_bands()]
    }

    /// The neighbours in contact in a band, increasing.
    pub(crate) fn runs(&self, band: usize) -> &[Run] {
        &self.runs[band]
    }

    /// The part of a list that belongs to a band.
    pub(crate) fn packed_range(&self, band: usize) -> Range<usize> {
        self.starts[band]..self.starts[band + 1]
    }

    /// The elements of a band outside the contact as ranges, increasing.
    pub(crate) fn inactive_ranges(&self, band: usize) -> impl Iterator<Item = Range<usize>> {
        let Range { start, end } = self.bands.elements(band);
        let runs = self.runs(band).iter().map(Run::elements);
        let starts = std::iter::once(start).chain(runs.clone().map(|run| run.end));
        let ends = runs.map(|run| run.start).chain(std::iter::once(end));
        starts.zip(ends).map(|(start, end)| start..end)
    }

    /// A list, for [`Bands::fold`].
    pub(crate) fn packed<'a, T>(&'a self, list: &'a mut [T]) -> (&'a mut [T], Starts<'a>) {
        (list, Starts::Listed(&self.starts))
    }

    /// A field with one value per element, for [`Bands::fold`].
    pub(crate) fn field<'a, T>(&self, field: &'a mut [T]) -> (&'a mut [T], Starts<'a>) {
        (field, self.bands.starts_of_blocks(1))
    }

    /// A field with one value per block of so many elements along an edge, for [`Bands::fold`].
    pub(crate) fn blocks<'a, T>(
        &self,
        edge: usize,
        field: &'a mut [T],
    ) -> (&'a mut [T], Starts<'a>) {
        (field, self.bands.starts_of_blocks(edge))
    }

    /// Sum over bands, from the places of the elements of each.
    pub(crate) fn sum(&self, of_range: impl Fn(Range<usize>) -> f64 + Sync) -> f64 {
        self.bands.sum(|band| of_range(self.packed_range(band)))
    }

    /// Lists the values of a field.
    pub(crate) fn gather<T: Copy + Send + Sync>(&self, field: &[T], list: &mut [T]) {
        self.bands
            .for_each_part([self.packed(list)], |band, [list]| {
                self.gather_in(band, field, list);
            });
    }

    pub(crate) fn gather_in<T: Copy>(&self, band: usize, field: &[T], list: &mut [T]) {
        for run in self.runs(band) {
            list[run.packed_range()].copy_from_slice(&field[run.elements()]);
        }
    }

    /// Writes the values of a list into a field.
    pub(crate) fn scatter<T: Copy + Send + Sync>(&self, list: &[T], field: &mut [T]) {
        self.bands
            .for_each_part([self.field(field)], |band, [field]| {
                self.scatter_in(band, &list[self.packed_range(band)], field);
            });
    }

    /// Writes the part of a list that belongs to a band into the same part of a field.
    pub(crate) fn scatter_in<T: Copy>(&self, band: usize, list: &[T], field: &mut [T]) {
        let first = self.bands.elements(band).start;
        for run in self.runs(band) {
            field[run.elements_from(first)].copy_from_slice(&list[run.packed_range()]);
        }
    }

    /// Number of elements for which `is` is true, which gets the element and whether that is in contact, and the last of
    /// them.
    pub(crate) fn find_last(&self, is: impl Fn(usize, bool) -> bool + Sync) -> (usize, usize) {
        let in_band = |band| {
            let found = |&element: &usize| is(element, self.is_active[element]);
            let found = self.bands.elements(band).filter(found);
            found.fold((0, 0), |(count, _), element| (count + 1, element))
        };
        let both =
            |left: (usize, usize), right: (usize, usize)| (left.0 + right.0, left.1.max(right.1));
        self.bands.gather(in_band, both)
    }

    pub(crate) fn contains(&self, element: usize) -> bool {
        self.is_active[element]
    }
}

/// Finds the runs in rows of which the first begins with the element `end`.
fn find_runs_in<'a>(rows: impl Iterator<Item = &'a [bool]>, mut end: usize, runs: &mut Vec<Run>) {
    runs.clear();
    let mut place = 0;
    for equal in rows.flat_map(|row| row.chunk_by(|left, right| left == right)) {
        let (element, length) = (end, equal.len());
        end += length;
        if equal[0] {
            runs.push(Run {
                element,
                packed_start: place,
                length,
            });
            place += length;
        }
    }
}

/// Sums over the elements of each block of a band that are in contact, of the terms that their places in the part of a
/// list have that belongs to the band.
pub(crate) fn sum_blocks<const EDGE: usize>(
    active: &ActiveSet,
    band: usize,
    term: impl Fn(usize) -> f64,
    sums: &mut [f64],
) {
    let columns = active.columns;
    let first_row = active.bands.rows(band).start;
    sums.fill(0.0);
    for run in active.runs(band) {
        let Range { start, end } = run.elements();
        let row = start / columns;
        let sums = &mut sums[(row - first_row) / EDGE * columns.div_ceil(EDGE)..];
        let (mut column, end) = (start - row * columns, end - row * columns);
        let mut place = run.packed_range().start;
        while column < end {
            let block = column / EDGE;
            let length = ((block + 1) * EDGE).min(end) - column;
            sums[block] += (place..place + length).map(&term).sum::<f64>();
            (column, place) = (column + length, place + length);
        }
    }
}
