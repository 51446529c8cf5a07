//! How far the stationary solver can be trusted, and what it costs.

mod error_bars;
mod growth;

use anyhow::{Result, ensure};
use clap::{Args, ValueEnum};

use super::{Report, Table};
use crate::output::WrongInput;

/// What is measured, and how far.
#[derive(Debug, Default, Args)]
pub(super) struct Options {
    /// Elements in contact on the largest grid of the table of growth, between 2e3 and 1e7 [default: 1e5, quick 4e3].
    #[arg(long, value_name = "N")]
    largest: Option<f64>,
    /// Table to make; may be given several times [default: all].
    #[arg(long = "table", value_enum, value_name = "TABLE")]
    tables: Vec<Part>,
}

/// One of the tables.
#[derive(Debug, Clone, Copy, PartialEq, Eq, ValueEnum)]
enum Part {
    /// Time and memory over the size of the grid.
    Growth,
    /// Error bars against much finer solutions.
    ErrorBars,
}

/// Elements in contact on the largest grid, and on that of a quick run.
const LARGEST: f64 = 1e5;
const QUICK_LARGEST: f64 = 4e3;

/// Makes the tables asked for; a quick run takes a dozen cheap cases and small grids only.
pub(super) fn report(options: &Options, quick: bool) -> Result<Report> {
    let usual = if quick { QUICK_LARGEST } else { LARGEST };
    let largest = options.largest.unwrap_or(usual);
    let wrong = format!("--largest must be between 2e3 and 1e7, but is {largest}");
    ensure!((2e3..=1e7).contains(&largest), WrongInput(wrong));
    let (mut tables, mut summaries) = (Vec::new(), Vec::new());
    // Growth comes first, because the memory that it reports is the largest that the process has had.
    for part in [Part::Growth, Part::ErrorBars] {
        if !options.tables.is_empty() && !options.tables.contains(&part) {
            continue;
        }
        let (table, summary) = match part {
            Part::Growth => growth::measure(largest)?,
            Part::ErrorBars => error_bars::measure(quick)?,
        };
        tables.push(table);
        summaries.push(summary);
    }
    Ok(Report {
        name: "stationary",
        tables,
        pictures: Vec::new(),
        summary: summaries.join("\n\n"),
        failure: None,
    })
}
