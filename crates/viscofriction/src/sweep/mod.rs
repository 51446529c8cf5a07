//! A scene for many values of its keys.

mod plan;
mod row;
mod vary;

pub use plan::Plan;
pub use row::{Row, header, identity};
pub use vary::{Shard, Vary};
