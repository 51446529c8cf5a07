//! Blocks of so many by so many elements.

use std::ops::Range;

use crate::contact::active_set::ActiveSet;

/// Sums over the elements of each block of a band that are in contact, of the terms that their places in the part of a
/// list have that belongs to the band.
pub(super) fn sum_blocks<const EDGE: usize>(
    contact: &ActiveSet,
    band: usize,
    term: impl Fn(usize) -> f64,
    sums: &mut [f64],
) {
    let columns = contact.columns();
    let first_row = contact.bands().rows(band).start;
    sums.fill(0.0);
    for run in contact.runs(band) {
        let Range { start, end } = run.elements();
        let row = start / columns;
        let sums = &mut sums[(row - first_row) / EDGE * columns.div_ceil(EDGE)..];
        let (mut column, end) = (start - row * columns, end - row * columns);
        let mut place = run.places().start;
        while column < end {
            let block = column / EDGE;
            let length = ((block + 1) * EDGE).min(end) - column;
            sums[block] += (place..place + length).map(&term).sum::<f64>();
            (column, place) = (column + length, place + length);
        }
    }
}
