//! The CSV file of a sweep, written row by row.

use std::collections::BTreeMap;
use std::collections::btree_map::Entry;
use std::fs::{self, File, OpenOptions};
use std::io::{Seek as _, SeekFrom, Write as _};
use std::ops::Range;
use std::path::{Path, PathBuf};

use anyhow::Result;
use viscofriction::WrongInput;
use viscofriction::sweep::{Plan, RowError, SweepRow, header};

use super::wrong_row;
use crate::input::read_rows;
use crate::output::{OutputFile, folder_of, lock, name_of, not_written, remove_parts, to_csv};

/// Treatment of an existing file.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Existing {
    /// An error; nothing is computed.
    Refuse,
    /// The rows of the file are kept, and missing ones are added.
    GoOn,
    /// The rows of the file are discarded.
    Replace,
}

/// An open file with its rows, locked while it is open.
pub(super) struct SweepFile {
    /// Path with links resolved.
    path: PathBuf,
    /// Names of the columns; empty for a new file.
    header: Vec<String>,
    /// One row per point, by its index.
    rows: BTreeMap<usize, SweepRow>,
    file: File,
    /// Length of the kept part of the file, \[bytes].
    kept: u64,
}

impl SweepFile {
    /// Opens and locks a file; it is not changed before [`Self::begin`].
    pub(super) fn open(path: PathBuf, plan: &Plan, existing: Existing) -> Result<Self> {
        let wrong = |error| WrongInput(format!("--out {}: {error}", path.display()));
        fs::create_dir_all(folder_of(&path)).map_err(wrong)?;
        let file = OpenOptions::new()
            .write(true)
            .create(true)
            .truncate(false)
            .open(&path)
            .map_err(wrong)?;
        lock(&file, &path)?;
        remove_parts(folder_of(&path), &[&name_of(&path)]);
        let contents = match existing {
            Existing::GoOn => read_rows(&path)?,
            Existing::Refuse | Existing::Replace => Vec::new(),
        };
        let table = TableFile::new(&path, &contents)?;
        if !table.header.is_empty() {
            check(&path, plan, &table)?;
        }
        let kept = complete_lines(&contents).len() as u64;
        let mut rows = BTreeMap::new();
        for (_, row) in table.rows {
            insert(&mut rows, row);
        }
        Ok(Self {
            path,
            header: table.header,
            rows,
            file,
            kept,
        })
    }

    /// Truncates the file to the kept rows, without an incomplete last line, and writes the header of a new file.
    pub(super) fn begin(&mut self, plan: &Plan) -> Result<()> {
        self.file
            .set_len(self.kept)
            .and_then(|()| self.file.seek(SeekFrom::End(0)))
            .map_err(|error| not_written(self.path.display(), error))?;
        if self.header.is_empty() {
            self.header = header(plan);
            self.write(&line(&header(plan))?)?;
        }
        Ok(())
    }

    /// Points in the file, each with whether it has an answer.
    pub(super) fn points(&self) -> impl Iterator<Item = (usize, bool)> {
        self.rows.values().map(|row| (row.point, !row.failed()))
    }

    /// Appends a row; on an error the file is truncated to its previous length.
    pub(super) fn append(&mut self, row: &SweepRow) -> Result<()> {
        self.write(&line(&row.fields)?)?;
        insert(&mut self.rows, row.clone());
        Ok(())
    }

    /// Appends a text, or restores the previous length on an error.
    fn write(&mut self, text: &str) -> Result<()> {
        let wrong = |error| not_written(self.path.display(), error);
        let end = self.file.stream_position().map_err(wrong)?;
        let written = self.file.write_all(text.as_bytes());
        if written.is_err() {
            self.file.set_len(end).ok();
        }
        written.map_err(wrong)
    }

    /// Rewrites the file with one row per point, in their order.
    pub(super) fn finish(self) -> Result<RowTable> {
        let rows = self.rows.into_values().collect();
        let table = RowTable {
            header: self.header,
            rows,
        };
        let text = table.text()?;
        if read_rows(&self.path)? != text.as_bytes() {
            OutputFile::new(&self.path, true)?.write(text.as_bytes())?;
        }
        Ok(table)
    }
}

/// Adds a row to those by point. Of two rows of one point the first that has an answer is kept; if both failed, the later one.
pub(super) fn insert(rows: &mut BTreeMap<usize, SweepRow>, row: SweepRow) {
    match rows.entry(row.point) {
        Entry::Occupied(known) if !known.get().failed() => {}
        Entry::Occupied(mut known) => {
            known.insert(row);
        }
        Entry::Vacant(place) => {
            place.insert(row);
        }
    }
}

/// Validates the path like [`OutputFile::new`]; an existing file may also be resumed.
pub(super) fn checked(path: &Path, existing: Existing) -> Result<PathBuf, WrongInput> {
    let file = OutputFile::new(path, existing != Existing::Refuse).map_err(
        |WrongInput(mut problem)| {
            if problem.ends_with("--overwrite replaces it") {
                problem += ", and --resume goes on with it";
            }
            WrongInput(problem)
        },
    )?;
    Ok(file.path().to_owned())
}

/// Contents up to the last complete line.
fn complete_lines(contents: &[u8]) -> &[u8] {
    let end = contents.iter().rposition(|byte| *byte == b'\n');
    &contents[..end.map_or(0, |end| end + 1)]
}

/// Header and rows of a sweep, in the order of the points.
pub(crate) struct RowTable {
    pub(super) header: Vec<String>,
    pub(super) rows: Vec<SweepRow>,
}

impl RowTable {
    /// Index of a column; `None` if the table has no such column.
    pub(super) fn place(&self, name: &str) -> Option<usize> {
        self.header.iter().position(|column| column == name)
    }

    /// Columns of the varied keys; `None` if the columns are not those of a sweep.
    pub(super) fn keys(&self) -> Option<Range<usize>> {
        Some(self.place("points")? + 1..self.place("check")?)
    }

    /// Numbers of a column; `None` for a text or an empty cell. Empty if the table has no such column.
    pub(super) fn numbers(&self, name: &str) -> Vec<Option<f64>> {
        let rows = self.rows.iter();
        let number = |place: usize| rows.map(move |row| row.fields[place].parse().ok());
        self.place(name).map(number).into_iter().flatten().collect()
    }

    /// Contents of the CSV file: header and rows in their present order.
    pub(super) fn text(&self) -> Result<String> {
        let rows = self.rows.iter().map(|row| &row.fields);
        let lines = std::iter::once(&self.header).chain(rows);
        lines.map(|fields| line(fields)).collect()
    }
}

/// The complete lines of a CSV file of a sweep.
pub(crate) struct TableFile {
    pub(super) header: Vec<String>,
    /// Rows with their lines, counted from 1.
    pub(super) rows: Vec<(usize, SweepRow)>,
}

impl TableFile {
    /// Parses the contents of a file up to the last complete line.
    pub(crate) fn new(path: &Path, contents: &[u8]) -> Result<Self, WrongInput> {
        let mut reader = csv::Reader::from_reader(complete_lines(contents));
        let wrong = |line: usize, problem: &dyn std::fmt::Display| {
            wrong_row(path, line, &format!("no row of a sweep: {problem}"))
        };
        let texts = |record: &csv::StringRecord| record.iter().map(str::to_owned).collect();
        let header: Vec<String> = texts(reader.headers().map_err(|error| wrong(1, &error))?);
        if let [names] = &header[..]
            && names.contains([';', '\t'])
        {
            return Err(wrong(1, &BETWEEN_COLUMNS));
        }
        if header.first().is_some_and(|name| name != FIRST_COLUMN) {
            return Err(wrong(1, &"the first column is not `sweep`"));
        }
        let mut rows = Vec::new();
        for record in reader.records() {
            let line = |position: Option<&csv::Position>| {
                let line = position.map_or(1, csv::Position::line);
                usize::try_from(line).unwrap_or(usize::MAX)
            };
            let record = record.map_err(|error| wrong(line(error.position()), &error))?;
            let line = line(record.position());
            let point = record
                .get(1)
                .and_then(|number| number.parse::<usize>().ok())
                .and_then(|number| number.checked_sub(1))
                .ok_or_else(|| wrong(line, &"the number of its point is missing"))?;
            let fields = texts(&record);
            rows.push((line, SweepRow { point, fields }));
        }
        Ok(Self { header, rows })
    }

    /// Rejects rows whose cells do not match their checksum, with the line and advice.
    pub(crate) fn check(&self, path: &Path) -> Result<(), WrongInput> {
        self.rows.iter().try_for_each(|(line, row)| {
            let checked = row.check(&self.header);
            checked.map_err(|error| {
                let advice = match error {
                    RowError::Cell { .. } | RowError::Cells => {
                        "; remove the line, and the sweep computes its point again with --resume"
                    }
                    _ => "",
                };
                wrong_row(path, *line, &format!("{error}{advice}"))
            })
        })
    }
}

/// Name of the first column of every sweep.
const FIRST_COLUMN: &str = "sweep";

/// Message for a file rewritten by a spreadsheet with another locale.
const BETWEEN_COLUMNS: &str = "commas are needed between the columns and points in numbers, as the sweep has written them, and there \
                               are semicolons or tabs";

/// Rejects rows of another sweep, and rows with changed cells.
fn check(path: &Path, plan: &Plan, table: &TableFile) -> Result<(), WrongInput> {
    table.check(path)?;
    let other = |line| Err(wrong_row(path, line, OTHER_SWEEP));
    if table.header != header(plan) {
        return other(1);
    }
    let mut rows = table.rows.iter();
    rows.find(|(_, row)| !plan.has(row))
        .map_or(Ok(()), |(line, _)| other(*line))
}

/// Message for a file that belongs to another sweep.
const OTHER_SWEEP: &str = "the file is of another scene, of other values of --vary, or from before a file that the scene names was \
                           changed; give another --out";

/// A CSV record with its line end.
pub(super) fn line(fields: &[String]) -> Result<String> {
    Ok(String::from_utf8(to_csv("", [fields])?)?)
}
