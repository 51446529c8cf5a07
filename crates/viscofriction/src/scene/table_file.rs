//! The table of radii and heights that a scene names.

use std::path::Path;

use csv::{ErrorKind, StringRecord};
use indenters::{IndenterError, PiecewiseLinearProfile};
use serde::Deserialize;

use crate::text::line_of_record;

#[derive(Debug, Clone, Copy, Deserialize)]
#[serde(deny_unknown_fields)]
struct Row {
    radius_m: f64,
    height_m: f64,
}

/// A profile from the contents of a CSV file with the columns `radius_m` and `height_m`.
///
/// # Errors
/// File, line and what is wrong there.
pub fn profile(file: &Path, contents: &[u8]) -> Result<PiecewiseLinearProfile, String> {
    let wrong = |(line, problem): (usize, String)| format!("{}:{line}: {problem}", file.display());
    let rows = rows(contents).map_err(wrong)?;
    let radii = rows.iter().map(|(_, row)| row.radius_m).collect();
    let heights = rows.iter().map(|(_, row)| row.height_m).collect();
    PiecewiseLinearProfile::new(radii, heights)
        .map_err(|error| wrong((line_of_error(&error, &rows), error.to_string())))
}

/// The rows and the lines they begin at, or a line and what is wrong there.
fn rows(contents: &[u8]) -> Result<Vec<(usize, Row)>, (usize, String)> {
    let mut reader = csv::Reader::from_reader(contents);
    let line = |error: &csv::Error| line_of_record(contents, error.position());
    let names = reader.headers().cloned();
    let names = names.map_err(|error| (line(&error), problem(&error, &StringRecord::new())))?;
    let wrong = |error: csv::Error| (line(&error), problem(&error, &names));
    let mut rows = Vec::new();
    for record in reader.records() {
        let record = record.map_err(wrong)?;
        let row = record.deserialize(Some(&names)).map_err(wrong)?;
        rows.push((line_of_record(contents, record.position()), row));
    }
    Ok(rows)
}

/// What is wrong, with the name of the column.
pub(crate) fn problem(error: &csv::Error, names: &StringRecord) -> String {
    match error.kind() {
        ErrorKind::Deserialize { err, .. } => {
            let name = err
                .field()
                .and_then(|field| names.get(usize::try_from(field).ok()?));
            match name {
                Some(name) => format!("{name}: {}", err.kind()),
                None => err.kind().to_string(),
            }
        }
        ErrorKind::Utf8 { .. } => "the text is no UTF-8".to_owned(),
        ErrorKind::UnequalLengths {
            expected_len, len, ..
        } => {
            format!("{expected_len} values are needed, but there are {len}")
        }
        _ => error.to_string(),
    }
}

/// The line of the row that the library refuses.
fn line_of_error(error: &IndenterError, rows: &[(usize, Row)]) -> usize {
    let row = match error {
        IndenterError::NotIncreasing { index, .. } => rows.get(*index),
        IndenterError::InvalidParameter { value, .. } => rows.iter().find(|(_, row)| {
            [row.radius_m, row.height_m]
                .iter()
                .any(|other| other.total_cmp(value).is_eq())
        }),
        _ => rows.last(),
    };
    row.map_or(1, |(line, _)| *line)
}
