//! `reproduce-figures --check`: recomputes a part of the committed data.

use std::path::{Path, PathBuf};

use anyhow::{Context, Result, ensure};
use serde::Serialize;

use crate::figures::friction_over_speed::{self, Indenter, SPEEDS};
use crate::figures::{factors, loss_tangent, scaling_function, stationary};
use crate::output::{read_csv, to_csv};

/// Closed forms differ by rounding only.
const CLOSED_FORM: Tolerance = Tolerance::Relative(1e-12);
/// Simulations stop at a relative residual of 1e-9, and transforms round differently from processor to processor.
const SIMULATION: Tolerance = Tolerance::Relative(1e-6);
/// The plain simulation reproduces the paper's factors to the digits the paper gives, and its last one doubtful.
const PAPER_TOLERANCE: f64 = 0.02;
/// An error bar is a difference of numbers that round.
const ERROR_BAR: Tolerance = Tolerance::Relative(1e-3);
/// Elements by which the outline of a contact may move, and a little for rounding.
const OUTLINE: f64 = 1.001;

/// How much a recomputed number may differ.
#[derive(Debug, Clone, Copy)]
enum Tolerance {
    Relative(f64),
    Absolute(f64),
    /// It is not compared.
    Any,
}

pub(crate) fn check() -> Result<()> {
    let mut compared = compare(
        loss_tangent::FILE,
        None,
        &loss_tangent::compute()?,
        |_, _| CLOSED_FORM,
    )?;
    for indenter in [Indenter::Cone, Indenter::Paraboloid] {
        compared += check_friction(indenter)?;
    }
    compared += check_factors()?;
    compared += compare(
        scaling_function::FILE,
        None,
        &scaling_function::compute()?,
        |_, _| CLOSED_FORM,
    )?;
    compared += scaling_function::check_against_the_half_space()?;
    compared += check_outlines()?;
    println!("docs/figures: {compared} recomputed numbers agree");
    Ok(())
}

fn committed(file: &str) -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR"))
        .join("../docs/figures")
        .join(file)
}

/// Compares recomputed rows with those of a committed table, or with the chosen ones; the tolerance is that of a column
/// of a recomputed row.
fn compare<R: Serialize>(
    file: &str,
    chosen: Option<&[usize]>,
    recomputed: &[R],
    tolerance: impl Fn(&str, &R) -> Tolerance,
) -> Result<usize> {
    let table = to_csv(recomputed)?;
    let mut new = csv::Reader::from_reader(table.as_bytes());
    let mut old = csv::Reader::from_path(committed(file)).with_context(|| file.to_owned())?;
    let columns = new.headers()?.clone();
    ensure!(*old.headers()? == columns, "{file}: other columns");
    let mut rows = old.records().collect::<Result<Vec<_>, _>>()?;
    if let Some(chosen) = chosen {
        let row = |&row: &usize| {
            rows.get(row)
                .cloned()
                .with_context(|| format!("{file}: {} rows", rows.len()))
        };
        rows = chosen.iter().map(row).collect::<Result<_>>()?;
    }
    let count = rows.len();
    ensure!(count == recomputed.len(), "{file}: {count} rows");
    let mut compared = 0;
    for ((old, new), row) in rows.iter().zip(new.records()).zip(recomputed) {
        let new = new?;
        for (column, (old, new)) in columns.iter().zip(old.iter().zip(&new)) {
            let what = || format!("{file}: {column} of {old:?}");
            let [old, new] = [
                old.parse::<f64>().with_context(what)?,
                new.parse().with_context(what)?,
            ];
            let allowed = match tolerance(column, row) {
                Tolerance::Relative(part) => part * old.abs(),
                Tolerance::Absolute(allowed) => allowed,
                Tolerance::Any => continue,
            };
            let off = (new - old).abs();
            ensure!(
                off <= allowed,
                "{}, recomputed {new:e}, off by {off:e}, allowed {allowed:e}",
                what()
            );
            compared += 1;
        }
    }
    Ok(compared)
}

/// The slowest, a middle and the fastest speed; the factor is that of the committed table.
fn check_friction(indenter: Indenter) -> Result<usize> {
    let factors = committed_factors()?;
    let same = |row: &&factors::Row| row.exponent.total_cmp(&indenter.exponent()).is_eq();
    let factor = factors
        .iter()
        .find(same)
        .context("a factor of the indenter")?
        .converged;
    let speeds = [0, SPEEDS / 2, SPEEDS - 1];
    let rows = speeds.map(|speed| friction_over_speed::row(indenter, speed, factor));
    let rows = rows.into_iter().collect::<Result<Vec<_>>>()?;
    let chosen = speeds.map(|speed| speed as usize);
    compare(
        indenter.file(),
        Some(&chosen),
        &rows,
        |column, _| match column {
            "half_space" | "half_space_plain" => SIMULATION,
            "half_space_distance_error" | "drift" => Tolerance::Any,
            _ => CLOSED_FORM,
        },
    )
}

fn committed_factors() -> Result<Vec<factors::Row>> {
    read_csv(&committed(factors::FILE))
}

/// The whole table: the simulation, its biases, which are differences of numbers of the order of one, and the converged
/// factors within the committed error bars.
fn check_factors() -> Result<usize> {
    let errors = committed_factors()?;
    let new = factors::compute()?;
    for row in &new {
        let off = (row.plain - row.paper).abs();
        ensure!(
            off <= PAPER_TOLERANCE,
            "{}: the plain simulation gives {}, the paper {}, off by {off}, allowed {PAPER_TOLERANCE}",
            factors::FILE,
            row.plain,
            row.paper
        );
    }
    compare(factors::FILE, None, &new, |column, row| match column {
        "exponent" | "paper" | "plain_elements" | "plain_lengths" => CLOSED_FORM,
        "plain" => SIMULATION,
        "time_level_bias" | "distance_bias" => Tolerance::Absolute(1e-6),
        "converged" | "grid_bias" => {
            let same = |old: &&factors::Row| old.exponent.total_cmp(&row.exponent).is_eq();
            Tolerance::Absolute(errors.iter().find(same).map_or(0.0, |old| old.error))
        }
        "error" => ERROR_BAR,
        _ => Tolerance::Any,
    })
}

/// All outlines. Rounding may decide about single elements, so each point may move by one.
fn check_outlines() -> Result<usize> {
    let contacts = stationary::compute()?;
    let outlines: Vec<&stationary::Row> = contacts
        .iter()
        .flat_map(|contact| &contact.outline)
        .collect();
    compare(stationary::FILE, None, &outlines, |_, row| {
        Tolerance::Absolute(OUTLINE * row.element)
    })
}
