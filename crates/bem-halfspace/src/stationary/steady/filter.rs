//! Convolutions with kernels that are even along y, but not along x, by Fourier transforms on the bounding box of a region.
//!
//! A region is a set of elements with its bounding box (`region.rs`); values on it are packed vectors in its order.

use std::sync::Arc;

use crate::stationary::steady::region::Region;
use crate::transform::plane_transform::complex_product::Spectrum;
use crate::transform::plane_transform::{PlaneTransform, Workspace};

/// Spectra of several kernels with one period, and the transforms that belong to the period.
#[derive(Debug)]
pub(super) struct Filters<const N: usize> {
    /// Plans of the transforms over the period.
    pub(super) transform: PlaneTransform,
    /// Spectrum of each kernel.
    pub(super) spectra: [Spectrum; N],
}

/// Convolutions of fields on the bounding box of a region, with their workspace.
pub(super) struct RegionFilter<const N: usize> {
    /// Spectra of the kernels.
    filters: Arc<Filters<N>>,
    /// Buffers of the transforms.
    workspace: Workspace,
    /// Input, then output of a convolution on the bounding box.
    field: Vec<f64>,
}

/// Application of the stationary kernel to loads: displacements of the elements of a region.
pub(super) type KernelOperator = RegionFilter<1>;

impl<const N: usize> RegionFilter<N> {
    /// Convolutions on the bounding box of a region, which must fit into the period of the filters.
    pub(super) fn new(filters: Arc<Filters<N>>, region: &Region) -> Self {
        Self {
            workspace: Workspace::new(&filters.transform, region.shape),
            field: vec![0.0; region.n_box_elements()],
            filters,
        }
    }

    /// Convolves values on the elements of `region`, 0 elsewhere, with the kernel of index `filter`.
    pub(super) fn apply(&mut self, filter: usize, values: &[f64], region: &Region) -> Vec<f64> {
        region.scatter(values, &mut self.field);
        let Filters { transform, spectra } = &*self.filters;
        transform.filter(&mut self.workspace, &mut self.field, &spectra[filter]);
        region.gather(&self.field)
    }
}
