//! Multilevel coarse-space correction of the preconditioner, for contacts of many patches.
//!
//! The inverse S of the influence K, restricted to the active set, gives the load that closes the gaps of a patch as if no other
//! patch were loaded. Where the contact is porous, a gap common to many patches therefore gets too much load, the more the more
//! patches there are. Let w = S 1 be the load per gap of an element, W its sum over a block (the conductance of the block), and
//! g = Σ w r / W the mean gap of a block. If blocks move as a whole, their loads t satisfy
//!
//! ```text
//! t = W (g − v),        v = K t,
//! ```
//!
//! where K is the influence between blocks. A load moves its own block and, together with its neighbours, the parent block of
//! twice the edges, and so on. With k, the excess of its influence on the block over that on the parent,
//!
//! ```text
//! v = (W k g + v') / (1 + W k),        g' = Σ t' / W',        t' = W g / (1 + W k),        W' = Σ W / (1 + W k),
//! ```
//!
//! with a dash for the parent. The load w v is subtracted from S r.
//!
//! The result is positive if the influences in S between different elements are negative: then xᵀ S x is at least Σ w x², and
//! what is subtracted is at most Σ (Σ w x)² / W, which is not more (Cauchy–Schwarz). The inverse of two parts has small positive
//! influences between diagonal neighbours; a test finds the result positive on contacts that have many of them.
//!
//! Theory: docs/theory/contact.md, "Other patches".

use std::f64::consts::PI;

use crate::contact::active_set::{ActiveSet, sum_blocks};
use crate::parallel::row_blocks::{RowBlocks, for_each_row, resize};
use crate::{Convolution, Grid};

/// Edge of the smallest blocks, in elements; within smaller ones the inverse is right without their neighbours.
pub(super) const FINEST_BLOCK_EDGE: usize = RowBlocks::MAX_COARSE_BLOCK;

/// Conductances of the active elements, and the hierarchy of blocks over which they are summed.
#[derive(Debug, Clone)]
pub(super) struct MultilevelCorrection {
    /// Conductances w = S 1, packed over the active set.
    conductances: Vec<f64>,
    /// Blocks from the smallest to a single one, each level with twice the edges of the one before.
    levels: Vec<Level>,
}

/// One level: blocks of one size.
#[derive(Debug, Clone)]
struct Level {
    /// Numbers of blocks along x and y.
    shape: [usize; 2],
    /// Factor k: excess of the self-influence of a block over the influence of its parent, per W.
    excess_influence: f64,
    /// Fraction W k / (1 + W k) of each block: weight of its own mean gap in its displacement.
    local_fraction: Vec<f64>,
    /// W of each block: sum of the conductances w of its elements, or of W / (1 + W k) of its children.
    conductance: Vec<f64>,
    /// Work values of each block during a V-cycle: load Σ w r, then mean gap g, then displacement v.
    values: Vec<f64>,
}

impl MultilevelCorrection {
    /// The levels for the grid of a convolution; `excess_fraction` is k as a fraction of the self-influence of a block.
    pub(super) fn new(convolution: &Convolution, excess_fraction: f64) -> Self {
        let mut levels = Vec::new();
        let grid = convolution.grid();
        let (mut blocks, mut edge) = (*grid, 1);
        while edge < FINEST_BLOCK_EDGE || blocks.n_elements() > 1 {
            (blocks, edge) = (blocks.blocks(), 2 * edge);
            if edge >= FINEST_BLOCK_EDGE {
                levels.push(Level::new(&blocks, edge, convolution, excess_fraction));
            }
        }
        Self {
            conductances: Vec::with_capacity(grid.n_elements()),
            levels,
        }
    }

    /// Resizes to another active set, with w = 0.
    pub(super) fn reset(&mut self, active: &ActiveSet) {
        self.conductances.clear();
        resize(&mut self.conductances, 0.0, active.len());
        self.sum_conductances(active);
    }

    /// Sets w = max(S 1, 0) from the packed vector `unit_gap_loads` = S 1, and the conductances of all blocks.
    pub(super) fn set_conductances(&mut self, active: &ActiveSet, unit_gap_loads: &[f64]) {
        let conductances = [active.packed(&mut self.conductances)];
        active
            .row_blocks
            .for_each_part(conductances, |row_block, [conductances]| {
                for (conductance, value) in conductances
                    .iter_mut()
                    .zip(&unit_gap_loads[active.packed_range(row_block)])
                {
                    *conductance = value.max(0.0);
                }
            });
        self.sum_conductances(active);
    }

    /// Sums the conductances over the blocks of all levels, from small blocks to large ones.
    fn sum_conductances(&mut self, active: &ActiveSet) {
        let (conductances, levels) = (&self.conductances, &mut self.levels);
        let sums = [active.blocks(FINEST_BLOCK_EDGE, &mut levels[0].conductance)];
        active.row_blocks.for_each_part(sums, |row_block, [sums]| {
            let conductances = &conductances[active.packed_range(row_block)];
            sum_blocks::<FINEST_BLOCK_EDGE>(active, row_block, |index| conductances[index], sums);
        });
        levels[0].update_local_fraction();
        for_each_parent(levels, |smaller, level| {
            let load =
                |block: usize| smaller.conductance[block] * (1.0 - smaller.local_fraction[block]);
            sum_children(smaller.shape, load, level.shape[1], &mut level.conductance);
            level.update_local_fraction();
        });
    }

    /// Conductances w, and the buffer for the loads Σ w r of the smallest blocks under a residual r.
    pub(super) fn conductances_and_loads(&mut self) -> (&[f64], &mut [f64]) {
        (&self.conductances, &mut self.levels[0].values)
    }

    /// Conductances w, and the displacements v of the smallest blocks.
    pub(super) fn conductances_and_displacements(&self) -> (&[f64], &[f64]) {
        (&self.conductances, &self.levels[0].values)
    }

    /// Solves for the displacements of the blocks from their loads, in one V-cycle.
    pub(super) fn solve_block_displacements(&mut self) {
        // From small blocks to large ones: restrict the loads, and divide by the conductance to obtain mean gaps.
        self.levels[0].divide_by_conductance();
        for_each_parent(&mut self.levels, |smaller, level| {
            let load = |block: usize| {
                smaller.conductance[block]
                    * (1.0 - smaller.local_fraction[block])
                    * smaller.values[block]
            };
            sum_children(smaller.shape, load, level.shape[1], &mut level.values);
            level.divide_by_conductance();
        });
        // Back from large blocks to small ones: add the displacements of the parents.
        let mut parent = None;
        for level in self.levels.iter_mut().rev() {
            level.add_parent_displacements(parent);
            parent = Some(&*level);
        }
    }
}

/// Calls `work` with each level and its parent level, from small blocks to large ones.
fn for_each_parent(levels: &mut [Level], work: impl Fn(&Level, &mut Level)) {
    for index in 1..levels.len() {
        let (smaller, larger) = levels.split_at_mut(index);
        work(&smaller[index - 1], &mut larger[0]);
    }
}

impl Level {
    /// Level of the grid `blocks`, whose blocks have `edge` elements along each edge; without conductances yet.
    fn new(blocks: &Grid, edge: usize, convolution: &Convolution, excess_fraction: f64) -> Self {
        let (n, elements) = (blocks.n_elements(), convolution.grid());
        let edges = [0, 1].map(|axis| {
            let length = edge.min(elements.shape()[axis]) as f64;
            length * elements.spacing()[axis]
        });
        // A layer may rise in the middle of a large block.
        let total_influence = convolution.base.influence([0.0; 2], edges).max(0.0);
        let self_influence = total_influence / (edges[0] * edges[1]);
        Self {
            shape: blocks.shape(),
            // The inverse multiplies waves by |q|, and the influence by 2π/|q|.
            excess_influence: excess_fraction * self_influence * elements.element_area()
                / (2.0 * PI),
            local_fraction: vec![0.0; n],
            conductance: vec![0.0; n],
            values: vec![0.0; n],
        }
    }

    /// Computes W k / (1 + W k) from the conductances.
    fn update_local_fraction(&mut self) {
        for (fraction, conductance) in self.local_fraction.iter_mut().zip(&self.conductance) {
            let ratio = conductance * self.excess_influence;
            *fraction = ratio / (1.0 + ratio);
        }
    }

    /// Turns the loads Σ w r of the blocks into mean gaps; zero for blocks without active elements.
    fn divide_by_conductance(&mut self) {
        let (columns, conductance) = (self.shape[1], &self.conductance);
        for_each_row(&mut self.values, columns, |row, values| {
            for (value, sum) in values.iter_mut().zip(&conductance[row * columns..]) {
                *value = if *sum > 0.0 { *value / sum } else { 0.0 };
            }
        });
    }

    /// Updates the displacements v = (W k g + v') / (1 + W k), with v' = 0 above the largest block.
    fn add_parent_displacements(&mut self, parent: Option<&Self>) {
        let (columns, local_fraction) = (self.shape[1], &self.local_fraction);
        for_each_row(&mut self.values, columns, |row, values| {
            let fractions = &local_fraction[row * columns..];
            let parents = parent.map(|parent| &parent.values[row / 2 * parent.shape[1]..]);
            for (column, (value, fraction)) in values.iter_mut().zip(fractions).enumerate() {
                let parent_displacement = parents.map_or(0.0, |parents| parents[column / 2]);
                *value = fraction * *value + (1.0 - fraction) * parent_displacement;
            }
        });
    }
}

/// Sums the loads of two by two blocks of a level of the shape [rows, columns] for each parent block; `load` gets the index of
/// a block.
fn sum_children(
    [rows, columns]: [usize; 2],
    load: impl Fn(usize) -> f64 + Sync,
    parent_columns: usize,
    sums: &mut [f64],
) {
    for_each_row(sums, parent_columns, |row, sums| {
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
