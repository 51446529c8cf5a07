//! Displacements at the rear edges of a region by the loads on it.

use std::sync::Arc;

use crate::plane_transform::Workspace;
use crate::steady::plans::{KernelSpectrum, Plans};
use crate::steady::region::Region;

/// The product of the stationary kernel with loads, by Fourier transforms on the bounding box of the region.
#[derive(Debug)]
pub(super) struct Product {
    kernel: Arc<KernelSpectrum>,
    workspace: Workspace,
    field: Vec<f64>,
}

impl Product {
    pub(super) fn new(plans: &mut Plans, region: &Region) -> Self {
        let kernel = plans.kernel(region.shape);
        Self {
            workspace: Workspace::new(&kernel.transform, region.shape),
            field: vec![0.0; region.n_places()],
            kernel,
        }
    }

    /// Displacements of the elements of `region` by loads on them.
    pub(super) fn displacements(&mut self, loads: &[f64], region: &Region) -> Vec<f64> {
        region.spread(loads, &mut self.field);
        let KernelSpectrum {
            transform,
            spectrum,
        } = &*self.kernel;
        transform.filter(&mut self.workspace, &mut self.field, spectrum);
        region.gather(&self.field)
    }
}
