//! A scene for many values of its keys.

mod plan;
mod row;
mod vary;

pub use plan::{Plan, header, identity};
pub use row::Row;
pub use vary::{Shard, Vary};
