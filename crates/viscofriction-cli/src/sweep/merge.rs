//! The files of shards as one.

use std::collections::BTreeMap;
use std::path::{Path, PathBuf};

use anyhow::{Result, bail};

use super::file::{RowTable, lines, read};
use super::wrong_row;
use crate::output::{OutputFile, print_text};
use viscofriction::WrongInput;

/// Joins files of one sweep, in the order of the points, and says which points none of them has.
pub(super) fn merge(paths: &[PathBuf], out: Option<&Path>, overwrite: bool) -> Result<()> {
    let out = out.map(|out| OutputFile::new(out, overwrite)).transpose()?;
    let tables = paths
        .iter()
        .map(|path| read(path))
        .collect::<Result<Vec<RowTable>, WrongInput>>()?;
    let Some(first) = tables.first() else {
        return Err(WrongInput("--merge needs at least one file".to_owned()).into());
    };
    let mut rows: BTreeMap<usize, &Vec<String>> = BTreeMap::new();
    let sweep = tables.iter().flat_map(|table| &table.rows).next();
    for (path, table) in paths.iter().zip(&tables) {
        if table.header != first.header {
            return Err(wrong_row(path, 1, "the columns are not those of the first file").into());
        }
        for (index, row) in table.rows.iter().enumerate() {
            let same = sweep.is_some_and(|sweep| sweep.fields[0] == row.fields[0]);
            let known = rows.insert(row.point, &row.fields);
            if !same || known.is_some_and(|known| *known != row.fields) {
                let problem = "the row is of another sweep than the first file";
                return Err(wrong_row(path, index + 2, problem).into());
            }
        }
    }
    let text = lines(&first.header, rows.values().copied())?;
    match &out {
        Some(out) => {
            out.write(text.as_bytes())?;
            eprintln!("{} points in {}", rows.len(), out.path().display());
        }
        None => print_text(&text)?,
    }
    let points = sweep.and_then(|row| row.fields.get(2)?.parse::<usize>().ok());
    let missing: Vec<String> = (0..points.unwrap_or(0))
        .filter(|point| !rows.contains_key(point))
        .map(|point| (point + 1).to_string())
        .collect();
    if !missing.is_empty() {
        bail!("no file has the points {}", missing.join(", "));
    }
    Ok(())
}
