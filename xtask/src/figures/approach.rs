//! The transition zone: friction over the sliding distance, by chain and half space.

use anyhow::{Context, Result};
use bem_halfspace::slide::PressureField;
use serde::{Deserialize, Serialize};

use crate::figures::factors;
use crate::scene::Scene;

/// Sliding distance shown, in contact lengths of the one-dimensional model.
pub(super) const LENGTHS: f64 = 16.0;
/// Elements along the contact length.
const ELEMENTS: f64 = 24.0;

/// One step; friction is relative to the stationary friction of the one-dimensional model.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub(super) struct Row {
    pub(super) exponent: f64,
    pub(super) sliding_distance_over_contact_length: f64,
    pub(super) chain: f64,
    pub(super) half_space: f64,
    /// In units of F_N/(4ηv).
    pub(super) chain_depth: f64,
    pub(super) half_space_depth: f64,
}

/// The approach to stationarity of one profile, and the pressure at its end.
pub(super) struct Approach {
    pub(super) rows: Vec<Row>,
    pub(super) pressure: PressureField,
    pub(super) contact_length: f64,
    pub(super) scaling_factor: f64,
}

pub(super) fn compute(factor: &factors::Row) -> Result<Approach> {
    let scene = Scene::unit(factor.exponent)?;
    let theory = scene.theory()?;
    let contact_length = theory.contact_length();
    let spacing = contact_length / ELEMENTS;
    let chain = scene.chain(spacing)?;
    let last = chain.rows.last().context("a chain that did not move")?;
    let transient = scene.half_space(spacing, LENGTHS)?;
    let rows = transient.rows.iter().enumerate().map(|(step, row)| {
        // The chain stops when it is stationary, and stays as it is.
        let chain = chain.rows.get(step).unwrap_or(last);
        Row {
            exponent: factor.exponent,
            sliding_distance_over_contact_length: row.sliding_distance / contact_length,
            chain: chain.friction_coefficient / theory.friction_coefficient,
            half_space: row.friction_coefficient / theory.friction_coefficient,
            chain_depth: chain.indentation_depth / theory.indentation_depth,
            half_space_depth: row.indentation_depth / theory.indentation_depth,
        }
    });
    let rows = rows.collect();
    Ok(Approach {
        rows,
        pressure: transient.pressure,
        contact_length,
        scaling_factor: factor.converged,
    })
}
