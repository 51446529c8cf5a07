//! Influence coefficients between the elements of a grid, computed once for all grids with the same elements.
//!
//! Upstream of a load, the potential `V = ∬ dA'/r` of a uniformly loaded element is smooth; a retardation element turns
//! it into
//!
//! ```text
//! k(ξ) = q ∫_0^∞ e^(−q s) V(ξ + s) ds = e^(−q) k(ξ + 1) + q ∫_0^1 e^(−q s) V(ξ + s) ds,      q = Δx/(v λ)
//! ```
//!
//! with lengths in units of the element length Δx, the sliding speed v and the retardation time λ. This is one recursion along
//! each column of the table, from ahead, for each retardation element.
//!
//! On a track of the length L the potential is that of the nearest image of the load. The recursion is the same within half the
//! length ahead and behind, and starts from the integral around the track:
//!
//! ```text
//! k(ξ) = q/(1 − e^(−q L)) ∫_0^L e^(−q s) V(ξ + s) ds,      V(ξ) = V(ξ − L) for ξ > L/2
//! ```
//!
//! An advanced element looks behind in the place of ahead. The potential is even along x, so that its table is the mirror image of that
//! of a retardation element.
//!
//! Theory: docs/theory/stationary-half-space.md, "Any linear viscoelastic material" and "A track".

use std::sync::Arc;

use numerics::whole_part;

use crate::stationary::steady::retarded_potential::RetardedPotential;
use crate::stationary::steady::sliding_creep::ElementCreep;
use crate::stationary::steady::wake_influence::wake_influence;

/// Displacement at the collocation point of an element by a unit load on another, as a function of their offset. Lengths are in Δx,
/// so that one table serves every spacing with the same creep over an element.
#[derive(Debug, Clone, Default)]
pub(super) struct WakeTable {
    /// Creep over an element.
    pub(super) creep: ElementCreep,
    /// Aspect ratio Δy/Δx of an element.
    pub(super) aspect: f64,
    /// Largest offsets: along x in either direction, and along y.
    max_offsets: [usize; 2],
    /// Displacements by the unit load, `[offset along x, from behind the load to ahead of it][distance along y]`.
    values: Vec<f64>,
    /// Creep within one element: the values without the displacement at the element ahead. With advanced elements it is the
    /// displacement of a spring of the unit compliance, from which the whole creep filters the values.
    creep_within_element: Vec<f64>,
}

impl WakeTable {
    /// Extends the table to offsets up to `max_offsets`. A table that is larger along one axis stays so.
    pub(super) fn cover(
        table: &mut Arc<Self>,
        creep: &ElementCreep,
        aspect: f64,
        max_offsets: [usize; 2],
    ) {
        let empty = table.values.is_empty();
        if !empty
            && table.max_offsets[0] >= max_offsets[0]
            && table.max_offsets[1] >= max_offsets[1]
        {
            return;
        }
        let max_offsets = [0, 1].map(|axis| max_offsets[axis].max(table.max_offsets[axis]));
        *table = Arc::new(Self::new(creep, aspect, max_offsets, table));
    }

    /// Table of the displacement in the wake of an element for a creep, with offsets up to `max_offsets` along x and y.
    pub(super) fn for_creep(creep: &ElementCreep, aspect: f64, max_offsets: [usize; 2]) -> Self {
        Self::new(creep, aspect, max_offsets, &Self::default())
    }

    /// A table with offsets up to `max_offsets`; for a dashpot it copies the values of a `smaller` table of the same kind.
    fn new(creep: &ElementCreep, aspect: f64, max_offsets: [usize; 2], smaller: &Self) -> Self {
        let n_values = (2 * max_offsets[0] + 1) * (max_offsets[1] + 1);
        let mut table = Self {
            creep: creep.clone(),
            aspect,
            max_offsets,
            values: vec![0.0; n_values],
            creep_within_element: vec![0.0; n_values],
        };
        // Sum the displacements by the parts of the creep: free flow, retardation elements and instantaneous compliance.
        if creep.flow > 0.0 {
            table.add_flow(smaller);
        }
        if !creep.retardations.is_empty() {
            table.add_viscoelastic();
        } else if creep.instantaneous > 0.0 {
            table.add_instantaneous();
        }
        if !creep.advanced.is_empty() {
            table.add_advanced();
        }
        table
    }

    /// Number of columns: distances along y from 0 on.
    const fn n_columns(&self) -> usize {
        self.max_offsets[1] + 1
    }

    /// Offset along x of the collocation points of a row of the table from the centre of the loaded element.
    fn offset(&self, row: usize) -> f64 {
        row as f64 - self.max_offsets[0] as f64 + self.creep.collocation_shift
    }

    /// Values of `kernel(offset, edges of an element)` at all columns of a row of the table, with lengths in Δx.
    fn kernel_row(&self, row: usize, kernel: impl Fn([f64; 2], [f64; 2]) -> f64) -> Vec<f64> {
        let x = self.offset(row);
        let value = |column| kernel([x, column as f64 * self.aspect], [1.0, self.aspect]);
        (0..self.n_columns()).map(value).collect()
    }

    /// Adds the displacement of each column to a row of the table, and its part that crept within the element.
    fn add_to_row(&mut self, row: usize, by_column: impl Fn(usize) -> RowEntry) {
        let first = row * self.n_columns();
        for column in 0..self.n_columns() {
            let entry = by_column(column);
            self.values[first + column] += entry.displacement;
            self.creep_within_element[first + column] += entry.creep_within_element;
        }
    }

    /// Adds the free flow, whose kernel is the wake.
    fn add_flow(&mut self, smaller: &Self) {
        let flow = self.creep.flow;
        let n_rows = 2 * self.max_offsets[0] + 1;
        // Begin with the row ahead of the table, so that the creep within each element is the difference of two rows.
        let mut ahead = self.kernel_row(n_rows, wake_influence);
        for row in (0..n_rows).rev() {
            let here = self.wake_row(row, smaller);
            self.add_to_row(row, |column| RowEntry {
                displacement: -flow * here[column],
                creep_within_element: flow * (ahead[column] - here[column]),
            });
            ahead = here;
        }
    }

    /// Values of the wake on a row. A smaller table of a dashpot contains them with the opposite sign.
    fn wake_row(&self, row: usize, smaller: &Self) -> Vec<f64> {
        let only_flows = smaller.creep.instantaneous == 0.0
            && smaller.creep.retardations.is_empty()
            && smaller.creep.advanced.is_empty();
        // Copy the columns that the smaller table has, and compute the others.
        let known = (row + smaller.max_offsets[0])
            .checked_sub(self.max_offsets[0])
            .filter(|row| only_flows && *row <= 2 * smaller.max_offsets[0])
            .and_then(|row| smaller.values.chunks_exact(smaller.n_columns()).nth(row))
            .unwrap_or_default();
        let x = self.offset(row);
        let beyond = (known.len()..self.n_columns())
            .map(|column| wake_influence([x, column as f64 * self.aspect], [1.0, self.aspect]));
        known.iter().map(|value| -value).chain(beyond).collect()
    }

    /// Adds the instantaneous compliance of a material without retardation elements.
    fn add_instantaneous(&mut self) {
        let instantaneous = self.creep.instantaneous;
        for row in 0..=2 * self.max_offsets[0] {
            let here = self.kernel_row(row, |at, edges| self.creep.base.influence(at, edges));
            self.add_to_row(row, |column| RowEntry {
                displacement: instantaneous * here[column],
                creep_within_element: instantaneous * here[column],
            });
        }
    }

    /// The last row within half a track ahead of the load. Offsets further ahead do not occur.
    fn last_row_on_track(&self) -> usize {
        let last = 2 * self.max_offsets[0];
        self.creep.track.map_or(last, |track| {
            let ahead = 0.5 * track - 1.0 - self.creep.collocation_shift;
            last.min(self.max_offsets[0] + whole_part(ahead.max(0.0)))
        })
    }

    /// Adds the instantaneous compliance and the retardation elements, which share the values of the potential.
    fn add_viscoelastic(&mut self) {
        let instantaneous = self.creep.instantaneous;
        let last = self.last_row_on_track();
        let first = self.offset(last);
        let mut retarded =
            RetardedPotential::new(&self.creep, first, self.aspect, self.n_columns());
        for row in (0..=last).rev() {
            retarded.step(self.offset(row));
            self.add_to_row(row, |column| {
                let immediate = instantaneous * retarded.load_potential(column);
                RowEntry {
                    displacement: immediate + retarded.displacement(column),
                    creep_within_element: immediate + retarded.creep_within_element(column),
                }
            });
        }
    }

    /// Adds the advanced elements, and sets the creep within an element to the displacement of a spring.
    fn add_advanced(&mut self) {
        // An advanced element is a retarded one of the opposite motion: add its mirrored table.
        let creep = ElementCreep {
            collocation_shift: -self.creep.collocation_shift,
            retardations: self.creep.advanced.clone(),
            base: self.creep.base.clone(),
            ..ElementCreep::default()
        };
        let mirrored = Self::for_creep(&creep, self.aspect, self.max_offsets);
        let n_columns = self.n_columns();
        let rows = self.values.chunks_exact_mut(n_columns);
        for (row, mirrored) in rows.zip(mirrored.values.chunks_exact(n_columns).rev()) {
            for (value, mirrored) in row.iter_mut().zip(mirrored) {
                *value += mirrored;
            }
        }
        for row in 0..=2 * self.max_offsets[0] {
            let spring = self.kernel_row(row, |at, edges| self.creep.base.influence(at, edges));
            self.creep_within_element[row * n_columns..][..n_columns].copy_from_slice(&spring);
        }
    }

    /// Displacement of an element by the unit load of another, which lies `rows` behind it and `columns` beside it.
    ///
    /// # Panics
    /// For an offset beyond the table.
    pub(super) fn displacement(&self, rows: isize, columns: usize) -> f64 {
        self.values[self.index(rows, columns)]
    }

    /// The part of [`displacement`](Self::displacement) that creeps within the element itself, from its front to its rear; with advanced
    /// elements the displacement of a spring.
    pub(super) fn creep_within_element(&self, rows: isize, columns: usize) -> f64 {
        self.creep_within_element[self.index(rows, columns)]
    }

    /// Index in `values` of the offset `rows` along x, negative behind the load, and the distance `columns` along y.
    fn index(&self, rows: isize, columns: usize) -> usize {
        let row = rows + self.max_offsets[0].cast_signed();
        assert!(
            row >= 0
                && row.unsigned_abs() <= 2 * self.max_offsets[0]
                && columns <= self.max_offsets[1],
            "offset {rows}, {columns} is beyond the table of {:?}",
            self.max_offsets
        );
        row.unsigned_abs() * (self.max_offsets[1] + 1) + columns
    }
}

/// One value of the table.
struct RowEntry {
    /// Displacement at the collocation point by a unit load.
    displacement: f64,
    /// Part of the displacement that creeps within the element.
    creep_within_element: f64,
}
