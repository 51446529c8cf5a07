//! `reproduce-figures`: everything the paper shows, from computations by three methods.

mod approach;
mod chain;
mod check;
mod contact_maps;
mod factors;
mod friction_over_speed;
mod loss_tangent;
mod resolution;
mod scaling_function;
mod stationary;

use std::path::Path;

use anyhow::Result;
use serde::Serialize;
use viscofriction_plot::Figure;

use crate::output::{make_folder, write_figure};
use crate::table::Table;

pub(crate) use check::check;
use friction_over_speed::{CONE, PARABOLOID};

/// A part of the paper: a table and the pictures that are drawn from it.
struct Part {
    table: Table,
    /// Names of the files, without extension, and what they show.
    pictures: Vec<(&'static str, Figure)>,
}

impl Part {
    /// The part with a table of this name.
    fn new<R: Serialize>(
        table: &'static str,
        rows: &[R],
        pictures: impl Into<Vec<(&'static str, Figure)>>,
    ) -> Result<Self> {
        Ok(Self {
            table: Table::new(table, rows)?,
            pictures: pictures.into(),
        })
    }
}

/// Computes all figures and writes data and pictures into `out`.
pub(crate) fn reproduce(out: &Path) -> Result<()> {
    make_folder(out)?;
    let start = std::time::Instant::now();
    let factors = factors::compute()?;
    let parts = [
        loss_tangent::part()?,
        friction_over_speed::part(&CONE, &factors[0])?,
        friction_over_speed::part(&PARABOLOID, &factors[1])?,
        Part::new(factors::NAME, &factors, [])?,
        approach::part(&factors)?,
        scaling_function::part()?,
        stationary::part()?,
        resolution::part(&factors)?,
    ];
    for Part { table, pictures } in parts {
        table.write(out)?;
        for (name, figure) in pictures {
            write_figure(out, name, &figure)?;
        }
    }
    let seconds = start.elapsed().as_secs_f64();
    println!("{} written in {seconds:.1} s", out.display());
    Ok(())
}
