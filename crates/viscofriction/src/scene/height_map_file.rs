//! The grid of heights that a scene names.

use std::path::Path;

use csv::{ReaderBuilder, StringRecord, Trim};
use indenters::HeightMap;

use super::table_file::problem;
use crate::npy::{NpyTable, from_npy};
use crate::text::line_of_record;

/// A surface from the contents of a file, of NumPy if its name ends with `.npy`, of CSV otherwise.
///
/// # Errors
/// File, place and what is wrong there.
pub fn height_map(file: &Path, contents: &[u8], spacing: [f64; 2]) -> Result<HeightMap, String> {
    let extension = file.extension();
    if extension.is_some_and(|extension| extension.eq_ignore_ascii_case("npy")) {
        of_numpy(contents, spacing).map_err(|problem| format!("{}: {problem}", file.display()))
    } else {
        of_csv(file, contents, spacing)
    }
}

/// An array of heights, the first index along x.
fn of_numpy(contents: &[u8], spacing: [f64; 2]) -> Result<HeightMap, String> {
    let NpyTable { shape, values } = from_npy(contents)?;
    let wrong = values.iter().position(|height| !height.is_finite());
    if let Some(index) = wrong {
        let [row, column] = [index / shape[1], index % shape[1]];
        return Err(format!(
            "[{row}, {column}]: a finite height in m is needed, and not {}",
            values[index]
        ));
    }
    HeightMap::new(shape, spacing, values).map_err(|error| error.to_string())
}

/// One line of heights per x, one column per y, without names.
fn of_csv(file: &Path, contents: &[u8], spacing: [f64; 2]) -> Result<HeightMap, String> {
    let wrong = |line: usize, problem: &str| format!("{}:{line}: {problem}", file.display());
    let mut reader = ReaderBuilder::new()
        .has_headers(false)
        .trim(Trim::All)
        .from_reader(contents);
    let mut heights = Vec::new();
    let [mut rows, mut columns, mut last] = [0, 0, 1];
    for record in reader.records() {
        let record = record.map_err(|error| {
            let line = line_of_record(contents, error.position());
            wrong(line, &problem(&error, &StringRecord::new()))
        })?;
        last = line_of_record(contents, record.position());
        for (column, cell) in record.iter().enumerate() {
            heights.push(height(column, cell).map_err(|problem| wrong(last, &problem))?);
        }
        columns = record.len();
        rows += 1;
    }
    HeightMap::new([rows, columns], spacing, heights)
        .map_err(|error| wrong(last, &error.to_string()))
}

fn height(column: usize, cell: &str) -> Result<f64, String> {
    let number = cell.parse::<f64>().ok().filter(|height| height.is_finite());
    number.ok_or_else(|| {
        let shown: String = cell
            .chars()
            .filter(|letter| !letter.is_control())
            .take(40)
            .collect();
        format!(
            "column {}: a finite height in m is needed, and not '{shown}'",
            column + 1
        )
    })
}
