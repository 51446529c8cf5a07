//! `scaling-table`: the function s(p), computed at nodes, as the table that `friction-analytic` reads.

use std::path::Path;

use anyhow::Result;
use numerics::Estimate;
use serde::{Deserialize, Serialize};

use crate::scaling::scaling_factor;
use crate::table::GrowingTable;

/// Value of 2p − 1 at the first node, with the exponent p. Node k has 2p − 1 = `LAST_ORDER` · e^(−k `NODE_DISTANCE`), from p = 64
/// down to 0.501: nodes are dense next to p = 1/2, where the factor s(p) bends.
const LAST_ORDER: f64 = 127.0;
/// Distance of neighbouring nodes in ln(2p − 1).
const NODE_DISTANCE: f64 = 0.153_594_4;
/// Number of nodes of the table.
const N_NODES: usize = 73;
/// Relative difference up to which two exponents belong to the same node. Chosen far below the distance of nodes and far above
/// rounding.
const EXPONENT_TOLERANCE: f64 = 1e-6;
/// Exponent below which the apex, where the profile is infinitely steep, dominates the friction and the error falls slowly.
/// Chosen.
const CUSP_EXPONENT: f64 = 0.65;
/// Relative error requested below [`CUSP_EXPONENT`]. Chosen: it is what [`MAX_UNKNOWNS`] reach.
const CUSP_ERROR: f64 = 9e-4;
/// Relative error requested from [`CUSP_EXPONENT`] on. Chosen.
const ERROR: f64 = 8e-5;
/// Largest number of unknown pressures of a node. Chosen large, because the boxes of the steepest contacts are nearly empty.
const MAX_UNKNOWNS: usize = 500_000;
/// File of the table, from which an interrupted run goes on.
const TABLE: &str = "scaling_table.csv";

/// s(p) at one exponent.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
pub(crate) struct Node {
    pub(crate) exponent: f64,
    pub(crate) scaling_factor: f64,
    /// Absolute error bar.
    pub(crate) error: f64,
}

impl Node {
    /// The node of an exponent with the factor s(p).
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
    // Compute few nodes at a time, cheap ones first, so that much is saved early.
    missing.sort_by(|left, right| left.ln().abs().total_cmp(&right.ln().abs()));
    let at_once = rayon::current_num_threads();
    table.extend(&missing, at_once, |&p| Ok(vec![node(p)?]))?;
    table
        .rows
        .sort_by(|left, right| left.exponent.total_cmp(&right.exponent));
    table.write()
}

/// Exponent p of the node k = `index`.
fn exponent(index: usize) -> f64 {
    0.5 + 0.5 * LAST_ORDER * (-NODE_DISTANCE * index as f64).exp()
}

/// Computes a node.
fn node(exponent: f64) -> Result<Node> {
    let relative_error = match exponent {
        ..CUSP_EXPONENT => CUSP_ERROR,
        _ => ERROR,
    };
    let factor = scaling_factor(exponent, relative_error, MAX_UNKNOWNS)?;
    Ok(Node::new(exponent, factor.value()))
}
