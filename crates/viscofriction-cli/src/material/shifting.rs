//! Isotherms onto one curve.

use anyhow::Result;
use rheology::fit::{
    Isotherm, MasterCurve, ModulusPoint, automatic_master_curve, shifted_master_curve,
};
use rheology::{ArrheniusShift, RheologyError, WlfShift};

use super::FitMaterial;
use super::table::{Measurements, Row, Table};
use viscofriction::WrongInput;

/// Isotherms on one curve.
pub(super) struct Shifted {
    pub(super) master: MasterCurve,
    /// The WLF law closest to the shifts, when there is one.
    pub(super) law: Option<WlfShift>,
}

const KELVIN_AT_ZERO_CELSIUS: f64 = 273.15;

/// The master curve of a table with several isotherms; `None` when there is only one.
pub(super) fn shifted(table: &Table, options: &FitMaterial) -> Result<Option<Shifted>> {
    let rows = match &table.measurements {
        Measurements::Oscillation(rows) => rows,
        Measurements::Relaxation(rows) if rows.iter().skip(1).any(|row| row.starts_isotherm) => {
            let message = "relaxation at several temperatures is not shifted: give a master curve";
            return Err(wrong(options, message).into());
        }
        Measurements::Relaxation(_) => return Ok(None),
    };
    let isotherms = isotherms(rows);
    if isotherms.len() < 2 {
        return Ok(None);
    }
    let reference = reference(&isotherms, options);
    let master = master_curve(&isotherms, reference, (table, options))
        .map_err(|error| wrong(options, &error.to_string()))?;
    Ok(Some(Shifted {
        law: WlfShift::through(&master.log10_factors, master.reference_temperature).ok(),
        master,
    }))
}

fn wrong(options: &FitMaterial, message: &str) -> WrongInput {
    WrongInput(format!("{}: {message}", options.data.display()))
}

/// Every isotherm with its mean temperature.
fn isotherms(rows: &[Row<ModulusPoint>]) -> Vec<Isotherm> {
    let groups = rows.chunk_by(|_, next| !next.starts_isotherm);
    groups
        .map(|group| {
            let temperatures = group.iter().filter_map(|row| row.temperature);
            Isotherm {
                temperature: temperatures.sum::<f64>() / group.len() as f64,
                points: group.iter().map(|row| row.point).collect(),
            }
        })
        .collect()
}

/// The temperature asked for; or that of the isotherm in the middle.
fn reference(isotherms: &[Isotherm], options: &FitMaterial) -> f64 {
    let mut temperatures: Vec<f64> = isotherms
        .iter()
        .map(|isotherm| isotherm.temperature)
        .collect();
    temperatures.sort_by(f64::total_cmp);
    let middle = temperatures[temperatures.len() / 2];
    options.reference_temperature.unwrap_or(middle)
}

fn master_curve(
    isotherms: &[Isotherm],
    reference: f64,
    (table, options): (&Table, &FitMaterial),
) -> Result<MasterCurve, RheologyError> {
    if let Some([c1, c2]) = options.wlf.as_deref() {
        let law = WlfShift::new([*c1, *c2], reference)?;
        return shifted_master_curve(isotherms, reference, |temperature| {
            law.log10_factor(temperature)
        });
    }
    if let Some(energy) = options.arrhenius {
        let zero = if table.celsius {
            KELVIN_AT_ZERO_CELSIUS
        } else {
            0.0
        };
        let law = ArrheniusShift::new(energy, reference + zero)?;
        return shifted_master_curve(isotherms, reference, |temperature| {
            law.log10_factor(temperature + zero)
        });
    }
    automatic_master_curve(isotherms, reference)
}
