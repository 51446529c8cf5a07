//! Files that are whole or not there, printed tables, and the error that means wrong input.

use std::fs;
use std::io::Write as _;
use std::path::Path;

use anyhow::{Context, Result};
use comfy_table::Table;
use serde::Serialize;
use serde::de::DeserializeOwned;

/// The input was wrong: exit status 2.
#[derive(Debug)]
pub(crate) struct WrongInput(pub(crate) String);

impl std::fmt::Display for WrongInput {
    fn fmt(&self, formatter: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        formatter.write_str(&self.0)
    }
}

impl std::error::Error for WrongInput {}

/// Prints a line; a reader that has seen enough is no error.
pub(crate) fn print_line(text: &dyn std::fmt::Display) -> Result<()> {
    match writeln!(std::io::stdout(), "{text}") {
        Err(error) if error.kind() != std::io::ErrorKind::BrokenPipe => {
            Err(error).context("printing")
        }
        _ => Ok(()),
    }
}

/// A table in Markdown, to be printed.
pub(crate) fn markdown_table<const N: usize>(
    header: [&str; N],
    rows: impl Iterator<Item = [String; N]>,
) -> Table {
    let mut table = Table::new();
    table.load_style(comfy_table::presets::ASCII_MARKDOWN);
    table.set_header(header);
    table.add_rows(rows);
    table
}

/// Writes a file under another name and then renames it, so that an interruption leaves the old file or the new one.
pub(crate) fn write_atomically(path: &Path, contents: &[u8]) -> Result<()> {
    let say = || format!("writing {}", path.display());
    if let Some(folder) = path.parent() {
        fs::create_dir_all(folder).with_context(say)?;
    }
    let mut name = path.file_name().unwrap_or_default().to_owned();
    name.push(format!(".{}.part", std::process::id()));
    let part = path.with_file_name(name);
    fs::write(&part, contents).with_context(say)?;
    fs::rename(&part, path).with_context(say)
}

/// CSV with a header line; numbers read back to the same f64.
pub(crate) fn to_csv<R: Serialize>(rows: &[R]) -> Result<String> {
    let mut writer = csv::Writer::from_writer(Vec::new());
    for row in rows {
        writer.serialize(row)?;
    }
    Ok(String::from_utf8(writer.into_inner()?)?)
}

/// Writes rows as CSV, and says where.
pub(crate) fn write_table<R: Serialize>(path: &Path, rows: &[R]) -> Result<()> {
    write_atomically(path, to_csv(rows)?.as_bytes())?;
    print_line(&path.display())
}

/// Reads a table that [`to_csv`] wrote.
pub(crate) fn read_csv<R: DeserializeOwned>(path: &Path) -> Result<Vec<R>> {
    let mut reader =
        csv::Reader::from_path(path).with_context(|| format!("reading {}", path.display()))?;
    let rows = reader.deserialize().collect::<Result<Vec<R>, _>>();
    rows.with_context(|| format!("reading {}", path.display()))
}
