//! Lowest and highest speed at which the viscous law is right within ten per cent.

use anyhow::{Context, Result, bail};
use numerics::bracketed_root;
use serde::Serialize;

use super::sliding::Sliding;
use super::{Model, Prediction, plateau};
use crate::output::markdown_table;

/// Largest |prediction/friction − 1| that is right.
const ALLOWED: f64 = 0.1;

/// The range of one profile and stiffness ratio; no speeds where the law is right at none of the map.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub(super) struct Row {
    pub(super) exponent: f64,
    pub(super) model: Model,
    pub(super) stiffness_ratio: f64,
    /// vτ/a.
    pub(super) lowest_speed: Option<f64>,
    pub(super) highest_speed: Option<f64>,
    /// tan δ at ω = v/a, at both speeds.
    loss_tangent_at_lowest: Option<f64>,
    loss_tangent_at_highest: Option<f64>,
    /// Smallest |prediction/friction − 1| on the map.
    smallest_deviation: f64,
}

/// The ranges of all rows of the map.
pub(super) fn find(map: &[Prediction]) -> Result<Vec<Row>> {
    let key = |at: &Prediction| [at.exponent, at.stiffness_ratio].map(f64::to_bits);
    let mut rows = Vec::new();
    for model in Model::BOTH {
        for speeds in map.chunk_by(|one, other| key(one) == key(other)) {
            rows.push(row(model, speeds)?);
        }
    }
    rows.sort_by(|one, other| one.exponent.total_cmp(&other.exponent));
    Ok(rows)
}

/// The range of one stiffness ratio.
fn row(model: Model, speeds: &[Prediction]) -> Result<Row> {
    let first = &speeds[0];
    let deviation = |at: &Prediction| {
        let [friction, predicted] = at.pair(model);
        (predicted / friction - 1.0).abs()
    };
    let right = |at: &Prediction| deviation(at) <= ALLOWED;
    let crossing = |low: Option<usize>, high: usize| match (low, speeds.get(high)) {
        (Some(low), Some(high)) => crossing(model, &speeds[low], high),
        _ => bail!("the viscous law is right up to the edge of the map: {first:?}"),
    };
    let lowest = speeds.iter().position(right);
    let lowest = lowest
        .map(|at| crossing(at.checked_sub(1), at))
        .transpose()?;
    let highest = speeds.iter().rposition(right);
    let highest = highest.map(|at| crossing(Some(at), at + 1)).transpose()?;
    let loss_tangent = |speed: f64| first.sliding().at_speed(speed).loss_tangent();
    Ok(Row {
        exponent: first.exponent,
        model,
        stiffness_ratio: first.stiffness_ratio,
        lowest_speed: lowest,
        highest_speed: highest,
        loss_tangent_at_lowest: lowest.map(loss_tangent).transpose()?,
        loss_tangent_at_highest: highest.map(loss_tangent).transpose()?,
        smallest_deviation: speeds.iter().map(deviation).fold(f64::INFINITY, f64::min),
    })
}

/// The speed at which the deviation is the one allowed, between two neighbours on the map.
///
/// The line is solved anew there; the ratio of the half space to it, which changes slowly, is interpolated.
fn crossing(model: Model, low: &Prediction, high: &Prediction) -> Result<f64> {
    let plateau = plateau(low.exponent)?;
    let ratio = |at: &Prediction| match model {
        Model::Line => plateau,
        Model::HalfSpace => at.half_space / at.line,
    };
    let [before, after] = [low, high].map(ratio);
    let excess = |logarithm: f64| {
        let place = (logarithm - low.speed.ln()) / (high.speed / low.speed).ln();
        let ratio = before + place * (after - before);
        let quotient = quotient(&low.sliding().at_speed(logarithm.exp()));
        quotient.map_or(f64::NAN, |quotient| {
            (quotient * plateau / ratio - 1.0).abs() - ALLOWED
        })
    };
    let root = bracketed_root(excess, [low.speed, high.speed].map(f64::ln));
    Ok(root
        .context("a border between two speeds of the map")?
        .exp())
}

/// Prediction over friction of the line.
fn quotient(at: &Sliding) -> Result<f64> {
    let (line, normal_force) = at.line()?;
    Ok(at.viscous_law(normal_force)? / line.value)
}

/// The ranges in Markdown.
pub(super) fn table(rows: &[Row]) -> comfy_table::Table {
    let header = [
        "p",
        "model",
        "γ",
        "lowest vτ/a",
        "highest vτ/a",
        "tan δ there",
        "and there",
        "best within",
    ];
    let speed = |speed: Option<f64>| speed.map_or_else(String::new, |speed| format!("{speed:.2e}"));
    let tangent =
        |value: Option<f64>| value.map_or_else(String::new, |value| format!("{value:.1}"));
    let lines = rows.iter().map(|row| {
        [
            row.exponent.to_string(),
            row.model.name().to_owned(),
            format!("{:.1e}", row.stiffness_ratio),
            speed(row.lowest_speed),
            speed(row.highest_speed),
            tangent(row.loss_tangent_at_lowest),
            tangent(row.loss_tangent_at_highest),
            format!("{:.1} %", 100.0 * row.smallest_deviation),
        ]
    });
    markdown_table(header, lines)
}
