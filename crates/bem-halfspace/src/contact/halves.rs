//! Elements through which a mirror passes, of which one half is in front of it.

use crate::contact::contact_set::Run;
use crate::mirror::Mirror;

/// Of a grid with so many columns, at its rear along x and y.
#[derive(Debug, Clone, Copy)]
pub(super) struct Halves {
    pub(super) mirrors: [Mirror; 2],
    pub(super) columns: usize,
}

impl Halves {
    /// Those of a run, counted from its start, and the part of each that is in front of the mirrors.
    pub(super) fn of(&self, run: &Run) -> impl Iterator<Item = (usize, f64)> {
        let of_row = self.of_row(run);
        let of_first = of_row * self.of_first_column(run);
        let count = if of_row < 1.0 {
            run.elements().len()
        } else {
            usize::from(of_first < 1.0)
        };
        (0..count).map(move |index| (index, if index == 0 { of_first } else { of_row }))
    }

    /// The part of the row of a run in front of the mirror across x.
    pub(super) fn of_row(&self, run: &Run) -> f64 {
        let is_first = run.elements().start < self.columns;
        in_front(self.mirrors[0], is_first)
    }

    /// The part of the column in which a run begins in front of the mirror across y.
    pub(super) fn of_first_column(&self, run: &Run) -> f64 {
        let is_first = run.elements().start.is_multiple_of(self.columns);
        in_front(self.mirrors[1], is_first)
    }
}

fn in_front(mirror: Mirror, is_first: bool) -> f64 {
    if is_first && mirror == Mirror::Centre {
        0.5
    } else {
        1.0
    }
}
