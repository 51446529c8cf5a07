//! `reproduce-figures --check`: recomputes a part of the committed data.

use std::collections::BTreeMap;
use std::path::{Path, PathBuf};

use anyhow::{Context, Result, ensure};
use serde::Serialize;

use crate::figures::factors::{self, NAME, Row};
use crate::figures::friction_over_speed::{self, CONE, Indenter, PARABOLOID, SPEEDS};
use crate::figures::{loss_tangent, resolution, scaling_function, stationary};
use crate::table::{parse_csv, read_csv, to_csv};

/// Tolerance of closed forms, which differ by rounding only.
const CLOSED_FORM: Tolerance = Tolerance::Relative(1e-12);
/// Tolerance of simulations, which stop at a relative residual of 1e-9 and whose Fourier transforms round differently from
/// processor to processor; chosen, since both are amplified.
const SIMULATION: Tolerance = Tolerance::Relative(1e-6);
/// Largest difference of the factors of the plain simulation from those of Kürschner (2014), which have two decimals: two units
/// of the last one.
const PAPER_TOLERANCE: f64 = 0.02;
/// Relative tolerance of an error bar, which is a small difference of simulated numbers. Chosen.
const ERROR_BAR: Tolerance = Tolerance::Relative(1e-3);
/// Number of elements by which the outline of a contact may move. Chosen: one, and a little for rounding of the coordinate.
const OUTLINE_TOLERANCE: f64 = 1.001;

/// How much a recomputed number may differ.
enum Tolerance {
    /// Relative to the committed number.
    Relative(f64),
    /// In the unit of the column.
    Absolute(f64),
    /// It is not compared.
    Any,
}

/// Recomputes what takes seconds of each committed table, and fails at the first number that differs by more than it may.
pub(crate) fn check() -> Result<()> {
    let (tangents, function) = (loss_tangent::compute()?, scaling_function::compute()?);
    let compared = compare(loss_tangent::NAME, None, &tangents, |_, _| CLOSED_FORM)?
        + check_friction(&CONE)?
        + check_friction(&PARABOLOID)?
        + check_factors()?
        + check_resolutions()?
        + compare(scaling_function::NAME, None, &function, |_, _| CLOSED_FORM)?
        + scaling_function::check_against_the_half_space()?
        + check_outlines()?;
    println!("docs/figures: {compared} recomputed numbers agree");
    Ok(())
}

/// The file of a committed table.
fn committed(table: &str) -> PathBuf {
    let figures = Path::new(env!("CARGO_MANIFEST_DIR")).join("../docs/figures");
    figures.join(table).with_extension("csv")
}

/// A row of numbers by the names of their columns.
type Numbers = BTreeMap<String, f64>;

/// Compares recomputed rows with all rows of a committed table, or with the rows of the indices `chosen`. `tolerance` is given
/// a column and a recomputed row. Returns how many numbers were compared.
fn compare<R: Serialize>(
    name: &str,
    chosen: Option<&[usize]>,
    recomputed: &[R],
    tolerance: impl Fn(&str, &R) -> Tolerance,
) -> Result<usize> {
    let mut old: Vec<Numbers> = read_csv(&committed(name))?;
    let new: Vec<Numbers> = parse_csv(to_csv(recomputed)?.as_bytes())?;
    if let Some(chosen) = chosen {
        let rows = chosen.iter().map(|&row| old.get(row).cloned());
        let rows: Option<Vec<Numbers>> = rows.collect();
        old = rows.with_context(|| format!("{name}: {} rows", old.len()))?;
    }
    ensure!(old.len() == new.len(), "{name}: {} rows", old.len());
    let mut compared = 0;
    for ((old, new), row) in old.iter().zip(&new).zip(recomputed) {
        ensure!(old.keys().eq(new.keys()), "{name}: other columns");
        for ((column, old), new) in old.iter().zip(new.values()) {
            let allowed = match tolerance(column, row) {
                Tolerance::Relative(part) => part * old.abs(),
                Tolerance::Absolute(allowed) => allowed,
                Tolerance::Any => continue,
            };
            let off = (new - old).abs();
            ensure!(
                off <= allowed,
                "{name}: {column} of {old:?}, recomputed {new:e}, off by {off:e}, allowed {allowed:e}"
            );
            compared += 1;
        }
    }
    Ok(compared)
}

/// Recomputes the slowest, a middle and the fastest speed of an indenter, with the factor of the committed table.
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
    compare(indenter.name, Some(&chosen), &rows, tolerance)
}

/// The committed table of scaling factors.
fn committed_factors() -> Result<Vec<Row>> {
    read_csv(&committed(NAME))
}

/// The row of an exponent, if the table has it.
fn of_exponent(factors: &[Row], exponent: f64) -> Option<&Row> {
    factors
        .iter()
        .find(|row| row.exponent.total_cmp(&exponent).is_eq())
}

/// Recomputes the whole table of scaling factors. Biases are differences of numbers of the order of 1, so that their tolerance
/// is absolute; converged factors may differ within the committed error bars, which the solver promises.
fn check_factors() -> Result<usize> {
    let errors = committed_factors()?;
    let new = factors::compute()?;
    for row in &new {
        let off = (row.plain - row.paper).abs();
        let Row { plain, paper, .. } = row;
        ensure!(
            off <= PAPER_TOLERANCE,
            "{NAME}: the plain simulation gives {plain}, the paper {paper}, off by {off}, allowed {PAPER_TOLERANCE}"
        );
    }
    compare(NAME, None, &new, |column, row| match column {
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

/// Recomputes the coarser resolutions of both profiles.
fn check_resolutions() -> Result<usize> {
    /// Number of the coarsest resolutions of a profile that are recomputed. Chosen: finer ones take much longer.
    const RESOLUTIONS: usize = 3;
    let rows = resolution::compute(RESOLUTIONS)?;
    let of_paraboloid = resolution::COUNT..resolution::COUNT + RESOLUTIONS;
    let chosen: Vec<usize> = (0..RESOLUTIONS).chain(of_paraboloid).collect();
    compare(resolution::NAME, Some(&chosen), &rows, |_, _| SIMULATION)
}

/// Recomputes all outlines. Rounding may decide about single elements, so each point may move by one.
fn check_outlines() -> Result<usize> {
    let contacts = stationary::compute()?;
    let outlines = stationary::outlines(&contacts);
    compare(stationary::NAME, None, &outlines, |_, row| {
        Tolerance::Absolute(OUTLINE_TOLERANCE * row.element)
    })
}
