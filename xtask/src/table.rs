//! Tables: files of comma-separated values, some of which grow, and what is printed of them in Markdown.

use std::collections::BTreeMap;
use std::path::{Path, PathBuf};

use anyhow::{Context, Result};
use comfy_table::Row;
use serde::Serialize;
use serde::de::DeserializeOwned;

use crate::output::write_atomically;
use crate::tasks::in_parallel;

/// A file of comma-separated values.
#[derive(Debug)]
pub(crate) struct Table {
    /// Name of the file, without its extension.
    pub(crate) name: &'static str,
    /// Header line and rows, as [`to_csv`] writes them.
    pub(crate) contents: String,
}

impl Table {
    /// The table of `rows`, whose columns are the fields of `R`.
    pub(crate) fn new<R: Serialize>(name: &'static str, rows: &[R]) -> Result<Self> {
        let contents = to_csv(rows)?;
        Ok(Self { name, contents })
    }

    /// Writes `NAME.csv` into a folder.
    pub(crate) fn write(&self, folder: &Path) -> Result<()> {
        let path = folder.join(self.name).with_extension("csv");
        write_atomically(&path, self.contents.as_bytes())
    }

    /// The table in Markdown with the columns that `columns` names, separated by blanks. A number whose row has a column
    /// `NAME_error` shows only the digits that this error leaves certain. Fails where a column is not there.
    pub(crate) fn markdown(&self, columns: &str) -> Result<String> {
        let mut reader = csv::Reader::from_reader(self.contents.as_bytes());
        let names = reader.headers()?.clone();
        let place = |column: &str| names.iter().position(|name| name == column);
        let mut lines = Vec::new();
        for record in reader.records() {
            let record = record?;
            let number = |place: usize| record[place].parse::<f64>().ok();
            let mut line = Vec::new();
            for column in columns.split_whitespace() {
                let cell = place(column).with_context(|| format!("no column {column}"))?;
                let error = place(&format!("{column}_error")).and_then(number);
                line.push(match number(cell) {
                    Some(value) => known_digits(value, error),
                    None => record[cell].to_owned(),
                });
            }
            lines.push(line);
        }
        let header: Vec<String> = columns
            .split_whitespace()
            .map(|name| name.replace('_', " "))
            .collect();
        Ok(markdown_table(&header, lines).to_string())
    }
}

/// Number of items whose rows [`GrowingTable::extend`] computes before it writes the file, where an item takes seconds. Chosen:
/// it is several times the number of cores, so that none waits long for the last of a chunk. An interruption loses less than this
/// work.
pub(crate) const ROWS_AT_ONCE: usize = 64;

/// A table whose file is written as it grows, so that an interrupted run goes on where it was.
pub(crate) struct GrowingTable<R> {
    /// Where the table is kept, as CSV.
    pub(crate) file: PathBuf,
    /// Rows of the file when it was opened, then those added since.
    pub(crate) rows: Vec<R>,
}

impl<R: Serialize + Send> GrowingTable<R> {
    /// The rows of a file; none if it is not there.
    pub(crate) fn open(file: PathBuf) -> Result<Self>
    where
        R: DeserializeOwned,
    {
        let rows = if file.exists() {
            read_csv(&file)?
        } else {
            Vec::new()
        };
        Ok(Self { file, rows })
    }

    /// Computes the rows of all items by `run`, in parallel, and adds them in the order of the items. The file is written
    /// after each `at_once` items. Stops at the first error; the rows of the chunk in which it occurs are lost.
    pub(crate) fn extend<T: Sync>(
        &mut self,
        items: &[T],
        at_once: usize,
        run: impl Fn(&T) -> Result<Vec<R>> + Sync + Send,
    ) -> Result<()> {
        let name = self.file.file_stem().unwrap_or_default().display();
        for (chunk, some) in items.chunks(at_once).enumerate() {
            let task = format!("{name}, {} of {}", chunk * at_once, items.len());
            let found = in_parallel(task, some, &run)?;
            self.rows.extend(found.into_iter().flatten());
            self.write()?;
        }
        Ok(())
    }

    /// Replaces the file by one with all rows.
    pub(crate) fn write(&self) -> Result<()> {
        write_atomically(&self.file, to_csv(&self.rows)?.as_bytes())
    }
}

/// Rows as CSV below a line with the names of the fields of `R`. Numbers are written such that they read back as the same f64.
pub(crate) fn to_csv<R: Serialize>(rows: &[R]) -> Result<String> {
    let mut writer = csv::Writer::from_writer(Vec::new());
    for row in rows {
        writer.serialize(row)?;
    }
    Ok(String::from_utf8(writer.into_inner()?)?)
}

/// Reads a table that [`to_csv`] wrote.
pub(crate) fn read_csv<R: DeserializeOwned>(path: &Path) -> Result<Vec<R>> {
    let contents = std::fs::read(path).map_err(Into::into);
    contents
        .and_then(|contents| parse_csv(&contents))
        .with_context(|| format!("reading {}", path.display()))
}

/// The rows of a table that [`to_csv`] wrote; fails where a column of `R` is missing or a cell is not of its type.
pub(crate) fn parse_csv<R: DeserializeOwned>(contents: &[u8]) -> Result<Vec<R>> {
    Ok(csv::Reader::from_reader(contents)
        .into_deserialize()
        .collect::<Result<_, _>>()?)
}

/// A table in Markdown, one line for each of `rows`; its `Display` is the text.
pub(crate) fn markdown_table<R: Into<Row>>(
    header: impl Into<Row>,
    rows: impl IntoIterator<Item = R>,
) -> comfy_table::Table {
    let mut table = comfy_table::Table::new();
    table.load_style(comfy_table::presets::ASCII_MARKDOWN);
    table.set_header(header);
    table.add_rows(rows);
    table
}

/// Name of a column, and its cell in the line of an item.
pub(crate) type Column<T> = (&'static str, fn(&T) -> String);

/// A table in Markdown with a line for each item.
pub(crate) fn table_of<T>(
    columns: &[Column<T>],
    items: impl IntoIterator<Item = T>,
) -> comfy_table::Table {
    let header = columns.iter().map(|(name, _)| *name);
    let line = |item: T| -> Vec<String> { columns.iter().map(|(_, cell)| cell(&item)).collect() };
    markdown_table(header, items.into_iter().map(line))
}

/// Rows of equal keys together, in the order of the keys.
pub(crate) fn group_by<R, K: Ord>(
    rows: impl IntoIterator<Item = R>,
    key: impl Fn(&R) -> K,
) -> BTreeMap<K, Vec<R>> {
    let mut groups: BTreeMap<K, Vec<R>> = BTreeMap::new();
    for row in rows {
        groups.entry(key(&row)).or_default().push(row);
    }
    groups
}

/// A number as text with four significant digits, or with fewer if its `error` (absolute) is larger than a unit of the last
/// one. Integers below 1e6 are written in full; beyond 1e-3 … 1e6 the notation is exponential, with three digits.
pub(crate) fn known_digits(value: f64, error: Option<f64>) -> String {
    if value == 0.0 || value.fract() == 0.0 && value.abs() < 1e6 {
        return value.to_string();
    }
    // Find the powers of ten of the first digit of the number and of the digit that the error makes uncertain.
    let first = value.abs().log10().floor();
    let last = error.map_or(f64::NEG_INFINITY, |error| error.log10().ceil());
    let is_below = |count: f64| move |&digit: &usize| (digit as f64) < count;
    let decimals = |count| (0..20).take_while(is_below(count)).count();
    if (-3.0..6.0).contains(&first) {
        let last_shown = last.max(first - 3.0);
        return format!("{value:.*}", decimals(-last_shown));
    }
    format!("{value:.*e}", decimals((first - last).min(2.0)))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn only_known_digits_are_printed() {
        for (value, error, expected) in [
            (0.271_8, Some(8e-3), "0.27"),
            (0.271_8, Some(0.6), "0"),
            (1.882e-5, Some(4e-8), "1.88e-5"),
            (1.882e-5, Some(4e-7), "1.9e-5"),
            (1.882e-5, None, "1.88e-5"),
            (97_736.0, None, "97736"),
            (12.345_67, None, "12.35"),
            (0.0, Some(0.0), "0"),
        ] {
            let got = known_digits(value, error);
            assert_eq!(got, expected, "{value} ± {error:?}");
        }
    }
}
