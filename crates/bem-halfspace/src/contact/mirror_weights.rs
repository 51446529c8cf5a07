//! Weights of elements on a mirror: the fraction of each element that lies in the symmetry-reduced domain.
//!
//! Theory: docs/theory/contact.md, "Mirrors".

use std::ops::Range;

use crate::Convolution;
use crate::elements::mirror::Mirror;

/// One half in the first row, and in the first column, if a mirror passes through its centres; else one.
#[derive(Debug, Clone, Copy)]
pub(super) struct MirrorWeights {
    mirrors: [Mirror; 2],
    columns: usize,
}

impl MirrorWeights {
    pub(super) const fn of(convolution: &Convolution) -> Self {
        Self {
            mirrors: convolution.mirrors,
            columns: convolution.grid().shape()[1],
        }
    }

    /// The weights that may differ from one, for a range of elements in one row, with their indices in the range.
    pub(super) fn in_line(
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

    /// Multiplies a field of loads of whole elements by the weights.
    pub(super) fn apply(&self, loads: &mut [f64]) {
        let lines = loads.chunks_exact_mut(self.columns).enumerate();
        for (row, line) in lines {
            for (column, weight) in self.in_line(row * self.columns..(row + 1) * self.columns) {
                line[column] *= weight;
            }
        }
    }

    pub(super) fn of_element(&self, element: usize) -> f64 {
        self.of_row(element) * self.of_column(element)
    }

    pub(super) fn of_row(&self, element: usize) -> f64 {
        weight(self.mirrors[0], element < self.columns)
    }

    pub(super) fn of_column(&self, element: usize) -> f64 {
        weight(self.mirrors[1], element.is_multiple_of(self.columns))
    }
}

fn weight(mirror: Mirror, is_first: bool) -> f64 {
    let is_half = is_first && mirror == Mirror::Centre;
    if is_half { 0.5 } else { 1.0 }
}
