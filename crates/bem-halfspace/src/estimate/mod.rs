//! Error estimates from several grids, and the grids to start from; shared by transient and stationary simulations.
//!
//! Theory: docs/theory/stationary-half-space.md, "Scatter, order, error bar", and docs/theory/transient-half-space.md, "Grid".

pub(crate) mod averages;
pub(crate) mod bars;
pub(crate) mod plan;
pub(crate) mod quantities;
pub(crate) mod reached;
pub(crate) mod refinement_limits;
