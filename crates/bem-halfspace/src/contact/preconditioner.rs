//! An approximate inverse of the influence.
//!
//! The influence of a half space multiplies waves by `2π/|q|`. The inverse has two parts, both positive: between
//! neighbouring elements a difference that is right for the shortest waves,
//!
//! ```text
//! s(q) = w [ (2 − 2 cos q_x Δx)/Δx + (2 − 2 cos q_y Δy)/Δy ],
//! ```
//!
//! and on blocks of two by two elements, where a convolution costs a quarter and needs no padding, what is missing to
//! `|q|` for the long waves. Restricted to the contact it remains positive definite, as conjugate gradients need it.
//! From its result, [`far_loads`](super::far_loads) subtracts the effect of the load on other patches.

use std::ops::Range;

use crate::contact::active_set::{ActiveSet, Run, sum_blocks};
use crate::contact::far_loads::{FarLoads, SMALLEST};
use crate::contact::mirror_weights::MirrorWeights;
use crate::elements::mirror::Mirror;
use crate::parallel::reductions::add;
use crate::{Convolution, ConvolutionWorkspace};

/// Weights of its two approximations. It is positive definite, so that the iteration converges, with any positive ones;
/// a test of the iteration finds how many iterations they cost.
#[derive(Debug, Clone, Copy)]
pub(super) struct Weights {
    /// The weight w of the differences between neighbours.
    pub(super) neighbours: f64,
    /// Part of the displacement of a block under its own load that the block of twice the edges does not have.
    pub(super) blocks: f64,
}

impl Weights {
    /// π/4 for neighbours would be exact for the shortest wave along an edge, and one half for blocks without neighbours,
    /// which take a part of what the larger block leaves. From 0.5 to 0.9 and from 0.2 to 0.5 the iterations are the same
    /// within 15 %, and from 0.01 to 10 and from 0.001 to 3 at most four times as many.
    pub(super) const DEFAULT: Self = Self {
        neighbours: 0.7,
        blocks: 0.3,
    };
}

/// Edge in elements of the blocks on which long waves are inverted.
const BLOCK: usize = 2;

#[derive(Debug, Clone)]
pub(super) struct Preconditioner {
    /// Differences along x and along y, \[1/m].
    weights: [f64; 2],
    shape: [usize; 2],
    mirrors: [Mirror; 2],
    mirror_weights: MirrorWeights,
    blocks: Convolution,
    workspace: ConvolutionWorkspace,
    /// Means of the residual over the blocks, and what the convolution makes of them.
    means: Vec<f64>,
    images: Vec<f64>,
    far_loads: FarLoads,
}

impl Preconditioner {
    pub(super) fn new(convolution: &Convolution, of: Weights) -> Self {
        let grid = convolution.grid();
        let weights = grid.spacing().map(|edge| of.neighbours / edge);
        let blocks = convolution.on_blocks(|q| {
            let difference =
                |axis: usize| weights[axis] * (2.0 - 2.0 * (q[axis] * grid.spacing()[axis]).cos());
            convolution.base.local_stiffness(q[0].hypot(q[1])) - difference(0) - difference(1)
        });
        let n_blocks = blocks.grid().n_elements();
        Self {
            weights,
            shape: grid.shape(),
            mirrors: convolution.mirrors,
            mirror_weights: MirrorWeights::of(convolution),
            workspace: blocks.workspace(),
            blocks,
            means: vec![0.0; n_blocks],
            images: vec![0.0; n_blocks],
            far_loads: FarLoads::new(convolution, of.blocks),
        }
    }

    /// Prepares for another contact; overwrites the field, which must vanish outside it, and both lists.
    pub(super) fn prepare(
        &mut self,
        active: &ActiveSet,
        field: &mut [f64],
        [one, result]: [&mut [f64]; 2],
    ) {
        self.far_loads.forget(active);
        one.fill(1.0);
        self.apply(active, (one, field), result);
        self.far_loads.weigh(active, result);
    }

    /// Lists what the inverse makes of a list of residuals; writes these into a field that vanishes outside the contact.
    pub(super) fn apply(
        &mut self,
        active: &ActiveSet,
        (residual, field): (&[f64], &mut [f64]),
        result: &mut [f64],
    ) {
        self.scatter_residual(active, residual, field);
        self.blocks
            .apply(&mut self.workspace, &self.means, &mut self.images);
        self.far_loads.move_blocks();
        let (this, field) = (&*self, &*field);
        let result = [active.packed(result)];
        active.bands.for_each_part(result, |band, [result]| {
            let residual = &residual[active.packed_range(band)];
            this.take_blocks((active, band), result);
            for run in active.runs(band) {
                let (residual, result) = (
                    &residual[run.packed_range()],
                    &mut result[run.packed_range()],
                );
                this.add_differences((run, residual, field), result);
            }
        });
    }

    /// Spreads a residual over the field, the blocks of long waves and those of far loads.
    fn scatter_residual(&mut self, active: &ActiveSet, residual: &[f64], field: &mut [f64]) {
        let (mirror_weights, columns) = (self.mirror_weights, self.shape[1]);
        let (weights, loads) = self.far_loads.weights_and_loads();
        let fields = [
            active.field(field),
            active.blocks(BLOCK, &mut self.means),
            active.blocks(SMALLEST, loads),
        ];
        let bands = active.bands;
        bands.for_each_part(fields, |band, [field, means, loads]| {
            let [residual, weights] =
                [residual, weights].map(|list| &list[active.packed_range(band)]);
            active.scatter_in(band, residual, field);
            sum_blocks::<BLOCK>(active, band, |place| 0.25 * residual[place], means);
            let first = bands.elements(band).start;
            for run in active.runs(band) {
                for (index, weight) in mirror_weights.in_line(run.elements()) {
                    let element = run.elements_from(first).start + index;
                    let [row, column] = [element / columns, element % columns];
                    means[row / BLOCK * columns.div_ceil(BLOCK) + column / BLOCK] -=
                        0.25 * (1.0 - weight) * residual[run.packed_range().start + index];
                }
            }
            let load = |place: usize| weights[place] * residual[place];
            sum_blocks::<SMALLEST>(active, band, load, loads);
        });
    }

    /// Writes the part of long waves, less that of far loads.
    fn take_blocks(&self, (active, band): (&ActiveSet, usize), result: &mut [f64]) {
        let columns = self.shape[1];
        let (weights, displacements) = self.far_loads.weights_and_displacements();
        let weights = &weights[active.packed_range(band)];
        for run in active.runs(band) {
            let start = run.elements().start;
            let (row, column) = (start / columns, start % columns);
            let images = &self.images[row / BLOCK * columns.div_ceil(BLOCK)..];
            let displacements = &displacements[row / SMALLEST * columns.div_ceil(SMALLEST)..];
            let (result, weights) = (
                &mut result[run.packed_range()],
                &weights[run.packed_range()],
            );
            for (column, (value, weight)) in (column..).zip(result.iter_mut().zip(weights)) {
                *value = images[column / BLOCK] - weight * displacements[column / SMALLEST];
            }
            for (index, weight) in self.mirror_weights.in_line(run.elements()) {
                result[index] -= (1.0 - weight) * images[(column + index) / BLOCK];
            }
        }
    }

    /// Adds the differences between elements of a run, and between them and those of the rows before and behind.
    fn add_differences(&self, (run, residual, field): (&Run, &[f64], &[f64]), result: &mut [f64]) {
        let [rows, columns] = self.shape;
        let mirrors = self.mirrors;
        let along_x = self.weights[0];
        let along_y = self.weights[1] * self.mirror_weights.of_row(run.elements().start);
        let Range { start, end } = run.elements();
        let row = start / columns;
        add(result, 2.0 * (along_x + along_y), residual);
        // Beside a run there is no residual, and behind a mirror stands the element itself, or the image of the next, of
        // which the other half of this one takes its part.
        add(&mut result[1..], -along_y, residual);
        add(result, -along_y, &residual[1..]);
        if !mirrors[1].is_none() && start == row * columns {
            result[0] -= along_y * residual[0];
        }
        let behind = if row > 0 {
            Some(&field[start - columns..end - columns])
        } else {
            (!mirrors[0].is_none()).then_some(residual)
        };
        let ahead = (row + 1 < rows).then(|| &field[start + columns..end + columns]);
        let missing = 1.0 - self.mirror_weights.of_column(run.elements().start);
        result[0] -= missing * 2.0 * along_x * residual[0];
        for beside in [behind, ahead].into_iter().flatten() {
            add(result, -along_x, beside);
            result[0] += missing * along_x * beside[0];
        }
    }
}
