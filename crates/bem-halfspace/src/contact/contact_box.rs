//! A part of a grid on which the contact is solved.

use crate::bands::for_each_row;
use crate::bounds::Bounds;
use crate::chunks::in_pool;
use crate::contact::solve::LoadProblem;
use crate::contact::{Accuracy, ContactState, Control, Solved, solve_loads};
use crate::mirror::Mirror;
use crate::{BemError, ContactOptions, Convolution, Grid};

/// Contact solver on a box of elements around the contact.
#[derive(Debug, Clone)]
pub(crate) struct ContactBox {
    pub(crate) bounds: Bounds,
    pub(super) convolution: Convolution,
    pub(crate) state: ContactState,
    pub(crate) separation: Vec<f64>,
}

impl ContactBox {
    fn new(convolution: Convolution, bounds: Bounds) -> Self {
        Self {
            bounds,
            state: ContactState::new(&convolution),
            separation: vec![0.0; bounds.n_elements()],
            convolution,
        }
    }

    /// A box of elements of the grid of a convolution, at the same mirrors.
    pub(crate) fn of(convolution: &Convolution, bounds: Bounds) -> Result<Self, BemError> {
        let grid = Grid::new(bounds.shape(), convolution.grid().spacing())?;
        Ok(Self::new(convolution.on_grid(&grid), bounds))
    }

    /// The part of the grid of a convolution in front of mirrors in its middle.
    pub(super) fn in_front_of(mirrors: [Mirror; 2], convolution: &Convolution) -> Self {
        let folded = convolution.folded(mirrors);
        let (part, upper) = (folded.grid().shape(), convolution.grid().shape());
        let lower = [upper[0] - part[0], upper[1] - part[1]];
        Self::new(folded, Bounds { lower, upper })
    }

    /// A box of other bounds that starts from the load of this one.
    pub(crate) fn moved_to(&self, bounds: Bounds) -> Result<Self, BemError> {
        let mut moved = Self::of(&self.convolution, bounds)?;
        let columns = bounds.shape()[1];
        for (element, load) in self.loaded_elements() {
            if bounds.contains(element) {
                let [row, column] = [element[0] - bounds.lower[0], element[1] - bounds.lower[1]];
                moved.state.load[row * columns + column] = load;
            }
        }
        Ok(moved)
    }

    /// Copies what lies inside the bounds from fields with `columns` columns, the load as a first guess.
    pub(super) fn take_from(&mut self, [separation, load]: [&[f64]; 2], columns: usize) {
        let bounds = self.bounds;
        bounds.cut((separation, columns), &mut self.separation);
        bounds.cut((load, columns), &mut self.state.load);
    }

    /// Copies the load into a field with `columns` columns.
    pub(super) fn give_load_to(&self, field: &mut [f64], columns: usize) {
        let (rows, width) = (self.bounds.rows(), self.bounds.shape()[1]);
        let field = &mut field[rows.start * columns..rows.end * columns];
        for_each_row(field, columns, |row, values| {
            let load = &self.state.load[row * width..][..width];
            values[self.bounds.columns()].copy_from_slice(load);
        });
    }

    /// Solves for the separation set before; the load has the unit of a length.
    pub(crate) fn solve(
        &mut self,
        control: Control,
        options: &ContactOptions,
    ) -> Result<Solved, BemError> {
        in_pool(self.bounds.n_elements(), || {
            self.solve_to(control, &options.into())
        })
    }

    pub(super) fn solve_to(
        &mut self,
        control: Control,
        accuracy: &Accuracy,
    ) -> Result<Solved, BemError> {
        let problem = LoadProblem {
            convolution: &self.convolution,
            separation: &self.separation,
            control,
        };
        solve_loads(problem, &mut self.state, accuracy)
    }

    /// Elements with load, as [row, column] of the field in which the box lies, and their load.
    pub(crate) fn loaded_elements(&self) -> impl Iterator<Item = ([usize; 2], f64)> {
        let (lower, columns) = (self.bounds.lower, self.bounds.shape()[1]);
        let loads = self.state.load.iter().enumerate();
        let loaded = loads.filter(|(_, load)| **load > 0.0);
        loaded.map(move |(index, &load)| {
            let element = [lower[0] + index / columns, lower[1] + index % columns];
            (element, load)
        })
    }
}
