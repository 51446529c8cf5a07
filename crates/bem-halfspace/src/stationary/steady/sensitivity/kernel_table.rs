//! Values of a kernel by the offset of an element from the loaded one.

use crate::parallel::reductions::add_scaled;
use crate::stationary::steady::wake_table::WakeTable;

/// A kernel as a function of the offset, or its derivative by a parameter, \[1/Pa].
pub(super) struct KernelTable {
    /// Largest offsets: along x in either direction, and along y.
    max_offsets: [usize; 2],
    /// Row-major: by offset along x, from behind the load on, and by distance along y.
    values: Vec<f64>,
}

impl KernelTable {
    /// A zero kernel up to the largest offsets along x and y.
    pub(super) fn zero(max_offsets: [usize; 2]) -> Self {
        let [rows, columns] = max_offsets;
        Self {
            max_offsets,
            values: vec![0.0; (2 * rows + 1) * (columns + 1)],
        }
    }

    /// Kernel with the values of a wake table times `compliance`, that of the unit load \[1/Pa], up to the largest offsets.
    pub(super) fn of_wake(wake: &WakeTable, compliance: f64, max_offsets: [usize; 2]) -> Self {
        let mut table = Self::zero(max_offsets);
        for (offset, row) in table.rows_mut() {
            for (column, value) in row.iter_mut().enumerate() {
                *value = compliance * wake.displacement(offset, column);
            }
        }
        table
    }

    /// Adds a function of the offset along x times a function of the distance along y.
    pub(super) fn add_product(&mut self, along_x: impl Fn(isize) -> f64, along_y: &[f64]) {
        for (offset, row) in self.rows_mut() {
            add_scaled(row, along_x(offset), along_y);
        }
    }

    /// The values at an offset along x, by distance along y.
    pub(super) fn row(&self, offset: isize) -> &[f64] {
        let columns = self.max_offsets[1] + 1;
        let row = (self.max_offsets[0].cast_signed() + offset).unsigned_abs();
        &self.values[row * columns..][..columns]
    }

    /// The rows of the table with their offsets along x.
    fn rows_mut(&mut self) -> impl Iterator<Item = (isize, &mut [f64])> {
        let [rows, columns] = self.max_offsets;
        let lines = self.values.chunks_exact_mut(columns + 1);
        (-rows.cast_signed()..).zip(lines)
    }
}
