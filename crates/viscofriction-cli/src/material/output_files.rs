//! The files that the command leaves behind.

use std::fmt::Write as _;

use anyhow::Result;
use serde::Serialize;

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

/// Measured and fitted moduli at one frequency.
#[derive(Debug, Serialize)]
pub(super) struct ModulusRow {
    pub(super) angular_frequency_rad_per_s: f64,
    pub(super) storage_pa: f64,
    pub(super) loss_pa: f64,
    pub(super) storage_fit_pa: f64,
    pub(super) loss_fit_pa: f64,
    /// |G*_fit/G* − 1|
    pub(super) relative_error: f64,
}

/// Measured and fitted modulus at one time.
#[derive(Debug, Serialize)]
pub(super) struct RelaxationRow {
    pub(super) time_s: f64,
    pub(super) modulus_pa: f64,
    pub(super) modulus_fit_pa: f64,
    pub(super) relative_error: f64,
}

#[derive(Debug, Serialize)]
struct ShiftRow {
    temperature: f64,
    log10_shift_factor: f64,
}

/// Measured against fitted, as rows of a table.
pub(super) enum Comparison {
    Oscillation(Vec<ModulusRow>),
    Relaxation(Vec<RelaxationRow>),
}

/// Writes material.toml, fit.csv, fit.svg and fit.png, and shifts.csv when isotherms were shifted.
pub(super) fn write(table: &Table, fitted: &Fitted<'_>, out: &OutputFolder) -> Result<()> {
    let comparison = compare(table, fitted)?;
    let rows = match &comparison {
        Comparison::Oscillation(rows) => to_csv(rows)?,
        Comparison::Relaxation(rows) => to_csv(rows)?,
    };
    out.write("fit.csv", rows.as_bytes())?;
    out.draw("fit", &picture::figure(&comparison))?;
    if let Some(shifted) = &fitted.shifted {
        let shifts = shifted.master.log10_factors.iter();
        let shifts: Vec<ShiftRow> = shifts
            .map(|&[temperature, log10_shift_factor]| ShiftRow {
                temperature,
                log10_shift_factor,
            })
            .collect();
        out.write("shifts.csv", to_csv(&shifts)?.as_bytes())?;
    }
    // Last: with it the others are there.
    out.write("material.toml", material(fitted)?.as_bytes())
}

fn compare(table: &Table, fitted: &Fitted<'_>) -> Result<Comparison> {
    let spectrum = &fitted.found.spectrum;
    let modulus_row = |point: &rheology::fit::ModulusPoint| {
        let fit = spectrum.complex_modulus(point.angular_frequency)?;
        let error = (fit.storage - point.storage).hypot(fit.loss - point.loss);
        Ok(ModulusRow {
            angular_frequency_rad_per_s: point.angular_frequency,
            storage_pa: point.storage,
            loss_pa: point.loss,
            storage_fit_pa: fit.storage,
            loss_fit_pa: fit.loss,
            relative_error: error / point.storage.hypot(point.loss),
        })
    };
    Ok(match (&fitted.shifted, &table.measurements) {
        (Some(shifted), _) => {
            let rows = shifted.master.points.iter().map(modulus_row);
            Comparison::Oscillation(rows.collect::<Result<_>>()?)
        }
        (None, Measurements::Oscillation(rows)) => {
            let rows = rows.iter().map(|row| modulus_row(&row.point));
            Comparison::Oscillation(rows.collect::<Result<_>>()?)
        }
        (None, Measurements::Relaxation(rows)) => {
            let rows = rows.iter().map(|row| {
                let fit = spectrum.relaxation_modulus(row.point.time)?;
                Ok(RelaxationRow {
                    time_s: row.point.time,
                    modulus_pa: row.point.modulus,
                    modulus_fit_pa: fit,
                    relative_error: (fit / row.point.modulus - 1.0).abs(),
                })
            });
            Comparison::Relaxation(rows.collect::<Result<_>>()?)
        }
    })
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
