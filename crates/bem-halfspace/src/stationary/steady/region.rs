//! The bounding box of a set of elements, and the conversion between packed vectors over the set and fields over the box.

use crate::elements::bounds::Bounds;

/// Elements of a mesh in their bounding box, images by mirror symmetry included.
pub(super) struct Region {
    /// Rows and columns of the box.
    pub(super) shape: [usize; 2],
    /// Row-major index of each element in the box, and of its mirror image; twice the same for an element without one.
    places: Vec<[usize; 2]>,
}

impl Region {
    /// The region of some elements, given by row and column, each with its image.
    pub(super) fn around(elements: impl Iterator<Item = [[usize; 2]; 2]> + Clone) -> Self {
        let bounds = Bounds::enclosing(elements.clone().flatten()).unwrap_or(Bounds::EMPTY);
        let place = |place| bounds.index_of(place);
        Self {
            shape: bounds.shape(),
            places: elements.map(|places| places.map(place)).collect(),
        }
    }

    /// The region reversed along x.
    pub(super) fn reversed(&self) -> Self {
        let [rows, columns] = self.shape;
        let reverse = |place: usize| (rows - 1 - place / columns) * columns + place % columns;
        Self {
            shape: self.shape,
            places: self.places.iter().map(|both| both.map(reverse)).collect(),
        }
    }

    /// Row-major index of each element in the box, and of its mirror image; twice the same for an element without one.
    pub(super) fn places(&self) -> &[[usize; 2]] {
        &self.places
    }

    /// Number of elements of the box.
    pub(super) fn n_places(&self) -> usize {
        self.shape[0] * self.shape[1]
    }

    /// Scatters a vector over the set into a field over the box, which is 0 elsewhere.
    pub(super) fn scatter(&self, vector: &[f64], field: &mut [f64]) {
        field.fill(0.0);
        for (places, value) in self.places.iter().zip(vector) {
            for place in places {
                field[*place] = *value;
            }
        }
    }

    /// Gathers a vector over the set from a field over the box.
    pub(super) fn gather(&self, field: &[f64]) -> Vec<f64> {
        self.places.iter().map(|[place, _]| field[*place]).collect()
    }

    /// Position of each element between the rear (0) and the front (1) of its run of contiguous elements along x.
    pub(super) fn fractions_from_rear(&self) -> Vec<f64> {
        let [rows, columns] = self.shape;
        let mut inside = vec![false; self.n_places()];
        for place in self.places.as_flattened() {
            inside[*place] = true;
        }
        let mut fractions = vec![0.0; self.n_places()];
        for column in 0..columns {
            let mut row = 0;
            while row < rows {
                // One run of elements.
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
