//! Displacement of a patch of the contact under the load on other patches.
//!
//! The inverse S of the influence, restricted to the contact, finds the pressure for the gaps of a patch as if no other
//! patch were loaded (as in the contact of one instant, `contact/far_loads.rs`). With the pressure w = S 1 for the gap one
//! and its means W over blocks of elements, the displacement d of the blocks under a displacement r of which S makes the
//! mean pressures s is
//!
//! ```text
//! d + K W d = K s,        M r = S r − w d.
//! ```
//!
//! The blocks are eight elements long along x and one across: waves with crests along x relax at every speed, so that
//! they are the softest by far, and short ones among them matter.

use crate::contact::active_set::ActiveSet;
use crate::parallel::bands::{Bands, copies};
use crate::parallel::chunks::Starts;
use crate::parallel::reductions::{add, sum};
use crate::stationary::conjugate_residuals::{minimise, norm};
use crate::stationary::periodic::kernel::{Kernel, Sliding};
use crate::{BemError, Grid};

/// Length of a block in elements.
const BLOCK: usize = Bands::LARGEST_BLOCK;
/// Residual of the equation of the blocks, relative to its right side: with 1e-2 a contact of 1024² elements takes half as
/// many products again, and with 5e-4 a dense one on a solid of many branches three times as many.
const TOLERANCE: f64 = 1e-4;
/// Directions that are tried, and earlier ones that are kept, at most. With 40 a contact of 2048² elements takes twice as many
/// products where the moduli differ by 1000; more to be kept take longer than they save.
const MOST: usize = 80;
const KEPT: usize = 2;

pub(super) struct FarLoads {
    columns: usize,
    kernel: Kernel,
    /// W.
    weights: Vec<f64>,
    mean_weight: f64,
}

impl FarLoads {
    /// None where the rows of the grid are no whole number of blocks.
    pub(super) fn new(sliding: &Sliding, grid: &Grid) -> Result<Option<Self>, BemError> {
        let ([rows, columns], [dx, dy]) = (grid.shape(), grid.spacing());
        if !rows.is_multiple_of(BLOCK) {
            return Ok(None);
        }
        let blocks = Grid::new([rows / BLOCK, columns], [dx * BLOCK as f64, dy])?;
        Ok(Some(Self {
            columns,
            kernel: Kernel::new(sliding, &blocks)?,
            weights: copies(0.0, blocks.n_elements()),
            mean_weight: 0.0,
        }))
    }

    /// Takes the pressures w of another contact; blocks with a mean tension take no part.
    pub(super) fn weigh(&mut self, near: &ActiveSet, pressures: &[f64]) {
        let means = self.means(near, pressures).into_iter();
        self.weights = means.map(|mean| mean.max(0.0)).collect();
        let total = sum([&self.weights], |[weight]| weight);
        self.mean_weight = total / self.weights.len() as f64;
    }

    /// Subtracts from a list of pressures S r those that other patches make unnecessary; `weights` lists w.
    pub(super) fn correct(&mut self, near: &ActiveSet, weights: &[f64], pressures: &mut [f64]) {
        let displacement = self.solve(&self.means(near, pressures));
        let columns = self.columns;
        let list = [near.list(pressures)];
        near.bands.for_each_part(list, |band, [pressures]| {
            let weights = &weights[near.places(band)];
            for run in near.runs(band) {
                let first = run.elements().start;
                let block = first / columns / BLOCK * columns + first % columns;
                let displacement = &displacement[block..];
                let places = run.places();
                let parts = pressures[places.clone()].iter_mut().zip(&weights[places]);
                for ((pressure, weight), displacement) in parts.zip(displacement) {
                    *pressure -= weight * displacement;
                }
            }
        });
    }

    /// Means of a list over the blocks.
    fn means(&self, near: &ActiveSet, list: &[f64]) -> Vec<f64> {
        let columns = self.columns;
        let mut means = copies(0.0, self.weights.len());
        let starts = Starts::Every(near.bands.rows(0).len() / BLOCK * columns);
        let parts = [(&mut means[..], starts)];
        near.bands.for_each_part(parts, |band, [means]| {
            let first_row = near.bands.rows(band).start;
            let list = &list[near.places(band)];
            for run in near.runs(band) {
                let first = run.elements().start;
                let block = (first / columns - first_row) / BLOCK * columns + first % columns;
                add(&mut means[block..], 1.0 / BLOCK as f64, &list[run.places()]);
            }
        });
        means
    }

    /// The displacement d of blocks that take part, by the inverse for the mean weight: with it the residual of the equation
    /// is a displacement.
    fn solve(&mut self, means: &[f64]) -> Vec<f64> {
        let (n, mean) = (means.len(), self.mean_weight);
        let [mut displacement, mut residual] = [copies(0.0, n), copies(0.0, n)];
        self.kernel.relax(mean, means, &mut residual);
        let target = TOLERANCE * norm(&residual);
        let unknowns = [&mut displacement[..], &mut residual[..]];
        minimise::<f32>(unknowns, &copies(1.0, n), [MOST, KEPT], |residual, from| {
            if norm(residual) <= target {
                return None;
            }
            let pairs = from.iter().zip(&self.weights);
            let load: Vec<f64> = pairs.map(|(r, weight)| (mean - weight) * r).collect();
            let mut image = copies(0.0, n);
            self.kernel.relax(mean, &load, &mut image);
            add(&mut image, -1.0, from);
            Some([from.to_vec(), image])
        });
        // What is subtracted has to be what the equation knows: the softest waves multiply any difference by the ratio of
        // the moduli.
        let taking_part = displacement.iter().zip(&self.weights);
        taking_part
            .map(|(d, w)| if *w > 0.0 { *d } else { 0.0 })
            .collect()
    }
}
