//! The materials by name.

pub(crate) mod compressible;
pub(crate) mod elastic;
pub(crate) mod kelvin_chain;
pub(crate) mod kelvin_voigt;
pub(crate) mod maxwell;
pub(crate) mod prony;
pub(crate) mod standard_solid;
pub(crate) mod viscous;
