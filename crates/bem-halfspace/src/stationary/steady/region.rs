//! The bounding box of a set of elements, and the conversion between packed vectors over the set and fields over the box.

use crate::elements::bounds::Bounds;

/// Elements of a mesh in their bounding box, images by mirror symmetry included.
pub(super) struct Region {
    /// Rows and columns of the box.
    pub(super) shape: [usize; 2],
    /// Row-major index of each element in the box, and of its mirror image; twice the same for an element without one.
    indices: Vec<[usize; 2]>,
}

impl Region {
    /// The region of some elements, given by row and column, each with its image.
    pub(super) fn around(elements: impl Iterator<Item = [[usize; 2]; 2]> + Clone) -> Self {
        let bounds = Bounds::enclosing(elements.clone().flatten()).unwrap_or(Bounds::EMPTY);
        let in_box = |element| bounds.index_of(element);
        Self {
            shape: bounds.shape(),
            indices: elements.map(|both| both.map(in_box)).collect(),
        }
    }

    /// The region reversed along x.
    pub(super) fn reversed(&self) -> Self {
        let [rows, columns] = self.shape;
        let reverse = |index: usize| (rows - 1 - index / columns) * columns + index % columns;
        Self {
            shape: self.shape,
            indices: self.indices.iter().map(|both| both.map(reverse)).collect(),
        }
    }

    /// Row-major index of each element in the box, and of its mirror image; twice the same for an element without one.
    pub(super) fn indices(&self) -> &[[usize; 2]] {
        &self.indices
    }

    /// Number of elements of the box.
    pub(super) fn n_box_elements(&self) -> usize {
        self.shape[0] * self.shape[1]
    }

    /// Scatters a vector over the set into a field over the box, which is 0 elsewhere.
    pub(super) fn scatter(&self, vector: &[f64], field: &mut [f64]) {
        field.fill(0.0);
        for (indices, value) in self.indices.iter().zip(vector) {
            for index in indices {
                field[*index] = *value;
            }
        }
    }

    /// Gathers a vector over the set from a field over the box.
    pub(super) fn gather(&self, field: &[f64]) -> Vec<f64> {
        self.indices.iter().map(|[from, _]| field[*from]).collect()
    }

    /// Position of each element between the rear (0) and the front (1) of its run of contiguous elements along x.
    pub(super) fn fractions_from_rear(&self) -> Vec<f64> {
        let [rows, columns] = self.shape;
        let mut inside = vec![false; self.n_box_elements()];
        for index in self.indices.as_flattened() {
            inside[*index] = true;
        }
        let mut fractions = vec![0.0; self.n_box_elements()];
        for column in 0..columns {
            let mut row = 0;
            while row < rows {
                // Find the run of contiguous elements that begins at this row. It is empty outside the region.
                let outside = |row: &usize| !inside[row * columns + column];
                let run = row..(row..rows).find(outside).unwrap_or(rows);
                for (step, row) in run.clone().enumerate() {
                    fractions[row * columns + column] = (step as f64 + 0.5) / run.len() as f64;
                }
                row = run.end + 1;
            }
        }
        self.gather(&fractions)
    }
}
