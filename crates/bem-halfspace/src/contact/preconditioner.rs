//! Preconditioner of the conjugate gradients: an approximate inverse S of the influence K, restricted to the active set.
//!
//! The influence of a half space multiplies waves by `2π/|q|`. Its inverse is split into two positive operators: a
//! difference between neighbouring elements that is right for the shortest waves,
//!
//! ```text
//! s(q) = w [ (2 − 2 cos q_x Δx)/Δx + (2 − 2 cos q_y Δy)/Δy ],
//! ```
//!
//! and a convolution with the remainder `|q| − s(q)` for the long waves on blocks of two by two elements, which costs a quarter
//! and needs no padding. Restricted to the active set the sum remains positive definite, as conjugate gradients need it.
//! [`multilevel_correction`](super::multilevel_correction) subtracts the effect of the load on other patches.
//!
//! Theory: docs/theory/contact.md, "Preconditioner".

use std::ops::Range;

use crate::contact::active_set::{ActiveSet, Run, sum_blocks};
use crate::contact::mirror_weights::MirrorWeights;
use crate::contact::multilevel_correction::{FINEST_BLOCK_EDGE, MultilevelCorrection};
use crate::elements::mirror::Mirror;
use crate::parallel::reductions::add_scaled;
use crate::{Convolution, ConvolutionWorkspace};

/// Parameters of the two approximations in the preconditioner.
///
/// The preconditioner is positive definite for any positive values, so that the iteration converges to the same solution. A test of
/// the iteration compares the numbers of iterations.
#[derive(Debug, Clone, Copy)]
pub(super) struct PreconditionerParameters {
    /// Weight w of the differences between neighbouring elements in s(q), without unit.
    pub(super) neighbour_weight: f64,
    /// Excess of the self-influence of a block over the influence of its load on the parent block, as a fraction of the former.
    pub(super) excess_fraction: f64,
}

impl PreconditionerParameters {
    /// Weights of the preconditioner, chosen below two limits. A neighbour weight of π/4 is exact for the shortest wave along an
    /// edge. An excess of one half is that of a block alone; with neighbouring blocks it is shared.
    ///
    /// For 0.5 to 0.9 and 0.2 to 0.5 the iterations are the same within 15 %; for 0.01 to 10 and 0.001 to 3 there are at most
    /// four times as many.
    pub(super) const DEFAULT: Self = Self {
        neighbour_weight: 0.7,
        excess_fraction: 0.3,
    };
}

/// Edge of the blocks on which long waves are inverted, in elements. Chosen as the smallest that makes the transforms cheaper, by
/// four; longer edges leave more waves to the other part of the preconditioner.
const BLOCK_EDGE: usize = 2;

/// The operators of both approximations, and their buffers.
#[derive(Debug, Clone)]
pub(super) struct Preconditioner {
    /// Factors w/Δx and w/Δy of the differences along x and along y, \[1/m]; w is the neighbour weight.
    stencil: [f64; 2],
    /// Rows and columns of the grid.
    shape: [usize; 2],
    /// Mirrors along x and y, at the first row and column of the grid.
    mirrors: [Mirror; 2],
    /// Fraction of each element in the symmetry-reduced domain.
    mirror_weights: MirrorWeights,
    /// Convolution with the symbol max(|q| − s(q), 0) on the grid of the blocks of [`BLOCK_EDGE`] elements.
    long_wave_inverse: Convolution,
    /// Buffers for applying it.
    workspace: ConvolutionWorkspace,
    /// Mean residual of each of these blocks, with zero outside the active set, \[m].
    block_means: Vec<f64>,
    /// Load of the elements of each of these blocks by long waves, without unit.
    block_loads: Vec<f64>,
    /// Displacements of blocks under the loads of other blocks.
    correction: MultilevelCorrection,
}

impl Preconditioner {
    /// Preconditioner for the operator of a convolution, on an empty active set.
    pub(super) fn new(convolution: &Convolution, parameters: PreconditionerParameters) -> Self {
        let grid = convolution.grid();
        // Set up the stencil s(q) for short waves, and the convolution with the remainder |q| − s(q) that it lacks for long ones.
        let stencil = grid.spacing().map(|dx| parameters.neighbour_weight / dx);
        let long_wave_inverse = convolution.on_blocks(|q| {
            let difference =
                |axis: usize| stencil[axis] * (2.0 - 2.0 * (q[axis] * grid.spacing()[axis]).cos());
            convolution.base.local_wave_number(q[0].hypot(q[1])) - difference(0) - difference(1)
        });
        let n_blocks = long_wave_inverse.grid().n_elements();
        Self {
            stencil,
            shape: grid.shape(),
            mirrors: convolution.mirrors,
            mirror_weights: MirrorWeights::new(convolution),
            workspace: long_wave_inverse.workspace(),
            long_wave_inverse,
            block_means: vec![0.0; n_blocks],
            block_loads: vec![0.0; n_blocks],
            correction: MultilevelCorrection::new(convolution, parameters.excess_fraction),
        }
    }

    /// Prepares for another active set: computes S 1, the loads under a unit gap, for the multilevel correction.
    ///
    /// `ones` and `result` are packed vectors and `field` a field of the grid, which must vanish outside the set; all three are work
    /// space and are overwritten.
    pub(super) fn prepare(
        &mut self,
        active: &ActiveSet,
        field: &mut [f64],
        ones: &mut [f64],
        result: &mut [f64],
    ) {
        // With zero conductances the correction vanishes, so that this applies S alone.
        self.correction.reset(active);
        ones.fill(1.0);
        self.apply(active, ones, field, result);
        self.correction.set_conductances(active, result);
    }

    /// Applies the preconditioner to a packed residual \[m] and writes loads to the packed vector `result`. Leaves the residual
    /// scattered in `field`, a field of the grid that must vanish outside the active set.
    pub(super) fn apply(
        &mut self,
        active: &ActiveSet,
        residual: &[f64],
        field: &mut [f64],
        result: &mut [f64],
    ) {
        let (columns, mirror_weights, row_blocks) =
            (self.shape[1], self.mirror_weights, active.row_blocks);

        // Scatter the residual over the grid, and restrict it to the blocks of the long waves and to those of the multilevel correction.
        let (conductances, block_loads) = self.correction.conductances_and_loads();
        let targets = [
            active.field(field),
            active.blocks(BLOCK_EDGE, &mut self.block_means),
            active.blocks(FINEST_BLOCK_EDGE, block_loads),
        ];
        row_blocks.for_each_part(targets, |row_block, [field, means, loads]| {
            let [residual, conductances] =
                [residual, conductances].map(|vector| &vector[active.packed_range(row_block)]);
            active.scatter_in(row_block, residual, field);
            sum_blocks::<BLOCK_EDGE>(active, row_block, |index| 0.25 * residual[index], means);
            // A mean counts an element on a mirror by its weight.
            let first = row_blocks.elements(row_block).start;
            for run in active.runs(row_block) {
                for (index, weight) in mirror_weights.row_weights(run.elements()) {
                    let element = run.elements_from(first).start + index;
                    let [row, column] = [element / columns, element % columns];
                    means[row / BLOCK_EDGE * columns.div_ceil(BLOCK_EDGE) + column / BLOCK_EDGE] -=
                        0.25 * (1.0 - weight) * residual[run.packed_range().start + index];
                }
            }
            let load = |index: usize| conductances[index] * residual[index];
            sum_blocks::<FINEST_BLOCK_EDGE>(active, row_block, load, loads);
        });

        // Invert the long waves, and find the displacements that other blocks cause.
        self.long_wave_inverse.apply(
            &mut self.workspace,
            &self.block_means,
            &mut self.block_loads,
        );
        self.correction.solve_block_displacements();

        // Prolong the loads of the long waves and the displacements of the blocks to the elements, and add the short waves.
        let (this, field) = (&*self, &*field);
        let (conductances, displacements) = this.correction.conductances_and_displacements();
        row_blocks.for_each_part([active.packed(result)], |row_block, [result]| {
            let [residual, conductances] =
                [residual, conductances].map(|vector| &vector[active.packed_range(row_block)]);
            for run in active.runs(row_block) {
                let start = run.elements().start;
                let (row, column) = (start / columns, start % columns);
                let loads = &this.block_loads[row / BLOCK_EDGE * columns.div_ceil(BLOCK_EDGE)..];
                let displacements =
                    &displacements[row / FINEST_BLOCK_EDGE * columns.div_ceil(FINEST_BLOCK_EDGE)..];
                let range = run.packed_range();
                let (residual, result) = (&residual[range.clone()], &mut result[range.clone()]);
                let values = result.iter_mut().zip(&conductances[range]);
                for (column, (value, conductance)) in (column..).zip(values) {
                    *value = loads[column / BLOCK_EDGE]
                        - conductance * displacements[column / FINEST_BLOCK_EDGE];
                }
                for (index, weight) in mirror_weights.row_weights(run.elements()) {
                    result[index] -= (1.0 - weight) * loads[(column + index) / BLOCK_EDGE];
                }
                this.add_differences(run, residual, field, result);
            }
        });
    }

    /// Adds the short-wave operator with the symbol s(q), a five-point stencil, on the elements of a run.
    ///
    /// `residual` and `result` are the parts of the packed vectors for the run, `field` is the residual on the whole grid.
    fn add_differences(&self, run: &Run, residual: &[f64], field: &[f64], result: &mut [f64]) {
        let [rows, columns] = self.shape;
        let mirrors = self.mirrors;
        let along_x = self.stencil[0];
        let along_y = self.stencil[1] * self.mirror_weights.of_row(run.elements().start);
        let Range { start, end } = run.elements();
        let row = start / columns;
        // Add the diagonal of the five-point stencil, twice the weight of each axis.
        add_scaled(result, 2.0 * (along_x + along_y), residual);
        // Subtract the neighbours along y. Beyond the ends of a run the residual is zero. Behind a mirror stands the element
        // itself, or the image of the next one, whose share belongs to the other half of this one.
        add_scaled(&mut result[1..], -along_y, residual);
        add_scaled(result, -along_y, &residual[1..]);
        if !mirrors[1].is_none() && start == row * columns {
            result[0] -= along_y * residual[0];
        }
        // Find the neighbours along x, which lie in the rows behind and ahead of the run, to subtract them below.
        let behind = if row > 0 {
            Some(&field[start - columns..end - columns])
        } else {
            (!mirrors[0].is_none()).then_some(residual)
        };
        let ahead = (row + 1 < rows).then(|| &field[start + columns..end + columns]);
        // The first element of a run may be halved by a mirror along its column.
        let missing = 1.0 - self.mirror_weights.of_column(run.elements().start);
        result[0] -= missing * 2.0 * along_x * residual[0];
        for neighbours in [behind, ahead].into_iter().flatten() {
            add_scaled(result, -along_x, neighbours);
            result[0] += missing * along_x * neighbours[0];
        }
    }
}

#[cfg(test)]
mod tests {
    use nalgebra::DMatrix;

    use super::*;
    use crate::elements::mirror::NO_MIRRORS;
    use crate::{BemError, Grid};

    /// Active sets with many diagonal neighbours, ends and gaps: a checkerboard, one of larger blocks, stripes, crosses, separate blocks,
    /// and an irregular one.
    fn patterns([rows, columns]: [usize; 2]) -> Vec<Vec<bool>> {
        let kinds: [fn(usize, usize) -> bool; 6] = [
            |row, column| (row + column) % 2 == 0,
            |row, column| (row / 2 + column / 2) % 2 == 0,
            |row, column| (row + 2 * column) % 5 < 2,
            |row, column| row % 6 == 2 || column % 6 == 3,
            |row, column| row % 9 < 3 && column % 9 < 3,
            |row, column| (row * row * 7 + column * 13 + row * column * 5) % 11 < 4,
        ];
        let pattern = |is_active: fn(usize, usize) -> bool| {
            let elements = 0..rows * columns;
            elements
                .map(|element| is_active(element / columns, element % columns))
                .collect()
        };
        kinds.map(pattern).to_vec()
    }

    /// The preconditioner as a matrix over an active set.
    fn matrix(preconditioner: &mut Preconditioner, active: &ActiveSet, n: usize) -> DMatrix<f64> {
        let [mut one, mut result] = [0, 1].map(|_| vec![0.0; active.len()]);
        let mut field = vec![0.0; n];
        preconditioner.prepare(active, &mut field, &mut one, &mut result);
        let mut matrix = DMatrix::zeros(one.len(), one.len());
        for column in 0..one.len() {
            one.fill(0.0);
            one[column] = 1.0;
            preconditioner.apply(active, &one, &mut field, &mut result);
            for (row, value) in result.iter().enumerate() {
                matrix[(row, column)] = *value;
            }
        }
        matrix
    }

    /// Checks the matrix on those rows of each pattern that are in the part, which keeps it small.
    fn check(convolution: &Convolution, in_part: impl Fn(usize) -> bool + Sync) {
        let (shape, mirrors) = (convolution.grid().shape(), convolution.mirrors);
        for (number, pattern) in patterns(shape).into_iter().enumerate() {
            let mut active = ActiveSet::new(shape);
            active.assign(|element| pattern[element] && in_part(element / shape[1]));
            active.find_runs();
            let mut preconditioner =
                Preconditioner::new(convolution, PreconditionerParameters::DEFAULT);
            let matrix = matrix(&mut preconditioner, &active, pattern.len());
            let largest = matrix.amax();
            let asymmetry = (&matrix - matrix.transpose()).amax() / largest;
            assert!(asymmetry < 1e-13, "pattern {number}: {asymmetry:e}");
            let smallest = matrix.symmetric_eigenvalues().min() / largest;
            assert!(smallest > 1e-3, "pattern {number}, {mirrors:?}: {smallest}");
        }
    }

    /// The claim of docs/theory/contact.md, on symmetry-reduced domains and over several row blocks too.
    #[test]
    fn on_any_contact_it_is_symmetric_and_positive() -> Result<(), BemError> {
        for (shape, mirrors) in [
            ([26, 24], NO_MIRRORS),
            ([26, 24], [Mirror::None, Mirror::Edge]),
            ([26, 24], [Mirror::Edge; 2]),
            ([26, 23], [Mirror::Edge, Mirror::Centre]),
            ([25, 23], [Mirror::None, Mirror::Centre]),
            ([25, 23], [Mirror::Centre, Mirror::None]),
            ([25, 23], [Mirror::Centre; 2]),
        ] {
            let grid = Grid::new(shape, [1.0, 0.7])?;
            check(&Convolution::new(&grid).folded(mirrors), |_| true);
            if shape == [26, 24] {
                check(&Convolution::periodic(&grid).folded(mirrors), |_| true);
            }
        }
        // Check grids that are divided into several row blocks, at the border of two of these.
        let whole = Convolution::new(&Grid::new([2000, 9], [1.0, 0.7])?);
        for convolution in [&whole, &whole.folded([Mirror::None, Mirror::Centre])] {
            let row_blocks = ActiveSet::new(convolution.grid().shape()).row_blocks;
            let border = row_blocks.rows(1).start;
            assert!(
                (1..1988).contains(&border),
                "two row blocks meet at {border}"
            );
            check(convolution, |row| (border - 12..border + 12).contains(&row));
        }
        Ok(())
    }
}
