//! The files of shards as one.

use std::collections::BTreeMap;
use std::path::{Path, PathBuf};

use anyhow::{Result, bail};
use viscofriction::WrongInput;
use viscofriction::sweep::Row;

use super::file::{RowTable, read};
use super::picture::PictureFiles;
use super::wrong_row;
use crate::output::{OutputFile, print_text, say};

/// Joins files of one sweep, in the order of the points, and says which points none of them has.
pub(super) fn merge(paths: &[PathBuf], out: Option<&Path>, overwrite: bool) -> Result<()> {
    let pictures = out
        .map(|out| PictureFiles::new(out, overwrite))
        .transpose()?;
    let out = out.map(|out| OutputFile::new(out, overwrite)).transpose()?;
    let table = joined(paths)?;
    match (&out, &pictures) {
        (Some(out), Some(pictures)) => {
            out.write(table.text()?.as_bytes())?;
            pictures.draw(&table)?;
            let n_rows = table.rows.len();
            say(&format!("{n_rows} points in {}", out.path().display()));
        }
        _ => print_text(&table.text()?)?,
    }
    let points = table.rows.first();
    let points = points.and_then(|row| row.fields.get(2)?.parse::<usize>().ok());
    let missing: Vec<String> = (0..points.unwrap_or(0))
        .filter(|point| {
            table
                .rows
                .binary_search_by_key(point, |row| row.point)
                .is_err()
        })
        .map(|point| (point + 1).to_string())
        .collect();
    if !missing.is_empty() {
        bail!("no file has the points {}", missing.join(", "));
    }
    Ok(())
}

/// The rows of all files in the order of their points.
fn joined(paths: &[PathBuf]) -> Result<RowTable, WrongInput> {
    let mut rows: BTreeMap<usize, Row> = BTreeMap::new();
    let mut header = Vec::new();
    let mut sweep: Option<String> = None;
    for path in paths {
        let table = read(path)?;
        if header.is_empty() {
            header.clone_from(&table.header);
        }
        if table.header != header {
            let problem = "the columns are not those of the first file";
            return Err(wrong_row(path, 1, problem));
        }
        for (index, row) in table.rows.into_iter().enumerate() {
            let same = *sweep.get_or_insert_with(|| row.fields[0].clone()) == row.fields[0];
            let other = rows.get(&row.point).is_some_and(|known| *known != row);
            if !same || other {
                let problem = "the row is of another sweep than the first file";
                return Err(wrong_row(path, index + 2, problem));
            }
            rows.insert(row.point, row);
        }
    }
    Ok(RowTable {
        header,
        rows: rows.into_values().collect(),
    })
}
