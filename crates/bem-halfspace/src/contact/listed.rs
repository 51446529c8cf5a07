//! Lists of values on the elements in contact.

use std::ops::Range;

use crate::bands::resize;
use crate::contact::active_set::ActiveSet;
use crate::contact::reductions::sum;

/// One value per element in contact, in the order of the field.
#[derive(Debug, Clone)]
pub(super) struct Listed {
    pub(super) separation: Vec<f64>,
    pub(super) displacement: Vec<f64>,
    pub(super) load: Vec<f64>,
    /// Minus the gap.
    pub(super) residual: Vec<f64>,
    pub(super) direction: Vec<f64>,
    /// The preconditioned residual, then the displacement under the direction.
    pub(super) image: Vec<f64>,
}

impl Listed {
    /// With room for as many elements as there are, so that a change of the contact does not allocate.
    pub(super) fn new(n_elements: usize) -> Self {
        let list = || Vec::with_capacity(n_elements);
        Self {
            separation: list(),
            displacement: list(),
            load: list(),
            residual: list(),
            direction: list(),
            image: list(),
        }
    }

    /// Takes another contact, with the values of the fields of separation and load there.
    pub(super) fn take(&mut self, contact: &ActiveSet, [separation, load]: [&[f64]; 2]) {
        let lists = [
            &mut self.separation,
            &mut self.displacement,
            &mut self.load,
            &mut self.residual,
            &mut self.direction,
            &mut self.image,
        ];
        for list in lists {
            resize(list, 0.0, contact.len());
        }
        contact.gather(separation, &mut self.separation);
        contact.gather(load, &mut self.load);
    }

    /// Mean height of the deformed surface above a level; there is contact.
    pub(super) fn mean_height_above(&self, contact: &ActiveSet, level: f64) -> f64 {
        let sum_in = |places: Range<usize>| {
            let (separation, displacement) =
                (&self.separation[places.clone()], &self.displacement[places]);
            sum([separation, displacement], |[separation, displacement]| {
                separation + displacement - level
            })
        };
        contact.sum(sum_in) / contact.len() as f64
    }
}
