//! Reader of tables of the shear strength of a contact over speed and temperature.

use std::path::Path;

use rheology::ShearStrengthPoint;

use crate::MeasurementError;
use crate::friction::ROTATIONAL_UNITS;
use crate::table::Quantity::{ShearError, ShearStrength, Temperature, Velocity};
use crate::table::{Line, Meaning, Source, Table, Vocabulary, text_of};

/// A row of a table of shear strengths.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct ShearStrengthRow {
    /// Line in the file, from 1.
    pub line: usize,
    /// The numbers of the row.
    pub point: ShearStrengthPoint,
    /// Standard error ≥ 0 of the shear strength, \[Pa]; `None` without a column of errors.
    pub standard_error: Option<f64>,
}

/// Names by which the columns of a table of shear strengths are recognised, and the columns that it needs.
pub(crate) static SHEAR: Vocabulary = Vocabulary {
    names: "v and tau (shear strength), and perhaps T and standard error",
    known: &[
        (Velocity, None, "v velocity speed geschwindigkeit vitesse"),
        (Velocity, None, "slidingvelocity slidingspeed"),
        (ShearStrength, None, "tau τ shearstrength shearstress"),
        (ShearStrength, None, "frictionalshearstress frictionstress"),
        (ShearStrength, None, "scherfestigkeit schubspannung"),
        (ShearError, None, "error stderr standarderror tauerror"),
        (ShearError, None, "shearstrengtherror shearstresserror"),
        (Temperature, None, "T temp temperature temperatur"),
    ],
    is_head: |columns| columns.contains(&Velocity) || columns.contains(&ShearStrength),
    needed: |_| vec![Velocity, ShearStrength],
    optional: &[Temperature, ShearError],
    has_order: true,
};

/// Reads a table of shear strengths from the contents of a file; the path is used for messages only.
///
/// # Errors
/// [`MeasurementError::Table`] with file, line and column.
pub fn shear_strength_rows(
    file: &Path,
    contents: &[u8],
) -> Result<Vec<ShearStrengthRow>, MeasurementError> {
    let text = text_of(contents, &SHEAR);
    let meaning = Meaning {
        deformation: None,
        scale: &|_| 1.0,
    };
    let source = Source::new(file, &text, &SHEAR, meaning);
    let tables = source.tables()?;
    if let Some((second, _)) = tables.get(1) {
        let problem = "a second table begins here; put all rows below one line of names";
        return Err(source.wrong_line(second.line, &problem));
    }
    let (table, lines) = &tables[0];
    let speed = table.find(Velocity);
    if speed.is_some_and(|column| ROTATIONAL_UNITS.contains(&column.unit)) {
        let problem = "the speed is that along the surface, in m/s, mm/s, um/s, cm/s or km/h";
        return Err(source.wrong_line(table.line, &problem));
    }
    lines.iter().map(|line| row(table, line)).collect()
}

/// The row of a line.
fn row(table: &Table, line: &Line) -> Result<ShearStrengthRow, MeasurementError> {
    let positives = table.positives(line)?;
    let standard_error = table.in_si(line, ShearError)?;
    if standard_error.is_some_and(|error| error < 0.0) {
        return Err(table.wrong_in(line, ShearError, "a number of at least 0"));
    }
    Ok(ShearStrengthRow {
        line: line.number,
        point: ShearStrengthPoint {
            velocity: positives[0],
            shear_strength: positives[1],
            temperature: table.celsius(line)?,
        },
        standard_error,
    })
}
