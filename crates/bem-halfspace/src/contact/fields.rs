//! Buffers of the iteration on a contact.

use crate::Convolution;
use crate::contact::active_set::ActiveSet;
use crate::contact::listed::Listed;
use crate::contact::preconditioner::{Preconditioner, Weights};

/// Buffers beside the load and its displacement.
#[derive(Debug, Clone)]
pub(super) struct Fields {
    pub(super) preconditioner: Preconditioner,
    pub(super) contact: ActiveSet,
    pub(super) listed: Listed,
    /// Of the list that was last spread over the field, residual or direction; zero outside the contact.
    pub(super) spread: Vec<f64>,
    /// Displacement under the direction.
    pub(super) image: Vec<f64>,
}

impl Fields {
    pub(super) fn new(convolution: &Convolution, weights: Weights) -> Self {
        let grid = convolution.grid();
        let n = grid.n_elements();
        Self {
            preconditioner: Preconditioner::new(convolution, weights),
            contact: ActiveSet::new(grid.shape()),
            listed: Listed::new(n),
            spread: vec![0.0; n],
            image: vec![0.0; n],
        }
    }
}
