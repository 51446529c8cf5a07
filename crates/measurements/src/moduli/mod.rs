//! Reader of tables of measured moduli, and their master curves.
//!
//! [`measured_moduli`] groups the rows of all tables of a file into isotherms; [`master_curve`] shifts these.

mod isotherms;
mod names;
mod shifting;

use std::f64::consts::FRAC_PI_2;
use std::path::Path;

use numerics::in_range;
use rheology::InvalidParameter;
use rheology::fit::{CreepPoint, Isotherm, ModulusPoint, RelaxationPoint, relaxation_of_creep};

use crate::MeasurementError;
pub use crate::table::Deformation;
use crate::table::Quantity::{
    Creep, Loss, LossFactor, Magnitude, Phase, Set, Storage, Temperature, Time,
};
use crate::table::{Column, Line, Meaning, Source, Table, text_of};
use isotherms::{Group, IsothermRow, insert};
pub(crate) use names::MODULI;
pub use shifting::{Shifted, Shifting, master_curve};

/// Measured moduli in SI units, converted to shear.
#[derive(Debug, Clone, PartialEq)]
#[must_use]
pub struct MeasuredModuli {
    /// Moduli over frequency or over time.
    pub measurements: Measurements,
    /// Whether temperatures are in °C rather than in K; `None` for a table without temperatures.
    pub celsius: Option<bool>,
}

/// Moduli over frequency or over time.
#[derive(Debug, Clone, PartialEq)]
pub enum Measurements {
    /// Isotherms in the order of the table; without temperatures there is one, whose temperature is meaningless.
    Oscillation(Vec<Isotherm>),
    /// Relaxation modulus at increasing times; a creep compliance is converted.
    Relaxation(Vec<RelaxationPoint>),
}

/// Information that a table of moduli does not contain.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct TableOptions {
    /// Ratio G/E > 0; see [`shear_per_tension`].
    pub shear_per_tension: f64,
    /// Deformation of moduli with neither E nor G in their names.
    pub deformation: Option<Deformation>,
}

/// Ratio G/E = 1/(2 (1 + ν)) at a constant Poisson ratio.
///
/// # Errors
/// [`InvalidParameter`] when the Poisson ratio is not greater than −1 and at most 0.5.
pub fn shear_per_tension(poisson_ratio: f64) -> Result<f64, InvalidParameter> {
    let holds = poisson_ratio > -1.0 && poisson_ratio <= 0.5;
    let allowed = "greater than -1 and at most 0.5";
    in_range("poisson_ratio", poisson_ratio, holds, allowed)?;
    Ok(0.5 / (1.0 + poisson_ratio))
}

/// Reads moduli from the contents of a file: tables with a line of names each, among other text.
///
/// The path is used for messages only.
///
/// # Errors
/// [`MeasurementError`] with file, line and column.
pub fn measured_moduli(
    file: &Path,
    contents: &[u8],
    options: &TableOptions,
) -> Result<MeasuredModuli, MeasurementError> {
    let text = text_of(contents, &MODULI);
    let scale = |column: &Column| match column.deformation {
        Some(Deformation::Tension) if column.quantity == Creep => options.shear_per_tension.recip(),
        Some(Deformation::Tension) => options.shear_per_tension,
        _ => 1.0,
    };
    let meaning = Meaning {
        deformation: options.deformation,
        scale: &scale,
    };
    let source = Source::new(file, &text, &MODULI, meaning);
    let tables = source.tables()?;
    let kind = Kind::of(&tables[0].0);
    let mut groups = Vec::new();
    for (table, rows) in &tables {
        if Kind::of(table) != kind {
            let problem =
                "in all tables of a file the same must be measured, with temperatures in one unit";
            return Err(source.wrong_line(table.line, &problem));
        }
        for line in rows {
            insert(&mut groups, row(table, line)?)
                .map_err(|problem| table.wrong_first(line, problem))?;
        }
    }
    let n_rows: usize = groups.iter().map(|group| group.rows.len()).sum();
    if n_rows < 2 {
        let needed = "at least 2 measurements are needed after the names and units";
        return Err(source.wrong_end(&format!("{needed}, but there are {n_rows}")));
    }
    Ok(MeasuredModuli {
        measurements: measurements(&source, groups, kind)?,
        celsius: kind.celsius,
    })
}

/// Kind of measurement, which all tables of a file must have in common.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
struct Kind {
    /// Whether the variable is the time rather than a frequency.
    is_relaxation: bool,
    /// Whether the quantity measured over time is a compliance.
    is_creep: bool,
    /// Whether temperatures are in °C; `None` without temperatures.
    celsius: Option<bool>,
}

impl Kind {
    /// Kind of measurement in a table, as its columns show it.
    fn of(table: &Table) -> Self {
        let temperature = table.find(Temperature);
        Self {
            is_relaxation: table.needed[0] == Time,
            is_creep: table.needed.contains(&Creep),
            celsius: temperature.map(|column| column.unit != "K"),
        }
    }
}

/// The measurement of a line, in SI units and in shear. From one modulus and tan δ, or the phase angle δ, follow G' and G''.
fn row(table: &Table, line: &Line) -> Result<IsothermRow, MeasurementError> {
    let numbers = table.positives(line)?;
    let [first, last] = [numbers[1], numbers[numbers.len() - 1]];
    let [quantity, angle] = [table.needed[1], table.needed[table.needed.len() - 1]];
    let loss_factor = match angle {
        Phase if last < FRAC_PI_2 => last.tan(),
        Phase => return Err(table.wrong_in(line, Phase, "a phase angle below 90° = 1.5708 rad")),
        _ => last,
    };
    let moduli = match (quantity, angle) {
        (Storage, LossFactor | Phase) => [first, first * loss_factor],
        (Loss, LossFactor | Phase) => [first / loss_factor, first],
        (Magnitude, _) => {
            let storage = first / 1.0_f64.hypot(loss_factor);
            [storage, storage * loss_factor]
        }
        _ => [first, last],
    };
    Ok(IsothermRow {
        line: line.number,
        at: numbers[0],
        moduli,
        temperature: table.temperature(line)?,
        set: table.optional(line, Set)?,
    })
}

/// The groups as isotherms, or as one relaxation curve, to which a creep compliance is converted. Refuses relaxation at several
/// temperatures.
fn measurements(
    source: &Source,
    groups: Vec<Group>,
    kind: Kind,
) -> Result<Measurements, MeasurementError> {
    if !kind.is_relaxation {
        let isotherms = groups.into_iter().map(isotherm).collect();
        return Ok(Measurements::Oscillation(isotherms));
    }
    if let Some(second) = groups.get(1) {
        let problem = "relaxation at several temperatures is not shifted: give a master curve";
        return Err(source.wrong_line(second.line, &problem));
    }
    let rows = groups
        .into_iter()
        .flat_map(|group| group.rows.into_values());
    if kind.is_creep {
        let point = |IsothermRow { at, moduli, .. }: IsothermRow| CreepPoint {
            time: at,
            compliance: moduli[0],
        };
        let points: Vec<CreepPoint> = rows.map(point).collect();
        let points = relaxation_of_creep(&points).map_err(|problem| source.wrong_end(&problem))?;
        return Ok(Measurements::Relaxation(points));
    }
    let point = |IsothermRow { at, moduli, .. }: IsothermRow| RelaxationPoint {
        time: at,
        modulus: moduli[0],
    };
    Ok(Measurements::Relaxation(rows.map(point).collect()))
}

/// The isotherm of a group, at the mean of its temperatures.
fn isotherm(group: Group) -> Isotherm {
    let point = |IsothermRow { at, moduli, .. }: IsothermRow| ModulusPoint {
        angular_frequency: at,
        storage: moduli[0],
        loss: moduli[1],
    };
    Isotherm {
        temperature: mean(&group.temperatures),
        points: group.rows.into_values().map(point).collect(),
    }
}

/// Mean, rounded to the decimals of the numbers; 0 without numbers.
fn mean(numbers: &[f64]) -> f64 {
    if numbers.is_empty() {
        return 0.0;
    }
    let decimals = |number: &f64| {
        number
            .to_string()
            .split_once('.')
            .map_or(0, |parts| parts.1.len())
    };
    let most = numbers.iter().map(decimals).max().unwrap_or(0);
    let mean = numbers.iter().sum::<f64>() / numbers.len() as f64;
    format!("{mean:.most$}").parse().unwrap_or(mean)
}
