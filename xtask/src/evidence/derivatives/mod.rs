//! Do the error bars of derivatives hold on random scenes? They are compared with differences of answers that are far more
//! exact.

mod differences;

use anyhow::Result;
use serde::Deserialize;

use super::sample::{Options, Source};
use super::{Outcomes, Report, Share, extent};
use crate::meter::median;
use crate::table::{Column, group_by, table_of};
use crate::tasks::in_parallel;
use differences::{Asked, Derivative, Refusal, compared};

/// Smallest fraction of the derivatives of each method whose deviation must be within both error bars. Chosen: an error bar
/// is an estimate and no bound.
const MIN_COVERAGE: f64 = 0.95;
/// Number of binomial standard deviations by which the observed fraction may fall short of [`MIN_COVERAGE`]. Chosen: if
/// exactly [`MIN_COVERAGE`] hold, one of 15 runs falls short of it by more.
const ALLOWED_SCATTER: f64 = 1.5;

/// What is computed: a table of `requests.toml`.
#[derive(Debug, Deserialize)]
struct Requests {
    /// By how many numbers of each scene is differentiated.
    numbers: usize,
    /// One entry for each method.
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
    let table = table_of(&columns(), group_by(&found.rows, |row| &row.group));
    Ok(Report {
        name: "derivatives",
        summary: format!("{table}\n\nnot solved: {}", found.refusals.len()),
        tables: found.tables(["derivatives", "derivatives_refused"])?,
        failure: failure(&found.rows),
        ..Report::default()
    })
}

/// Why the command fails: a method whose bars hold too seldom. Each is judged for itself, so that none is outvoted by others.
fn failure(rows: &[Derivative]) -> Option<String> {
    let by_method = group_by(rows, |row| row.method).into_iter();
    let missed = by_method.filter_map(|(method, rows)| {
        let share = held(&rows);
        let Share { held, all } = share;
        (!share.may_be(MIN_COVERAGE, ALLOWED_SCATTER))
            .then(|| format!("{method}: {held} of {all} are within their bars"))
    });
    let missed: Vec<String> = missed.collect();
    match rows.is_empty() {
        true => Some("derivatives: there are none".to_owned()),
        false => (!missed.is_empty()).then(|| format!("derivatives: {}", missed.join(", "))),
    }
}

/// Fraction of the derivatives whose deviation is within both error bars.
fn held(rows: &[&Derivative]) -> Share {
    rows.iter().map(|row| row.holds()).collect()
}

/// Columns of the table with one line per group of scenes.
fn columns<'a>() -> [Column<(&'a String, Vec<&'a Derivative>)>; 8] {
    [
        ("method", |(group, _)| (*group).clone()),
        ("derivatives", |(_, rows)| rows.len().to_string()),
        ("within the bars", |(_, rows)| held(rows).percentage()),
        ("median of bar/largest", |(_, rows)| {
            short(median(parts(rows, |row| row.error_bar)))
        }),
        ("median of deviation/largest", |(_, rows)| below(rows, 50)),
        ("95 %", |(_, rows)| below(rows, 95)),
        ("worst", |(_, rows)| below(rows, 100)),
        ("median of the reference's error/largest", |(_, rows)| {
            short(median(parts(rows, |row| row.reference_error)))
        }),
    ]
}

/// A number with two significant digits and a power of ten.
fn short(value: f64) -> String {
    format!("{value:.1e}")
}

/// An error or a deviation of each derivative, over the largest derivative of the same quantity in its scene.
fn parts(rows: &[&Derivative], number: fn(&Derivative) -> f64) -> Vec<f64> {
    rows.iter().map(|row| number(row) / row.largest).collect()
}

/// The relative deviation that `percent` per cent of the derivatives do not exceed.
fn below(rows: &[&Derivative], percent: usize) -> String {
    let mut deviations = parts(rows, |row| row.deviation);
    deviations.sort_by(f64::total_cmp);
    short(deviations[((rows.len() - 1) * percent).div_ceil(100)])
}
