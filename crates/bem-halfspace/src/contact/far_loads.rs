//! Displacement of a block of the contact under the load on other blocks.
//!
//! The inverse S of the influence, restricted to the contact, finds the load for the gaps of a patch as if no other patch
//! were loaded too. Where the contact is porous, gaps that are the same over many patches get too much load, the more of it
//! the more patches there are. With the load w = S 1 that the inverse puts on an element under the gap one, the sums W
//! of w over blocks and the mean gaps g = Σ w r / W, the loads of blocks under which all of them move are
//!
//! ```text
//! t = W (g − v),        v = K t,
//! ```
//!
//! where K is the influence between blocks. As a load moves its own block and, together with its neighbours, blocks of
//! twice the edges, and so on, with k for what it adds to the block over that of twice the edges,
//!
//! ```text
//! v = (W k g + v') / (1 + W k),        g' = Σ t' / W',        t' = W g / (1 + W k),        W' = Σ W / (1 + W k),
//! ```
//!
//! with a dash for the block of twice the edges. The load w v is taken from what S gives.
//!
//! What remains is positive where the influences in S between different elements are negative: the work of S on x is
//! then at least Σ w x², and what is taken away is at most Σ (Σ w x)² / W, which is not more (Cauchy–Schwarz). The
//! inverse of two parts has small positive ones between diagonal neighbours; a test finds what remains positive on
//! contacts that have many of them.

use std::f64::consts::PI;

use crate::contact::active_set::{ActiveSet, sum_blocks};
use crate::parallel::bands::{Bands, for_each_row, resize};
use crate::{Convolution, Grid};

/// Edge of the smallest blocks in elements; in smaller ones the inverse is right without their neighbours.
pub(super) const SMALLEST: usize = Bands::LARGEST_BLOCK;

#[derive(Debug, Clone)]
pub(super) struct FarLoads {
    /// w, a list.
    weights: Vec<f64>,
    /// The smallest blocks, those of twice the edges, and so on to one block.
    levels: Vec<Level>,
}

/// Blocks of one size.
#[derive(Debug, Clone)]
struct Level {
    shape: [usize; 2],
    /// k for the sums of w.
    added: f64,
    /// W k / (1 + W k).
    own: Vec<f64>,
    /// W.
    sums: Vec<f64>,
    /// Σ w r, then the mean gap, then the displacement v.
    values: Vec<f64>,
}

impl FarLoads {
    /// With k as the part `weight` of the displacement of a block under its own load.
    pub(super) fn new(convolution: &Convolution, weight: f64) -> Self {
        let mut levels = Vec::new();
        let grid = convolution.grid();
        let (mut blocks, mut edge) = (*grid, 1);
        while edge < SMALLEST || blocks.n_elements() > 1 {
            (blocks, edge) = (blocks.blocks(), 2 * edge);
            if edge >= SMALLEST {
                levels.push(Level::new(&blocks, edge, (convolution, weight)));
            }
        }
        Self {
            weights: Vec::with_capacity(grid.n_elements()),
            levels,
        }
    }

    /// Takes another contact, with the weights w = 0.
    pub(super) fn forget(&mut self, active: &ActiveSet) {
        self.weights.clear();
        resize(&mut self.weights, 0.0, active.len());
        self.find_sums(active);
    }

    /// Takes the list of the `loads` that the inverse finds for the gap one.
    pub(super) fn weigh(&mut self, active: &ActiveSet, loads: &[f64]) {
        let weights = [active.packed(&mut self.weights)];
        active.bands.for_each_part(weights, |band, [weights]| {
            for (weight, value) in weights.iter_mut().zip(&loads[active.packed_range(band)]) {
                *weight = value.max(0.0);
            }
        });
        self.find_sums(active);
    }

    fn find_sums(&mut self, active: &ActiveSet) {
        let (weights, levels) = (&self.weights, &mut self.levels);
        let sums = [active.blocks(SMALLEST, &mut levels[0].sums)];
        active.bands.for_each_part(sums, |band, [sums]| {
            let weights = &weights[active.packed_range(band)];
            sum_blocks::<SMALLEST>(active, band, |place| weights[place], sums);
        });
        levels[0].find_own();
        for_each_larger(levels, |smaller, level| {
            let load = |block: usize| smaller.sums[block] * (1.0 - smaller.own[block]);
            add_blocks((smaller.shape, load), (level.shape[1], &mut level.sums));
            level.find_own();
        });
    }

    /// The list w, and the place of the sums of w r over the smallest blocks for a residual r.
    pub(super) fn weights_and_loads(&mut self) -> (&[f64], &mut [f64]) {
        (&self.weights, &mut self.levels[0].values)
    }

    /// The list w, and the displacements v of the smallest blocks.
    pub(super) fn weights_and_displacements(&self) -> (&[f64], &[f64]) {
        (&self.weights, &self.levels[0].values)
    }

    /// Finds the displacements from the loads: mean gaps from small blocks to large ones, displacements back.
    pub(super) fn move_blocks(&mut self) {
        self.levels[0].divide_by_sums();
        for_each_larger(&mut self.levels, |smaller, level| {
            let load = |block: usize| {
                smaller.sums[block] * (1.0 - smaller.own[block]) * smaller.values[block]
            };
            add_blocks((smaller.shape, load), (level.shape[1], &mut level.values));
            level.divide_by_sums();
        });
        let mut larger = None;
        for level in self.levels.iter_mut().rev() {
            level.find_displacements_in(larger);
            larger = Some(&*level);
        }
    }
}

/// Does work on every level but the first, with that of half the edges, from small blocks to large ones.
fn for_each_larger(levels: &mut [Level], work: impl Fn(&Level, &mut Level)) {
    for index in 1..levels.len() {
        let (smaller, larger) = levels.split_at_mut(index);
        work(&smaller[index - 1], &mut larger[0]);
    }
}

impl Level {
    fn new(blocks: &Grid, edge: usize, (convolution, weight): (&Convolution, f64)) -> Self {
        let (n, elements) = (blocks.n_elements(), convolution.grid());
        let edges = [0, 1].map(|axis| {
            let length = edge.min(elements.shape()[axis]) as f64;
            length * elements.spacing()[axis]
        });
        // A layer may rise in the middle of a large block.
        let of_own = convolution.base.influence([0.0; 2], edges).max(0.0);
        let of_own = of_own / (edges[0] * edges[1]);
        Self {
            shape: blocks.shape(),
            // The inverse multiplies waves by |q|, and the influence by 2π/|q|.
            added: weight * of_own * elements.element_area() / (2.0 * PI),
            own: vec![0.0; n],
            sums: vec![0.0; n],
            values: vec![0.0; n],
        }
    }

    fn find_own(&mut self) {
        for (own, sum) in self.own.iter_mut().zip(&self.sums) {
            let ratio = sum * self.added;
            *own = ratio / (1.0 + ratio);
        }
    }

    fn divide_by_sums(&mut self) {
        let (columns, sums) = (self.shape[1], &self.sums);
        for_each_row(&mut self.values, columns, |row, values| {
            for (value, sum) in values.iter_mut().zip(&sums[row * columns..]) {
                *value = if *sum > 0.0 { *value / sum } else { 0.0 };
            }
        });
    }

    /// Under the displacement of the blocks of twice the edges; beyond the largest block there is no load.
    fn find_displacements_in(&mut self, larger: Option<&Self>) {
        let (columns, own) = (self.shape[1], &self.own);
        for_each_row(&mut self.values, columns, |row, values| {
            let own = &own[row * columns..];
            let around = larger.map(|larger| &larger.values[row / 2 * larger.shape[1]..]);
            for (column, (value, own)) in values.iter_mut().zip(own).enumerate() {
                let around = around.map_or(0.0, |around| around[column / 2]);
                *value = own * *value + (1.0 - own) * around;
            }
        });
    }
}

/// Sums of the loads of two by two blocks of a field; `load` gets the number of a block.
fn add_blocks(
    ([rows, columns], load): ([usize; 2], impl Fn(usize) -> f64 + Sync),
    (larger_columns, sums): (usize, &mut [f64]),
) {
    for_each_row(sums, larger_columns, |row, sums| {
        for (column, sum) in sums.iter_mut().enumerate() {
            *sum = 0.0;
            for row in 2 * row..(2 * row + 2).min(rows) {
                for column in 2 * column..(2 * column + 2).min(columns) {
                    *sum += load(row * columns + column);
                }
            }
        }
    });
}
