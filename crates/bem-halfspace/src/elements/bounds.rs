//! Boxes of elements: half-open ranges of rows and columns.

use std::ops::Range;

use crate::elements::mirror::Mirror;
use crate::parallel::row_blocks::{RowBlocks, for_each_row};
use crate::transform::fast_length::fast_length;

/// Half-open ranges of rows and columns of a field.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) struct Bounds {
    /// First row and column.
    pub(crate) lower: [usize; 2],
    /// One more than the last row and column.
    pub(crate) upper: [usize; 2],
}

impl Bounds {
    /// The box without elements.
    pub(crate) const EMPTY: Self = Self {
        lower: [0; 2],
        upper: [0; 2],
    };

    /// The box of one element.
    pub(crate) const fn single(element: [usize; 2]) -> Self {
        Self {
            lower: element,
            upper: [element[0] + 1, element[1] + 1],
        }
    }

    /// The smallest box that contains all elements, [row, column] each; `None` if there are none.
    pub(crate) fn enclosing(elements: impl Iterator<Item = [usize; 2]>) -> Option<Self> {
        let boxes = elements.map(Self::single);
        boxes.reduce(|bounds, element| bounds.union(&element))
    }

    /// The smallest box that contains the elements [row, column] of a field for which `matches` is true; `None` if there are none.
    pub(crate) fn enclosing_where(
        shape: [usize; 2],
        matches: impl Fn([usize; 2]) -> bool + Sync,
    ) -> Option<Self> {
        let row_blocks = RowBlocks::new(shape);
        let in_row_block = |row_block| {
            let elements = row_blocks
                .elements(row_block)
                .map(|index| [index / shape[1], index % shape[1]]);
            Self::enclosing(elements.filter(|element| matches(*element)))
        };
        let union = |left: Option<Self>, right: Option<Self>| match (left, right) {
            (Some(left), Some(right)) => Some(left.union(&right)),
            (left, right) => left.or(right),
        };
        row_blocks.gather(in_row_block, union)
    }

    /// The smallest box that contains both.
    pub(crate) fn union(&self, other: &Self) -> Self {
        Self {
            lower: [0, 1].map(|axis| self.lower[axis].min(other.lower[axis])),
            upper: [0, 1].map(|axis| self.upper[axis].max(other.upper[axis])),
        }
    }

    /// True if the element [row, column] of the field lies in the box.
    pub(crate) fn contains(&self, element: [usize; 2]) -> bool {
        self.rows().contains(&element[0]) && self.columns().contains(&element[1])
    }

    /// Range of rows.
    pub(crate) const fn rows(&self) -> Range<usize> {
        self.lower[0]..self.upper[0]
    }

    /// Range of columns.
    pub(crate) const fn columns(&self) -> Range<usize> {
        self.lower[1]..self.upper[1]
    }

    /// Numbers of rows and columns.
    pub(crate) const fn shape(&self) -> [usize; 2] {
        [self.upper[0] - self.lower[0], self.upper[1] - self.lower[1]]
    }

    /// Number of elements.
    pub(crate) const fn n_elements(&self) -> usize {
        self.shape()[0] * self.shape()[1]
    }

    /// Index in the box, row-major, of an element [row, column] of the field.
    pub(crate) const fn index_of(&self, element: [usize; 2]) -> usize {
        (element[0] - self.lower[0]) * self.shape()[1] + element[1] - self.lower[1]
    }

    /// Copies the part inside the box from a field with `columns` columns.
    pub(crate) fn extract(&self, field: &[f64], columns: usize, part: &mut [f64]) {
        for_each_row(part, self.shape()[1], |row, part| {
            let start = (self.lower[0] + row) * columns;
            part.copy_from_slice(&field[start..][self.columns()]);
        });
    }

    /// The box with a margin for a growing contact, inside a field of the shape `field`, with lengths whose Fourier transform is fast.
    ///
    /// Along each axis the margin is an eighth of the length, at least four elements, shared by both ends. Along an axis with a mirror
    /// the box begins at the first row or column of the field, where the mirror is. The share is chosen; it decides how often a box has
    /// to be enlarged, not the solution.
    pub(crate) fn with_margin(&self, field: [usize; 2], mirrors: [Mirror; 2]) -> Self {
        // Widen the box along each axis. The padded transform has twice its length, which is made a fast one.
        let mut grown = *self;
        for (axis, &available) in field.iter().enumerate() {
            let is_free = mirrors[axis].is_none();
            let rear = if is_free { self.lower[axis] } else { 0 };
            let needed = self.upper[axis] - rear;
            let wanted = needed + (needed / 16).max(2) * 2;
            let length = (fast_length(2 * wanted) / 2).min(available);
            let behind = (length - needed) / 2;
            grown.lower[axis] = rear.saturating_sub(behind).min(available - length);
            grown.upper[axis] = grown.lower[axis] + length;
        }
        grown
    }
}
