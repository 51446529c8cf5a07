//! Blocks of so many by so many elements.

use std::ops::Range;

use crate::contact::contact_set::ContactSet;

/// Visits the parts of the runs of a band that lie in one block each, with the number of the block, counted from the
/// first of the band, and the places of the elements in the part of a list that belongs to the band.
fn for_each_part<const EDGE: usize>(
    contact: &ContactSet,
    band: usize,
    mut visit: impl FnMut(usize, Range<usize>),
) {
    let columns = contact.columns();
    let first_row = contact.bands().rows(band).start;
    for run in contact.runs(band) {
        let Range { start, end } = run.elements();
        let row = start / columns;
        let before = (row - first_row) / EDGE * columns.div_ceil(EDGE);
        let (mut column, end) = (start - row * columns, end - row * columns);
        let mut place = run.places().start;
        while column < end {
            let block = column / EDGE;
            let length = ((block + 1) * EDGE).min(end) - column;
            visit(before + block, place..place + length);
            (column, place) = (column + length, place + length);
        }
    }
}

/// Sums over the elements of each block of a band that are in contact, of the terms that their places have.
pub(super) fn sum_blocks<const EDGE: usize>(
    contact: &ContactSet,
    band: usize,
    term: impl Fn(usize) -> f64,
    sums: &mut [f64],
) {
    sums.fill(0.0);
    for_each_part::<EDGE>(contact, band, |block, places| {
        sums[block] += places.map(&term).sum::<f64>();
    });
}
