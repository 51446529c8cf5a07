//! The correlation of adjoint and primal loads: the weight of each value of the kernel in a bilinear sum over pairs of elements.
//!
//! ```text
//! λᵀ K x = Σ_m c_m k_m,      c_m = Σ_j λ_(j+m) x_j
//! ```
//!
//! for the adjoint loads λ, the loads x and the kernel k_m at the offset m, in elements along x and y.

use crate::parallel::reductions::{add_scaled, dot};
use crate::stationary::steady::sensitivity::kernel_table::KernelTable;

/// The weights c of the kernel, by the offset of an element from the loaded one.
#[derive(Debug, Clone, Default)]
pub(super) struct Correlation {
    /// Largest offsets: along x in either direction, and along y.
    max_offsets: [usize; 2],
    /// Weights, row-major: by offset along x, from behind the load on, and by distance along y.
    weights: Vec<f64>,
}

impl Correlation {
    /// The weights of k(i − j) in Σ y_i k(i − j) x_j for the fields y (`left`) and x (`right`), with one row more on either side.
    /// If the loads x are mirror symmetric, `left` may contain one of two mirror images of y with twice the weight. Both fields
    /// are row-major over a box of the shape `shape`.
    pub(super) fn between(left: &[f64], right: &[f64], shape: [usize; 2]) -> Self {
        let [rows, columns] = shape;
        // Sum the products of both fields by their offset along x and their signed distance along y.
        let width = 2 * columns - 1;
        let mut signed = vec![0.0; (2 * rows + 1) * width];
        let loaded = left.iter().enumerate();
        for (index, &value) in loaded.filter(|(_, value)| **value != 0.0) {
            let (row, column) = (index / columns, index % columns);
            for (other, from) in right.chunks_exact(columns).enumerate() {
                // One row of products covers successive distances along y, of either sign.
                let first = (row + rows - other) * width + columns - 1 - column;
                let weights = &mut signed[first..first + columns];
                for (weight, load) in weights.iter_mut().zip(from) {
                    *weight += value * load;
                }
            }
        }

        // The kernel is even along y, so that the weights of both signs of a distance are added.
        let fold = |row: &[f64]| -> Vec<f64> {
            let middle = columns - 1;
            let both_sides = |distance: usize| match distance {
                0 => row[middle],
                _ => row[middle - distance] + row[middle + distance],
            };
            (0..columns).map(both_sides).collect()
        };
        Self {
            max_offsets: [rows, columns - 1],
            weights: signed.chunks_exact(width).flat_map(fold).collect(),
        }
    }

    /// The weights of k in −½ Σ y_i [k(i + 1 − j) − k(i − 1 − j)] x_j, with steps along x.
    pub(super) fn slope(&self) -> Self {
        let columns = self.max_offsets[1] + 1;
        let shifted_weight = |index: usize, rows: isize| {
            let shifted = index.checked_add_signed(rows * columns.cast_signed());
            shifted
                .and_then(|index| self.weights.get(index))
                .copied()
                .unwrap_or(0.0)
        };
        let weight = |index| -0.5 * (shifted_weight(index, -1) - shifted_weight(index, 1));
        Self {
            max_offsets: self.max_offsets,
            weights: (0..self.weights.len()).map(weight).collect(),
        }
    }

    /// Adds multiples of the second difference k₀ − (k₁ + k₋₁)/2 of the kernel along each axis.
    pub(super) fn add_second_difference(&mut self, factors: [f64; 2]) {
        let [along_x, along_y] = factors;
        let columns = self.max_offsets[1] + 1;
        // The second difference has the weights 1 at the offset 0 and −1/2 at both neighbours along each axis.
        let origin = self.max_offsets[0] * columns;
        let weights = &mut self.weights;
        weights[origin] += along_x + along_y;
        weights[origin - columns] -= 0.5 * along_x;
        weights[origin + columns] -= 0.5 * along_x;
        if columns > 1 {
            // A distance along y stands for the neighbours on both sides.
            weights[origin + 1] -= along_y;
        }
    }

    /// Adds a multiple of another correlation with the same offsets.
    pub(super) fn add_scaled(&mut self, factor: f64, other: &Self) {
        add_scaled(&mut self.weights, factor, &other.weights);
    }

    /// Multiplies all weights by a factor.
    pub(super) fn scale(&mut self, factor: f64) {
        self.weights.iter_mut().for_each(|weight| *weight *= factor);
    }

    /// Largest offsets: along x in either direction, and along y.
    pub(super) const fn max_offsets(&self) -> [usize; 2] {
        self.max_offsets
    }

    /// The sum Σ c_m k_m with a kernel, whose table may reach further.
    pub(super) fn contract(&self, kernel: &KernelTable) -> f64 {
        let rows = self.max_offsets[0].cast_signed();
        let offsets = -rows..=rows;
        offsets
            .map(|offset| self.contract_row(offset, kernel.row(offset)))
            .sum()
    }

    /// The part of the sum Σ c_m k_m at one offset along x, with the values of the kernel at it by distance along y.
    pub(super) fn contract_row(&self, offset: isize, kernel: &[f64]) -> f64 {
        dot(self.row(offset), kernel)
    }

    /// The weights at an offset along x, by distance along y; none beyond the largest offsets.
    fn row(&self, offset: isize) -> &[f64] {
        let columns = self.max_offsets[1] + 1;
        let row = self.max_offsets[0].checked_add_signed(offset);
        let mut rows = self.weights.chunks_exact(columns);
        row.and_then(|row| rows.nth(row)).unwrap_or_default()
    }
}
