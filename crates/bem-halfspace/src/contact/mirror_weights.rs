//! Weights of elements on a mirror: the fraction of each element that lies in the symmetry-reduced domain.
//!
//! Theory: docs/theory/contact.md, "Mirrors".

use std::ops::Range;

use crate::Convolution;
use crate::elements::mirror::Mirror;

/// Weight of each element: the product of one half for the first row, and of one half for the first column, where a mirror passes
/// through their centres; one elsewhere.
#[derive(Debug, Clone, Copy)]
pub(super) struct MirrorWeights {
    /// Mirrors along x and y, at the first row and column.
    mirrors: [Mirror; 2],
    /// Number of columns of the grid.
    columns: usize,
}

impl MirrorWeights {
    /// Weights of all elements on the grid of a convolution, for its mirrors.
    pub(super) const fn new(convolution: &Convolution) -> Self {
        Self {
            mirrors: convolution.mirrors,
            columns: convolution.grid().shape()[1],
        }
    }

    /// Pairs (index in the range, weight) for a range of elements of one row; elements that it omits have the weight one.
    pub(super) fn row_weights(
        &self,
        elements: Range<usize>,
    ) -> impl Iterator<Item = (usize, f64)> + use<> {
        let of_row = self.of_row(elements.start);
        let of_first = self.of_element(elements.start);
        let count = if of_row < 1.0 {
            elements.len()
        } else {
            usize::from(of_first < 1.0)
        };
        (0..count).map(move |index| (index, if index == 0 { of_first } else { of_row }))
    }

    /// Multiplies a row-major field of loads of whole elements by the weights.
    pub(super) fn apply(&self, loads: &mut [f64]) {
        let lines = loads.chunks_exact_mut(self.columns).enumerate();
        for (row, line) in lines {
            for (column, weight) in self.row_weights(row * self.columns..(row + 1) * self.columns) {
                line[column] *= weight;
            }
        }
    }

    /// Weight of an element: the product of those of its row and column.
    pub(super) fn of_element(&self, element: usize) -> f64 {
        self.of_row(element) * self.of_column(element)
    }

    /// Weight of the row of an element: 1/2 if the mirror passes through its centres, else 1.
    pub(super) fn of_row(&self, element: usize) -> f64 {
        weight_of_line(self.mirrors[0], element < self.columns)
    }

    /// Weight of the column of an element: 1/2 if the mirror passes through its centres, else 1.
    pub(super) fn of_column(&self, element: usize) -> f64 {
        weight_of_line(self.mirrors[1], element.is_multiple_of(self.columns))
    }
}

/// Weight of a row or column: one half if it is the first and the mirror passes through its centres.
fn weight_of_line(mirror: Mirror, is_first: bool) -> f64 {
    let is_half = is_first && mirror == Mirror::Centre;
    if is_half { 0.5 } else { 1.0 }
}
