//! Work on parts of fields, side by side, with results that do not depend on the number of threads.

pub(crate) mod chunks;
pub(crate) mod reductions;
pub(crate) mod row_blocks;
