//! `measure-stationary`: how far the stationary solver can be trusted, and what it costs.

mod bodies;
mod error_bars;
mod growth;
mod speed;

use std::path::PathBuf;

use anyhow::Result;
use clap::{Args, ValueEnum};

use crate::output::{WrongInput, write_table};

/// What is measured, and how far.
#[derive(Debug, Args)]
pub(crate) struct MeasureStationary {
    /// Where the tables are written.
    #[arg(long, default_value = "target/stationary")]
    out: PathBuf,
    /// A dozen cheap cases and small grids only.
    #[arg(long)]
    quick: bool,
    /// Elements in contact on the largest grid of the table of growth, between 2e3 and 1e7.
    #[arg(long, default_value_t = 1e5, value_name = "N")]
    largest: f64,
    /// Table to make; may be given several times [default: all].
    #[arg(long = "table", value_enum, value_name = "TABLE")]
    tables: Vec<Table>,
}

/// One of the tables.
#[derive(Debug, Clone, Copy, PartialEq, Eq, ValueEnum)]
enum Table {
    /// Time and memory over the size of the grid.
    Growth,
    /// Time to an error, by the stationary solver and by the march in time.
    Speed,
    /// Error bars against much finer solutions.
    ErrorBars,
}

/// Elements in contact on the largest grid of a quick run.
const QUICK_LARGEST: f64 = 4e3;

/// Makes the tables asked for, writes them, and prints what they say.
pub(crate) fn measure(options: &MeasureStationary) -> Result<()> {
    if !(2e3..=1e7).contains(&options.largest) {
        let (range, given) = ("between 2e3 and 1e7", options.largest);
        return Err(WrongInput(format!("--largest must be {range}, but is {given}")).into());
    }
    let wanted = |table| options.tables.is_empty() || options.tables.contains(&table);
    // Growth comes first, because the memory that it reports is the largest that the process has had.
    if wanted(Table::Growth) {
        let largest = if options.quick {
            QUICK_LARGEST
        } else {
            options.largest
        };
        let rows = growth::compute(largest)?;
        write_table(&options.out.join("growth.csv"), &rows)?;
        println!("{}", growth::summary(&rows));
    }
    if wanted(Table::Speed) {
        let rows = speed::compute(options.quick)?;
        write_table(&options.out.join("speed.csv"), &rows)?;
        println!("{}", speed::summary(&rows));
    }
    if wanted(Table::ErrorBars) {
        let rows = error_bars::compute(options.quick)?;
        write_table(&options.out.join("error_bars.csv"), &rows)?;
        println!("{}", error_bars::summary(&rows));
    }
    Ok(())
}
