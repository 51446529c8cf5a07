//! Stationary sliding, solved directly.

mod conjugate_residuals;
pub mod periodic;
pub mod steady;

pub use steady::steady;
