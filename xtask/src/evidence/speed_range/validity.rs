//! Where the viscous law of the same loss modulus predicts the friction of the three-element solid.

use anyhow::Result;
use serde::Serialize;

use crate::evidence::speed_range::curves;
use crate::evidence::speed_range::sliding::{Sliding, plateau};
use crate::evidence::speed_range::{EXPONENTS, Extent};

/// One contact; friction in units of the mean slope d/a, errors absolute.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub(super) struct Row {
    pub(super) exponent: f64,
    /// γ = G₁/G₂.
    pub(super) stiffness_ratio: f64,
    /// vτ/a.
    pub(super) speed: f64,
    pub(super) loss_tangent: f64,
    pub(super) line: f64,
    /// By (12) and (16).
    pub(super) predicted_line: f64,
    pub(super) half_space: f64,
    pub(super) half_space_error: f64,
    /// s_p times that of the line.
    pub(super) predicted_half_space: f64,
}

/// All contacts of the map, speed by speed for each stiffness ratio of each profile.
pub(super) fn compute(extent: &Extent) -> Result<Vec<Row>> {
    let mut questions = Vec::new();
    for exponent in EXPONENTS {
        for stiffness_ratio in extent.map_ratios.values() {
            questions.extend(extent.map_speeds.values().map(|speed| Sliding {
                exponent,
                stiffness_ratio,
                speed,
            }));
        }
    }
    let solved = curves::rows("validity of the viscous law", &questions, extent.map_error)?;
    let rows = questions.iter().zip(solved);
    rows.map(|(question, solved)| row(question, &solved))
        .collect()
}

fn row(question: &Sliding, solved: &curves::Row) -> Result<Row> {
    let predicted_line = question.viscous_law(solved.normal_force)?;
    Ok(Row {
        exponent: question.exponent,
        stiffness_ratio: question.stiffness_ratio,
        speed: question.speed,
        loss_tangent: question.loss_tangent()?,
        line: solved.line,
        predicted_line,
        half_space: solved.half_space,
        half_space_error: solved.half_space_error,
        predicted_half_space: plateau(question.exponent)? * predicted_line,
    })
}
