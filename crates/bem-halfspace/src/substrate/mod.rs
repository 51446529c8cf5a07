//! What pressure does to the surface at rest: the influence of an element on a half space and on a layer.

pub(crate) mod influence;
pub(crate) mod layer;
pub(crate) mod rectangle;
