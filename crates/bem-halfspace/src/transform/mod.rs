//! Fast Fourier transforms of fields on the plane, convolution with influence coefficients, and spectra of pressures.
//!
//! Theory: docs/theory/transient-half-space.md, "Elements and steps"; mirrors: docs/theory/contact.md, "Mirrors".

pub(crate) mod convolution;
pub(crate) mod fast_length;
pub(crate) mod plane_transform;
pub(crate) mod pressure_spectrum;
