//! Files that are whole or not there, pictures, and the error that means wrong input.

use std::fs;
use std::io::Write as _;
use std::path::Path;

use anyhow::{Context, Result};
use viscofriction_plot::{Figure, PNG_WIDTH, draw, render_png};

pub use viscofriction::WrongInput;

/// Prints a line to standard output. A pipe that its reader has closed, as `head` does, is no error.
pub(crate) fn print_line(text: &dyn std::fmt::Display) -> Result<()> {
    match writeln!(std::io::stdout(), "{text}") {
        Err(error) if error.kind() != std::io::ErrorKind::BrokenPipe => {
            Err(error).context("printing")
        }
        _ => Ok(()),
    }
}

/// Makes the folder that `--out` names, with all above it; a folder that is there stays as it is.
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

/// Draws a figure and writes it beside other files, as `NAME.svg` and `NAME.png`.
pub(crate) fn write_figure(folder: &Path, name: &str, figure: &Figure) -> Result<()> {
    let drawing = draw(figure).with_context(|| format!("drawing {name}"))?;
    let png = render_png(&drawing, PNG_WIDTH).with_context(|| format!("drawing {name}"))?;
    let path = |extension: &str| folder.join(format!("{name}.{extension}"));
    write_atomically(&path("svg"), drawing.svg.as_bytes())?;
    write_atomically(&path("png"), &png)
}

/// Points of a curve, one for each row of a table.
pub(crate) fn points<R>(rows: &[R], x: impl Fn(&R) -> f64, y: impl Fn(&R) -> f64) -> Vec<[f64; 2]> {
    rows.iter().map(|row| [x(row), y(row)]).collect()
}
