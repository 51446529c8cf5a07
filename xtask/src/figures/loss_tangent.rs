//! Fig. 1: loss tangent of the three-element solid, and its moduli for γ = 1/100.

use anyhow::Result;
use casebook::standard_solid;
use rheology::{Material, StandardSolid};
use serde::{Deserialize, Serialize};

pub(super) const FILE: &str = "fig1_loss_tangent.csv";

/// Stiffness ratios γ = G₁/G₂ of the paper.
pub(super) const RATIOS: [f64; 3] = [1e-3, 1e-2, 1e-1];

/// The scale of the moduli in the caption is 10/G₂, so that a solid with G₂ = 10 shows them as they are drawn.
const MAXWELL_MODULUS: f64 = 10.0;

#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub(super) struct Row {
    /// Ω = ω η / G₂; the paper prints ω G₂ / η, which has a dimension.
    pub(super) dimensionless_frequency: f64,
    pub(super) loss_tangent_gamma_0_001: f64,
    pub(super) loss_tangent_gamma_0_01: f64,
    pub(super) loss_tangent_gamma_0_1: f64,
    /// 10 G' / G₂ for γ = 1/100.
    pub(super) scaled_storage_modulus: f64,
    /// 10 G'' / G₂ for γ = 1/100.
    pub(super) scaled_loss_modulus: f64,
}

pub(super) fn solid(ratio: f64) -> Result<StandardSolid> {
    let modulus = MAXWELL_MODULUS;
    // A relaxation time of 1 s makes Ω equal to ω.
    Ok(standard_solid([ratio * modulus, modulus, modulus])?)
}

/// Forty frequencies per decade from 10⁻⁴ to 10².
pub(super) fn compute() -> Result<Vec<Row>> {
    let [soft, middle, stiff] = [solid(RATIOS[0])?, solid(RATIOS[1])?, solid(RATIOS[2])?];
    let row = |k: u32| {
        let frequency = 10.0_f64.powf(f64::from(k) / 40.0 - 4.0);
        Ok(Row {
            dimensionless_frequency: frequency,
            loss_tangent_gamma_0_001: soft.loss_tangent(frequency)?,
            loss_tangent_gamma_0_01: middle.loss_tangent(frequency)?,
            loss_tangent_gamma_0_1: stiff.loss_tangent(frequency)?,
            scaled_storage_modulus: middle.complex_modulus(frequency)?.storage,
            scaled_loss_modulus: middle.complex_modulus(frequency)?.loss,
        })
    };
    (0..=240).map(row).collect()
}
