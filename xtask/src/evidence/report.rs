//! What an experiment found, and how it is written.

use std::collections::BTreeMap;
use std::path::{Path, PathBuf};

use anyhow::{Context, Result};
use serde::Serialize;
use serde::de::DeserializeOwned;
use viscofriction_plot::Figure;

use crate::output::{known_digits, markdown_table, to_csv, write_atomically, write_figure};

/// What an experiment found.
#[derive(Debug, Default)]
pub(super) struct Report {
    /// Name of the page.
    pub(super) name: &'static str,
    pub(super) tables: Vec<Table>,
    pub(super) pictures: Vec<(&'static str, Figure)>,
    /// Markdown.
    pub(super) summary: String,
    /// Why the command fails, if it does.
    pub(super) failure: Option<String>,
}

/// Rows of the cases that were solved, and why the others were not.
pub(super) struct Outcomes<R, F> {
    pub(super) rows: Vec<R>,
    pub(super) refusals: Vec<F>,
}

impl<R, F> FromIterator<Result<Vec<R>, F>> for Outcomes<R, F> {
    fn from_iter<I: IntoIterator<Item = Result<Vec<R>, F>>>(cases: I) -> Self {
        let (mut rows, mut refusals) = (Vec::new(), Vec::new());
        for case in cases {
            match case {
                Ok(found) => rows.extend(found),
                Err(refusal) => refusals.push(refusal),
            }
        }
        Self { rows, refusals }
    }
}

impl<R: Serialize, F: Serialize> Outcomes<R, F> {
    /// Both tables.
    pub(super) fn tables(&self, [rows, refusals]: [&'static str; 2]) -> Result<Vec<Table>> {
        Ok(vec![
            Table::new(rows, &self.rows)?,
            Table::new(refusals, &self.refusals)?,
        ])
    }
}

/// How much is computed, of a file that says it of a quick run and of a full one.
pub(super) fn extent<T: DeserializeOwned>(file: &str, quick: bool) -> Result<T> {
    let mut extents: BTreeMap<String, T> = toml::from_str(file)?;
    let name = if quick { "quick" } else { "full" };
    extents.remove(name).context("an extent")
}

/// A file of comma-separated values.
#[derive(Debug)]
pub(super) struct Table {
    name: &'static str,
    contents: String,
}

impl Report {
    /// The page: summary, tables and pictures.
    pub(super) fn page(&self, out: &Path) -> PathBuf {
        out.join(self.name).with_extension("md")
    }

    pub(super) fn write(&self, out: &Path) -> Result<()> {
        let mut page = format!("{}\n", self.summary);
        for Table { name, contents } in &self.tables {
            let file = format!("{name}.csv");
            page += &format!("\n[{file}]({file})\n");
            write_atomically(&out.join(file), contents.as_bytes())?;
        }
        for (name, figure) in &self.pictures {
            page += &format!("\n![{name}]({name}.svg)\n");
            write_figure(out, name, figure)?;
        }
        write_atomically(&self.page(out), page.as_bytes())
    }
}

impl Table {
    pub(super) fn new<R: Serialize>(name: &'static str, rows: &[R]) -> Result<Self> {
        let contents = to_csv(rows)?;
        Ok(Self { name, contents })
    }

    /// Some columns, separated by blanks, in Markdown; numbers only as far as their `…_error` says that they are known.
    pub(super) fn markdown(&self, columns: &str) -> Result<String> {
        let columns = columns.split_whitespace();
        let mut reader = csv::Reader::from_reader(self.contents.as_bytes());
        let names = reader.headers()?.clone();
        let place = |column: &str| names.iter().position(|name| name == column);
        let mut lines = Vec::new();
        for record in reader.records() {
            let record = record?;
            let number = |place: usize| record[place].parse::<f64>().ok();
            let mut line = Vec::new();
            for column in columns.clone() {
                let cell = place(column).with_context(|| format!("no column {column}"))?;
                let error = place(&format!("{column}_error")).and_then(number);
                line.push(match number(cell) {
                    Some(value) => known_digits(value, error),
                    None => record[cell].to_owned(),
                });
            }
            lines.push(line);
        }
        let header: Vec<String> = columns.map(|name| name.replace('_', " ")).collect();
        Ok(markdown_table(&header, lines).to_string())
    }
}
