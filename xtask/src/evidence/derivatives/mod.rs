//! Do the error bars of derivatives hold on random scenes? They are compared with differences of answers that are far more exact.

mod differences;

use std::collections::BTreeMap;

use anyhow::Result;
use serde::Deserialize;

use super::sample::{Options, Source};
use super::{Outcomes, Report, Share, extent};
use crate::meter::median;
use crate::table::markdown_table;
use crate::tasks::in_parallel;
use differences::{Asked, Derivative, Refusal, compared};

/// Fraction of the derivatives of each method that must be within their bars.
const MIN_COVERAGE: f64 = 0.95;
/// Standard deviations by which the fraction of a few derivatives may be lower.
const ALLOWED_SCATTER: f64 = 1.5;

/// What `requests.toml` holds.
#[derive(Debug, Deserialize)]
struct Requests {
    /// Numbers of each scene that are changed.
    numbers: usize,
    method: Vec<Asked>,
}

/// Compares the derivatives of random scenes; fails where bars hold too seldom.
pub(super) fn report(options: &Options, quick: bool) -> Result<Report> {
    let requests: Requests = extent(include_str!("requests.toml"), quick)?;
    let mut found = Vec::new();
    for asked in &requests.method {
        let count = options.count(asked.scenes)?.div_ceil(asked.one_scene_of);
        let scenes = Source::new(&asked.range)?.scenes(options.seed(), count)?;
        let task = format!("derivatives, {}", asked.method.name());
        found.extend(in_parallel(task, &scenes, |scene| {
            let compared = compared(scene, asked, requests.numbers);
            Ok(compared.map_err(|error| Refusal::new(scene.number, asked, &error)))
        })?);
    }
    let found: Outcomes<Derivative, Refusal> = found.into_iter().collect();
    let table = table(&found.rows);
    Ok(Report {
        name: "derivatives",
        summary: format!("{table}\n\nnot solved: {}", found.refusals.len()),
        tables: found.tables(["derivatives", "derivatives_refused"])?,
        failure: failure(&found.rows),
        ..Report::default()
    })
}

/// Each method for itself, so that none is outvoted by the others.
fn failure(rows: &[Derivative]) -> Option<String> {
    let mut methods: BTreeMap<&str, Vec<bool>> = BTreeMap::new();
    for row in rows {
        let method = row.group.split(',').next().unwrap_or_default();
        methods.entry(method).or_default().push(row.holds());
    }
    let shares = methods.into_iter();
    let shares = shares.map(|(method, holds)| (method, holds.into_iter().collect::<Share>()));
    let missed = shares.filter(|(_, share)| !share.may_be(MIN_COVERAGE, ALLOWED_SCATTER));
    let missed: Vec<String> = missed
        .map(|(method, Share { held, all })| {
            format!("{method}: {held} of {all} are within their bars")
        })
        .collect();
    match rows.is_empty() {
        true => Some("derivatives: there are none".to_owned()),
        false => (!missed.is_empty()).then(|| format!("derivatives: {}", missed.join(", "))),
    }
}

/// One line per group of scenes.
fn table(rows: &[Derivative]) -> comfy_table::Table {
    let mut groups: BTreeMap<&str, Vec<&Derivative>> = BTreeMap::new();
    for row in rows {
        groups.entry(&row.group).or_default().push(row);
    }
    let header = "method|derivatives|within the bars|median of bar/largest|median of deviation/largest|95 %|worst|\
                  median of the reference's error/largest";
    let lines = groups.into_iter().map(|(group, rows)| line(group, &rows));
    markdown_table(header.split('|'), lines)
}

fn line(group: &str, rows: &[&Derivative]) -> [String; 8] {
    let of = |number: fn(&Derivative) -> f64| -> Vec<f64> {
        let parts = rows.iter().map(|row| number(row) / row.largest);
        parts.collect()
    };
    let mut deviations = of(|row| row.deviation);
    deviations.sort_by(f64::total_cmp);
    let held: Share = rows.iter().map(|row| row.holds()).collect();
    let below = |percent: usize| deviations[((rows.len() - 1) * percent).div_ceil(100)];
    let short = |value: f64| format!("{value:.1e}");
    [
        group.to_owned(),
        held.all.to_string(),
        held.percentage(),
        short(median(of(|row| row.error_bar))),
        short(below(50)),
        short(below(95)),
        short(below(100)),
        short(median(of(|row| row.reference_error))),
    ]
}
