//! Stationary sliding, solved directly: single bodies and profiles ([`mod@steady`]), and periodic surfaces ([`periodic`](crate::periodic)).
//!
//! Theory: docs/theory/stationary-half-space.md.

pub(crate) mod change;
mod conjugate_residuals;
pub(crate) mod periodic;
mod search;
pub mod steady;

pub use steady::steady;
