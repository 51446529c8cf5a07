//! Motions that are followed in time.

pub mod indent;
pub(crate) mod move_along;
pub mod slide;

pub use indent::indent;
pub use move_along::{move_along, move_along_memory};
pub use slide::slide;
