//! Coarse-space correction of the preconditioner on blocks of elements, for contacts of many patches.
//!
//! The preconditioner is the inverse S of the influence, restricted to the active set. It finds the pressure for the gaps of a
//! patch as if no other patch were loaded (as for static contacts, `contact/multilevel_correction.rs`). Let w = S 1 be the
//! pressures under the unit gap, the *conductances* of the elements, and W their mean over a block. Let s be the means over the
//! blocks of the pressures S r under a gap r, and K the kernel between blocks. The displacement U of the blocks by other patches
//! then satisfies
//!
//! ```text
//! U + K W U = K s,        C r = S r − w U.
//! ```
//!
//! and S is replaced by the corrected preconditioner C. Pressures and displacements are in units in which an element is displaced by
//! 1 under its own unit pressure. The blocks are eight elements long along x and one across. Waves that do not vary along x, the
//! direction of motion, have the frequency 0 and the equilibrium modulus at every speed. They are therefore the most compliant by
//! far, and short ones among them matter.
//!
//! Theory: docs/theory/stationary-half-space.md, "Periodic surfaces", and docs/theory/contact.md, "Other patches".

use numerics::transforms::Real as _;
use rustfft::num_complex::Complex;

use crate::contact::active_set::ActiveSet;
use crate::parallel::chunks::Starts;
use crate::parallel::reductions::{add_scaled, sum};
use crate::parallel::row_blocks::{RowBlocks, copies};
use crate::stationary::conjugate_residuals::{GcrLimits, GcrState, gcr, norm};
use crate::stationary::periodic::kernel::{MaterialAtSpeed, PeriodicKernel};
use crate::{BemError, Grid};

/// Length of a block along x, in elements. Derived: the largest for which no block is divided between two row blocks, the shares
/// of the threads.
pub(super) const BLOCK_LENGTH: usize = RowBlocks::MAX_COARSE_BLOCK;
/// Weight of an element in the mean over a block, 1/[`BLOCK_LENGTH`].
const INVERSE_BLOCK_LENGTH: f32 = 1.0 / BLOCK_LENGTH as f32;
/// Tolerance of the residual of the block equation, relative to its right side. Chosen by measurements on rough contacts (case of
/// `evidence tuning`): with 3e-3 throughout, a dense contact on a solid of many branches takes four times as many operator
/// applications.
const TOLERANCE: f64 = 1e-4;
/// Limits of GCR for the block equation. Measured: up to 2048² elements 40 and 80 steps lead to about as many operator applications,
/// and so do truncation depths of one, two and eight.
const GCR_LIMITS: GcrLimits = GcrLimits {
    max_steps: 80,
    truncation_depth: 2,
};

/// The correction on one grid, for the present active set.
pub(super) struct BlockCorrection {
    /// Number of columns of the grid, and of the grid of blocks.
    columns: usize,
    /// Kernel K on the grid of blocks.
    kernel: PeriodicKernel,
    /// Displacement of an element under its own unit pressure, the unit of K, \[m/Pa].
    self_influence: f64,
    /// Mean conductance W of each block, row-major; 0 for a block with a mean tension under the unit gap.
    conductance: Vec<f32>,
    /// Mean w̄ of W, which replaces W in the preconditioner of the block equation.
    mean_conductance: f32,
    /// Symbols K (1 + w̄ K)⁻¹ of that preconditioner.
    preconditioner: Vec<Complex<f32>>,
    /// Displacement U of the blocks for s = W, row-major: the first guess for the next active set.
    unit_gap_displacement: Vec<f32>,
}

impl BlockCorrection {
    /// The correction on a grid, for an empty active set; `None` if the number of rows is not a multiple of [`BLOCK_LENGTH`].
    pub(super) fn new(
        sliding: &MaterialAtSpeed,
        grid: &Grid,
        self_influence: f64,
    ) -> Result<Option<Self>, BemError> {
        // The blocks form a grid of their own, with the same kernel on longer elements.
        let ([rows, columns], [dx, dy]) = (grid.shape(), grid.spacing());
        if !rows.is_multiple_of(BLOCK_LENGTH) {
            return Ok(None);
        }
        let blocks = Grid::new(
            [rows / BLOCK_LENGTH, columns],
            [dx * BLOCK_LENGTH as f64, dy],
        )?;
        Ok(Some(Self {
            columns,
            kernel: PeriodicKernel::new(sliding, &blocks)?,
            self_influence,
            conductance: copies(0.0, blocks.n_elements()),
            mean_conductance: 0.0,
            preconditioner: Vec::new(),
            unit_gap_displacement: copies(0.0, blocks.n_elements()),
        }))
    }

    /// Sets the packed `conductances` w = S 1 of another active set, and replaces `unit_depth_response`, a copy of them, by C 1. Blocks
    /// with a mean tension take no part.
    pub(super) fn set_conductances(
        &mut self,
        active: &ActiveSet,
        conductances: &[f32],
        unit_depth_response: &mut [f32],
    ) {
        // Average the response over the blocks, and update the preconditioner.
        let means = self.means(active, conductances);
        self.conductance = means.iter().map(|mean| mean.max(0.0)).collect();
        let total = f64::from(sum([&self.conductance], |[conductance]| conductance));
        let mean = total / self.conductance.len() as f64;
        self.mean_conductance = f32::rounded(mean);
        self.preconditioner = self.kernel.parallel_compliance(mean, self.self_influence);
        // The solution for the previous active set is similar, and serves as the first guess.
        let mut displacement = std::mem::take(&mut self.unit_gap_displacement);
        self.solve(&means, &mut displacement);
        self.subtract(active, conductances, &displacement, unit_depth_response);
        self.unit_gap_displacement = displacement;
    }

    /// Replaces a packed vector of pressures S r by C r; `w` has the packed conductances.
    pub(super) fn correct(&mut self, active: &ActiveSet, w: &[f32], pressures: &mut [f32]) {
        let mut displacement = copies(0.0, self.conductance.len());
        self.solve(&self.means(active, pressures), &mut displacement);
        self.subtract(active, w, &displacement, pressures);
    }

    /// Subtracts w U from packed pressures, on the blocks that take part, those with W > 0; `displacement` has U of each block.
    ///
    /// The other blocks must be left out as in the block equation, because the most compliant waves multiply any difference by the
    /// ratio of the moduli.
    fn subtract(&self, active: &ActiveSet, w: &[f32], displacement: &[f32], pressures: &mut [f32]) {
        let columns = self.columns;
        let list = [active.packed(pressures)];
        active
            .row_blocks
            .for_each_part(list, |row_block, [pressures]| {
                let w = &w[active.packed_range(row_block)];
                for run in active.runs(row_block) {
                    // A run is a row of successive elements. Find the blocks to which they belong, and subtract w U of each
                    // element that takes part.
                    let first = run.elements().start;
                    let block = first / columns / BLOCK_LENGTH * columns + first % columns;
                    let blocks = displacement[block..].iter().zip(&self.conductance[block..]);
                    let range = run.packed_range();
                    let parts = pressures[range.clone()].iter_mut().zip(&w[range]);
                    for ((pressure, w), (displacement, of_block)) in parts.zip(blocks) {
                        let takes_part = *of_block > 0.0;
                        *pressure -= if takes_part { w * displacement } else { 0.0 };
                    }
                }
            });
    }

    /// Means of a packed vector over the blocks, row-major; elements outside the active set count as zero.
    fn means(&self, active: &ActiveSet, list: &[f32]) -> Vec<f32> {
        let columns = self.columns;
        let mut means = copies(0.0, self.conductance.len());
        let starts = Starts::Every(active.row_blocks.rows(0).len() / BLOCK_LENGTH * columns);
        let parts = [(&mut means[..], starts)];
        active
            .row_blocks
            .for_each_part(parts, |row_block, [means]| {
                let first_row = active.row_blocks.rows(row_block).start;
                let list = &list[active.packed_range(row_block)];
                for run in active.runs(row_block) {
                    // Add each element of the run, over the length of a block, to the mean of the block to which it belongs.
                    let first = run.elements().start;
                    let block =
                        (first / columns - first_row) / BLOCK_LENGTH * columns + first % columns;
                    add_scaled(
                        &mut means[block..],
                        INVERSE_BLOCK_LENGTH,
                        &list[run.packed_range()],
                    );
                }
            });
        means
    }

    /// Solves the block equation U + K W U = K s by GCR; `means` is s, and `displacement` a guess of U that becomes the solution.
    ///
    /// The equation is multiplied by (1 + w̄ K)⁻¹ from the left, its inverse for a constant conductance w̄. The residual of the result is a
    /// displacement.
    fn solve(&mut self, means: &[f32], displacement: &mut [f32]) {
        let Self {
            kernel,
            conductance,
            mean_conductance,
            preconditioner,
            ..
        } = self;
        let row_blocks = RowBlocks::new([means.len(), 1]);
        let [mut residual, mut load] = [(); 2].map(|()| copies(0.0, means.len()));
        kernel.apply_single_precision(preconditioner, means, &mut residual);
        let target = TOLERANCE * norm(&residual);
        // This is the change of the residual by a change `from` of the displacement: minus the preconditioned operator of the
        // block equation.
        let mut find_image = |from: &[f32], image: &mut [f32]| {
            row_blocks.for_each([&mut load], |row_block, [load]| {
                let elements = row_blocks.elements(row_block);
                let pairs = from[elements.clone()].iter().zip(&conductance[elements]);
                for (load, (value, conductance)) in load.iter_mut().zip(pairs) {
                    *load = (*mean_conductance - conductance) * value;
                }
            });
            kernel.apply_single_precision(preconditioner, &load, image);
            row_blocks.for_each([image], |row_block, [image]| {
                add_scaled(image, -1.0, &from[row_blocks.elements(row_block)]);
            });
        };
        // So far the residual is that of U = 0. A guess changes it by the image of the guess.
        if norm(displacement) > 0.0 {
            let mut image = copies(0.0, means.len());
            find_image(displacement, &mut image);
            add_scaled(&mut residual, 1.0, &image);
        }
        // Iterate to the target. The equation is already preconditioned, so that its residual is the next direction.
        let find_direction = |state: GcrState<f32>, direction: &mut [f32], image: &mut [f32]| {
            let goes_on = state.residual_square.sqrt() > target;
            if goes_on {
                direction.copy_from_slice(state.source);
                find_image(state.source, image);
            }
            goes_on
        };
        gcr(displacement, &mut residual, GCR_LIMITS, find_direction);
    }
}
