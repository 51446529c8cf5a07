//! Multilevel coarse-space correction of the preconditioner, for contacts of many patches.
//!
//! The inverse S of the influence K, restricted to the active set, gives the load that closes the gaps of a patch as if no other
//! patch were loaded. In a contact of many patches a gap common to all of them therefore gets too much load; the error grows with
//! their number. Let w = S 1 be the load per gap of an element \[1/m], its conductance, and W = Σ w the conductance of a block of
//! elements. The mean gap that the load of a block has to close is g = Σ w r / W, with the residuals r of its elements. If blocks
//! move as a whole, their loads t satisfy
//!
//! ```text
//! t = W (g − v),        v = K t,
//! ```
//!
//! with the displacement v \[m] of a block by all loads and the influence K between blocks. A load moves its own block and, together
//! with its neighbours, the parent block of twice the edges, and so on. Let k \[m] be the excess of the influence of a load on its
//! own block over that on the parent. Then
//!
//! ```text
//! v = (W k g + v') / (1 + W k),        g' = Σ t' / W',        t' = W g / (1 + W k),        W' = Σ W / (1 + W k),
//! ```
//!
//! where primes denote the parent and sums run over its children. The load w v is subtracted from S r.
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

/// Edge of the smallest blocks, in elements: the largest edge that row blocks allow. Over shorter distances the inverse S of the
/// head of this file is accurate itself.
pub(super) const FINEST_BLOCK_EDGE: usize = RowBlocks::MAX_COARSE_BLOCK;

/// Conductances of the active elements, and the hierarchy of blocks over which they are summed.
#[derive(Debug, Clone)]
pub(super) struct MultilevelCorrection {
    /// Conductances w = max(S 1, 0) of the active elements, packed, \[1/m].
    conductances: Vec<f64>,
    /// Blocks from the smallest to a single one, each level with twice the edges of the one before.
    levels: Vec<Level>,
}

/// One level: blocks of one size.
#[derive(Debug, Clone)]
struct Level {
    /// Numbers of blocks along x and y.
    shape: [usize; 2],
    /// Factor k: excess of the self-influence of a block over the influence of its load on the parent block, \[m].
    excess_influence: f64,
    /// Fraction W k / (1 + W k) of each block: weight of its own mean gap in its displacement.
    local_fraction: Vec<f64>,
    /// Conductance W of each block \[1/m]: Σ w over its elements on the finest level, else Σ W / (1 + W k) over its children.
    conductance: Vec<f64>,
    /// Work values of each block during a V-cycle: load Σ w r, then mean gap g \[m], then displacement v \[m].
    values: Vec<f64>,
}

impl MultilevelCorrection {
    /// The levels for the grid of a convolution, without conductances; `excess_fraction` is k as a fraction of the self-influence of
    /// a block.
    pub(super) fn new(convolution: &Convolution, excess_fraction: f64) -> Self {
        let mut levels = Vec::new();
        let grid = convolution.grid();
        // Double the edges until one block covers the grid.
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

    /// Resizes to another active set and sets all conductances to 0, so that the correction vanishes.
    pub(super) fn reset(&mut self, active: &ActiveSet) {
        self.conductances.clear();
        resize(&mut self.conductances, 0.0, active.len());
        self.sum_conductances(active);
    }

    /// Sets the conductances w = max(S 1, 0) of the elements from the packed vector `unit_gap_loads` = S 1, and those of all blocks.
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
        // The conductance of a block of the smallest size is the sum over its active elements.
        let (conductances, levels) = (&self.conductances, &mut self.levels);
        let sums = [active.blocks(FINEST_BLOCK_EDGE, &mut levels[0].conductance)];
        active.row_blocks.for_each_part(sums, |row_block, [sums]| {
            let conductances = &conductances[active.packed_range(row_block)];
            sum_blocks::<FINEST_BLOCK_EDGE>(active, row_block, |index| conductances[index], sums);
        });
        // The conductance of a larger block is the sum of W / (1 + W k) over its children (head of this file).
        levels[0].update_local_fraction();
        for_each_parent(levels, |smaller, level| {
            let load =
                |block: usize| smaller.conductance[block] * (1.0 - smaller.local_fraction[block]);
            sum_children(smaller.shape, load, level.shape[1], &mut level.conductance);
            level.update_local_fraction();
        });
    }

    /// Conductances w of the elements, packed, and the buffer for the loads Σ w r of the smallest blocks under a residual r.
    pub(super) fn conductances_and_loads(&mut self) -> (&[f64], &mut [f64]) {
        (&self.conductances, &mut self.levels[0].values)
    }

    /// Conductances w of the elements, packed, and the displacements v of the smallest blocks after
    /// [`solve_block_displacements`](Self::solve_block_displacements), \[m].
    pub(super) fn conductances_and_displacements(&self) -> (&[f64], &[f64]) {
        (&self.conductances, &self.levels[0].values)
    }

    /// Solves (1/W + K) t = g for the blocks approximately, in one V-cycle, from the loads Σ w r of the smallest blocks; leaves their
    /// displacements v = K t.
    pub(super) fn solve_block_displacements(&mut self) {
        // Go from small blocks to large ones: restrict the loads, and divide by the conductance to obtain mean gaps.
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
        // Go back from large blocks to small ones, and add the displacements of the parents.
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
        // Find the displacement of a block under its own unit load. Negative values are cut off: an incompressible layer may rise
        // in the middle of a large block.
        let total_influence = convolution.base.influence([0.0; 2], edges).max(0.0);
        let self_influence = total_influence / (edges[0] * edges[1]);
        Self {
            shape: blocks.shape(),
            // S multiplies waves by |q|, which is 2π times the inverse of the influence 2π/|q|; k is smaller by the same factor.
            excess_influence: excess_fraction * self_influence * elements.element_area()
                / (2.0 * PI),
            local_fraction: vec![0.0; n],
            conductance: vec![0.0; n],
            values: vec![0.0; n],
        }
    }

    /// Computes W k / (1 + W k) of each block from its conductance W.
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

/// Restriction to the parent level: `sums` gets, for each parent block, the sum of `load` over its two by two children.
///
/// `load` takes the row-major index of a child on a level of the shape `shape`.
fn sum_children(
    shape: [usize; 2],
    load: impl Fn(usize) -> f64 + Sync,
    parent_columns: usize,
    sums: &mut [f64],
) {
    for_each_row(sums, parent_columns, |row, sums| {
        for (column, sum) in sums.iter_mut().enumerate() {
            *sum = 0.0;
            for row in 2 * row..(2 * row + 2).min(shape[0]) {
                for column in 2 * column..(2 * column + 2).min(shape[1]) {
                    *sum += load(row * shape[1] + column);
                }
            }
        }
    });
}
