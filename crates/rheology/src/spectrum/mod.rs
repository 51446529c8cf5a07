//! The two descriptions of a material: how stress relaxes and how strain creeps.

mod conversion;
pub(crate) mod creep;
mod decays;
pub(crate) mod relaxation;
mod secular;
