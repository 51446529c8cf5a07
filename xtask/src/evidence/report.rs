//! What an experiment found, and how it is written.

use std::path::{Path, PathBuf};

use anyhow::{Context, Result};
use serde::Serialize;
use viscofriction_plot::Figure;

use crate::output::{known_digits, markdown_table, to_csv, write_atomically, write_figure};
use crate::tasks::in_parallel;

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

/// Items whose rows are computed before they are written.
const AT_ONCE: usize = 64;

/// Adds the rows of all missing items to a table, and writes it after some items each, so that an interrupted run goes on where
/// it was.
pub(super) fn resume<T: Sync, R: Serialize + Send>(
    (file, rows): (&Path, &mut Vec<R>),
    missing: &[T],
    run: impl Fn(&T) -> Result<Vec<R>> + Sync + Send,
) -> Result<()> {
    let name = file.file_stem().unwrap_or_default().display();
    for (chunk, some) in missing.chunks(AT_ONCE).enumerate() {
        let task = format!("{name}, {} of {}", chunk * AT_ONCE, missing.len());
        let found = in_parallel(task, some, &run)?;
        rows.extend(found.into_iter().flatten());
        write_atomically(file, to_csv(rows)?.as_bytes())?;
    }
    Ok(())
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
