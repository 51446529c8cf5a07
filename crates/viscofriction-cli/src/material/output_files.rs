//! The files that the command leaves behind.

use std::fmt::Write as _;

use anyhow::Result;
use rheology::fit::{ModulusPoint, RelaxationPoint};

use super::table::{Measurements, Table};
use super::{Fitted, picture};
use crate::output::{OutputFolder, to_csv};

/// All files that a fit may write.
pub(super) const NAMES: [&str; 5] = [
    "material.toml",
    "fit.csv",
    "fit.svg",
    "fit.png",
    "shifts.csv",
];

/// Columns of fit.csv: what was measured, the same of the series, and the relative error |G_fit/G − 1|.
const OSCILLATION: [&str; 6] = [
    "angular_frequency_rad_per_s",
    "storage_pa",
    "loss_pa",
    "storage_fit_pa",
    "loss_fit_pa",
    "relative_error",
];
const RELAXATION: [&str; 4] = ["time_s", "modulus_pa", "modulus_fit_pa", "relative_error"];

/// Measured against fitted, as rows of a table.
pub(super) struct Comparison {
    pub(super) names: &'static [&'static str],
    pub(super) rows: Vec<Vec<f64>>,
}

/// Writes material.toml, fit.csv, fit.svg and fit.png, and shifts.csv when isotherms were shifted.
pub(super) fn write(table: &Table, fitted: &Fitted<'_>, out: &OutputFolder) -> Result<()> {
    let comparison = compare(table, fitted)?;
    let rows = to_csv(comparison.names, &comparison.rows)?;
    out.write("fit.csv", &rows)?;
    out.draw("fit", &picture::figure(&comparison))?;
    if let Some(shifted) = &fitted.shifted {
        let names = ["temperature", "log10_shift_factor"];
        let shifts = to_csv(&names, &shifted.master.log10_factors)?;
        out.write("shifts.csv", &shifts)?;
    }
    // Last: with it the others are there.
    out.write("material.toml", material(fitted)?.as_bytes())
}

fn compare(table: &Table, fitted: &Fitted<'_>) -> Result<Comparison> {
    let spectrum = &fitted.found.spectrum;
    let oscillation = |point: &ModulusPoint| {
        let ModulusPoint {
            angular_frequency,
            storage,
            loss,
        } = *point;
        let fit = spectrum.complex_modulus(angular_frequency)?;
        let error = (fit.storage - storage).hypot(fit.loss - loss) / storage.hypot(loss);
        Ok(vec![
            angular_frequency,
            storage,
            loss,
            fit.storage,
            fit.loss,
            error,
        ])
    };
    let rows: Result<Vec<Vec<f64>>> = match (&fitted.shifted, &table.measurements) {
        (Some(shifted), _) => shifted.master.points.iter().map(oscillation).collect(),
        (None, Measurements::Oscillation(rows)) => {
            rows.iter().map(|row| oscillation(&row.point)).collect()
        }
        (None, Measurements::Relaxation(rows)) => {
            let row = |RelaxationPoint { time, modulus }: RelaxationPoint| {
                let fit = spectrum.relaxation_modulus(time)?;
                Ok(vec![time, modulus, fit, (fit / modulus - 1.0).abs()])
            };
            rows.iter().map(|measured| row(measured.point)).collect()
        }
    };
    let names = match &table.measurements {
        Measurements::Oscillation(_) => &OSCILLATION[..],
        Measurements::Relaxation(_) => &RELAXATION,
    };
    Ok(Comparison { names, rows: rows? })
}

/// The table `[material.prony]` of a scene file.
pub(super) fn material(fitted: &Fitted<'_>) -> Result<String> {
    let spectrum = &fitted.found.spectrum;
    let mut text = String::new();
    writeln!(
        text,
        "# {}: {}",
        fitted.options.data.display(),
        fitted.summary()
    )?;
    if let Some(shifted) = &fitted.shifted {
        writeln!(
            text,
            "# at the temperature {}",
            shifted.master.reference_temperature
        )?;
        if let Some([c1, c2]) = shifted.law.map(|law| law.constants()) {
            writeln!(
                text,
                "# WLF law closest to the shifts: C1 = {c1:.4}, C2 = {c2:.4} K"
            )?;
        }
    }
    writeln!(text, "[material.prony]")?;
    writeln!(
        text,
        "equilibrium_modulus = {:?}",
        spectrum.equilibrium_modulus()
    )?;
    writeln!(text, "poisson_ratio = {:?}", fitted.options.poisson_ratio)?;
    writeln!(text, "branches = [")?;
    for branch in spectrum.branches() {
        let (modulus, time) = (branch.modulus, branch.relaxation_time);
        writeln!(
            text,
            "    {{ modulus = {modulus:?}, relaxation_time = {time:?} }},"
        )?;
    }
    writeln!(text, "]")?;
    Ok(text)
}
