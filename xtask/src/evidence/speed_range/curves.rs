//! Friction over speed on the line and on the half space, and their ratio.

use anyhow::Result;
use serde::Serialize;

use crate::evidence::speed_range::sliding::{Friction, Line, Sliding};
use crate::evidence::speed_range::{EXPONENTS, Extent};
use crate::tasks::in_parallel;

/// One speed; friction in units of the mean slope d/a, errors absolute.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub(super) struct Row {
    pub(super) exponent: f64,
    /// γ = G₁/G₂.
    pub(super) stiffness_ratio: f64,
    /// vτ/a.
    pub(super) speed: f64,
    /// F_N/(G₂ a d).
    pub(super) normal_force: f64,
    pub(super) line: f64,
    pub(super) line_error: f64,
    pub(super) half_space: f64,
    pub(super) half_space_error: f64,
    /// s(p, vτ/a, γ), half space over line.
    pub(super) ratio: f64,
    pub(super) ratio_error: f64,
}

/// All speeds of the curves, speed by speed for each stiffness ratio of each profile.
pub(super) fn compute(extent: &Extent) -> Result<Vec<Row>> {
    let mut questions = Vec::new();
    for exponent in EXPONENTS {
        for &stiffness_ratio in extent.curve_ratios {
            questions.extend(extent.curve_speeds.values().map(|speed| Sliding {
                exponent,
                stiffness_ratio,
                speed,
            }));
        }
    }
    rows("friction over speed", &questions, extent.curve_error)
}

/// Solves every question by both methods.
pub(super) fn rows(task: &'static str, questions: &[Sliding], error: f64) -> Result<Vec<Row>> {
    in_parallel(task, questions, |question| row(question, error))
}

fn row(question: &Sliding, relative_error: f64) -> Result<Row> {
    let Line {
        normal_force,
        friction: line,
    } = question.line()?;
    let half_space = question.half_space(normal_force, relative_error)?;
    let ratio = quotient(half_space, line);
    Ok(Row {
        exponent: question.exponent,
        stiffness_ratio: question.stiffness_ratio,
        speed: question.speed,
        normal_force,
        line: line.value,
        line_error: line.error,
        half_space: half_space.value,
        half_space_error: half_space.error,
        ratio: ratio.value,
        ratio_error: ratio.error,
    })
}

fn quotient(numerator: Friction, denominator: Friction) -> Friction {
    let value = numerator.value / denominator.value;
    let error = (numerator.error + value * denominator.error) / denominator.value;
    Friction { value, error }
}
