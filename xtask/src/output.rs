//! Files that are whole or not there, printed tables, and the error that means wrong input.

use std::fs;
use std::io::Write as _;
use std::path::Path;

use anyhow::{Context, Result};
use comfy_table::Table;
use serde::Serialize;
use serde::de::DeserializeOwned;
use viscofriction_plot::{Drawing, Figure, PNG_WIDTH, draw, render_png};

/// The input was wrong: exit status 2; one line that names the place.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct WrongInput(pub(crate) String);

impl std::fmt::Display for WrongInput {
    fn fmt(&self, formatter: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        formatter.write_str(&self.0)
    }
}

impl std::error::Error for WrongInput {}

/// Reads a whole file that the command line names.
pub(crate) fn read_input(path: &Path) -> Result<Vec<u8>, WrongInput> {
    fs::read(path).map_err(|error| WrongInput(format!("{}: {error}", path.display())))
}

/// The line at which a record of a CSV file begins, counted from 1; empty lines before it belong to its position.
pub(crate) fn line_of_record(contents: &[u8], position: Option<&csv::Position>) -> usize {
    let start = position.map_or(0, csv::Position::byte);
    let start = usize::try_from(start)
        .unwrap_or(usize::MAX)
        .min(contents.len());
    let is_break = |byte: &&u8| b"\r\n".contains(byte);
    line_of(
        contents,
        start + contents[start..].iter().take_while(is_break).count(),
    )
}

/// The line of an offset in a text, counted from 1.
pub(crate) fn line_of(text: &[u8], offset: usize) -> usize {
    let before = text.iter().take(offset);
    1 + before.filter(|byte| **byte == b'\n').count()
}

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

/// Draws a figure and writes it beside other files, as `NAME.svg` and `NAME.png`.
pub(crate) fn write_figure(folder: &Path, name: &str, figure: &Figure) -> Result<()> {
    let drawing = draw(figure).with_context(|| format!("drawing {name}"))?;
    write_drawing(folder, name, &drawing)
}

/// Writes a drawing as `NAME.svg` and `NAME.png`.
pub(crate) fn write_drawing(folder: &Path, name: &str, drawing: &Drawing) -> Result<()> {
    let png = render_png(drawing, PNG_WIDTH).with_context(|| format!("drawing {name}"))?;
    let path = |extension: &str| folder.join(format!("{name}.{extension}"));
    write_atomically(&path("svg"), drawing.svg.as_bytes())?;
    write_atomically(&path("png"), &png)
}

/// Removes what killed runs left of [`write_atomically`] for this file; nobody else may be writing it.
pub(crate) fn remove_parts(path: &Path) -> Result<()> {
    let say = || format!("clearing parts of {}", path.display());
    let folder = match path.parent() {
        Some(folder) if folder.as_os_str().is_empty() => Path::new("."),
        Some(folder) if folder.is_dir() => folder,
        _ => return Ok(()),
    };
    for entry in fs::read_dir(folder).with_context(say)? {
        let name = entry.with_context(say)?.file_name();
        if is_part(&name.to_string_lossy(), path) {
            fs::remove_file(folder.join(name)).with_context(say)?;
        }
    }
    Ok(())
}

/// Whether a file is the name of another one with the number of a process.
fn is_part(name: &str, path: &Path) -> bool {
    let whole = path.file_name().unwrap_or_default().to_string_lossy();
    let process = name
        .strip_prefix(&*whole)
        .and_then(|rest| rest.strip_prefix('.'))
        .and_then(|rest| rest.strip_suffix(".part"));
    process.is_some_and(|number| number.parse::<u32>().is_ok())
}

/// CSV with a header line; numbers read back to the same f64.
pub(crate) fn to_csv<R: Serialize>(rows: &[R]) -> Result<String> {
    let mut writer = csv::Writer::from_writer(Vec::new());
    for row in rows {
        writer.serialize(row)?;
    }
    Ok(String::from_utf8(writer.into_inner()?)?)
}

/// Reads a table that [`to_csv`] wrote.
pub(crate) fn read_csv<R: DeserializeOwned>(path: &Path) -> Result<Vec<R>> {
    let mut reader =
        csv::Reader::from_path(path).with_context(|| format!("reading {}", path.display()))?;
    let rows = reader.deserialize().collect::<Result<Vec<R>, _>>();
    rows.with_context(|| format!("reading {}", path.display()))
}
