//! Motions that are simulated in time, with their error bars: pressing, sliding from first touch, any motion along the surface.
//!
//! Theory: docs/theory/transient-half-space.md.

mod along_surface;
mod any_motion;
pub mod indent;
#[cfg(feature = "rough")]
pub(crate) mod periodic;
pub mod slide;

pub use along_surface::{move_along, move_along_memory};
pub use indent::indent;
pub use slide::slide;
