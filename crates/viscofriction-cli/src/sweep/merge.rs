//! The files of shards as one.

use std::collections::BTreeMap;
use std::path::{Path, PathBuf};

use anyhow::{Result, bail};
use viscofriction::WrongInput;
use viscofriction::sweep::SweepRow;

use super::file::RowTable;
use super::picture::PictureFiles;
use super::{say_samples, say_warnings, wrong_row};
use crate::input::read_table;
use crate::output::{OutputFile, print_text, say};

/// Joins files of one sweep, in the order of the points, and says which points none of them has.
pub(super) fn merge(paths: &[PathBuf], out: Option<&Path>, overwrite: bool) -> Result<()> {
    let table = joined(paths)?;
    let files = out.map(|out| {
        let pictures = PictureFiles::new(out, overwrite)?;
        Ok::<_, WrongInput>((OutputFile::new(out, overwrite)?, pictures))
    });
    let files = files.transpose()?;
    if let Some((out, pictures)) = files {
        out.write(table.text()?.as_bytes())?;
        pictures.draw(&table, None)?;
        let n_rows = table.rows.len();
        say(&format!("{n_rows} points in {}", out.path().display()));
    } else {
        print_text(&table.text()?)?;
    }
    say_warnings(&table.rows);
    say_samples(&table.header, &table.rows);
    let points = table.rows.first();
    let points = points.and_then(|row| row.fields.get(2)?.parse::<usize>().ok());
    let has = |point: usize| table.rows.binary_search_by_key(&point, |row| row.point);
    let missing = (0..points.unwrap_or(0)).filter(|point| has(*point).is_err());
    let missing: Vec<String> = missing.map(|point| (point + 1).to_string()).collect();
    if !missing.is_empty() {
        bail!("no file has the points {}", missing.join(", "));
    }
    Ok(())
}

/// The rows of all files in the order of their points.
fn joined(paths: &[PathBuf]) -> Result<RowTable, WrongInput> {
    let mut rows: BTreeMap<usize, SweepRow> = BTreeMap::new();
    let mut header = Vec::new();
    for path in paths {
        let table = RowTable::new(path, &read_table(path)?)?;
        if table.header.is_empty() {
            return Err(wrong_row(
                path,
                1,
                "no rows of a sweep, and no names of columns",
            ));
        }
        if header.is_empty() {
            header = table.header;
        } else if table.header != header {
            let problem = "the columns are not those of the first file";
            return Err(wrong_row(path, 1, problem));
        }
        for (index, row) in table.rows.into_iter().enumerate() {
            if !row.is_unchanged(&header) {
                let problem =
                    "the row is not as it was computed: its point or its values were changed";
                return Err(wrong_row(path, index + 2, problem));
            }
            let first = rows.values().next();
            let same = first.is_none_or(|first| first.fields[0] == row.fields[0]);
            let other = rows.get(&row.point).is_some_and(|known| *known != row);
            if !same || other {
                let problem = "the row is of another sweep than the first file";
                return Err(wrong_row(path, index + 2, problem));
            }
            rows.insert(row.point, row);
        }
    }
    let rows = rows.into_values().collect();
    Ok(RowTable { header, rows })
}
