//! A part of a grid on which the contact is solved.

use crate::bounds::Bounds;
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
    /// A box of elements with the given edges.
    pub(crate) fn new(bounds: Bounds, spacing: [f64; 2]) -> Result<Self, BemError> {
        let convolution = Convolution::new(&Grid::new(bounds.shape(), spacing)?);
        let state = ContactState::new(&convolution);
        let separation = vec![0.0; convolution.grid().n_elements()];
        Ok(Self {
            bounds,
            convolution,
            state,
            separation,
        })
    }

    /// A box of other bounds that starts from the load of this one.
    pub(crate) fn moved_to(&self, bounds: Bounds) -> Result<Self, BemError> {
        let mut moved = Self::new(bounds, self.convolution.grid().spacing())?;
        let columns = bounds.shape()[1];
        for (element, load) in self.loaded_elements() {
            if bounds.contains(element) {
                let [row, column] = [element[0] - bounds.lower[0], element[1] - bounds.lower[1]];
                moved.state.load[row * columns + column] = load;
            }
        }
        Ok(moved)
    }

    /// Copies what lies inside the bounds from a field with `columns` columns, the load as a first guess.
    pub(super) fn take_from(&mut self, (separation, load): (&[f64], &[f64]), columns: usize) {
        let width = self.bounds.shape()[1];
        let pieces = self.separation.chunks_exact_mut(width);
        let pieces = pieces.zip(self.state.load.chunks_exact_mut(width));
        for (range, (box_separation, box_load)) in self.bounds.row_ranges(columns).zip(pieces) {
            box_separation.copy_from_slice(&separation[range.clone()]);
            box_load.copy_from_slice(&load[range]);
        }
    }

    /// Copies the load back.
    pub(super) fn give_to(&self, load: &mut [f64], columns: usize) {
        let pieces = self.state.load.chunks_exact(self.bounds.shape()[1]);
        for (range, box_load) in self.bounds.row_ranges(columns).zip(pieces) {
            load[range].copy_from_slice(box_load);
        }
    }

    /// Solves for the separation set before; the load has the unit of a length, see [`solve_normalised`].
    pub(crate) fn solve(
        &mut self,
        control: Control,
        options: &ContactOptions,
    ) -> Result<Outcome, BemError> {
        self.solve_to(control, &options.into())
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
            .iter()
            .enumerate()
            .filter(|(_, load)| **load > 0.0)
            .map(move |(index, &load)| {
                let element = [lower[0] + index / columns, lower[1] + index % columns];
                (element, load)
            })
    }
}
