//! Relaxation and creep spectra, the two descriptions of a material, and their conversion.

mod conversion;
pub(crate) mod creep;
mod decays;
pub(crate) mod relaxation;
mod secular;
pub(crate) mod stationary;
