//! `reproduce-figures`: everything the paper shows, from computations by three methods.

mod approach;
mod check;
mod contact_maps;
mod factors;
mod friction_over_speed;
mod loss_tangent;
mod pictures;
mod report;
mod resolution;
mod scaling_function;
mod stationary;

use std::path::Path;

use anyhow::Result;

use crate::output::{make_folder, to_csv, write_atomically, write_figure};
use crate::scaling::Node;
use friction_over_speed::{CONE, PARABOLOID};

pub(crate) use check::check;

/// The data of all figures.
struct Data {
    loss_tangent: Vec<loss_tangent::Row>,
    cone: Vec<friction_over_speed::Row>,
    paraboloid: Vec<friction_over_speed::Row>,
    factors: Vec<factors::Row>,
    resolution: Vec<resolution::Row>,
    approach: [approach::Approach; 2],
    scaling_function: Vec<Node>,
    contacts: Vec<stationary::Contact>,
}

/// Computes all figures and writes data, pictures and report into `out`.
pub(crate) fn reproduce(out: &Path) -> Result<()> {
    make_folder(out)?;
    let start = std::time::Instant::now();
    let factors = factors::compute()?;
    let data = Data {
        loss_tangent: loss_tangent::compute()?,
        cone: friction_over_speed::compute(&CONE, &factors[0])?,
        paraboloid: friction_over_speed::compute(&PARABOLOID, &factors[1])?,
        approach: [
            approach::compute(&factors[0])?,
            approach::compute(&factors[1])?,
        ],
        scaling_function: scaling_function::compute()?,
        contacts: stationary::compute()?,
        resolution: resolution::compute(resolution::COUNT)?,
        factors,
    };
    let tables = tables(&data)?;
    for (name, table) in &tables {
        write_atomically(&out.join(name), table.as_bytes())?;
    }
    let mut pictures = Vec::new();
    for (name, figure) in pictures::all(&data) {
        pictures.push((name, write_figure(out, name, &figure)?));
    }
    let page = out.join("report.html");
    write_atomically(&page, report::html(&tables, &pictures)?.as_bytes())?;
    let seconds = start.elapsed().as_secs_f64();
    println!("{} written in {seconds:.1} s", page.display());
    Ok(())
}

/// File names and contents.
fn tables(data: &Data) -> Result<[(&'static str, String); 8]> {
    let outlines = data.contacts.iter().flat_map(|contact| &contact.outline);
    let approach = data.approach.iter().flat_map(|approach| &approach.rows);
    Ok([
        (loss_tangent::FILE, to_csv(&data.loss_tangent)?),
        (CONE.file, to_csv(&data.cone)?),
        (PARABOLOID.file, to_csv(&data.paraboloid)?),
        (factors::FILE, to_csv(&data.factors)?),
        (resolution::FILE, to_csv(&data.resolution)?),
        (scaling_function::FILE, to_csv(&data.scaling_function)?),
        ("approach.csv", to_csv(&approach.collect::<Vec<_>>())?),
        (stationary::FILE, to_csv(&outlines.collect::<Vec<_>>())?),
    ])
}
