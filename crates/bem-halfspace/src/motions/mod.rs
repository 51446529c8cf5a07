//! Motions that are followed in time.

pub mod indent;
pub(crate) mod moving;
pub mod slide;

pub use indent::indent;
pub use moving::{move_along, move_along_memory};
pub use slide::slide;
