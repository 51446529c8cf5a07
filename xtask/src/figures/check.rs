//! `reproduce-figures --check`: recomputes a part of the committed data.

use std::path::{Path, PathBuf};

use anyhow::{Context, Result, ensure};

use crate::figures::friction_over_speed::{self, Indenter, SPEEDS};
use crate::figures::{factors, loss_tangent, scaling_function, stationary};
use crate::output::read_csv;
use crate::progress;
use crate::scaling::scaling_factor;

/// Closed forms differ by rounding only.
const CLOSED_FORM_TOLERANCE: f64 = 1e-12;
/// Simulations stop at a relative residual of 1e-9, and transforms round differently from processor to processor.
const SIMULATION_TOLERANCE: f64 = 1e-6;
/// The plain simulation reproduces the paper's factors to the digits the paper gives, and its last one doubtful.
const PAPER_TOLERANCE: f64 = 0.02;
/// An error bar is a difference of numbers that round.
const ERROR_TOLERANCE: f64 = 1e-3;
/// Elements by which the outline of a contact may move, and a little for rounding.
const OUTLINE_TOLERANCE: f64 = 1.001;

pub(crate) fn check() -> Result<()> {
    let folder = committed();
    let bar = progress::bar("comparing", 6);
    let mut compared = check_loss_tangent(&folder)?;
    bar.inc(1);
    for indenter in [Indenter::Cone, Indenter::Paraboloid] {
        compared += check_friction(&folder, indenter)?;
        bar.inc(1);
    }
    compared += check_factors(&folder)?;
    bar.inc(1);
    compared += check_scaling_function(&folder)?;
    bar.inc(1);
    compared += check_outlines(&folder)?;
    bar.finish_and_clear();
    println!("docs/figures: {compared} recomputed numbers agree");
    Ok(())
}

fn committed() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("../docs/figures")
}

fn compare(what: &str, [committed, recomputed]: [f64; 2], tolerance: f64) -> Result<()> {
    let difference = (recomputed - committed).abs();
    let allowed = tolerance * committed.abs();
    ensure!(
        difference <= allowed,
        "{what}: committed {committed:e}, recomputed {recomputed:e}, off by {difference:e}, allowed {allowed:e}"
    );
    Ok(())
}

fn check_loss_tangent(folder: &Path) -> Result<usize> {
    let committed: Vec<loss_tangent::Row> = read_csv(&folder.join(loss_tangent::FILE))?;
    let recomputed = loss_tangent::compute()?;
    ensure!(
        committed.len() == recomputed.len(),
        "{}: {} rows",
        loss_tangent::FILE,
        committed.len()
    );
    for (line, (old, new)) in committed.iter().zip(&recomputed).enumerate() {
        for (name, old, new) in [
            (
                "frequency",
                old.dimensionless_frequency,
                new.dimensionless_frequency,
            ),
            (
                "tan δ, γ = 1/1000",
                old.loss_tangent_gamma_0_001,
                new.loss_tangent_gamma_0_001,
            ),
            (
                "tan δ, γ = 1/100",
                old.loss_tangent_gamma_0_01,
                new.loss_tangent_gamma_0_01,
            ),
            (
                "tan δ, γ = 1/10",
                old.loss_tangent_gamma_0_1,
                new.loss_tangent_gamma_0_1,
            ),
            (
                "10 G'/G₂",
                old.scaled_storage_modulus,
                new.scaled_storage_modulus,
            ),
            (
                "10 G''/G₂",
                old.scaled_loss_modulus,
                new.scaled_loss_modulus,
            ),
        ] {
            let what = format!("{} row {}: {name}", loss_tangent::FILE, line + 1);
            compare(&what, [old, new], CLOSED_FORM_TOLERANCE)?;
        }
    }
    Ok(6 * committed.len())
}

/// The slowest, a middle and the fastest speed; the factor is that of the committed table.
fn check_friction(folder: &Path, indenter: Indenter) -> Result<usize> {
    let committed: Vec<friction_over_speed::Row> = read_csv(&folder.join(indenter.file()))?;
    ensure!(
        committed.len() == SPEEDS as usize,
        "{}: {} rows",
        indenter.file(),
        committed.len()
    );
    let factor = committed_factor(folder, indenter.exponent())?.converged;
    let mut compared = 0;
    for speed in [0, SPEEDS / 2, SPEEDS - 1] {
        let old = &committed[speed as usize];
        let new = friction_over_speed::row(indenter, speed, factor)?;
        let what = format!("{} row {}", indenter.file(), speed + 1);
        for (columns, tolerance) in [
            (
                old.closed_forms().into_iter().zip(new.closed_forms()),
                CLOSED_FORM_TOLERANCE,
            ),
            (
                old.simulated().into_iter().zip(new.simulated()),
                SIMULATION_TOLERANCE,
            ),
        ] {
            for ((name, old), (_, new)) in columns {
                compare(&format!("{what}: {name}"), [old, new], tolerance)?;
                compared += 1;
            }
        }
    }
    Ok(compared)
}

fn committed_factor(folder: &Path, exponent: f64) -> Result<factors::Row> {
    let rows: Vec<factors::Row> = read_csv(&folder.join(factors::FILE))?;
    let same = |row: &factors::Row| row.exponent.total_cmp(&exponent).is_eq();
    rows.into_iter()
        .find(same)
        .with_context(|| format!("{}: no row for p = {exponent}", factors::FILE))
}

/// The whole table: the simulation, its biases, and the converged factors within the committed error bars.
fn check_factors(folder: &Path) -> Result<usize> {
    for &(exponent, paper) in &factors::PAPER {
        let old = committed_factor(folder, exponent)?;
        let new = factors::row(
            exponent,
            paper,
            scaling_factor(exponent, factors::RELATIVE_ERROR)?,
        )?;
        let name = format!("{}, p = {exponent}", factors::FILE);
        let [before, now] = [&old, &new].map(|row| {
            let mean_slope = row.plain + row.time_level_bias;
            [row.plain, mean_slope, mean_slope + row.distance_bias]
        });
        for ((what, old), new) in ["plain", "with the mean slope", "at infinite distance"]
            .iter()
            .zip(before)
            .zip(now)
        {
            compare(&format!("{name}: {what}"), [old, new], SIMULATION_TOLERANCE)?;
        }
        compare(
            &format!("{name}: error bar of the converged value"),
            [old.error, new.error],
            ERROR_TOLERANCE,
        )?;
        let bar = old.error / old.converged;
        compare(
            &format!("{name}: converged, within its error bar"),
            [old.converged, new.converged],
            bar,
        )?;
        let off = (new.plain - paper).abs();
        ensure!(
            off <= PAPER_TOLERANCE,
            "{name}: the plain simulation gives {}, the paper {paper}, off by {off}, allowed {PAPER_TOLERANCE}",
            new.plain
        );
    }
    Ok(6 * factors::PAPER.len())
}

/// The curve against the table it was drawn from, and the table against the half space.
fn check_scaling_function(folder: &Path) -> Result<usize> {
    let name = scaling_function::FILE;
    let committed: Vec<scaling_function::Row> = read_csv(&folder.join(name))?;
    let recomputed = scaling_function::compute()?;
    ensure!(
        committed.len() == recomputed.len(),
        "{name}: {} rows",
        committed.len()
    );
    for (line, (old, new)) in committed.iter().zip(&recomputed).enumerate() {
        for (column, pair) in [
            ("exponent", [old.exponent, new.exponent]),
            ("s(p)", [old.scaling_factor, new.scaling_factor]),
            ("error", [old.error, new.error]),
        ] {
            compare(
                &format!("{name} row {}: {column}", line + 1),
                pair,
                CLOSED_FORM_TOLERANCE,
            )?;
        }
    }
    Ok(3 * committed.len() + scaling_function::check_against_the_half_space()?)
}

/// All outlines. Rounding may decide about single elements, so each point may move by one.
fn check_outlines(folder: &Path) -> Result<usize> {
    let committed: Vec<stationary::Row> = read_csv(&folder.join(stationary::FILE))?;
    let contacts = stationary::compute()?;
    let recomputed: Vec<_> = contacts
        .iter()
        .flat_map(|contact| &contact.outline)
        .collect();
    ensure!(
        committed.len() == recomputed.len(),
        "{}: {} rows instead of {}",
        stationary::FILE,
        committed.len(),
        recomputed.len()
    );
    for (line, (old, new)) in committed.iter().zip(recomputed).enumerate() {
        let moved = [(old.y, new.y), (old.rear, new.rear), (old.front, new.front)]
            .map(|(old, new)| (old - new).abs())
            .into_iter()
            .fold((old.exponent - new.exponent).abs(), f64::max);
        ensure!(
            moved <= OUTLINE_TOLERANCE * new.element,
            "{} row {}: committed {old:?}, recomputed {new:?}",
            stationary::FILE,
            line + 1
        );
    }
    Ok(3 * committed.len())
}
