//! `reproduce-figures --check`: recomputes a part of the committed data.

use std::path::{Path, PathBuf};

use anyhow::{Context, Result, ensure};
use serde::Serialize;

use crate::figures::factors::{self, FILE, Row};
use crate::figures::friction_over_speed::{self, CONE, Indenter, PARABOLOID, SPEEDS};
use crate::figures::{loss_tangent, resolution, scaling_function, stationary};
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
enum Tolerance {
    Relative(f64),
    Absolute(f64),
    /// It is not compared.
    Any,
}

pub(crate) fn check() -> Result<()> {
    let (tangents, function) = (loss_tangent::compute()?, scaling_function::compute()?);
    let compared = compare(loss_tangent::FILE, None, &tangents, |_, _| CLOSED_FORM)?
        + check_friction(&CONE)?
        + check_friction(&PARABOLOID)?
        + check_factors()?
        + check_resolutions()?
        + compare(scaling_function::FILE, None, &function, |_, _| CLOSED_FORM)?
        + scaling_function::check_against_the_half_space()?
        + check_outlines()?;
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
        let count = rows.len();
        let row = |&row: &usize| rows.get(row).cloned();
        let rows_of = chosen.iter().map(row).collect::<Option<_>>();
        rows = rows_of.with_context(|| format!("{file}: {count} rows"))?;
    }
    let count = rows.len();
    ensure!(count == recomputed.len(), "{file}: {count} rows");
    let mut compared = 0;
    for ((old, new), row) in rows.iter().zip(new.records()).zip(recomputed) {
        let new = new?;
        for (column, (old, new)) in columns.iter().zip(old.iter().zip(&new)) {
            let what = || format!("{file}: {column} of {old:?}");
            let number = |text: &str| text.parse::<f64>().with_context(what);
            let [old, new] = [number(old)?, number(new)?];
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
fn check_friction(indenter: &Indenter) -> Result<usize> {
    let factors = committed_factors()?;
    let factor = of_exponent(&factors, indenter.exponent).context("a factor of the indenter")?;
    let speeds = [0, SPEEDS / 2, SPEEDS - 1];
    let row = |speed| friction_over_speed::row(indenter, speed, factor.converged);
    let rows = speeds.into_iter().map(row).collect::<Result<Vec<_>>>()?;
    let chosen = speeds.map(|speed| speed as usize);
    let tolerance = |column: &str, _: &_| match column {
        "half_space" | "half_space_plain" => SIMULATION,
        "half_space_distance_error" | "drift" => Tolerance::Any,
        _ => CLOSED_FORM,
    };
    compare(indenter.file, Some(&chosen), &rows, tolerance)
}

fn committed_factors() -> Result<Vec<Row>> {
    read_csv(&committed(FILE))
}

fn of_exponent(factors: &[Row], exponent: f64) -> Option<&Row> {
    let mut factors = factors.iter();
    factors.find(|row| row.exponent.total_cmp(&exponent).is_eq())
}

/// The whole table: the simulation, its biases, which are differences of numbers of the order of one, and the converged
/// factors within the committed error bars.
fn check_factors() -> Result<usize> {
    let errors = committed_factors()?;
    let new = factors::compute()?;
    for row in &new {
        let off = (row.plain - row.paper).abs();
        let Row { plain, paper, .. } = row;
        ensure!(
            off <= PAPER_TOLERANCE,
            "{FILE}: the plain simulation gives {plain}, the paper {paper}, off by {off}, allowed {PAPER_TOLERANCE}"
        );
    }
    compare(FILE, None, &new, |column, row| match column {
        "exponent" | "paper" | "plain_elements" | "plain_lengths" => CLOSED_FORM,
        "plain" => SIMULATION,
        "time_level_bias" | "distance_bias" => Tolerance::Absolute(1e-6),
        "converged" | "grid_bias" => {
            Tolerance::Absolute(of_exponent(&errors, row.exponent).map_or(0.0, |old| old.error))
        }
        "error" => ERROR_BAR,
        _ => Tolerance::Any,
    })
}

/// The coarser resolutions of both profiles.
fn check_resolutions() -> Result<usize> {
    const RESOLUTIONS: usize = 3;
    let rows = resolution::compute(RESOLUTIONS)?;
    let of_paraboloid = resolution::COUNT..resolution::COUNT + RESOLUTIONS;
    let chosen: Vec<usize> = (0..RESOLUTIONS).chain(of_paraboloid).collect();
    compare(resolution::FILE, Some(&chosen), &rows, |_, _| SIMULATION)
}

/// All outlines. Rounding may decide about single elements, so each point may move by one.
fn check_outlines() -> Result<usize> {
    let contacts = stationary::compute()?;
    let outlines = contacts.iter().flat_map(|contact| &contact.outline);
    let outlines: Vec<&stationary::Row> = outlines.collect();
    compare(stationary::FILE, None, &outlines, |_, row| {
        Tolerance::Absolute(OUTLINE * row.element)
    })
}
