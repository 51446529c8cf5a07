//! The correlation of adjoint and primal loads: the weight of each value of the kernel in a bilinear sum over pairs of elements.
//!
//! ```text
//! λᵀ K x = Σ_m c_m k_m,      c_m = Σ_j λ_(j+m) x_j
//! ```

use crate::elements::bounds::Bounds;
use crate::parallel::reductions::add_scaled;
use crate::stationary::steady::wake_table::WakeTable;

/// Loads on elements of a box.
pub(super) struct Field {
    shape: [usize; 2],
    values: Vec<f64>,
}

/// The weights c of the kernel, by the offset of an element from the loaded one.
#[derive(Debug, Clone, Default)]
pub(super) struct Correlation {
    /// Largest offsets: along x in either direction, and along y.
    max_offsets: [usize; 2],
    /// Row-major: by offset along x, from behind the load on, and by distance along y.
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
    /// The weights of k(i − j) in Σ y_i k(i − j) x_j, with one row more on either side. If the loads x are mirror symmetric, `left` may
    /// contain one of two mirror images y with twice the weight.
    pub(super) fn between(left: &Field, right: &Field) -> Self {
        let [rows, columns] = left.shape;
        // Accumulate by signed distance along y.
        let width = 2 * columns - 1;
        let mut signed = vec![0.0; (2 * rows + 1) * width];
        let loaded = left.values.iter().enumerate();
        for (place, &value) in loaded.filter(|(_, value)| **value != 0.0) {
            let (row, column) = (place / columns, place % columns);
            for (other, from) in right.values.chunks_exact(columns).enumerate() {
                // By signed distance along y; the negative side is folded onto the positive one below.
                let first = (row + rows - other) * width + columns - 1 - column;
                let weights = &mut signed[first..first + columns];
                for (weight, load) in weights.iter_mut().zip(from) {
                    *weight += value * load;
                }
            }
        }

        // Fold, because the kernel is even along y.
        let fold = |row: &[f64]| -> Vec<f64> {
            let middle = columns - 1;
            let both = |apart: usize| match apart {
                0 => row[middle],
                _ => row[middle - apart] + row[middle + apart],
            };
            (0..columns).map(both).collect()
        };
        Self {
            max_offsets: [rows, columns - 1],
            weights: signed.chunks_exact(width).flat_map(fold).collect(),
        }
    }

    /// The weights of k in −½ Σ y_i [k(i + 1 − j) − k(i − 1 − j)] x_j times a factor, with steps along x.
    pub(super) fn slope(&self, factor: f64) -> Self {
        let columns = self.max_offsets[1] + 1;
        let at = |index: usize, rows: isize| {
            let moved = index.checked_add_signed(rows * columns.cast_signed());
            moved
                .and_then(|index| self.weights.get(index))
                .copied()
                .unwrap_or(0.0)
        };
        let weight = |index| -0.5 * factor * (at(index, -1) - at(index, 1));
        Self {
            max_offsets: self.max_offsets,
            weights: (0..self.weights.len()).map(weight).collect(),
        }
    }

    /// Adds multiples of the second difference k₀ − (k₁ + k₋₁)/2 of the kernel along each axis.
    pub(super) fn with_second_difference(mut self, [along_x, along_y]: [f64; 2]) -> Self {
        let columns = self.max_offsets[1] + 1;
        // Offset 0, and its neighbours along x and y.
        let here = self.max_offsets[0] * columns;
        let weights = &mut self.weights;
        weights[here] += along_x + along_y;
        weights[here - columns] -= 0.5 * along_x;
        weights[here + columns] -= 0.5 * along_x;
        if columns > 1 {
            // The distance stands for both sides.
            weights[here + 1] -= along_y;
        }
        self
    }

    /// Adds another correlation with the same offsets.
    pub(super) fn plus(mut self, other: &Self) -> Self {
        add_scaled(&mut self.weights, 1.0, &other.weights);
        self
    }

    /// Pads correlations with zeros to the largest offsets among them.
    pub(super) fn align(all: &mut [Self]) {
        let max_offsets = all
            .iter()
            .map(|one| one.max_offsets)
            .reduce(|one, other| [0, 1].map(|axis| one[axis].max(other[axis])));
        for one in all
            .iter_mut()
            .filter(|one| Some(one.max_offsets) != max_offsets)
        {
            let Some([rows, columns]) = max_offsets else {
                return;
            };
            // Rows of zeros before and after, columns of zeros after.
            let before = rows - one.max_offsets[0];
            let mut weights = vec![0.0; (2 * rows + 1) * (columns + 1)];
            let wide = weights.chunks_exact_mut(columns + 1).skip(before);
            for (wide, narrow) in wide.zip(one.weights.chunks_exact(one.max_offsets[1] + 1)) {
                wide[..narrow.len()].copy_from_slice(narrow);
            }
            *one = Self {
                max_offsets: [rows, columns],
                weights,
            };
        }
    }

    /// Largest offsets: along x in either direction, and along y.
    pub(super) const fn max_offsets(&self) -> [usize; 2] {
        self.max_offsets
    }

    /// The weights of one row: of one offset along x, counted from behind the load on.
    pub(super) fn row(&self, row: usize) -> &[f64] {
        let columns = self.max_offsets[1] + 1;
        &self.weights[row * columns..][..columns]
    }

    /// The sum Σ c_m k_m with a kernel.
    pub(super) fn contract(&self, table: &WakeTable) -> f64 {
        let [rows, columns] = self.max_offsets;
        let row_of = |row: usize| row.cast_signed() - rows.cast_signed();
        let weighted = |(index, weight): (usize, &f64)| {
            weight * table.displacement(row_of(index / (columns + 1)), index % (columns + 1))
        };
        self.weights.iter().enumerate().map(weighted).sum()
    }
}
