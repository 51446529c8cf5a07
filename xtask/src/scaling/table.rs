//! `scaling-table`: the function s(p), computed at nodes, as the table that `friction-analytic` reads.

use std::path::Path;

use anyhow::Result;
use numerics::Estimate;
use serde::{Deserialize, Serialize};

use crate::scaling::scaling_factor;
use crate::table::GrowingTable;

/// The nodes have 2p − 1 = `LAST_ORDER` · e^(−k `STEP`), from p = 64 down to 0.501: dense where s bends, next to
/// p = 1/2.
const LAST_ORDER: f64 = 127.0;
const STEP: f64 = 0.153_594_4;
const N_NODES: usize = 73;
/// Relative difference up to which two exponents belong to the same node.
const EXPONENT_TOLERANCE: f64 = 1e-6;
/// Exponent below which the apex dominates the friction.
const CUSP_EXPONENT: f64 = 0.65;
/// Relative error requested below that exponent.
const CUSP_ERROR: f64 = 9e-4;
/// Relative error requested from that exponent on.
const ERROR: f64 = 8e-5;
/// Most unknown pressures: the boxes of the steepest contacts are nearly empty.
const MAX_UNKNOWNS: usize = 500_000;
/// The table; an interrupted run goes on where it was.
const TABLE: &str = "scaling_table.csv";

/// s(p) at one exponent.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
pub(crate) struct Node {
    pub(crate) exponent: f64,
    pub(crate) scaling_factor: f64,
    /// Absolute.
    pub(crate) error: f64,
}

impl Node {
    pub(crate) fn new(exponent: f64, factor: Estimate) -> Self {
        Self {
            exponent,
            scaling_factor: factor.value,
            error: factor.error,
        }
    }
}

/// Computes all nodes that are not in `out` yet, and adds them to the table there; in the end they are sorted.
pub(crate) fn generate(out: &Path) -> Result<()> {
    let mut table: GrowingTable<Node> = GrowingTable::open(out.join(TABLE))?;
    let is_node = |p: f64| move |node: &Node| (node.exponent / p - 1.0).abs() < EXPONENT_TOLERANCE;
    let mut missing: Vec<f64> = (0..N_NODES).map(exponent).collect();
    missing.retain(|p| !table.rows.iter().any(is_node(*p)));
    // Few at a time, cheap ones first, so that much is saved early.
    missing.sort_by(|left, right| left.ln().abs().total_cmp(&right.ln().abs()));
    let at_once = rayon::current_num_threads();
    table.extend(&missing, at_once, |&p| Ok(vec![node(p)?]))?;
    table
        .rows
        .sort_by(|left, right| left.exponent.total_cmp(&right.exponent));
    table.write()
}

fn exponent(index: usize) -> f64 {
    0.5 + 0.5 * LAST_ORDER * (-STEP * index as f64).exp()
}

fn node(exponent: f64) -> Result<Node> {
    let relative_error = match exponent {
        ..CUSP_EXPONENT => CUSP_ERROR,
        _ => ERROR,
    };
    let factor = scaling_factor(exponent, relative_error, MAX_UNKNOWNS)?;
    Ok(Node::new(exponent, factor.value()))
}
