//! Buffers of the conjugate gradients on the active set: fields of the grid and packed vectors.
//!
//! The unknown is the load x = α P/(4π) of each element, a scaled pressure without unit; K x is the displacement, \[m].

use std::ops::Range;

use crate::Convolution;
use crate::contact::active_set::ActiveSet;
use crate::contact::preconditioner::{Preconditioner, PreconditionerParameters};
use crate::parallel::reductions::sum;
use crate::parallel::row_blocks::resize;

/// Buffers of the conjugate gradients, besides the fields of load and displacement; fields are row-major.
#[derive(Debug, Clone)]
pub(super) struct Fields {
    /// Preconditioner S, an approximate inverse of K on the active set.
    pub(super) preconditioner: Preconditioner,
    /// Elements in contact.
    pub(super) active: ActiveSet,
    /// Gap, displacement, load, residual and direction on the active set.
    pub(super) vectors: ActiveVectors,
    /// Field of the vector that was last scattered over the grid, residual \[m] or direction; zero outside the active set.
    pub(super) scattered: Vec<f64>,
    /// Displacement K p of the search direction p on the whole grid, \[m].
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

/// Vectors over the active set, packed in the order of the field; lengths in \[m], loads without unit.
#[derive(Debug, Clone, Default)]
pub(super) struct ActiveVectors {
    /// Initial gap s, \[m].
    pub(super) separation: Vec<f64>,
    /// Displacement K x, \[m].
    pub(super) displacement: Vec<f64>,
    /// Load x, a scaled pressure without unit.
    pub(super) load: Vec<f64>,
    /// Residual r = d − (s + K x) of the linear equations, which is minus the gap, \[m].
    pub(super) residual: Vec<f64>,
    /// Search direction p of the conjugate gradients, a load without unit.
    pub(super) direction: Vec<f64>,
    /// Output of the last operator: the preconditioned residual z = S r, later in the same iteration K p \[m].
    pub(super) operator_output: Vec<f64>,
}

impl ActiveVectors {
    /// Empty packed vectors with capacity for all elements of the grid, so that a change of the active set does not allocate.
    pub(super) fn new(n_elements: usize) -> Self {
        let mut vectors = Self::default();
        for vector in vectors.vectors_mut() {
            vector.reserve(n_elements);
        }
        vectors
    }

    /// Mutable references to all six vectors, for resizing them alike.
    const fn vectors_mut(&mut self) -> [&mut Vec<f64>; 6] {
        [
            &mut self.separation,
            &mut self.displacement,
            &mut self.load,
            &mut self.residual,
            &mut self.direction,
            &mut self.operator_output,
        ]
    }

    /// Resizes all vectors to another active set, and gathers the fields of separation \[m] and load on it. The other vectors keep
    /// values without meaning.
    pub(super) fn restrict_to(&mut self, active: &ActiveSet, separation: &[f64], load: &[f64]) {
        for vector in self.vectors_mut() {
            resize(vector, 0.0, active.len());
        }
        active.gather(separation, &mut self.separation);
        active.gather(load, &mut self.load);
    }

    /// Mean of the deformed height s + K x above a `level` \[m] over an active set that is not empty, \[m].
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
