//! Elements through which a mirror passes, of which one half is in front of it.

use std::ops::Range;

use crate::Convolution;
use crate::contact::contact_set::Run;
use crate::mirror::Mirror;

/// Where the mirrors of a grid pass through its first row and its first column.
#[derive(Debug, Clone, Copy)]
pub(super) struct Halves {
    mirrors: [Mirror; 2],
    columns: usize,
}

impl Halves {
    pub(super) const fn of(convolution: &Convolution) -> Self {
        Self {
            mirrors: convolution.mirrors(),
            columns: convolution.grid().shape()[1],
        }
    }

    /// The elements of a run through which mirrors pass, counted from its start, and the part of each in front of them.
    pub(super) fn in_run(&self, run: &Run) -> impl Iterator<Item = (usize, f64)> + use<> {
        self.in_line(run.elements())
    }

    /// The same for neighbours in one row.
    pub(super) fn in_line(
        &self,
        elements: Range<usize>,
    ) -> impl Iterator<Item = (usize, f64)> + use<> {
        let of_row = self.part_of_row(elements.start);
        let of_first = of_row * self.part_of_column(elements.start);
        let count = if of_row < 1.0 {
            elements.len()
        } else {
            usize::from(of_first < 1.0)
        };
        (0..count).map(move |index| (index, if index == 0 { of_first } else { of_row }))
    }

    /// Leaves of the whole loads on a field what is in front of the mirrors.
    pub(super) fn keep_front(&self, loads: &mut [f64]) {
        let lines = loads.chunks_exact_mut(self.columns).enumerate();
        for (row, line) in lines {
            for (column, part) in self.in_line(row * self.columns..(row + 1) * self.columns) {
                line[column] *= part;
            }
        }
    }

    /// The part of the row of an element in front of the mirror across x.
    pub(super) fn part_of_row(&self, element: usize) -> f64 {
        part_of(self.mirrors[0], element < self.columns)
    }

    /// The part of the column of an element in front of the mirror across y.
    pub(super) fn part_of_column(&self, element: usize) -> f64 {
        part_of(self.mirrors[1], element.is_multiple_of(self.columns))
    }
}

fn part_of(mirror: Mirror, is_first: bool) -> f64 {
    if is_first && mirror == Mirror::Centre {
        0.5
    } else {
        1.0
    }
}
