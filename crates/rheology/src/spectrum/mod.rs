//! The two descriptions of a material: how stress relaxes and how strain creeps.

pub(crate) mod conversion;
pub(crate) mod creep;
mod merge;
pub(crate) mod relaxation;
mod secular;
