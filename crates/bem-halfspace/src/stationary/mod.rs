//! Stationary sliding, solved directly.

mod conjugate_residuals;
pub mod periodic;
mod pivots;
mod search;
pub mod steady;

pub use steady::steady;
