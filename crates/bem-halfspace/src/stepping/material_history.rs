//! The elements that the footprint passes, and their memory of past loads.
//!
//! ```text
//! u = history + 2 (1 − ν) α w,   w = K P / (4π)        at the end of a step
//! ```
//! Every element keeps one number per retardation element of the material, and one for free flow. A material that
//! remembers nothing needs no more elements than the footprint has.

use std::ops::Range;

use rheology::ExponentialStep;

use crate::elements::resolution::Layout;
use crate::{Base, BemError, Convolution, ConvolutionWorkspace, Grid, Rows};

/// Fields over all elements of a path in front of the mirrors; displacements in units of the height scale, lengths in Δx.
pub(super) struct MaterialHistory {
    pub(super) convolution: Convolution,
    workspace: ConvolutionWorkspace,
    load: Vec<f64>,
    /// Displacement by the load of the present step.
    increment: Vec<f64>,
    /// [row][field][column], so that the rows of a step lie together.
    variables: Vec<f64>,
    pub(super) n_fields: usize,
}

impl MaterialHistory {
    pub(super) fn new(
        n_rows: usize,
        layout: &Layout,
        aspect: f64,
        (n_fields, base): (usize, Base),
    ) -> Result<Self, BemError> {
        let grid = Grid::new([n_rows, layout.folded_shape()[1]], [1.0, aspect])?;
        let n_elements = grid.n_elements();
        let whole = Convolution::free(&grid.unfolded(layout.mirrors), base);
        let convolution = whole.folded(layout.mirrors);
        Ok(Self {
            workspace: convolution.workspace(),
            load: vec![0.0; n_elements],
            increment: vec![0.0; n_elements],
            variables: vec![0.0; n_fields * n_elements],
            n_fields,
            convolution,
        })
    }

    fn columns(&self) -> usize {
        self.convolution.grid().shape()[1]
    }

    /// Displacement of the step in a range of rows.
    pub(super) fn increment(&self, rows: Range<usize>) -> &[f64] {
        &self.increment[rows.start * self.columns()..rows.end * self.columns()]
    }

    fn row_variables(&self, rows: Range<usize>) -> &[f64] {
        let per_row = self.n_fields * self.columns();
        &self.variables[rows.start * per_row..rows.end * per_row]
    }

    /// What all elements remember.
    pub(super) fn variables_mut(&mut self) -> &mut [f64] {
        &mut self.variables
    }

    /// Displacement at the end of a step without load, from `first_row` on.
    pub(super) fn displacement_without_load(
        &self,
        step: &ExponentialStep,
        first_row: usize,
        history: &mut [f64],
    ) {
        let columns = self.columns();
        for (row, history) in (first_row..).zip(history.chunks_exact_mut(columns)) {
            step.history(self.row_variables(row..row + 1), history);
        }
    }

    /// Presses with loads on the elements of a footprint that begins at `first_row`, and finds how far the rows
    /// `wanted` give way.
    pub(super) fn apply_load(
        &mut self,
        loaded: impl Iterator<Item = ([usize; 2], f64)>,
        (first_row, rows): (usize, Range<usize>),
        wanted: Range<usize>,
    ) {
        let columns = self.columns();
        let rows = rows.start + first_row..rows.end + first_row;
        self.load[rows.start * columns..rows.end * columns].fill(0.0);
        for ([row, column], load) in loaded {
            self.load[(row + first_row) * columns + column] = load;
        }
        let rows = Rows {
            loaded: rows,
            wanted,
        };
        let (load, increment) = (&self.load, &mut self.increment);
        self.convolution
            .apply_in(&rows, &mut self.workspace, load, increment);
    }

    /// A step without load.
    pub(super) fn clear_increment(&mut self, wanted: Range<usize>) {
        let columns = self.columns();
        self.increment[wanted.start * columns..wanted.end * columns].fill(0.0);
    }

    /// Ends the step in the rows that are still needed.
    pub(super) fn advance(&mut self, step: &ExponentialStep, wanted: Range<usize>) {
        if self.n_fields == 0 {
            return;
        }
        let columns = self.columns();
        let per_row = self.n_fields * columns;
        let compliance = step.response();
        let increments = self.increment[wanted.start * columns..wanted.end * columns]
            .chunks_exact_mut(columns)
            .zip(self.variables[wanted.start * per_row..].chunks_exact_mut(per_row));
        for (increment, memory) in increments {
            // From here on the load potential that caused the displacement, times 2 (1 − ν).
            for value in &mut *increment {
                *value /= compliance;
            }
            step.advance(increment, memory);
        }
    }
}
