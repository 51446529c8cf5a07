//! What pressure does to the surface at rest: the influence of an element on a half space, on a layer and on other substrates.

pub(crate) mod base;
mod correction;
pub(crate) mod influence;
pub(crate) mod layer;
pub(crate) mod rectangle;
