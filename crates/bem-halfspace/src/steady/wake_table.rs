//! Kernel values between the elements of a grid, computed once for all grids of the same aspect ratio.

use std::sync::Arc;

use crate::steady::kernel::wake_influence;

/// Displacement at the rear edge of an element by a unit load on another, by their offset; lengths are in Δx, so that
/// one table serves every spacing.
#[derive(Debug, Clone, Default)]
pub(super) struct WakeTable {
    /// Δy/Δx.
    aspect: f64,
    /// Largest offsets along x, either way, and along y.
    reach: [usize; 2],
    values: Vec<f64>,
}

impl WakeTable {
    /// Whether the table is for elements of this aspect ratio.
    pub(super) fn has_aspect(&self, aspect: f64) -> bool {
        self.aspect.total_cmp(&aspect).is_eq()
    }

    /// Makes the table cover offsets up to `reach`; what is wider already is kept.
    pub(super) fn cover(table: &mut Arc<Self>, aspect: f64, reach: [usize; 2]) {
        let empty = table.values.is_empty();
        if !empty && table.reach[0] >= reach[0] && table.reach[1] >= reach[1] {
            return;
        }
        let reach = [0, 1].map(|axis| reach[axis].max(table.reach[axis]));
        let mut values = Vec::with_capacity((2 * reach[0] + 1) * (reach[1] + 1));
        for row in 0..=2 * reach[0] {
            let rows = row as f64 - reach[0] as f64;
            let line = (0..=reach[1]).map(|columns| displacement([rows, columns as f64], aspect));
            values.extend(line);
        }
        *table = Arc::new(Self {
            aspect,
            reach,
            values,
        });
    }

    /// Displacement at the rear edge of an element by the unit load of another that lies `rows` behind it and `columns`
    /// beside it.
    pub(super) fn at(&self, rows: isize, columns: usize) -> f64 {
        match rows
            .checked_add_unsigned(self.reach[0])
            .map(usize::try_from)
        {
            Some(Ok(row)) if row <= 2 * self.reach[0] && columns <= self.reach[1] => {
                self.values[row * (self.reach[1] + 1) + columns]
            }
            _ => displacement([rows as f64, columns as f64], self.aspect),
        }
    }
}

/// Displacement at the rear edge of an element by a unit load `rows` behind it and `columns` beside it.
fn displacement([rows, columns]: [f64; 2], aspect: f64) -> f64 {
    // From the centre of the loaded element to the rear edge of the other one.
    -wake_influence([rows - 0.5, columns * aspect], [1.0, aspect])
}
