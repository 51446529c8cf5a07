//! A scene for many values of its keys.

mod plan;
mod vary;

pub use plan::{Plan, Row, header, identity};
pub use vary::{Shard, Vary};
