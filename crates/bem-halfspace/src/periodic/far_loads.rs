//! Displacement of a patch of the contact under the load on other patches.
//!
//! The inverse S of the influence, restricted to the contact, finds the pressure for the gaps of a patch as if no other
//! patch were loaded (as in the contact of one instant, `contact/far_loads.rs`). With the pressure w = S 1 for the gap one
//! and its means W over blocks of elements, the mean pressures t of the blocks under a displacement of which S makes the
//! means s are
//!
//! ```text
//! t + W K t = s,        M r = S r − w K t.
//! ```
//!
//! The blocks are eight elements long along x and one across: waves with crests along x relax at every speed, so that
//! they are the softest by far, and short ones among them matter.

use rustfft::num_complex::Complex;

use crate::bands::{Bands, copies};
use crate::chunks::Starts;
use crate::contact::active_set::ActiveSet;
use crate::periodic::kernel::{Kernel, Sliding};
use crate::periodic::waves::Waves;
use crate::reductions::{add, sum};
use crate::{BemError, Grid};

/// Length of a block in elements.
pub(super) const BLOCK: usize = Bands::LARGEST_BLOCK;
/// Residual of the equation of the blocks, relative to its right side: with 3e-2 the contact takes up to twice as many
/// products.
const TOLERANCE: f64 = 1e-2;
/// Directions that are kept, and tried at most.
const KEPT: usize = 16;
const MOST: usize = 40;

#[derive(Debug)]
pub(super) struct FarLoads {
    bands: Bands,
    columns: usize,
    waves: Waves,
    kernel: Vec<Complex<f64>>,
    /// W.
    weights: Vec<f64>,
    mean_weight: f64,
    residual: Vec<f64>,
    /// K t.
    displacement: Vec<f64>,
    /// K z and (1 + W K) z of the directions z, of which the latter are orthonormal.
    kept: Vec<[Vec<f64>; 2]>,
}

impl FarLoads {
    /// None where the rows of the grid are no whole number of blocks.
    pub(super) fn new(sliding: &Sliding, grid: &Grid) -> Result<Option<Self>, BemError> {
        let ([rows, columns], [dx, dy]) = (grid.shape(), grid.spacing());
        if !rows.is_multiple_of(BLOCK) {
            return Ok(None);
        }
        let blocks = Grid::new([rows / BLOCK, columns], [dx * BLOCK as f64, dy])?;
        let field = || copies(0.0, blocks.n_elements());
        Ok(Some(Self {
            bands: Bands::new(blocks.shape()),
            columns,
            waves: Waves::new(&blocks),
            kernel: Kernel::new(sliding, &blocks)?.at_centre,
            weights: field(),
            mean_weight: 0.0,
            residual: field(),
            displacement: field(),
            kept: (0..KEPT).map(|_| [field(), field()]).collect(),
        }))
    }

    /// Takes the pressures w of another contact.
    pub(super) fn weigh(&mut self, near: &ActiveSet, pressures: &[f64]) {
        self.take_means(near, pressures);
        for (weight, mean) in self.weights.iter_mut().zip(&self.residual) {
            *weight = mean.max(0.0);
        }
        let total = self.total([&self.weights; 2], |[weight, _]| weight);
        self.mean_weight = total / self.weights.len() as f64;
    }

    /// Subtracts from a list of pressures S r those that other patches make unnecessary; `weights` lists w.
    pub(super) fn correct(&mut self, near: &ActiveSet, weights: &[f64], pressures: &mut [f64]) {
        self.take_means(near, pressures);
        self.solve();
        let (displacement, columns) = (&self.displacement, self.columns);
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
    fn take_means(&mut self, near: &ActiveSet, list: &[f64]) {
        let columns = self.columns;
        let starts = Starts::Every(near.bands.rows(0).len() / BLOCK * columns);
        let fields = [(&mut self.residual[..], starts)];
        near.bands.for_each_part(fields, |band, [means]| {
            means.fill(0.0);
            let first_row = near.bands.rows(band).start;
            let list = &list[near.places(band)];
            for run in near.runs(band) {
                let first = run.elements().start;
                let block = (first / columns - first_row) / BLOCK * columns + first % columns;
                add(&mut means[block..], 1.0 / BLOCK as f64, &list[run.places()]);
            }
        });
    }

    /// Solves the equation of the blocks by minimal residuals, with the inverse for the mean weight as preconditioner.
    fn solve(&mut self) {
        self.displacement.fill(0.0);
        let target = TOLERANCE * self.norm();
        for direction in 0..MOST {
            if self.norm() <= target {
                break;
            }
            self.add_direction(direction);
            let [moved, image] = &self.kept[direction % KEPT];
            let step = self.total([image, &self.residual], |[image, r]| image * r);
            for (values, factor, other) in [
                (&mut self.displacement, step, moved),
                (&mut self.residual, -step, image),
            ] {
                let other = &other[..];
                self.bands.for_each([values], |band, [values]| {
                    add(values, factor, &other[self.bands.elements(band)]);
                });
            }
        }
    }

    fn add_direction(&mut self, number: usize) {
        let mut pair = std::mem::take(&mut self.kept[number % KEPT]);
        let [moved, image] = &mut pair;
        let (kernel, mean) = (&self.kernel, self.mean_weight);
        // K z with (1 + W K) z = r for the mean W, and z from it.
        self.waves.apply(&self.residual, moved, |row, q| {
            kernel[row] / (kernel[row] * mean + q)
        });
        let (residual, weights, bands) = (&self.residual, &self.weights, self.bands);
        bands.for_each([moved, image], |band, [moved, image]| {
            let [residual, weights] = [residual, weights].map(|f| &f[bands.elements(band)]);
            for (((image, moved), r), weight) in
                image.iter_mut().zip(moved).zip(residual).zip(weights)
            {
                *image = r + (weight - mean) * *moved;
            }
        });
        for earlier in number.saturating_sub(KEPT - 1)..number {
            let earlier = &self.kept[earlier % KEPT];
            let component = self.total([&earlier[1], image], |[one, other]| one * other);
            bands.for_each([moved, image], |band, parts| {
                for (values, earlier) in parts.into_iter().zip(earlier) {
                    add(values, -component, &earlier[bands.elements(band)]);
                }
            });
        }
        let length = self
            .total([image, image], |[one, other]| one * other)
            .sqrt();
        bands.for_each([moved, image], |_, parts| {
            for value in parts.into_iter().flatten() {
                *value /= length;
            }
        });
        self.kept[number % KEPT] = pair;
    }

    fn norm(&self) -> f64 {
        self.total([&self.residual; 2], |[one, other]| one * other)
            .sqrt()
    }

    fn total(&self, fields: [&[f64]; 2], term: impl Fn([f64; 2]) -> f64 + Sync) -> f64 {
        self.bands
            .sum(|band| sum(fields.map(|field| &field[self.bands.elements(band)]), &term))
    }
}
