//! `scaling-factors`: the ratio s_p of the friction of the half space to that of the one-dimensional model.

mod table;

use std::time::Instant;

use anyhow::{Context, Result, bail};
use bem_halfspace::steady::RefinementOptions;
use clap::ValueEnum;
use numerics::Estimate;
use serde::Serialize;

use crate::output::WrongInput;
use crate::scene::{Scene, as_far_as_reached};
use crate::table::{Column, table_of, to_csv};
use crate::tasks::in_parallel;
pub(crate) use table::{Node, generate as generate_table};

/// Exponent of the profile from which on the elements are squares instead of half as wide as long. Chosen: from about there on
/// the contact is a thin crescent, as long across the sliding direction as along it.
const SQUARE_ELEMENTS_FROM: f64 = 4.0;
/// Largest number of unknown pressures of a factor that the command computes. Chosen; it bounds the time.
pub(crate) const MAX_UNKNOWNS: usize = 100_000;

/// Scaling factor s(p), and the effort of its computation.
#[derive(Serialize)]
pub(crate) struct ScalingFactor {
    exponent: f64,
    /// Ratio of the friction of the half space to that of the one-dimensional model.
    scaling_factor: f64,
    /// Absolute error bar.
    error: f64,
    /// Number of unknown pressures on the finest grid.
    unknowns: usize,
    /// Time on the wall clock \[s].
    seconds: f64,
}

impl ScalingFactor {
    /// Scaling factor s(p) with its error bar.
    pub(crate) fn value(&self) -> Estimate {
        Estimate::new(self.scaling_factor, self.error)
    }
}

/// How the factors are printed: as Markdown, or all their digits by name.
#[derive(Debug, Clone, Copy, Default, ValueEnum)]
pub(crate) enum Format {
    #[default]
    Table,
    Csv,
    Json,
}

/// Names and contents of the columns of the table that is printed.
const COLUMNS: [Column<ScalingFactor>; 5] = [
    ("p", |row| row.exponent.to_string()),
    ("s_p", |row| format!("{:.6}", row.scaling_factor)),
    ("error", |row| format!("{:.1e}", row.error)),
    ("unknowns", |row| row.unknowns.to_string()),
    ("seconds", |row| format!("{:.3}", row.seconds)),
];

/// Computes the factors s(p) of the given exponents and prints them.
pub(crate) fn print(exponents: &[f64], relative_error: f64, format: Format) -> Result<()> {
    validate(exponents, relative_error)?;
    let rows = in_parallel("scaling factors", exponents, |&exponent| {
        scaling_factor(exponent, relative_error, MAX_UNKNOWNS)
    })?;
    match format {
        Format::Table => println!("{}", table_of(&COLUMNS, rows)),
        Format::Csv => print!("{}", to_csv(&rows)?),
        Format::Json => println!("{}", serde_json::to_string_pretty(&rows)?),
    }
    Ok(())
}

/// Fails unless all exponents are above 1/2 and finite and the relative error is between 1e-6 and 0.1.
fn validate(exponents: &[f64], relative_error: f64) -> Result<(), WrongInput> {
    let outside = exponents.iter().find(|p| !(p.is_finite() && **p > 0.5));
    let problem = if let Some(p) = outside {
        format!(
            "--exponent must be finite and above 1/2, but is {p}: \
             for p <= 1/2 the friction integral of the one-dimensional model diverges at the apex"
        )
    } else if !(1e-6..=0.1).contains(&relative_error) {
        format!("--relative-error must be between 1e-6 and 0.1, but is {relative_error}")
    } else {
        return Ok(());
    };
    Err(WrongInput(problem))
}

/// Computes s_p to a relative error with at most about `max_unknowns` unknown pressures. If these do not suffice, fails with
/// the factor and the error that were reached.
pub(crate) fn scaling_factor(
    exponent: f64,
    relative_error: f64,
    max_unknowns: usize,
) -> Result<ScalingFactor> {
    let start = Instant::now();
    let scene = Scene::unit(exponent)?;
    let line = scene.theory()?.friction_coefficient;
    let options = RefinementOptions {
        relative_error,
        // The contact of a steep profile is a thin crescent, as long across the sliding direction as along it.
        aspect: match exponent {
            ..SQUARE_ELEMENTS_FROM => 0.5,
            _ => 1.0,
        },
        max_unknowns,
    };
    let half_space = scene.friction(&options);
    let finest = half_space
        .as_ref()
        .ok()
        .and_then(|found| found.refinements.last());
    let unknowns = finest.map(|finest| finest.unknowns);
    let friction = as_far_as_reached(half_space)
        .with_context(|| format!("scaling factor of p = {exponent}"))?;
    let (scaling_factor, error) = (friction.value / line, friction.error / line);
    let Some(unknowns) = unknowns else {
        bail!(
            "the scaling factor of p = {exponent} was not reached to the relative error {relative_error:e}: it is \
             {scaling_factor} with an error of {error:.1e}"
        )
    };
    Ok(ScalingFactor {
        exponent,
        scaling_factor,
        error,
        unknowns,
        seconds: start.elapsed().as_secs_f64(),
    })
}
