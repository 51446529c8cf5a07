//! Buffers of the iteration on a contact.

use std::ops::Range;

use crate::Convolution;
use crate::contact::active_set::ActiveSet;
use crate::contact::preconditioner::{Preconditioner, Weights};
use crate::parallel::bands::resize;
use crate::parallel::reductions::sum;

/// Buffers beside the load and its displacement.
#[derive(Debug, Clone)]
pub(super) struct Fields {
    pub(super) preconditioner: Preconditioner,
    pub(super) active: ActiveSet,
    pub(super) vectors: ActiveVectors,
    /// Of the list that was last spread over the field, residual or direction; zero outside the contact.
    pub(super) scattered: Vec<f64>,
    /// Displacement under the direction.
    pub(super) image: Vec<f64>,
}

impl Fields {
    pub(super) fn new(convolution: &Convolution, weights: Weights) -> Self {
        let grid = convolution.grid();
        let n = grid.n_elements();
        Self {
            preconditioner: Preconditioner::new(convolution, weights),
            active: ActiveSet::new(grid.shape()),
            vectors: ActiveVectors::new(n),
            scattered: vec![0.0; n],
            image: vec![0.0; n],
        }
    }
}

/// One value per element in contact, in the order of the field.
#[derive(Debug, Clone, Default)]
pub(super) struct ActiveVectors {
    pub(super) separation: Vec<f64>,
    pub(super) displacement: Vec<f64>,
    pub(super) load: Vec<f64>,
    /// Minus the gap.
    pub(super) residual: Vec<f64>,
    pub(super) direction: Vec<f64>,
    /// The preconditioned residual, then the displacement under the direction.
    pub(super) image: Vec<f64>,
}

impl ActiveVectors {
    /// With room for as many elements as there are, so that a change of the contact does not allocate.
    pub(super) fn new(n_elements: usize) -> Self {
        let mut vectors = Self::default();
        for list in vectors.all() {
            list.reserve(n_elements);
        }
        vectors
    }

    const fn all(&mut self) -> [&mut Vec<f64>; 6] {
        [
            &mut self.separation,
            &mut self.displacement,
            &mut self.load,
            &mut self.residual,
            &mut self.direction,
            &mut self.image,
        ]
    }

    /// Takes another contact, with the values of the fields of separation and load there.
    pub(super) fn take(&mut self, active: &ActiveSet, [separation, load]: [&[f64]; 2]) {
        for list in self.all() {
            resize(list, 0.0, active.len());
        }
        active.gather(separation, &mut self.separation);
        active.gather(load, &mut self.load);
    }

    /// Mean height of the deformed surface above a level; there is contact.
    pub(super) fn mean_height_above(&self, active: &ActiveSet, level: f64) -> f64 {
        let sum_in = |range: Range<usize>| {
            let lists = [&self.separation, &self.displacement].map(|list| &list[range.clone()]);
            sum(lists, |[height, displacement]| {
                height + displacement - level
            })
        };
        active.sum(sum_in) / active.len() as f64
    }
}
