//! Displacement of a patch of the contact under the load on other patches.
//!
//! The inverse S of the influence, restricted to the contact, finds the pressure for the gaps of a patch as if no other
//! patch were loaded (as in the contact of one instant, `contact/block_correction.rs`). With the pressure w = S 1 for the gap one
//! and its means W over blocks of elements, the displacement d of the blocks under a displacement r of which S makes the
//! mean pressures s is
//!
//! ```text
//! d + K W d = K s,        M r = S r − w d.
//! ```
//!
//! The blocks are eight elements long along x and one across: waves with crests along x relax at every speed, so that
//! they are the softest by far, and short ones among them matter.

use numerics::transforms::Real as _;
use rustfft::num_complex::Complex;

use crate::contact::active_set::ActiveSet;
use crate::parallel::chunks::Starts;
use crate::parallel::reductions::{add_scaled, sum};
use crate::parallel::row_blocks::{RowBlocks, copies};
use crate::stationary::conjugate_residuals::{GcrLimits, GcrState, gcr, norm};
use crate::stationary::periodic::kernel::{PeriodicKernel, Sliding};
use crate::{BemError, Grid};

/// Length of a block in elements.
const BLOCK: usize = RowBlocks::MAX_COARSE_BLOCK;
const ONE_OF_BLOCK: f32 = 1.0 / BLOCK as f32;
/// Residual of the equation of the blocks at first, relative to its right side: on 1024² elements a contact takes an eighth to a
/// third more products with 1e-2, and as much less with 1e-3, of which each takes longer.
const TOLERANCE: f64 = 3e-3;
/// By what it is multiplied where the directions that it leads to take little off, and its least value: a dense contact on a solid
/// of many branches takes four times as many products where it stays as it is.
const FINER: f64 = 0.3;
const FINEST: f64 = 1e-5;
/// Part of the mean weight by which the equation is solved; with all of it a contact takes a tenth longer, and with a tenth as
/// long.
const PART_OF_MEAN: f64 = 0.4;
/// Directions that are tried, and earlier ones that are kept, at most. Up to 2048² elements 40 and 80 lead to about as many
/// products, and so do one, two and eight that are kept.
const MOST: usize = 80;
const KEPT: usize = 2;

pub(super) struct BlockCorrection {
    columns: usize,
    kernel: PeriodicKernel,
    /// Displacement of an element under its own unit pressure, by which displacements are measured, [m/Pa].
    self_influence: f64,
    /// W.
    weights: Vec<f32>,
    /// That of the inverse by which the equation is solved, and its symbols.
    one_weight: f32,
    relaxation: Vec<Complex<f32>>,
    /// The displacement d under the pressures w.
    lifted: Vec<f32>,
    /// Of the residual, relative to the right side.
    tolerance: f64,
}

impl BlockCorrection {
    /// None where the rows of the grid are no whole number of blocks.
    pub(super) fn new(
        sliding: &Sliding,
        grid: &Grid,
        self_influence: f64,
    ) -> Result<Option<Self>, BemError> {
        let ([rows, columns], [dx, dy]) = (grid.shape(), grid.spacing());
        if !rows.is_multiple_of(BLOCK) {
            return Ok(None);
        }
        let blocks = Grid::new([rows / BLOCK, columns], [dx * BLOCK as f64, dy])?;
        Ok(Some(Self {
            columns,
            kernel: PeriodicKernel::new(sliding, &blocks)?,
            self_influence,
            weights: copies(0.0, blocks.n_elements()),
            one_weight: 0.0,
            relaxation: Vec::new(),
            lifted: copies(0.0, blocks.n_elements()),
            tolerance: TOLERANCE,
        }))
    }

    /// Makes the solutions more accurate, because the directions that they lead to take too little off.
    pub(super) fn tighten_tolerance(&mut self) {
        self.tolerance = (FINER * self.tolerance).max(FINEST);
    }

    /// Takes the pressures w = S 1 of another contact and subtracts from a copy of them those that other patches make unnecessary;
    /// blocks with a mean tension take no part.
    pub(super) fn set_weights(
        &mut self,
        near: &ActiveSet,
        weights: &[f32],
        unit_depth_response: &mut [f32],
    ) {
        let means = self.means(near, weights);
        self.weights = means.iter().map(|mean| mean.max(0.0)).collect();
        let total = f64::from(sum([&self.weights], |[weight]| weight));
        let weight = PART_OF_MEAN * total / self.weights.len() as f64;
        self.one_weight = f32::rounded(weight);
        self.relaxation = self.kernel.relaxation(weight, self.self_influence);
        // That of the contact before is not far from it.
        let mut lifted = std::mem::take(&mut self.lifted);
        self.solve(&means, &mut lifted);
        self.subtract(near, weights, &lifted, unit_depth_response);
        self.lifted = lifted;
    }

    /// Subtracts from a list of pressures S r those that other patches make unnecessary; `weights` lists w.
    pub(super) fn correct(&mut self, near: &ActiveSet, weights: &[f32], pressures: &mut [f32]) {
        let mut displacement = copies(0.0, self.weights.len());
        self.solve(&self.means(near, pressures), &mut displacement);
        self.subtract(near, weights, &displacement, pressures);
    }

    /// Subtracts the pressures w of the displacements of blocks that take part: what is subtracted has to be what the equation
    /// knows, since the softest waves multiply any difference by the ratio of the moduli.
    fn subtract(
        &self,
        near: &ActiveSet,
        weights: &[f32],
        displacement: &[f32],
        pressures: &mut [f32],
    ) {
        let columns = self.columns;
        let list = [near.packed(pressures)];
        near.bands.for_each_part(list, |band, [pressures]| {
            let weights = &weights[near.packed_range(band)];
            for run in near.runs(band) {
                let first = run.elements().start;
                let block = first / columns / BLOCK * columns + first % columns;
                let blocks = displacement[block..].iter().zip(&self.weights[block..]);
                let range = run.packed_range();
                let parts = pressures[range.clone()].iter_mut().zip(&weights[range]);
                for ((pressure, weight), (displacement, of_block)) in parts.zip(blocks) {
                    let takes_part = *of_block > 0.0;
                    *pressure -= if takes_part {
                        weight * displacement
                    } else {
                        0.0
                    };
                }
            }
        });
    }

    /// Means of a list over the blocks.
    fn means(&self, near: &ActiveSet, list: &[f32]) -> Vec<f32> {
        let columns = self.columns;
        let mut means = copies(0.0, self.weights.len());
        let starts = Starts::Every(near.bands.rows(0).len() / BLOCK * columns);
        let parts = [(&mut means[..], starts)];
        near.bands.for_each_part(parts, |band, [means]| {
            let first_row = near.bands.rows(band).start;
            let list = &list[near.packed_range(band)];
            for run in near.runs(band) {
                let first = run.elements().start;
                let block = (first / columns - first_row) / BLOCK * columns + first % columns;
                add_scaled(&mut means[block..], ONE_OF_BLOCK, &list[run.packed_range()]);
            }
        });
        means
    }

    /// Solves for the displacement d from a guess of it, by the inverse for one weight: with it the residual of the equation is a
    /// displacement.
    fn solve(&mut self, means: &[f32], displacement: &mut [f32]) {
        let Self {
            kernel,
            weights,
            one_weight,
            relaxation,
            tolerance,
            ..
        } = self;
        let of = RowBlocks::new([means.len(), 1]);
        let [mut residual, mut load] = [(); 2].map(|()| copies(0.0, means.len()));
        kernel.apply_single_precision(relaxation, means, &mut residual);
        let target = *tolerance * norm(&residual);
        // What a displacement adds to the residual.
        let mut find_image = |from: &[f32], image: &mut [f32]| {
            of.for_each([&mut load], |band, [load]| {
                let elements = of.elements(band);
                let pairs = from[elements.clone()].iter().zip(&weights[elements]);
                for (load, (value, weight)) in load.iter_mut().zip(pairs) {
                    *load = (*one_weight - weight) * value;
                }
            });
            kernel.apply_single_precision(relaxation, &load, image);
            of.for_each([image], |band, [image]| {
                add_scaled(image, -1.0, &from[of.elements(band)]);
            });
        };
        if norm(displacement) > 0.0 {
            let mut image = copies(0.0, means.len());
            find_image(displacement, &mut image);
            add_scaled(&mut residual, 1.0, &image);
        }
        let limits = GcrLimits {
            max_steps: MOST,
            truncation_depth: KEPT,
        };
        let find_direction = |state: GcrState<f32>, direction: &mut [f32], image: &mut [f32]| {
            let goes_on = state.residual_square.sqrt() > target;
            if goes_on {
                direction.copy_from_slice(state.source);
                find_image(state.source, image);
            }
            goes_on
        };
        gcr(displacement, &mut residual, None, limits, find_direction);
    }
}
