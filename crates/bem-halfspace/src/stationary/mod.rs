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

/// Complementarity tolerance (largest gap in contact or penetration outside, over the largest displacement) on the first grid of a
/// refinement. The coarser grids of a nested iteration, which only supply an initial guess, never use a smaller one. Chosen; from
/// 1e-7 to 1e-4 no answer changes by more than 4 % of its bar (case of `evidence tuning`).
const COARSE_GRID_TOLERANCE: f64 = 1e-4;
