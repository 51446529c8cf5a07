//! Motions that are followed in time.

pub mod indent;
pub mod slide;

pub use indent::indent;
pub use slide::slide;
