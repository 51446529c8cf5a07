//! What the program prints and writes; nothing that a person has is replaced unless they say so.

mod closed;
mod folder;

use std::fs::{self, File, TryLockError};
use std::io::{self, ErrorKind, Write as _};
use std::path::{Path, PathBuf};

use anyhow::Result;
use clap::ValueEnum;
use comfy_table::Table;
use serde::Serialize;
use tempfile::NamedTempFile;
use viscofriction::WrongInput;
use viscofriction_plot::{Figure, PNG_WIDTH, draw, render_png};

use crate::input::is_input;
pub(crate) use folder::{NewFiles, OutputFolder};

/// What was computed and could not be written.
#[derive(Debug)]
pub(crate) struct NotWritten(String);

impl std::fmt::Display for NotWritten {
    fn fmt(&self, out: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        write!(out, "{} was not written", self.0)
    }
}

/// The error of a file, or of the standard output, that was not written.
pub(crate) fn not_written(what: impl std::fmt::Display, error: io::Error) -> anyhow::Error {
    anyhow::Error::new(error).context(NotWritten(what.to_string()))
}

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
    printed(|| {
        let mut output = io::stdout();
        output.write_all(text.as_bytes())?;
        output.flush()
    })
}

/// Prints, and says where that cannot be done.
pub(crate) fn printed(print: impl FnOnce() -> io::Result<()>) -> Result<()> {
    let written = if closed::was_closed() {
        Err(io::Error::other("it is closed"))
    } else {
        print()
    };
    written.map_err(|error| not_written("the standard output", error))
}

/// Whether somebody who reads the output has seen enough.
pub(crate) fn is_closed_pipe(error: &anyhow::Error) -> bool {
    let cause = error.chain().find_map(|cause| cause.downcast_ref());
    cause.is_some_and(|cause: &io::Error| cause.kind() == ErrorKind::BrokenPipe)
}

/// What stands below the warnings of a command.
pub(crate) const ABOUT_WARNINGS: &str = "about warnings: docs/numbers.md";

/// Says a line beside the output; where nobody reads it, nothing is lost.
pub(crate) fn say(text: &str) {
    writeln!(io::stderr(), "{text}").ok();
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
        self.put(self.part(contents)?)
    }

    /// The contents under another name, in the same folder.
    pub(crate) fn part(&self, contents: &[u8]) -> Result<NamedTempFile> {
        let write = || -> io::Result<NamedTempFile> {
            let folder = folder_of(&self.path);
            fs::create_dir_all(folder)?;
            remove_parts(folder, &[&name_of(&self.path)]);
            let mut part = new_part(&part_start(&name_of(&self.path)), folder)?;
            part.write_all(contents)?;
            if let Ok(replaced) = fs::metadata(&self.path) {
                part.as_file().set_permissions(replaced.permissions())?;
            }
            Ok(part)
        };
        write().map_err(|error| not_written(self.path.display(), error))
    }

    /// Gives a part the name of the file.
    pub(crate) fn put(&self, part: NamedTempFile) -> Result<()> {
        // Somebody else may have written it meanwhile.
        let persisted = if self.overwrite {
            part.persist(&self.path)
        } else {
            part.persist_noclobber(&self.path)
        };
        let persisted = persisted.map(drop).map_err(io::Error::from);
        persisted.map_err(|error| not_written(self.path.display(), error))
    }

    /// Removes the file that is to be replaced, if there is one.
    pub(crate) fn remove(&self) -> Result<()> {
        if !self.overwrite {
            return Ok(());
        }
        match fs::remove_file(&self.path) {
            Err(error) if error.kind() != ErrorKind::NotFound => {
                Err(not_written(self.path.display(), error))
            }
            _ => Ok(()),
        }
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
fn new_part(start: &str, folder: &Path) -> io::Result<NamedTempFile> {
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
