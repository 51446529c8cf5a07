//! Parallel loops and reductions over fields, with results that do not depend on the number of threads to the last bit.
//!
//! With the feature `rayon` they run on the current pool, otherwise on one thread in the same order.

pub(crate) mod chunks;
pub(crate) mod reductions;
pub(crate) mod row_blocks;
