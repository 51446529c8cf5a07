//! Tables of measured moduli, as instruments export them.
//!
//! [`measured_moduli`] puts the rows of all tables of a file into isotherms.

mod isotherms;
mod names;
mod shifting;

use std::path::Path;

use numerics::in_range;
use rheology::InvalidParameter;
use rheology::fit::{Isotherm, ModulusPoint, RelaxationPoint};

use crate::MeasurementError;
pub use crate::table::Deformation;
use crate::table::Quantity::{Loss, LossFactor, Set, Storage, Temperature, Time};
use crate::table::{Column, Line, Meaning, Source, Table, text_of};
use isotherms::{Group, IsothermRow, insert};
use names::MODULI;
pub use shifting::{Shifted, Shifting, master_curve};

/// What was measured, in SI and in shear.
#[derive(Debug, Clone, PartialEq)]
#[must_use]
pub struct MeasuredModuli {
    /// The moduli.
    pub measurements: Measurements,
    /// Whether temperatures are in °C, and not in K; none of a table without them.
    pub celsius: Option<bool>,
}

/// Moduli over frequency or over time.
#[derive(Debug, Clone, PartialEq)]
pub enum Measurements {
    /// Isotherms in the order in which they begin in the table; without temperatures there is one, whose own means nothing.
    Oscillation(Vec<Isotherm>),
    /// Points at increasing times.
    Relaxation(Vec<RelaxationPoint>),
}

/// What a table does not say.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct TableOptions {
    /// G/E, greater than 0; see [`shear_per_tension`].
    pub shear_per_tension: f64,
    /// What a "storage modulus" is that has neither E nor G in its name.
    pub deformation: Option<Deformation>,
}

/// G/E = 1/(2 (1 + ν)) at a constant Poisson ratio.
///
/// # Errors
/// When the Poisson ratio is not greater than −1 and at most 0.5.
pub fn shear_per_tension(poisson_ratio: f64) -> Result<f64, InvalidParameter> {
    let holds = poisson_ratio > -1.0 && poisson_ratio <= 0.5;
    let allowed = "greater than -1 and at most 0.5";
    in_range("poisson_ratio", poisson_ratio, holds, allowed)?;
    Ok(0.5 / (1.0 + poisson_ratio))
}

/// Reads the contents of a file, which need not be there: tables with a line of names each, among other text.
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
        measurements: measurements(&source, groups, kind.is_relaxation)?,
        celsius: kind.celsius,
    })
}

/// What all tables of a file have in common.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
struct Kind {
    is_relaxation: bool,
    /// Whether temperatures are in °C, where there are some.
    celsius: Option<bool>,
}

impl Kind {
    fn of(table: &Table) -> Self {
        let temperature = table.find(Temperature);
        Self {
            is_relaxation: table.needed[0] == Time,
            celsius: temperature.map(|column| column.unit != "K"),
        }
    }
}

fn row(table: &Table, line: &Line) -> Result<IsothermRow, MeasurementError> {
    let numbers = table.positives(line)?;
    let [first, last] = [numbers[1], numbers[numbers.len() - 1]];
    let moduli = match table.needed[1..] {
        [Storage, LossFactor] => [first, first * last],
        [Loss, LossFactor] => [first / last, first],
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

fn measurements(
    source: &Source,
    groups: Vec<Group>,
    is_relaxation: bool,
) -> Result<Measurements, MeasurementError> {
    if !is_relaxation {
        let isotherms = groups.into_iter().map(isotherm).collect();
        return Ok(Measurements::Oscillation(isotherms));
    }
    if let Some(second) = groups.get(1) {
        let problem = "relaxation at several temperatures is not shifted: give a master curve";
        return Err(source.wrong_line(second.line, &problem));
    }
    let groups = groups.into_iter();
    let rows = groups.flat_map(|group| group.rows.into_values());
    let point = |IsothermRow { at, moduli, .. }: IsothermRow| RelaxationPoint {
        time: at,
        modulus: moduli[0],
    };
    Ok(Measurements::Relaxation(rows.map(point).collect()))
}

fn isotherm(group: Group) -> Isotherm {
    let point = |IsothermRow { at, moduli, .. }: IsothermRow| ModulusPoint {
        angular_frequency: at,
        storage: moduli[0],
        loss: moduli[1],
    };
    Isotherm {
        temperature: group.temperatures.iter().sum::<f64>() / group.rows.len() as f64,
        points: group.rows.into_values().map(point).collect(),
    }
}
