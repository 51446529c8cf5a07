//! The file of a sweep, which grows row by row.

use std::collections::BTreeMap;
use std::fs::{File, OpenOptions};
use std::io::{Seek as _, SeekFrom, Write as _};
use std::path::{Path, PathBuf};

use anyhow::{Context, Result};
use viscofriction::WrongInput;
use viscofriction::sweep::{Plan, Row, header, identity};

use super::wrong_row;
use crate::input::read_input;
use crate::output::{OutputFile, folder_of, lock, name_of, remove_parts};

/// What happens to a file that is there.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Existing {
    /// It stays, and nothing is computed.
    Refuse,
    /// Its rows stay, and those that are missing are added.
    GoOn,
    /// Its rows are given up.
    Replace,
}

/// An open file and what it has; nobody else writes it as long as it is open.
#[derive(Debug)]
pub(super) struct SweepFile {
    path: PathBuf,
    header: Vec<String>,
    rows: BTreeMap<usize, Row>,
    /// Whether the rows in the file are in the order of their points.
    sorted: bool,
    file: File,
}

impl SweepFile {
    /// Begins a file, or goes on with one; what an interruption left of its last line is cut off.
    pub(super) fn open(path: PathBuf, plan: &Plan, existing: Existing) -> Result<Self> {
        let say = || format!("writing {}", path.display());
        std::fs::create_dir_all(folder_of(&path)).with_context(say)?;
        let mut file = OpenOptions::new()
            .write(true)
            .create(true)
            .truncate(false)
            .open(&path)
            .with_context(say)?;
        lock(&file, &path)?;
        remove_parts(folder_of(&path), &[&name_of(&path)]);
        let mut table = RowTable::default();
        if existing == Existing::GoOn {
            let contents = read_input(&path)?;
            table = row_table(&path, &contents)?;
            check(&path, plan, &table)?;
            let end = whole(&contents).len() as u64;
            file.set_len(end).with_context(say)?;
        } else {
            file.set_len(0).with_context(say)?;
        }
        file.seek(SeekFrom::End(0)).with_context(say)?;
        let header = header(plan);
        if table.header.is_empty() {
            file.write_all(line(&header)?.as_bytes())
                .with_context(say)?;
        }
        Ok(Self {
            header,
            sorted: table.rows.is_sorted_by_key(|row| row.point),
            rows: table.rows.into_iter().map(|row| (row.point, row)).collect(),
            file,
            path,
        })
    }

    pub(super) fn has(&self, point: usize) -> bool {
        self.rows.contains_key(&point)
    }

    /// Writes a row, or nothing of it.
    pub(super) fn append(&mut self, row: &Row) -> Result<()> {
        let text = line(&row.fields)?;
        let end = self.file.stream_position()?;
        if let Err(error) = self.file.write_all(text.as_bytes()) {
            self.file.set_len(end).ok();
            return Err(error).with_context(|| format!("writing {}", self.path.display()));
        }
        let last = self.rows.last_key_value();
        self.sorted &= last.is_none_or(|(point, _)| *point < row.point);
        self.rows.insert(row.point, row.clone());
        Ok(())
    }

    /// Puts the rows in order.
    pub(super) fn finish(&self) -> Result<RowTable> {
        let table = RowTable {
            header: self.header.clone(),
            rows: self.rows.values().cloned().collect(),
        };
        if !self.sorted {
            OutputFile::new(&self.path, true)?.write(table.text()?.as_bytes())?;
        }
        Ok(table)
    }
}

/// The file that may be written.
///
/// # Errors
/// [`WrongInput`] as of [`OutputFile::new`]; a sweep can also go on with a file that is there.
pub(super) fn checked(path: &Path, existing: Existing) -> Result<PathBuf, WrongInput> {
    let file = OutputFile::new(path, existing != Existing::Refuse);
    let file = file.map_err(|WrongInput(problem)| {
        let there = problem.ends_with("--overwrite replaces it");
        let resume = if there {
            ", and --resume goes on with it"
        } else {
            ""
        };
        WrongInput(problem + resume)
    });
    Ok(file?.path().to_owned())
}

/// A file up to its last whole line.
fn whole(contents: &[u8]) -> &[u8] {
    let end = contents.iter().rposition(|byte| *byte == b'\n');
    &contents[..end.map_or(0, |end| end + 1)]
}

/// The whole lines of a file of rows.
#[derive(Debug, Default)]
pub(super) struct RowTable {
    pub(super) header: Vec<String>,
    pub(super) rows: Vec<Row>,
}

impl RowTable {
    /// The text of the file.
    pub(super) fn text(&self) -> Result<String> {
        let mut text = line(&self.header)?;
        for row in &self.rows {
            text.push_str(&line(&row.fields)?);
        }
        Ok(text)
    }
}

/// Reads a file up to its last whole line.
pub(super) fn read(path: &Path) -> Result<RowTable, WrongInput> {
    row_table(path, &read_input(path)?)
}

/// The rows of a file of the given contents.
pub(super) fn row_table(path: &Path, bytes: &[u8]) -> Result<RowTable, WrongInput> {
    let mut reader = csv::Reader::from_reader(whole(bytes));
    let wrong = |line: usize, problem: &dyn std::fmt::Display| {
        wrong_row(path, line, &format!("no row of a sweep: {problem}"))
    };
    let header = reader.headers().map_err(|error| wrong(1, &error))?;
    let header: Vec<String> = header.iter().map(str::to_owned).collect();
    let mut rows = Vec::new();
    for (index, record) in reader.records().enumerate() {
        let line = index + 2;
        let record = record.map_err(|error| wrong(line, &error))?;
        let fields: Vec<String> = record.iter().map(str::to_owned).collect();
        let number = fields
            .get(1)
            .and_then(|number| number.parse::<usize>().ok());
        let point = number.and_then(|number| number.checked_sub(1));
        let point = point.ok_or_else(|| wrong(line, &"the number of its point is missing"))?;
        rows.push(Row { point, fields });
    }
    Ok(RowTable { header, rows })
}

/// Rows of another sweep are refused.
fn check(path: &Path, plan: &Plan, table: &RowTable) -> Result<(), WrongInput> {
    let other = "the file is of another scene, of other values of --vary, or from before a file that the scene \
                 names was changed; give another --out";
    let empty = table.rows.is_empty() && table.header.is_empty();
    if !empty && table.header != header(plan) {
        return Err(wrong_row(path, 1, other));
    }
    for (index, row) in table.rows.iter().enumerate() {
        let expected = (row.point < plan.n_points()).then(|| identity(plan, row.point));
        if !expected.is_some_and(|expected| row.fields.starts_with(&expected)) {
            return Err(wrong_row(path, index + 2, other));
        }
    }
    Ok(())
}

/// One record with the end of its line.
pub(super) fn line(fields: &[String]) -> Result<String> {
    let mut writer = csv::Writer::from_writer(Vec::new());
    writer.write_record(fields)?;
    Ok(String::from_utf8(writer.into_inner()?)?)
}
