//! What a contact solve overwrites.

use crate::{Convolution, ConvolutionWorkspace};

/// Pressure and buffers of a contact; kept by the caller so that one solution is the first guess of the next.
#[derive(Debug, Clone)]
pub struct ContactState {
    pub(super) load: Vec<f64>,
    pub(super) displacement: Vec<f64>,
    pub(super) direction: Vec<f64>,
    pub(super) image: Vec<f64>,
    /// Elements in contact, increasing; those that penetrate without being in contact.
    pub(super) contact: Vec<usize>,
    pub(super) penetrating: Vec<usize>,
    pub(super) workspace: ConvolutionWorkspace,
}

impl ContactState {
    /// A state without pressure for the grid of `convolution`.
    #[must_use]
    pub fn new(convolution: &Convolution) -> Self {
        let n = convolution.grid().n_elements();
        Self {
            load: vec![0.0; n],
            displacement: vec![0.0; n],
            direction: vec![0.0; n],
            image: vec![0.0; n],
            contact: Vec::with_capacity(n),
            penetrating: Vec::with_capacity(n),
            workspace: convolution.workspace(),
        }
    }

    /// Pressure P ≥ 0, \[Pa], row-major.
    #[must_use]
    pub fn pressure(&self) -> &[f64] {
        &self.load
    }

    /// The pressure to start from, \[Pa], row-major. Negative values count as zero.
    pub fn pressure_mut(&mut self) -> &mut [f64] {
        &mut self.load
    }

    /// Indices of the elements in contact after a solve, increasing.
    #[must_use]
    pub fn contact(&self) -> &[usize] {
        &self.contact
    }

    /// Displacement of the surface under the pressure of the last solve, without what it was before, \[m], row-major.
    #[must_use]
    pub fn displacement(&self) -> &[f64] {
        &self.displacement
    }

    pub(super) fn scale_load(&mut self, factor: f64) {
        for load in &mut self.load {
            *load *= factor;
        }
    }
}
