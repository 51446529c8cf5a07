//! What the load on other blocks of a contact does to a block.
//!
//! An inverse S of the influence that is restricted to the contact answers the gap of a patch as if no other patch would
//! answer too. Where the contact is porous, gaps that are the same over many patches get too much load, the more of it
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
//! with a dash for the block of twice the edges. The load w v is taken from what S gives. What remains is positive: the
//! work of S on a load is at least Σ w x², as the influences in S between different elements are negative, and the
//! work that is taken away is at most Σ (Σ w x)² / W, which is not more (Cauchy–Schwarz).

use std::f64::consts::PI;

use crate::contact::blocks::sum_blocks;
use crate::contact::contact_set::ContactSet;
use crate::{Grid, influence};

/// Part of the displacement under the own load of a block that counts as k. A half is what the block of twice the edges
/// leaves; its neighbours take a part of that.
const SHARE: f64 = 0.3;

/// In smaller blocks, edges in elements, the inverse is right without their neighbours.
const SMALLEST: usize = 8;

#[derive(Debug, Clone)]
pub(super) struct FarLoads {
    columns: usize,
    /// w, for the elements in contact.
    weights: Vec<f64>,
    /// Blocks of two by two elements, of four by four, and so on to one.
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
    /// The mean gap, then the displacement v.
    values: Vec<f64>,
}

impl FarLoads {
    pub(super) fn new(grid: &Grid) -> Self {
        let mut levels = Vec::new();
        let (mut blocks, mut edge) = (grid.blocks(), 2);
        loop {
            levels.push(Level::new(&blocks, edge, grid));
            if blocks.n_elements() == 1 {
                break;
            }
            (blocks, edge) = (blocks.blocks(), 2 * edge);
        }
        Self {
            columns: grid.shape()[1],
            weights: vec![0.0; grid.n_elements()],
            levels,
        }
    }

    /// Takes another contact, with the `answer` of the inverse to the gap one.
    pub(super) fn weigh(&mut self, contact: &ContactSet, answer: &[f64]) {
        let bands = contact.bands();
        bands.for_each([&mut self.weights], |band, [weights]| {
            let first = bands.elements(band).start;
            for run in contact.runs(band) {
                for (weight, value) in weights[run.start - first..]
                    .iter_mut()
                    .zip(&answer[run.clone()])
                {
                    *weight = value.max(0.0);
                }
            }
        });
        let weights = &self.weights;
        let [first, others @ ..] = &mut self.levels[..] else {
            return;
        };
        sum_blocks(
            contact,
            self.columns,
            |element| weights[element],
            &mut first.sums,
        );
        first.find_own();
        let mut smaller = first;
        for larger in others {
            let loads = smaller.sums.iter().zip(&smaller.own);
            let loads = loads.map(|(sum, own)| sum * (1.0 - own));
            add_blocks(smaller.shape, loads, &mut larger.sums);
            larger.find_own();
            smaller = larger;
        }
    }

    /// Takes away from the answer of the inverse to a residual what belongs to the load of other blocks.
    pub(super) fn take_from(&mut self, contact: &ContactSet, residual: &[f64], answer: &mut [f64]) {
        self.find_gaps(contact, residual);
        self.find_displacements();
        let Some(first) = self.levels.first() else {
            return;
        };
        let (bands, columns, weights) = (contact.bands(), self.columns, &self.weights);
        bands.for_each([answer], |band, [answer]| {
            let start = bands.elements(band).start;
            for run in contact.runs(band) {
                let (row, column) = (run.start / columns, run.start % columns);
                let displacements = &first.values[row / 2 * first.shape[1]..];
                for (column, element) in (column..).zip(run.clone()) {
                    answer[element - start] -= weights[element] * displacements[column / 2];
                }
            }
        });
    }

    /// From small blocks to large ones.
    fn find_gaps(&mut self, contact: &ContactSet, residual: &[f64]) {
        let (columns, weights) = (self.columns, &self.weights);
        let [first, others @ ..] = &mut self.levels[..] else {
            return;
        };
        let load = |element: usize| weights[element] * residual[element];
        sum_blocks(contact, columns, load, &mut first.values);
        first.divide_by_sums();
        let mut smaller = first;
        for larger in others {
            let blocks = smaller.sums.iter().zip(&smaller.own).zip(&smaller.values);
            let loads = blocks.map(|((sum, own), gap)| sum * (1.0 - own) * gap);
            add_blocks(smaller.shape, loads, &mut larger.values);
            larger.divide_by_sums();
            smaller = larger;
        }
    }

    /// From large blocks to small ones.
    fn find_displacements(&mut self) {
        let mut larger: Option<&Level> = None;
        for level in self.levels.iter_mut().rev() {
            let columns = level.shape[1];
            for (block, (value, own)) in level.values.iter_mut().zip(&level.own).enumerate() {
                let around = larger.map_or(0.0, |larger| {
                    larger.values[block / columns / 2 * larger.shape[1] + block % columns / 2]
                });
                *value = own * *value + (1.0 - own) * around;
            }
            larger = Some(level);
        }
    }
}

impl Level {
    fn new(blocks: &Grid, edge: usize, elements: &Grid) -> Self {
        let n = blocks.n_elements();
        let edges = [0, 1].map(|axis| {
            let length = edge.min(elements.shape()[axis]) as f64;
            length * elements.spacing()[axis]
        });
        let of_own = influence([0.0; 2], edges) / (edges[0] * edges[1]);
        let share = if edge < SMALLEST { 0.0 } else { SHARE };
        Self {
            shape: blocks.shape(),
            // The inverse answers waves with |q|, of which 2π/|q| is the influence.
            added: share * of_own * elements.element_area() / (2.0 * PI),
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
        for (value, sum) in self.values.iter_mut().zip(&self.sums) {
            *value = if *sum > 0.0 { *value / sum } else { 0.0 };
        }
    }
}

/// Sums over two by two values of a field of the given shape.
fn add_blocks(shape: [usize; 2], values: impl Iterator<Item = f64>, sums: &mut [f64]) {
    sums.fill(0.0);
    let columns = shape[1].div_ceil(2);
    for (index, value) in values.enumerate() {
        sums[index / shape[1] / 2 * columns + index % shape[1] / 2] += value;
    }
}
