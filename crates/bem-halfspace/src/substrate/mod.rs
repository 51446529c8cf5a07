//! Influence coefficients: displacement of the surface by a uniformly loaded element, on a half space, on a layer and on
//! other substrates.
//!
//! Theory: docs/theory/transient-half-space.md, "Elements and steps" (half space); docs/layers.md, "How it is computed" and
//! "Other substrates".

pub(crate) mod base;
mod correction;
pub(crate) mod influence;
pub(crate) mod layer;
pub(crate) mod rectangle;
pub(crate) mod wave_shift;
