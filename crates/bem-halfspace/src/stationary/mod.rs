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

/// Relative tolerance of the contact on the first grid of a refinement, and smallest one on the coarser grids of a nested iteration,
/// whose solution is only an initial guess. Chosen; from 1e-7 to 1e-4 no answer changes by more than 4 % of its bar (case of
/// `evidence tuning`).
const FIRST_TOLERANCE: f64 = 1e-4;
