//! What an experiment found, and how it is written.

use std::collections::BTreeMap;
use std::path::{Path, PathBuf};

use anyhow::{Context, Result};
use serde::Serialize;
use serde::de::DeserializeOwned;
use viscofriction_plot::Figure;

use crate::output::{write_atomically, write_figure};
use crate::table::Table;

/// What an experiment found.
#[derive(Debug, Default)]
pub(super) struct Report {
    /// Name of the page, without `.md`.
    pub(super) name: &'static str,
    /// Tables, each written as `NAME.csv` next to the page.
    pub(super) tables: Vec<Table>,
    /// Name of the files, without extension, and what they show.
    pub(super) pictures: Vec<(&'static str, Figure)>,
    /// What was found, in Markdown; printed, and the first part of the page.
    pub(super) summary: String,
    /// Why the command fails, if a method is wrong; the report is written all the same.
    pub(super) failure: Option<String>,
}

/// Rows `R` of the cases that were solved, and reasons `F` why the others were not; collected from one result for each case.
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
    /// Tables of rows and of refusals, under the two given names.
    pub(super) fn tables(&self, [rows, refusals]: [&'static str; 2]) -> Result<Vec<Table>> {
        Ok(vec![
            Table::new(rows, &self.rows)?,
            Table::new(refusals, &self.refusals)?,
        ])
    }
}

/// How much is computed: the table `quick` or `full` of the contents of a file in TOML.
pub(super) fn extent<T: DeserializeOwned>(file: &str, quick: bool) -> Result<T> {
    let mut extents: BTreeMap<String, T> = toml::from_str(file)?;
    let name = if quick { "quick" } else { "full" };
    extents.remove(name).context("an extent")
}

impl Report {
    /// Path of the page of the report in the folder `out`.
    pub(super) fn page(&self, out: &Path) -> PathBuf {
        out.join(self.name).with_extension("md")
    }

    /// Writes the tables, the pictures and the page, which has the summary and links to the others, into the folder `out`.
    pub(super) fn write(&self, out: &Path) -> Result<()> {
        let mut page = format!("{}\n", self.summary);
        for table in &self.tables {
            page += &format!("\n[{0}.csv]({0}.csv)\n", table.name);
            table.write(out)?;
        }
        for (name, figure) in &self.pictures {
            page += &format!("\n![{name}]({name}.svg)\n");
            write_figure(out, name, figure)?;
        }
        write_atomically(&self.page(out), page.as_bytes())
    }
}
