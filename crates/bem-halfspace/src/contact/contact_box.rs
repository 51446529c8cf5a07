//! A part of a grid on which the contact is solved.

use crate::bands::Bands;
use crate::bounds::Bounds;
use crate::chunks::in_pool;
use crate::contact::{Accuracy, ContactState, Control, Outcome, solve_normalised};
use crate::{BemError, ContactOptions, Convolution, Grid};

/// Contact solver on a box of elements around the contact.
#[derive(Debug, Clone)]
pub(crate) struct ContactBox {
    pub(crate) bounds: Bounds,
    convolution: Convolution,
    pub(crate) state: ContactState,
    pub(crate) separation: Vec<f64>,
}

impl ContactBox {
    /// A box of elements of the grid of a convolution, at the same mirrors.
    pub(crate) fn of(convolution: &Convolution, bounds: Bounds) -> Result<Self, BemError> {
        let grid = Grid::new(bounds.shape(), convolution.grid().spacing())?;
        let convolution = convolution.on_grid(&grid);
        Ok(Self {
            bounds,
            state: ContactState::new(&convolution),
            separation: vec![0.0; grid.n_elements()],
            convolution,
        })
    }

    /// A box that is solved as a whole, also where the contact is much smaller.
    pub(crate) fn undivided(convolution: &Convolution, bounds: Bounds) -> Result<Self, BemError> {
        let mut contact_box = Self::of(convolution, bounds)?;
        contact_box.state.in_parts = false;
        Ok(contact_box)
    }

    /// A box of other bounds that starts from the load of this one.
    pub(crate) fn moved_to(&self, bounds: Bounds) -> Result<Self, BemError> {
        let mut moved = Self::of(&self.convolution, bounds)?;
        let (columns, moved_load) = (bounds.shape()[1], moved.state.load.values_mut());
        for (element, load) in self.loaded_elements() {
            if bounds.contains(element) {
                let [row, column] = [element[0] - bounds.lower[0], element[1] - bounds.lower[1]];
                moved_load[row * columns + column] = load;
            }
        }
        Ok(moved)
    }

    /// Copies what lies inside the bounds from a field with `columns` columns, the load as a first guess.
    pub(super) fn take_from(&mut self, (separation, load): (&[f64], &[f64]), columns: usize) {
        let bounds = self.bounds;
        bounds.cut((separation, columns), &mut self.separation);
        bounds.cut((load, columns), self.state.load.values_mut());
    }

    /// Copies the load back.
    pub(super) fn give_to(&self, load: &mut [f64], columns: usize) {
        let (bounds, shape) = (self.bounds, self.bounds.shape());
        let bands = Bands::new(shape);
        let rows = bounds.rows();
        let load = &mut load[rows.start * columns..rows.end * columns];
        let copy = |band, [load]: [&mut [f64]; 1]| {
            let pieces = self.state.load.values()[bands.elements(band)].chunks_exact(shape[1]);
            for (piece, row) in pieces.zip(load.chunks_exact_mut(columns)) {
                row[bounds.lower[1]..bounds.upper[1]].copy_from_slice(piece);
            }
        };
        let load = [(load, bands.starts_of_rows(columns))];
        bands.for_each_part(load, copy);
    }

    /// Solves for the separation set before; the load has the unit of a length, see [`solve_normalised`].
    pub(crate) fn solve(
        &mut self,
        control: Control,
        options: &ContactOptions,
    ) -> Result<Outcome, BemError> {
        in_pool(self.bounds.n_elements(), || {
            self.solve_to(control, &options.into())
        })
    }

    pub(super) fn solve_to(
        &mut self,
        control: Control,
        accuracy: &Accuracy,
    ) -> Result<Outcome, BemError> {
        let question = (&self.convolution, &self.separation[..], control);
        solve_normalised(question, &mut self.state, accuracy)
    }

    /// Elements with load, as [row, column] of the field in which the box lies, and their load.
    pub(crate) fn loaded_elements(&self) -> impl Iterator<Item = ([usize; 2], f64)> {
        let columns = self.bounds.shape()[1];
        let lower = self.bounds.lower;
        self.state
            .load
            .values()
            .iter()
            .enumerate()
            .filter(|(_, load)| **load > 0.0)
            .map(move |(index, &load)| {
                let element = [lower[0] + index / columns, lower[1] + index % columns];
                (element, load)
            })
    }
}
