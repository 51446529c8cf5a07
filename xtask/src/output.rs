//! Files that are whole or not there, printed tables, and the error that means wrong input.

use std::fs;
use std::io::Write as _;
use std::path::{Path, PathBuf};

use anyhow::{Context, Result};
use comfy_table::{Row, Table};
use serde::Serialize;
use serde::de::DeserializeOwned;
use viscofriction_plot::{Figure, PNG_WIDTH, draw, render_png};

use crate::tasks::in_parallel;

pub use viscofriction::WrongInput;

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
pub(crate) fn markdown_table<R: Into<Row>>(
    header: impl Into<Row>,
    rows: impl IntoIterator<Item = R>,
) -> Table {
    let mut table = Table::new();
    table.load_style(comfy_table::presets::ASCII_MARKDOWN);
    table.set_header(header);
    table.add_rows(rows);
    table
}

/// Makes the folder that `--out` names.
pub(crate) fn make_folder(out: &Path) -> Result<(), WrongInput> {
    let problem = |error| WrongInput(format!("--out {} cannot be made: {error}", out.display()));
    fs::create_dir_all(out).map_err(problem)
}

/// Writes a file under another name and then renames it, so that an interruption leaves the old file or the new one.
pub(crate) fn write_atomically(path: &Path, contents: &[u8]) -> Result<()> {
    let mut part = path.as_os_str().to_owned();
    part.push(".part");
    let write = || {
        fs::create_dir_all(path.parent().unwrap_or(Path::new(".")))?;
        fs::write(&part, contents)?;
        fs::rename(&part, path)
    };
    write().with_context(|| format!("writing {}", path.display()))
}

/// Draws a figure and writes it beside other files, as `NAME.svg` and `NAME.png`; returns the SVG.
pub(crate) fn write_figure(folder: &Path, name: &str, figure: &Figure) -> Result<String> {
    let drawing = draw(figure).with_context(|| format!("drawing {name}"))?;
    let png = render_png(&drawing, PNG_WIDTH).with_context(|| format!("drawing {name}"))?;
    let path = |extension: &str| folder.join(format!("{name}.{extension}"));
    write_atomically(&path("svg"), drawing.svg.as_bytes())?;
    write_atomically(&path("png"), &png)?;
    Ok(drawing.svg)
}

/// Points of a curve, one for each row of a table.
pub(crate) fn points<R>(rows: &[R], x: impl Fn(&R) -> f64, y: impl Fn(&R) -> f64) -> Vec<[f64; 2]> {
    rows.iter().map(|row| [x(row), y(row)]).collect()
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

/// Items whose rows are computed before they are written, of many that take seconds each.
pub(crate) const ROWS_AT_ONCE: usize = 64;

/// A table whose file is written as it grows, so that an interrupted run goes on where it was.
pub(crate) struct GrowingTable<R> {
    pub(crate) file: PathBuf,
    pub(crate) rows: Vec<R>,
}

impl<R: Serialize + Send> GrowingTable<R> {
    /// The rows of a file; none if it is not there.
    pub(crate) fn open(file: PathBuf) -> Result<Self>
    where
        R: DeserializeOwned,
    {
        let rows = file.exists().then(|| read_csv(&file)).transpose()?;
        let rows = rows.unwrap_or_default();
        Ok(Self { file, rows })
    }

    /// Adds the rows of all items, and writes the file after so many of them.
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

    pub(crate) fn write(&self) -> Result<()> {
        write_atomically(&self.file, to_csv(&self.rows)?.as_bytes())
    }
}

/// Four digits, or fewer if the error is larger than a unit of the last one.
pub(crate) fn known_digits(value: f64, error: Option<f64>) -> String {
    if value == 0.0 || value.fract() == 0.0 && value.abs() < 1e6 {
        return value.to_string();
    }
    let first = value.abs().log10().floor();
    let last = error.map_or(f64::NEG_INFINITY, |error| error.log10().ceil());
    let is_below = |count: f64| move |&digit: &usize| (digit as f64) < count;
    let decimals = |count| (0..20).take_while(is_below(count)).count();
    if (-3.0..6.0).contains(&first) {
        let last = last.max(first - 3.0);
        return format!("{value:.*}", decimals(-last));
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
