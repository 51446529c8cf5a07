//! What the motions and the stationary states have in common: the grids to start from, and error bars from several of them.

pub(crate) mod averages;
pub(crate) mod bars;
pub(crate) mod plan;
pub(crate) mod quantities;
pub(crate) mod reached;
