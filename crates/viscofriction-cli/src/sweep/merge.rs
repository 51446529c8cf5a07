//! Merging of the files of shards.

use std::collections::BTreeMap;
use std::path::{Path, PathBuf};

use anyhow::{Result, bail};
use viscofriction::WrongInput;
use viscofriction::sweep::SweepRow;

use super::file::{RowTable, TableFile, insert};
use super::measured::Measured;
use super::picture::PictureFiles;
use super::{eprint_samples, eprint_warnings, wrong_row};
use crate::input::read_table;
use crate::output::{OutputFile, eprint_line, print_text};

/// Merges the files of one sweep in the order of the points; an error names missing points.
pub(super) fn merge(
    paths: &[PathBuf],
    out: Option<&Path>,
    overwrite: bool,
    measured: Option<&Measured>,
) -> Result<()> {
    let table = merged_rows(paths)?;
    measured.map_or(Ok(()), |measured| measured.check(&table))?;
    let new_files = |out| {
        let pictures = PictureFiles::new(out, measured, overwrite)?;
        Ok::<_, WrongInput>((OutputFile::new(out, overwrite)?, pictures))
    };
    if let Some((out, pictures)) = out.map(new_files).transpose()? {
        out.write(table.text()?.as_bytes())?;
        pictures.draw(&table, measured, None)?;
        let n_rows = table.rows.len();
        eprint_line(&format!("{n_rows} points in {}", out.path().display()));
    } else {
        print_text(&table.text()?)?;
    }
    eprint_warnings(&table.rows);
    eprint_samples(&table.header, &table.rows);
    let first = table.rows.first();
    let n_points = first.and_then(|row| row.fields.get(2)?.parse::<usize>().ok());
    let has = |point: usize| table.rows.binary_search_by_key(&point, |row| row.point);
    let missing = (0..n_points.unwrap_or(0)).filter(|point| has(*point).is_err());
    let missing: Vec<String> = missing.map(|point| (point + 1).to_string()).collect();
    if !missing.is_empty() {
        bail!("no file has the points {}", missing.join(", "));
    }
    Ok(())
}

/// The rows of all files in the order of the points; an error if two files have different answers to a point.
fn merged_rows(paths: &[PathBuf]) -> Result<RowTable, WrongInput> {
    let mut rows: BTreeMap<usize, SweepRow> = BTreeMap::new();
    let mut header = Vec::new();
    for path in paths {
        let table = TableFile::new(path, &read_table(path)?)?;
        let wrong = |line, problem: &str| Err(wrong_row(path, line, problem));
        if table.header.is_empty() {
            return wrong(1, "no rows of a sweep, and no names of columns");
        }
        table.check(path)?;
        if header.is_empty() {
            header = table.header;
        } else if table.header != header {
            return wrong(1, "the columns are not those of the first file");
        }
        for (line, row) in table.rows {
            let first = rows.values().next();
            if first.is_some_and(|first| first.fields[0] != row.fields[0]) {
                return wrong(line, "the row is of another sweep than the first file");
            }
            let known = rows.get(&row.point);
            let is_other = |known: &SweepRow| *known != row && !known.failed() && !row.failed();
            if known.is_some_and(is_other) {
                let problem = format!(
                    "point {} has another answer in a file before, or in a line before",
                    row.point + 1
                );
                return wrong(line, &problem);
            }
            insert(&mut rows, row);
        }
    }
    Ok(RowTable {
        header,
        rows: rows.into_values().collect(),
    })
}
