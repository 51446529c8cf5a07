//! A scene for many values of its keys.

mod plan;
mod vary;
mod warnings;

pub use plan::{Plan, SweepRow, header, identity};
pub use vary::{SAMPLE, Shard, Varied, Vary};
pub use warnings::{SharedWarning, each_once};
