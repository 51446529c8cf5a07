//! What a sum over pairs of loads gives each value of the kernel.

use crate::elements::bounds::Bounds;
use crate::parallel::reductions::add;
use crate::stationary::steady::wake_table::WakeTable;

/// Loads on elements of a box.
pub(super) struct Field {
    shape: [usize; 2],
    values: Vec<f64>,
}

/// Weights of the kernel by the offset of an element from the one that is loaded.
#[derive(Debug, Clone, Default)]
pub(super) struct Correlation {
    /// Largest offset along x, either way, and along y.
    reach: [usize; 2],
    /// By offset along x, from behind, and by distance along y.
    weights: Vec<f64>,
}

impl Field {
    pub(super) fn new(bounds: &Bounds, loads: impl Iterator<Item = ([usize; 2], f64)>) -> Self {
        let shape = bounds.shape();
        let mut values = vec![0.0; shape[0] * shape[1]];
        for (element, load) in loads {
            values[bounds.index_of(element)] = load;
        }
        Self { shape, values }
    }
}

impl Correlation {
    /// The weights of k(i − j) in Σ y_i k(i − j) x_j, with one row more on either side; where x is mirror symmetric, of images
    /// in y one may stand for both.
    pub(super) fn of(left: &Field, right: &Field) -> Self {
        let [rows, columns] = left.shape;
        let width = 2 * columns - 1;
        let mut signed = vec![0.0; (2 * rows + 1) * width];
        for (place, &value) in left
            .values
            .iter()
            .enumerate()
            .filter(|(_, value)| **value != 0.0)
        {
            let (row, column) = (place / columns, place % columns);
            for (other, from) in right.values.chunks_exact(columns).enumerate() {
                // By the distance along y to the other side, which is folded onto this one.
                let first = (row + rows - other) * width + columns - 1 - column;
                let weights = &mut signed[first..first + columns];
                for (weight, load) in weights.iter_mut().zip(from) {
                    *weight += value * load;
                }
            }
        }
        let fold = |row: &[f64]| -> Vec<f64> {
            let middle = columns - 1;
            let both = |apart: usize| match apart {
                0 => row[middle],
                _ => row[middle - apart] + row[middle + apart],
            };
            (0..columns).map(both).collect()
        };
        Self {
            reach: [rows, columns - 1],
            weights: signed.chunks_exact(width).flat_map(fold).collect(),
        }
    }

    /// The weights of k in −½ Σ y_i [k(i + 1 − j) − k(i − 1 − j)] x_j, so many times, with the step along x.
    pub(super) fn of_slope(&self, factor: f64) -> Self {
        let columns = self.reach[1] + 1;
        let at = |index: usize, rows: isize| {
            let moved = index.checked_add_signed(rows * columns.cast_signed());
            moved
                .and_then(|index| self.weights.get(index))
                .copied()
                .unwrap_or(0.0)
        };
        let weight = |index| -0.5 * factor * (at(index, -1) - at(index, 1));
        Self {
            reach: self.reach,
            weights: (0..self.weights.len()).map(weight).collect(),
        }
    }

    /// With a multiple of the bend k₀ − (k₁ + k₋₁)/2 along each axis.
    pub(super) fn with_bend(mut self, [along_x, along_y]: [f64; 2]) -> Self {
        let columns = self.reach[1] + 1;
        let here = self.reach[0] * columns;
        let weights = &mut self.weights;
        weights[here] += along_x + along_y;
        weights[here - columns] -= 0.5 * along_x;
        weights[here + columns] -= 0.5 * along_x;
        if columns > 1 {
            // That of both sides.
            weights[here + 1] -= along_y;
        }
        self
    }

    /// Both together.
    pub(super) fn and(mut self, other: &Self) -> Self {
        add(&mut self.weights, 1.0, &other.weights);
        self
    }

    /// Gives all the largest reach among them.
    pub(super) fn align(all: &mut [Self]) {
        let reach = all.iter().map(|one| one.reach);
        let reach = reach.reduce(|one, other| [0, 1].map(|axis| one[axis].max(other[axis])));
        for one in all.iter_mut().filter(|one| Some(one.reach) != reach) {
            let Some([rows, columns]) = reach else {
                return;
            };
            let before = rows - one.reach[0];
            let mut weights = vec![0.0; (2 * rows + 1) * (columns + 1)];
            let wide = weights.chunks_exact_mut(columns + 1).skip(before);
            for (wide, narrow) in wide.zip(one.weights.chunks_exact(one.reach[1] + 1)) {
                wide[..narrow.len()].copy_from_slice(narrow);
            }
            *one = Self {
                reach: [rows, columns],
                weights,
            };
        }
    }

    pub(super) const fn reach(&self) -> [usize; 2] {
        self.reach
    }

    /// The weights of an offset along x, from behind.
    pub(super) fn row(&self, row: usize) -> &[f64] {
        let columns = self.reach[1] + 1;
        &self.weights[row * columns..][..columns]
    }

    /// The sum with a kernel.
    pub(super) fn with_kernel(&self, table: &WakeTable) -> f64 {
        let [rows, columns] = self.reach;
        let row_of = |row: usize| row.cast_signed() - rows.cast_signed();
        let weighted = |(index, weight): (usize, &f64)| {
            weight * table.displacement(row_of(index / (columns + 1)), index % (columns + 1))
        };
        self.weights.iter().enumerate().map(weighted).sum()
    }
}
