//! Stationary sliding, solved directly: single bodies and profiles ([`mod@steady`]), and periodic surfaces
//! ([`periodic`](crate::periodic)).
//!
//! Theory: docs/theory/stationary-half-space.md.

pub(crate) mod change;
mod conjugate_residuals;
pub(crate) mod periodic;
mod search;
pub mod steady;

pub use steady::steady;

/// Smallest relative tolerance of the contact on a coarser grid whose solution is only the initial guess of a nested iteration.
///
/// Chosen; from 1e-6 to 1e-3 no answer of `evidence tuning` changes by more than 1e-6 of its bar.
const INITIAL_GUESS_TOLERANCE: f64 = 1e-4;
