//! The file of a sweep, which grows row by row.

use std::collections::BTreeSet;
use std::fs::{self, File, OpenOptions};
use std::io::{Seek as _, SeekFrom, Write as _};
use std::path::{Path, PathBuf};

use anyhow::{Context, Result};
use viscofriction::WrongInput;
use viscofriction::sweep::{Plan, SweepRow, header, identity};

use super::wrong_row;
use crate::input::read_rows;
use crate::output::{OutputFile, folder_of, lock, name_of, remove_parts, to_csv};

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
pub(super) struct SweepFile {
    path: PathBuf,
    table: RowTable,
    file: File,
    /// Length of what stays, \[bytes].
    kept: u64,
}

impl SweepFile {
    /// Takes a file that is to be begun or gone on with, and leaves it as it is until [`Self::begin`].
    pub(super) fn open(path: PathBuf, plan: &Plan, existing: Existing) -> Result<Self> {
        let wrong = |error| WrongInput(format!("--out {}: {error}", path.display()));
        fs::create_dir_all(folder_of(&path)).map_err(wrong)?;
        let mut options = OpenOptions::new();
        let options = options.write(true).create(true).truncate(false);
        let file = options.open(&path).map_err(wrong)?;
        lock(&file, &path)?;
        remove_parts(folder_of(&path), &[&name_of(&path)]);
        let contents = match existing {
            Existing::GoOn => read_rows(&path)?,
            Existing::Refuse | Existing::Replace => Vec::new(),
        };
        let table = RowTable::new(&path, &contents)?;
        if !table.header.is_empty() {
            check(&path, plan, &table)?;
        }
        let kept = whole(&contents).len() as u64;
        Ok(Self {
            path,
            table,
            file,
            kept,
        })
    }

    /// Cuts off what is given up, and what an interruption left of the last line.
    pub(super) fn begin(&mut self, plan: &Plan) -> Result<()> {
        self.file
            .set_len(self.kept)
            .and_then(|()| self.file.seek(SeekFrom::End(0)))
            .with_context(|| format!("writing {}", self.path.display()))?;
        if self.table.header.is_empty() {
            self.table.header = header(plan);
            self.write(&line(&header(plan))?)?;
        }
        Ok(())
    }

    /// The points that the file has.
    pub(super) fn points(&self) -> BTreeSet<usize> {
        self.table.rows.iter().map(|row| row.point).collect()
    }

    /// Writes a row, or nothing of it.
    pub(super) fn append(&mut self, row: &SweepRow) -> Result<()> {
        self.write(&line(&row.fields)?)?;
        self.table.rows.push(row.clone());
        Ok(())
    }

    fn write(&mut self, text: &str) -> Result<()> {
        let end = self.file.stream_position()?;
        let written = self.file.write_all(text.as_bytes());
        if written.is_err() {
            self.file.set_len(end).ok();
        }
        written.with_context(|| format!("writing {}", self.path.display()))
    }

    /// Puts the rows in order.
    pub(super) fn finish(mut self) -> Result<RowTable> {
        if !self.table.rows.is_sorted_by_key(|row| row.point) {
            self.table.rows.sort_by_key(|row| row.point);
            self.table.rows.dedup_by_key(|row| row.point);
            let text = self.table.text()?;
            OutputFile::new(&self.path, true)?.write(text.as_bytes())?;
        }
        Ok(self.table)
    }
}

/// The file that may be written, as of [`OutputFile::new`]; a sweep can also go on with a file that is there.
pub(super) fn checked(path: &Path, existing: Existing) -> Result<PathBuf, WrongInput> {
    let file = OutputFile::new(path, existing != Existing::Refuse);
    let file = file.map_err(|WrongInput(mut problem)| {
        if problem.ends_with("--overwrite replaces it") {
            problem += ", and --resume goes on with it";
        }
        WrongInput(problem)
    });
    Ok(file?.path().to_owned())
}

/// A file up to its last whole line.
fn whole(contents: &[u8]) -> &[u8] {
    let end = contents.iter().rposition(|byte| *byte == b'\n');
    &contents[..end.map_or(0, |end| end + 1)]
}

/// The whole lines of a file of rows.
pub(crate) struct RowTable {
    pub(super) header: Vec<String>,
    pub(super) rows: Vec<SweepRow>,
}

impl RowTable {
    /// The rows of a file of the given contents, up to its last whole line.
    pub(crate) fn new(path: &Path, contents: &[u8]) -> Result<Self, WrongInput> {
        let mut reader = csv::Reader::from_reader(whole(contents));
        let wrong = |line: usize, problem: &dyn std::fmt::Display| {
            wrong_row(path, line, &format!("no row of a sweep: {problem}"))
        };
        let texts = |record: &csv::StringRecord| record.iter().map(str::to_owned).collect();
        let header = texts(reader.headers().map_err(|error| wrong(1, &error))?);
        let mut rows = Vec::new();
        for (index, record) in reader.records().enumerate() {
            let line = index + 2;
            let record = record.map_err(|error| wrong(line, &error))?;
            let number = record.get(1).and_then(|number| number.parse().ok());
            let point = number.and_then(|number: usize| number.checked_sub(1));
            let point = point.ok_or_else(|| wrong(line, &"the number of its point is missing"))?;
            let fields = texts(&record);
            rows.push(SweepRow { point, fields });
        }
        Ok(Self { header, rows })
    }

    /// The text of the file.
    pub(super) fn text(&self) -> Result<String> {
        let rows = self.rows.iter().map(|row| &row.fields);
        let lines = std::iter::once(&self.header).chain(rows);
        lines.map(|fields| line(fields)).collect()
    }
}

/// Rows of another sweep are refused.
fn check(path: &Path, plan: &Plan, table: &RowTable) -> Result<(), WrongInput> {
    let other = "the file is of another scene, of other values of --vary, or from before a file that the scene \
                 names was changed; give another --out";
    if table.header != header(plan) {
        return Err(wrong_row(path, 1, other));
    }
    for (index, row) in table.rows.iter().enumerate() {
        let is_point = row.point < plan.n_points();
        if !is_point || !row.fields.starts_with(&identity(plan, row.point)) {
            return Err(wrong_row(path, index + 2, other));
        }
    }
    Ok(())
}

/// One record with the end of its line.
pub(super) fn line(fields: &[String]) -> Result<String> {
    Ok(String::from_utf8(to_csv("", [fields])?)?)
}
