//! Products in Fourier space: of fields on the plane, of pressures with the influence of the elements.

pub(crate) mod convolution;
pub(crate) mod fast_length;
pub(crate) mod plane_transform;
pub(crate) mod pressure_spectrum;
