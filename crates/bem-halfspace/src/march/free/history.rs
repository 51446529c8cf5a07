//! Displacements and history variables of all elements that the footprint passes.
//!
//! ```text
//! u = H + 2 (1 − ν) α w,   w = K P / (4π)        at the end of a step
//! ```
//! P is the pressure of the step, K the operator of the influence coefficients, w the load potential and ν the Poisson ratio. H
//! is the displacement at the end of the step if P were zero, and α the compliance of the step.
//!
//! Every element has one history variable per retardation element of the material, one for free flow, and the last load
//! if loads are linear over a step. An elastic material has none, and needs no more elements than the footprint.
//!
//! Theory: docs/theory/transient-half-space.md, "Elements and steps".

use std::ops::Range;

use rheology::ExponentialStep;

use crate::elements::resolution::Layout;
use crate::{Base, BemError, Convolution, ConvolutionWorkspace, Grid, Rows};

/// Fields over the *path*, all elements that the symmetry-reduced domain of the footprint passes; row-major. Displacements are in units of
/// the height scale of the march, lengths along the surface in Δx, loads in the ratio of the two.
pub(super) struct MaterialHistory {
    /// Operator K on the path.
    pub(super) convolution: Convolution,
    /// Buffers for applying K.
    workspace: ConvolutionWorkspace,
    /// Load x = 2 (1 − ν) α P/(4π) of the present step; valid only in the rows that were last loaded.
    load: Vec<f64>,
    /// Displacement 2 (1 − ν) α w by the load of the present step. [`advance`](Self::advance) divides it by α if there are history
    /// variables.
    increment: Vec<f64>,
    /// History variables, `[row][field][column]`: rows that a step needs are contiguous.
    pub(super) variables: Vec<f64>,
    /// History variables per element.
    pub(super) n_fields: usize,
}

impl MaterialHistory {
    /// A path of `n_rows` rows over an undeformed surface; `aspect` is Δy/Δx, and the base has lengths in Δx.
    pub(super) fn new(
        n_rows: usize,
        layout: &Layout,
        aspect: f64,
        n_fields: usize,
        base: Base,
    ) -> Result<Self, BemError> {
        let grid = Grid::new([n_rows, layout.folded_shape()[1]], [1.0, aspect])?;
        let n_elements = grid.n_elements();
        let whole = Convolution::new_free(&grid.unfolded(layout.mirrors), base);
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

    /// Number of columns of the path, those of the symmetry-reduced domain of the footprint.
    fn columns(&self) -> usize {
        self.convolution.grid().shape()[1]
    }

    /// Displacement by the load of the present step in a range of rows of the path, in units of the height scale.
    pub(super) fn increment(&self, rows: Range<usize>) -> &[f64] {
        &self.increment[rows.start * self.columns()..rows.end * self.columns()]
    }

    /// History variables of a range of rows of the path, `[row][field][column]`.
    fn row_variables(&self, rows: Range<usize>) -> &[f64] {
        let per_row = self.n_fields * self.columns();
        &self.variables[rows.start * per_row..rows.end * per_row]
    }

    /// Writes H, the displacement at the end of a step without load, for the rows of the path from `first_row` on; `history` has whole
    /// rows and determines their number.
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

    /// Computes the displacement by the load of a step in the rows `wanted` of the path.
    ///
    /// `loaded` gives the loaded elements, [row, column] of the footprint, with their loads. The footprint begins at row `first_row` of
    /// the path, and only its rows `footprint_rows` may be loaded.
    pub(super) fn apply_load(
        &mut self,
        loaded: impl Iterator<Item = ([usize; 2], f64)>,
        first_row: usize,
        footprint_rows: Range<usize>,
        wanted: Range<usize>,
    ) {
        // Write the loads of the footprint into the load field of the path. Other rows need not be cleared, because the
        // convolution does not read them.
        let columns = self.columns();
        let path_rows = footprint_rows.start + first_row..footprint_rows.end + first_row;
        self.load[path_rows.start * columns..path_rows.end * columns].fill(0.0);
        for ([row, column], load) in loaded {
            self.load[(row + first_row) * columns + column] = load;
        }
        let rows = Rows {
            loaded: path_rows,
            wanted,
        };
        let (load, increment) = (&self.load, &mut self.increment);
        self.convolution
            .apply_in(&rows, &mut self.workspace, load, increment);
    }

    /// Sets the displacement by the load of the present step to zero in the rows `wanted`: a step without load.
    pub(super) fn clear_increment(&mut self, wanted: Range<usize>) {
        let columns = self.columns();
        self.increment[wanted.start * columns..wanted.end * columns].fill(0.0);
    }

    /// Advances the history variables of the rows `wanted` to the end of the step, from the displacement by its load.
    pub(super) fn advance(&mut self, step: &ExponentialStep, wanted: Range<usize>) {
        if self.n_fields == 0 {
            return;
        }
        let columns = self.columns();
        let per_row = self.n_fields * columns;
        let compliance = step.response();
        // Advance the history variables row by row, because `variables` stores all fields of a row next to each other.
        let increments = self.increment[wanted.start * columns..wanted.end * columns]
            .chunks_exact_mut(columns)
            .zip(self.variables[wanted.start * per_row..].chunks_exact_mut(per_row));
        for (increment, variables) in increments {
            // The input of the creep law is 2 (1 − ν) times the load potential w (head of this file): the displacement over the
            // compliance α of the step.
            for value in &mut *increment {
                *value /= compliance;
            }
            step.advance(increment, variables);
        }
    }
}
