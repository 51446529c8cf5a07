//! Blocks of two by two elements.

use crate::bands::fold_parts;
use crate::contact::contact_set::ContactSet;

/// Sums over the elements of each block that are in contact, on a grid with so many columns.
pub(super) fn sum_blocks(
    contact: &ContactSet,
    columns: usize,
    value: impl Fn(usize) -> f64 + Sync,
    sums: &mut [f64],
) {
    let bands = contact.bands();
    let block_columns = columns.div_ceil(2);
    let in_band = |band, [sums]: [&mut [f64]; 1]| {
        sums.fill(0.0);
        for run in contact.runs(band) {
            let (row, column) = (run.start / columns, run.start % columns);
            let sums = &mut sums[(row - bands.rows(band).start) / 2 * block_columns..];
            for (column, element) in (column..).zip(run.clone()) {
                sums[column / 2] += value(element);
            }
        }
    };
    let blocks_per_band = bands.rows_per_band() / 2 * block_columns;
    let sums = [(sums, blocks_per_band)];
    fold_parts(0..bands.n_bands(), sums, &in_band, &|(), ()| ());
}
