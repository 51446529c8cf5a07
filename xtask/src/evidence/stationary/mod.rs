//! How far the stationary solver can be trusted, and what it costs.

mod error_bars;
mod growth;
mod speed;

use anyhow::Result;
use clap::{Args, ValueEnum};

use super::{Report, Table};
use crate::output::WrongInput;

/// What is measured, and how far.
#[derive(Debug, Args)]
pub(super) struct Options {
    /// Elements in contact on the largest grid of the table of growth, between 2e3 and 1e7.
    #[arg(long, default_value_t = LARGEST, value_name = "N")]
    largest: f64,
    /// Table to make; may be given several times [default: all].
    #[arg(long = "table", value_enum, value_name = "TABLE")]
    tables: Vec<Part>,
}

impl Default for Options {
    fn default() -> Self {
        Self {
            largest: LARGEST,
            tables: Vec::new(),
        }
    }
}

/// One of the tables.
#[derive(Debug, Clone, Copy, PartialEq, Eq, ValueEnum)]
enum Part {
    /// Time and memory over the size of the grid.
    Growth,
    /// Time to an error, by the stationary solver and by the march in time.
    Speed,
    /// Error bars against much finer solutions.
    ErrorBars,
}

/// Elements in contact on the largest grid, and on that of a quick run.
const LARGEST: f64 = 1e5;
const QUICK_LARGEST: f64 = 4e3;

/// Makes the tables asked for; a quick run takes a dozen cheap cases and small grids only.
pub(super) fn report(options: &Options, quick: bool) -> Result<Report> {
    let asked = options.largest;
    if !(2e3..=1e7).contains(&asked) {
        let problem = format!("--largest must be between 2e3 and 1e7, but is {asked}");
        return Err(WrongInput(problem).into());
    }
    let largest = if quick { QUICK_LARGEST } else { asked };
    let (mut tables, mut summaries) = (Vec::new(), Vec::new());
    // Growth comes first, because the memory that it reports is the largest that the process has had.
    for part in [Part::Growth, Part::Speed, Part::ErrorBars] {
        if !options.tables.is_empty() && !options.tables.contains(&part) {
            continue;
        }
        let (table, summary) = match part {
            Part::Growth => growth::measure(largest)?,
            Part::Speed => speed::measure(quick)?,
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
