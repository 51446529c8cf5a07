//! Kernel values between the elements of a grid, computed once for all grids with the same elements.
//!
//! Upstream of a load, the potential `V = ∬ dA'/r` of a uniformly loaded element is smooth; a retardation element turns
//! it into
//!
//! ```text
//! k(ξ) = q ∫_0^∞ e^(−q s) V(ξ + s) ds = e^(−q) k(ξ + 1) + q ∫_0^1 e^(−q s) V(ξ + s) ds,      q = Δx/(v λ)
//! ```
//!
//! with lengths in Δx: one recursion along each column of the table, from ahead, for each retardation element.

use std::sync::Arc;

use crate::influence;
use crate::steady::kernel::wake_influence;
use crate::steady::retarded_potential::RetardedPotential;
use crate::steady::sliding_creep::ElementCreep;

/// Displacement at the point of an element where its gap is evaluated by a unit load on another, by their offset;
/// lengths are in Δx, so that one table serves every spacing with the same creep over an element.
#[derive(Debug, Clone, Default)]
pub(super) struct WakeTable {
    creep: ElementCreep,
    /// Δy/Δx.
    aspect: f64,
    /// Largest offsets along x, either way, and along y.
    reach: [usize; 2],
    values: Vec<f64>,
    /// What creeps within one element: the values without what came from ahead.
    potentials: Vec<f64>,
}

impl WakeTable {
    /// Whether the table is for this creep and elements of this aspect ratio.
    pub(super) fn is_for(&self, creep: &ElementCreep, aspect: f64) -> bool {
        self.creep == *creep && self.aspect.total_cmp(&aspect).is_eq()
    }

    pub(super) const fn creep(&self) -> &ElementCreep {
        &self.creep
    }

    /// Makes the table cover offsets up to `reach`; what is wider already is kept.
    pub(super) fn cover(
        table: &mut Arc<Self>,
        (creep, aspect): (&ElementCreep, f64),
        reach: [usize; 2],
    ) {
        let empty = table.values.is_empty();
        if !empty && table.reach[0] >= reach[0] && table.reach[1] >= reach[1] {
            return;
        }
        let reach = [0, 1].map(|axis| reach[axis].max(table.reach[axis]));
        *table = Arc::new(Self::new(creep, aspect, reach));
    }

    fn new(creep: &ElementCreep, aspect: f64, reach: [usize; 2]) -> Self {
        let [n_rows, n_columns] = [2 * reach[0] + 1, reach[1] + 1];
        let mut table = Self {
            creep: creep.clone(),
            aspect,
            reach,
            values: vec![0.0; n_rows * n_columns],
            potentials: vec![0.0; n_rows * n_columns],
        };
        let offset = |row: usize| row as f64 - reach[0] as f64 + creep.shift;
        let mut retarded = (!creep.delays.is_empty())
            .then(|| RetardedPotential::new(creep, [offset(n_rows - 1), aspect], n_columns));
        let sunken = |row: usize| -> Vec<f64> {
            let value = |column: usize| {
                -wake_influence([offset(row), column as f64 * aspect], [1.0, aspect])
            };
            (0..n_columns).map(value).collect()
        };
        let mut ahead = if creep.flow > 0.0 {
            sunken(n_rows)
        } else {
            Vec::new()
        };
        for row in (0..n_rows).rev() {
            if let Some(retarded) = &mut retarded {
                retarded.step(offset(row));
            }
            let line = row * n_columns..(row + 1) * n_columns;
            let values = &mut table.values[line.clone()];
            let potentials = &mut table.potentials[line];
            if creep.flow > 0.0 {
                let here = sunken(row);
                for column in 0..n_columns {
                    values[column] += creep.flow * here[column];
                    potentials[column] += creep.flow * (here[column] - ahead[column]);
                }
                ahead = here;
            }
            for column in 0..n_columns {
                if creep.instant > 0.0 {
                    let y = column as f64 * aspect;
                    let instant = creep.instant * influence([offset(row), y], [1.0, aspect]);
                    values[column] += instant;
                    potentials[column] += instant;
                }
                if let Some(retarded) = &retarded {
                    values[column] += retarded.value(column);
                    potentials[column] += retarded.increment(column);
                }
            }
        }
        table
    }

    /// Displacement of an element by the unit load of another that lies `rows` behind it and `columns` beside it, both
    /// within the reach.
    pub(super) fn at(&self, rows: isize, columns: usize) -> f64 {
        self.values[self.index(rows, columns)]
    }

    /// The part of [`at`](Self::at) that has crept over the element itself.
    pub(super) fn potential(&self, rows: isize, columns: usize) -> f64 {
        self.potentials[self.index(rows, columns)]
    }

    fn index(&self, rows: isize, columns: usize) -> usize {
        let row = rows + self.reach[0].cast_signed();
        debug_assert!(
            row >= 0 && row.unsigned_abs() <= 2 * self.reach[0] && columns <= self.reach[1],
            "offset {rows}, {columns} is beyond the reach {:?}",
            self.reach
        );
        row.unsigned_abs() * (self.reach[1] + 1) + columns
    }
}
