//! `reproduce-figures`: everything the paper shows, from computations by three methods.

mod approach;
mod check;
mod contact_maps;
mod factors;
mod friction_over_speed;
mod loss_tangent;
mod pictures;
mod report;
mod scaling_function;
mod stationary;

use std::path::Path;

use anyhow::Result;

use crate::output::{WrongInput, to_csv, write_atomically, write_drawing};
use friction_over_speed::Indenter;

pub(crate) use check::check;
use pictures::Picture;

/// The data of all figures.
#[derive(Debug)]
struct Data {
    loss_tangent: Vec<loss_tangent::Row>,
    cone: Vec<friction_over_speed::Row>,
    paraboloid: Vec<friction_over_speed::Row>,
    factors: Vec<factors::Row>,
    approach: [approach::Approach; 2],
    scaling_function: Vec<scaling_function::Row>,
    contacts: Vec<stationary::Contact>,
}

/// Computes all figures and writes data, pictures and report into `out`.
pub(crate) fn reproduce(out: &Path) -> Result<()> {
    std::fs::create_dir_all(out)
        .map_err(|error| WrongInput(format!("--out {} cannot be made: {error}", out.display())))?;
    let start = std::time::Instant::now();
    let factors = factors::compute()?;
    let data = Data {
        loss_tangent: loss_tangent::compute()?,
        cone: friction_over_speed::compute(Indenter::Cone, &factors[0])?,
        paraboloid: friction_over_speed::compute(Indenter::Paraboloid, &factors[1])?,
        approach: [
            approach::compute(&factors[0])?,
            approach::compute(&factors[1])?,
        ],
        scaling_function: scaling_function::compute()?,
        contacts: stationary::compute()?,
        factors,
    };
    write_data(&data, out)?;
    let pictures = pictures::all(&data)?;
    for Picture { name, drawing, .. } in &pictures {
        write_drawing(out, name, drawing)?;
    }
    write_atomically(
        &out.join("report.html"),
        report::html(&data, &pictures)?.as_bytes(),
    )?;
    println!(
        "{} written in {:.1} s",
        out.join("report.html").display(),
        start.elapsed().as_secs_f64()
    );
    Ok(())
}

fn write_data(data: &Data, out: &Path) -> Result<()> {
    let outlines = data.contacts.iter().flat_map(|contact| &contact.outline);
    for (name, table) in [
        (loss_tangent::FILE, to_csv(&data.loss_tangent)?),
        (Indenter::Cone.file(), to_csv(&data.cone)?),
        (Indenter::Paraboloid.file(), to_csv(&data.paraboloid)?),
        (factors::FILE, to_csv(&data.factors)?),
        (scaling_function::FILE, to_csv(&data.scaling_function)?),
        (
            "approach.csv",
            to_csv(&[&data.approach[0].rows[..], &data.approach[1].rows].concat())?,
        ),
        (stationary::FILE, to_csv(&outlines.collect::<Vec<_>>())?),
    ] {
        write_atomically(&out.join(name), table.as_bytes())?;
    }
    Ok(())
}
