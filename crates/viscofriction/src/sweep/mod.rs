//! Parameter sweeps: a scene for many values of its keys.

mod cache;
mod plan;
mod row;
mod vary;
mod warnings;

pub use plan::{Plan, header};
pub use row::{RowError, SweepRow};
pub use vary::{SAMPLE, Shard, Varied, Vary};
pub use warnings::{SharedWarning, each_once};
