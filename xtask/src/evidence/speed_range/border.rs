//! Lowest and highest speed at which the viscous law is right within ten per cent.

use anyhow::{Context, Result};
use comfy_table::Table;
use numerics::bracketed_root;
use serde::Serialize;

use crate::evidence::speed_range::sliding::{Sliding, plateau};
use crate::evidence::speed_range::validity;
use crate::output::markdown_table;

/// Largest |prediction/friction − 1| that counts as right.
pub(super) const ALLOWED: f64 = 0.1;

/// Which friction is predicted.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize)]
#[serde(rename_all = "kebab-case")]
pub(super) enum Model {
    Line,
    HalfSpace,
}

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
    pub(super) loss_tangent_at_lowest: Option<f64>,
    pub(super) loss_tangent_at_highest: Option<f64>,
    /// Smallest |prediction/friction − 1| on the map.
    pub(super) smallest_deviation: f64,
}

/// The ranges of all rows of the map.
pub(super) fn find(map: &[validity::Row]) -> Result<Vec<Row>> {
    let same = |one: &validity::Row, other: &validity::Row| {
        one.exponent.total_cmp(&other.exponent).is_eq()
            && one
                .stiffness_ratio
                .total_cmp(&other.stiffness_ratio)
                .is_eq()
    };
    let mut rows = Vec::new();
    for model in [Model::Line, Model::HalfSpace] {
        for speeds in map.chunk_by(same) {
            rows.push(row(&Scan { model, speeds })?);
        }
    }
    rows.sort_by(|one, other| one.exponent.total_cmp(&other.exponent));
    Ok(rows)
}

/// The speeds of one stiffness ratio.
struct Scan<'a> {
    model: Model,
    speeds: &'a [validity::Row],
}

fn row(scan: &Scan) -> Result<Row> {
    let first = scan.speeds.first().context("a map without speeds")?;
    let deviations: Vec<f64> = scan.speeds.iter().map(|at| scan.on_map(at)).collect();
    let right = |deviation: &f64| *deviation <= ALLOWED;
    let ends = [
        deviations
            .iter()
            .position(right)
            .map(|end| [end.checked_sub(1), Some(end)]),
        deviations
            .iter()
            .rposition(right)
            .map(|end| [Some(end), Some(end + 1)]),
    ];
    let [lowest, highest] = ends.map(|end| end.map(|between| scan.crossing(between)).transpose());
    let (lowest, highest) = (lowest?, highest?);
    let loss_tangent = |speed: Option<f64>| {
        let tangent = |speed| {
            Sliding {
                speed,
                ..question(first)
            }
            .loss_tangent()
        };
        speed.map(tangent).transpose()
    };
    Ok(Row {
        exponent: first.exponent,
        model: scan.model,
        stiffness_ratio: first.stiffness_ratio,
        lowest_speed: lowest,
        highest_speed: highest,
        loss_tangent_at_lowest: loss_tangent(lowest)?,
        loss_tangent_at_highest: loss_tangent(highest)?,
        smallest_deviation: deviations.into_iter().fold(f64::INFINITY, f64::min),
    })
}

fn question(row: &validity::Row) -> Sliding {
    Sliding {
        exponent: row.exponent,
        stiffness_ratio: row.stiffness_ratio,
        speed: row.speed,
    }
}

impl Scan<'_> {
    fn on_map(&self, row: &validity::Row) -> f64 {
        let quotient = match self.model {
            Model::Line => row.predicted_line / row.line,
            Model::HalfSpace => row.predicted_half_space / row.half_space,
        };
        (quotient - 1.0).abs()
    }

    /// The speed at which the deviation is the one allowed, between two neighbours on the map.
    ///
    /// The line is solved anew there; the ratio of the half space to it, which changes slowly, is interpolated.
    fn crossing(&self, between: [Option<usize>; 2]) -> Result<f64> {
        let neighbours = between.map(|index| self.speeds.get(index?));
        let [Some(low), Some(high)] = neighbours else {
            anyhow::bail!("the viscous law is right up to the edge of the map: {neighbours:?}");
        };
        let plateau = plateau(low.exponent)?;
        let excess = |logarithm: f64| {
            let place = (logarithm - low.speed.ln()) / (high.speed / low.speed).ln();
            let ratio = match self.model {
                Model::Line => plateau,
                Model::HalfSpace => {
                    let [before, after] = [low, high].map(|row| row.half_space / row.line);
                    before + place * (after - before)
                }
            };
            let at = Sliding {
                speed: logarithm.exp(),
                ..question(low)
            };
            let line = at
                .line()
                .and_then(|line| Ok(at.viscous_law(line.normal_force)? / line.friction.value));
            line.map_or(f64::NAN, |quotient| {
                (quotient * plateau / ratio - 1.0).abs() - ALLOWED
            })
        };
        let root = bracketed_root(excess, [low.speed.ln(), high.speed.ln()]);
        Ok(root
            .context("a border between two speeds of the map")?
            .exp())
    }
}

/// The ranges in Markdown.
pub(super) fn printed(rows: &[Row]) -> Table {
    let number =
        |value: Option<f64>| value.map_or_else(String::new, |value| format!("{value:.2e}"));
    let tangent =
        |value: Option<f64>| value.map_or_else(String::new, |value| format!("{value:.1}"));
    markdown_table(
        [
            "p",
            "model",
            "γ",
            "lowest vτ/a",
            "highest vτ/a",
            "tan δ there",
            "and there",
            "best within",
        ],
        rows.iter().map(|row| {
            [
                row.exponent.to_string(),
                match row.model {
                    Model::Line => "line".to_owned(),
                    Model::HalfSpace => "half space".to_owned(),
                },
                format!("{:.1e}", row.stiffness_ratio),
                number(row.lowest_speed),
                number(row.highest_speed),
                tangent(row.loss_tangent_at_lowest),
                tangent(row.loss_tangent_at_highest),
                format!("{:.1} %", 100.0 * row.smallest_deviation),
            ]
        }),
    )
}
