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
//!
//! On a track of the length L the potential is that of the nearest image of the load, and the recursion, which is the same
//! within half the length ahead and behind, starts from the integral around the track:
//!
//! ```text
//! k(ξ) = q/(1 − e^(−q L)) ∫_0^L e^(−q s) V(ξ + s) ds,      V(ξ) = V(ξ − L) for ξ > L/2
//! ```

use std::sync::Arc;

use numerics::whole_part;

use crate::stationary::steady::kernel::wake_influence;
use crate::stationary::steady::retarded_potential::RetardedPotential;
use crate::stationary::steady::sliding_creep::ElementCreep;

/// Displacement at the point of an element where its gap is evaluated by a unit load on another, by their offset;
/// lengths are in Δx, so that one table serves every spacing with the same creep over an element.
#[derive(Debug, Clone, Default)]
pub(super) struct WakeTable {
    pub(super) creep: ElementCreep,
    /// Δy/Δx.
    pub(super) aspect: f64,
    /// Largest offsets along x, either way, and along y.
    reach: [usize; 2],
    values: Vec<f64>,
    /// What creeps within one element: the values without what came from ahead.
    potentials: Vec<f64>,
}

impl WakeTable {
    /// Makes the table cover offsets up to `reach`; what is wider already is kept.
    pub(super) fn cover(
        table: &mut Arc<Self>,
        creep: &ElementCreep,
        aspect: f64,
        reach: [usize; 2],
    ) {
        let empty = table.values.is_empty();
        if !empty && table.reach[0] >= reach[0] && table.reach[1] >= reach[1] {
            return;
        }
        let reach = [0, 1].map(|axis| reach[axis].max(table.reach[axis]));
        *table = Arc::new(Self::new(creep, aspect, reach, table));
    }

    /// The table of a creep up to `reach`.
    pub(super) fn of(creep: &ElementCreep, aspect: f64, reach: [usize; 2]) -> Self {
        Self::new(creep, aspect, reach, &Self::default())
    }

    /// The table up to `reach`; what a `smaller` one of the same kind has is not computed again where that is simple.
    fn new(creep: &ElementCreep, aspect: f64, reach: [usize; 2], smaller: &Self) -> Self {
        let n_values = (2 * reach[0] + 1) * (reach[1] + 1);
        let mut table = Self {
            creep: creep.clone(),
            aspect,
            reach,
            values: vec![0.0; n_values],
            potentials: vec![0.0; n_values],
        };
        if creep.flow > 0.0 {
            table.add_flow(smaller);
        }
        if !creep.delays.is_empty() {
            table.add_recovering();
        } else if creep.instant > 0.0 {
            table.add_instant();
        }
        table
    }

    const fn n_columns(&self) -> usize {
        self.reach[1] + 1
    }

    /// Offset of a row of the table from the loaded element.
    fn offset(&self, row: usize) -> f64 {
        row as f64 - self.reach[0] as f64 + self.creep.shift
    }

    fn along(&self, row: usize, kernel: impl Fn([f64; 2], [f64; 2]) -> f64) -> Vec<f64> {
        let x = self.offset(row);
        let value = |column| kernel([x, column as f64 * self.aspect], [1.0, self.aspect]);
        (0..self.n_columns()).map(value).collect()
    }

    /// Adds a row, and what of it has crept within the element.
    fn add(&mut self, row: usize, parts: impl Fn(usize) -> [f64; 2]) {
        let first = row * self.n_columns();
        for column in 0..self.n_columns() {
            let [value, potential] = parts(column);
            self.values[first + column] += value;
            self.potentials[first + column] += potential;
        }
    }

    fn add_flow(&mut self, smaller: &Self) {
        let flow = self.creep.flow;
        let n_rows = 2 * self.reach[0] + 1;
        let mut ahead = self.along(n_rows, wake_influence);
        for row in (0..n_rows).rev() {
            let here = self.wake_along(row, smaller);
            let crept = |column: usize| flow * (ahead[column] - here[column]);
            self.add(row, |column| [-flow * here[column], crept(column)]);
            ahead = here;
        }
    }

    /// Values of the wake along a row; those of a dashpot are the values of the table, with the other sign.
    fn wake_along(&self, row: usize, smaller: &Self) -> Vec<f64> {
        let only_flows = smaller.creep.instant == 0.0 && smaller.creep.delays.is_empty();
        let known = (row + smaller.reach[0])
            .checked_sub(self.reach[0])
            .filter(|row| only_flows && *row <= 2 * smaller.reach[0])
            .and_then(|row| smaller.values.chunks_exact(smaller.n_columns()).nth(row))
            .unwrap_or_default();
        let x = self.offset(row);
        let beyond = (known.len()..self.n_columns())
            .map(|column| wake_influence([x, column as f64 * self.aspect], [1.0, self.aspect]));
        known.iter().map(|value| -value).chain(beyond).collect()
    }

    fn add_instant(&mut self) {
        let instant = self.creep.instant;
        for row in 0..=2 * self.reach[0] {
            let here = self.along(row, |at, edges| self.creep.base.influence(at, edges));
            self.add(row, |column| [instant * here[column]; 2]);
        }
    }

    /// The last row within half a track ahead of the load; what is further ahead is not asked for.
    fn last_on_track(&self) -> usize {
        let last = 2 * self.reach[0];
        self.creep.track.map_or(last, |track| {
            let ahead = 0.5 * track - 1.0 - self.creep.shift;
            last.min(self.reach[0] + whole_part(ahead.max(0.0)))
        })
    }

    /// What recovers, at once or with delays, from one and the same potentials.
    fn add_recovering(&mut self) {
        let instant = self.creep.instant;
        let last = self.last_on_track();
        let first = [self.offset(last), self.aspect];
        let mut retarded = RetardedPotential::new(&self.creep, first, self.n_columns());
        for row in (0..=last).rev() {
            retarded.step(self.offset(row));
            self.add(row, |column| {
                let now = instant * retarded.here(column);
                [retarded.value(column), retarded.increment(column)].map(|part| now + part)
            });
        }
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
        assert!(
            row >= 0 && row.unsigned_abs() <= 2 * self.reach[0] && columns <= self.reach[1],
            "offset {rows}, {columns} is beyond the reach {:?}",
            self.reach
        );
        row.unsigned_abs() * (self.reach[1] + 1) + columns
    }
}
