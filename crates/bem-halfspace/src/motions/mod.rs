//! Motions that are simulated in time, with their error bars: pressing, sliding from first touch, any motion along the surface.
//!
//! Theory: docs/theory/transient-half-space.md.

pub mod indent;
pub(crate) mod move_along;
pub mod slide;

pub use indent::indent;
pub use move_along::{move_along, move_along_memory};
pub use slide::slide;
