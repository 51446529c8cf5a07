//! Named materials.

pub(crate) mod elementary;
pub(crate) mod generalised;
pub(crate) mod standard_solid;
