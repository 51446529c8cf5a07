//! What the program prints and writes; nothing that a person has is replaced unless they say so.

use std::fs::{self, File, TryLockError};
use std::io::{ErrorKind, Write as _};
use std::path::{Path, PathBuf};

use anyhow::{Context, Result};
use clap::ValueEnum;
use comfy_table::Table;
use serde::Serialize;
use viscofriction::WrongInput;
use viscofriction_plot::{Figure, PNG_WIDTH, draw, render_png};

use crate::input::is_input;

/// How a result is printed.
#[derive(Debug, Clone, Copy, PartialEq, Eq, ValueEnum)]
pub(crate) enum Format {
    Table,
    Json,
}

pub(crate) fn print_line(text: &dyn std::fmt::Display) -> Result<()> {
    print_text(&format!("{text}\n"))
}

/// Prints a text; a pipe that is closed is an error, by which the program ends quietly.
pub(crate) fn print_text(text: &str) -> Result<()> {
    let mut output = std::io::stdout();
    output.write_all(text.as_bytes())?;
    Ok(output.flush()?)
}

/// Whether somebody who reads the output has seen enough.
pub(crate) fn is_closed_pipe(error: &anyhow::Error) -> bool {
    let cause = error.chain().find_map(|cause| cause.downcast_ref());
    cause.is_some_and(|cause: &std::io::Error| cause.kind() == ErrorKind::BrokenPipe)
}

/// What stands below the warnings of a command.
pub(crate) const ABOUT_WARNINGS: &str = "about warnings: docs/numbers.md";

/// Says a line beside the output; where nobody reads it, nothing is lost.
pub(crate) fn say(text: &str) {
    writeln!(std::io::stderr(), "{text}").ok();
}

/// CSV with a line of names between blanks, which rows with fields have already; numbers read back to the same f64.
pub(crate) fn to_csv(
    names: &str,
    rows: impl IntoIterator<Item = impl Serialize>,
) -> Result<Vec<u8>> {
    let mut writer = csv::Writer::from_writer(Vec::new());
    if !names.is_empty() {
        writer.write_record(names.split(' '))?;
    }
    for row in rows {
        writer.serialize(row)?;
    }
    Ok(writer.into_inner()?)
}

/// A table in Markdown; bars divide the header.
pub(crate) fn markdown(header: &str) -> Table {
    let mut table = Table::new();
    table.load_style(comfy_table::presets::ASCII_MARKDOWN);
    table.set_header(header.split(" | "));
    table
}

/// A picture as SVG and as PNG.
pub(crate) fn picture(figure: &Figure) -> Result<(String, Vec<u8>)> {
    let drawing = draw(figure)?;
    let png = render_png(&drawing, PNG_WIDTH)?;
    Ok((drawing.svg, png))
}

/// A file that is whole or not there.
pub(crate) struct OutputFile {
    path: PathBuf,
    overwrite: bool,
}

impl OutputFile {
    /// A file to be written; a symbolic link stands for the file that it names. A device, a pipe, a socket and a folder are
    /// refused, an input of the same command, and a file that is there unless it may be replaced.
    pub(crate) fn new(path: &Path, overwrite: bool) -> Result<Self, WrongInput> {
        let wrong = |problem: &str| WrongInput(format!("--out {}: {problem}", path.display()));
        match fs::metadata(path) {
            Ok(file) if !file.is_file() => {
                Err(wrong("only a regular file is written, and this is none"))
            }
            Ok(_) if is_input(path) => Err(wrong(
                "this command reads that file, and replaces none that it reads",
            )),
            Ok(_) if !overwrite => Err(wrong("the file is there already; --overwrite replaces it")),
            Err(error) if error.kind() != ErrorKind::NotFound => Err(wrong(&error.to_string())),
            _ => Ok(Self {
                path: followed(path),
                overwrite,
            }),
        }
    }

    pub(crate) fn path(&self) -> &Path {
        &self.path
    }

    /// Writes the file under another name and then gives it its own, so that an interruption leaves the old one or the
    /// new one. A file that is replaced keeps its permissions.
    pub(crate) fn write(&self, contents: &[u8]) -> Result<()> {
        let write = || -> std::io::Result<()> {
            let folder = folder_of(&self.path);
            fs::create_dir_all(folder)?;
            remove_parts(folder, &[&name_of(&self.path)]);
            let mut part = new_part(&part_start(&name_of(&self.path)), folder)?;
            part.write_all(contents)?;
            if let Ok(replaced) = fs::metadata(&self.path) {
                part.as_file().set_permissions(replaced.permissions())?;
            }
            // Somebody else may have written it meanwhile.
            let persisted = if self.overwrite {
                part.persist(&self.path)
            } else {
                part.persist_noclobber(&self.path)
            };
            persisted?;
            Ok(())
        };
        write().with_context(|| format!("writing {}", self.path.display()))
    }
}

/// The folder that a file is in.
pub(crate) fn folder_of(path: &Path) -> &Path {
    match path.parent() {
        Some(folder) if !folder.as_os_str().is_empty() => folder,
        _ => Path::new("."),
    }
}

/// The name of a file in its folder.
pub(crate) fn name_of(path: &Path) -> String {
    let name = path.file_name().unwrap_or_default();
    name.to_string_lossy().into_owned()
}

/// What the name of an unfinished file begins with; 50 letters are 200 bytes at most, and no name may have more than 255.
fn part_start(name: &str) -> String {
    let name: String = name.chars().take(50).collect();
    format!(".{name}.viscofriction-")
}

const PART_END: &str = ".part";

/// A file that is removed unless it is finished, with the permissions of any new file.
fn new_part(start: &str, folder: &Path) -> std::io::Result<tempfile::NamedTempFile> {
    let mut builder = tempfile::Builder::new();
    builder.prefix(start).suffix(PART_END);
    #[cfg(unix)]
    {
        use std::os::unix::fs::PermissionsExt as _;
        // What the umask forbids is taken away by the system.
        builder.permissions(fs::Permissions::from_mode(0o666));
    }
    let part = builder.tempfile_in(folder)?;
    // As long as it is open, nobody takes it for one that was left.
    part.as_file().try_lock().ok();
    Ok(part)
}

/// Removes what a program that was killed has left of these files; what another one writes is locked.
pub(crate) fn remove_parts(folder: &Path, names: &[&str]) {
    for entry in fs::read_dir(folder).into_iter().flatten().flatten() {
        let part = entry.file_name().to_string_lossy().into_owned();
        let of = |name: &&str| part.starts_with(&part_start(name));
        let is_left = || File::open(entry.path()).is_ok_and(|part| part.try_lock().is_ok());
        let is_part = part.ends_with(PART_END) && names.iter().any(of);
        if is_part && is_left() && !is_input(&entry.path()) {
            fs::remove_file(entry.path()).ok();
        }
    }
}

/// The file that a symbolic link names, whether or not that is there; links that name each other are no file.
fn followed(path: &Path) -> PathBuf {
    match fs::read_link(path) {
        Ok(target) => followed(&path.with_file_name(target)),
        Err(_) => path.to_owned(),
    }
}

/// Takes what only one program may write, and keeps it as long as the file is open; refused while another program has it.
pub(crate) fn lock(file: &File, path: &Path) -> Result<(), WrongInput> {
    match file.try_lock() {
        Err(TryLockError::WouldBlock) => Err(WrongInput(format!(
            "--out {}: another viscofriction is writing it",
            path.display()
        ))),
        // Some file systems have no locks.
        Ok(()) | Err(TryLockError::Error(_)) => Ok(()),
    }
}

/// A folder for the files of one result; nobody else writes into it as long as this value lives.
pub(crate) struct OutputFolder {
    path: PathBuf,
    overwrite: bool,
    _lock: Option<File>,
}

impl OutputFolder {
    /// A folder that was made, or is there without any of the files that may be written, named between spaces; refused as
    /// by [`OutputFile::new`] and [`lock`].
    pub(crate) fn new(path: &Path, overwrite: bool, names: &str) -> Result<Self, WrongInput> {
        let wrong = |problem: &str| WrongInput(format!("--out {}: {problem}", path.display()));
        if path.exists() && !path.is_dir() {
            return Err(wrong("a folder is needed"));
        }
        let names: Vec<&str> = names.split(' ').collect();
        for name in &names {
            OutputFile::new(&path.join(name), overwrite)?;
        }
        fs::create_dir_all(path).map_err(|error| wrong(&error.to_string()))?;
        // Not every system opens folders.
        let folder = File::open(path).ok();
        if let Some(folder) = &folder {
            lock(folder, path)?;
            remove_parts(path, &names);
        }
        // Nothing is computed that cannot be written.
        new_part(&part_start("probe"), path).map_err(|error| wrong(&error.to_string()))?;
        Ok(Self {
            path: path.to_owned(),
            overwrite,
            _lock: folder,
        })
    }

    pub(crate) fn path(&self) -> &Path {
        &self.path
    }

    /// Writes one of the files.
    pub(crate) fn write(&self, name: &str, contents: &[u8]) -> Result<()> {
        OutputFile::new(&self.path.join(name), self.overwrite)?.write(contents)
    }

    /// Draws a picture as SVG and as PNG.
    pub(crate) fn draw(&self, name: &str, figure: &Figure) -> Result<()> {
        let (svg, png) = picture(figure).with_context(|| format!("drawing {name}"))?;
        self.write(&format!("{name}.svg"), svg.as_bytes())?;
        self.write(&format!("{name}.png"), &png)
    }
}

impl Drop for OutputFolder {
    /// A folder without files says nothing; one that has some is not removed by the system.
    fn drop(&mut self) {
        fs::remove_dir(&self.path).ok();
    }
}
