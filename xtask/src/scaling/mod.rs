//! `scaling-factors`: the ratio s_p of the friction of the half space to that of the one-dimensional model.

mod converged;
mod table;

use anyhow::Result;
use clap::ValueEnum;
use comfy_table::Table;
use serde::Serialize;

use crate::output::{WrongInput, markdown_table, to_csv};
use crate::tasks::in_parallel;
pub(crate) use converged::{MAX_UNKNOWNS, scaling_factor};
pub(crate) use table::{Node, generate as generate_table};

/// How the factors are printed.
#[derive(Debug, Clone, Copy, ValueEnum)]
pub(crate) enum Format {
    Table,
    Csv,
    Json,
}

#[derive(Debug, Serialize)]
struct Row {
    exponent: f64,
    scaling_factor: f64,
    error: f64,
    unknowns: usize,
    seconds: f64,
}

/// Computes the factors and prints them as they are asked for.
pub(crate) fn print(exponents: &[f64], relative_error: f64, format: Format) -> Result<()> {
    let exponents = if exponents.is_empty() {
        &[1.0, 2.0]
    } else {
        exponents
    };
    validate(exponents, relative_error)?;
    let rows = in_parallel("scaling factors", exponents, |&exponent| {
        timed(exponent, relative_error)
    })?;
    match format {
        Format::Table => println!("{}", table(&rows)),
        Format::Csv => print!("{}", to_csv(&rows)?),
        Format::Json => println!("{}", serde_json::to_string_pretty(&rows)?),
    }
    Ok(())
}

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

fn timed(exponent: f64, relative_error: f64) -> Result<Row> {
    let start = std::time::Instant::now();
    let factor = scaling_factor(exponent, relative_error, MAX_UNKNOWNS)?;
    Ok(Row {
        exponent,
        scaling_factor: factor.friction_ratio.value,
        error: factor.friction_ratio.error,
        unknowns: factor.unknowns,
        seconds: start.elapsed().as_secs_f64(),
    })
}

fn table(rows: &[Row]) -> Table {
    let lines = rows.iter().map(|row| {
        [
            row.exponent.to_string(),
            format!("{:.6}", row.scaling_factor),
            format!("{:.1e}", row.error),
            row.unknowns.to_string(),
            format!("{:.3}", row.seconds),
        ]
    });
    markdown_table(["p", "s_p", "error", "unknowns", "seconds"], lines)
}
