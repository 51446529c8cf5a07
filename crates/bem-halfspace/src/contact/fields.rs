//! Buffers of the iteration on the active set: fields of the grid and packed vectors.

use std::ops::Range;

use crate::Convolution;
use crate::contact::active_set::ActiveSet;
use crate::contact::preconditioner::{Preconditioner, PreconditionerParameters};
use crate::parallel::reductions::sum;
use crate::parallel::row_blocks::resize;

/// Buffers of the iteration, besides load and displacement.
#[derive(Debug, Clone)]
pub(super) struct Fields {
    /// Approximate inverse of K on the active set.
    pub(super) preconditioner: Preconditioner,
    /// Elements in contact.
    pub(super) active: ActiveSet,
    /// Gap, displacement, load, residual and direction on the active set.
    pub(super) vectors: ActiveVectors,
    /// The vector that was last scattered over the grid, residual or direction; zero outside the active set.
    pub(super) scattered: Vec<f64>,
    /// K times the direction on the grid, \[m].
    pub(super) direction_displacement: Vec<f64>,
}

impl Fields {
    /// Buffers for the grid of a convolution, with an empty active set.
    pub(super) fn new(convolution: &Convolution, parameters: PreconditionerParameters) -> Self {
        let grid = convolution.grid();
        let n = grid.n_elements();
        Self {
            preconditioner: Preconditioner::new(convolution, parameters),
            active: ActiveSet::new(grid.shape()),
            vectors: ActiveVectors::new(n),
            scattered: vec![0.0; n],
            direction_displacement: vec![0.0; n],
        }
    }
}

/// Vectors over the active set, packed in the order of the field, \[m].
#[derive(Debug, Clone, Default)]
pub(super) struct ActiveVectors {
    /// Initial gap s.
    pub(super) separation: Vec<f64>,
    /// Displacement K x.
    pub(super) displacement: Vec<f64>,
    /// Scaled pressure x.
    pub(super) load: Vec<f64>,
    /// Residual r of the linear equations, minus the gap.
    pub(super) residual: Vec<f64>,
    /// Search direction p of the conjugate gradients.
    pub(super) direction: Vec<f64>,
    /// Output of the last operator of an iteration: the preconditioned residual, then K times the direction.
    pub(super) operator_output: Vec<f64>,
}

impl ActiveVectors {
    /// Empty vectors with capacity for the whole grid, so that a change of the active set does not allocate.
    pub(super) fn new(n_elements: usize) -> Self {
        let mut vectors = Self::default();
        for vector in vectors.all() {
            vector.reserve(n_elements);
        }
        vectors
    }

    /// All vectors, for work that concerns each of them.
    const fn all(&mut self) -> [&mut Vec<f64>; 6] {
        [
            &mut self.separation,
            &mut self.displacement,
            &mut self.load,
            &mut self.residual,
            &mut self.direction,
            &mut self.operator_output,
        ]
    }

    /// Resizes all vectors to another active set, and gathers separation and load on it.
    pub(super) fn restrict_to(&mut self, active: &ActiveSet, separation: &[f64], load: &[f64]) {
        for vector in self.all() {
            resize(vector, 0.0, active.len());
        }
        active.gather(separation, &mut self.separation);
        active.gather(load, &mut self.load);
    }

    /// Mean height of the deformed surface above a level, \[m], over an active set that is not empty.
    pub(super) fn mean_height_above(&self, active: &ActiveSet, level: f64) -> f64 {
        let sum_in = |range: Range<usize>| {
            let vectors = [&self.separation, &self.displacement].map(|one| &one[range.clone()]);
            sum(vectors, |[height, displacement]| {
                height + displacement - level
            })
        };
        active.sum(sum_in) / active.len() as f64
    }
}
