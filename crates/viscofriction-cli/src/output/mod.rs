//! Output of the program: text and files; existing files are replaced only on request.

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

/// A result that could not be written.
#[derive(Debug)]
pub(crate) struct NotWritten(String);

impl std::fmt::Display for NotWritten {
    fn fmt(&self, out: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        write!(out, "{} was not written", self.0)
    }
}

/// Error for `what` was not written, a file or the standard output; it leads to the exit status 3.
pub(crate) fn not_written(what: impl std::fmt::Display, error: io::Error) -> anyhow::Error {
    anyhow::Error::new(error).context(NotWritten(what.to_string()))
}

/// How a result is printed.
#[derive(Debug, Clone, Copy, PartialEq, Eq, ValueEnum)]
pub(crate) enum Format {
    Table,
    Json,
}

/// Prints a line to the standard output; a closed pipe is an error, on which the program ends silently.
pub(crate) fn print_line(text: &dyn std::fmt::Display) -> Result<()> {
    print_text(&format!("{text}\n"))
}

/// Prints a text; a closed pipe is an error, on which the program ends silently.
pub(crate) fn print_text(text: &str) -> Result<()> {
    printed(|| {
        let mut output = io::stdout();
        output.write_all(text.as_bytes())?;
        output.flush()
    })
}

/// Runs a print operation; an error names the standard output.
pub(crate) fn printed(print: impl FnOnce() -> io::Result<()>) -> Result<()> {
    let written = if closed::was_closed() {
        Err(io::Error::other("it is closed"))
    } else {
        print()
    };
    written.map_err(|error| not_written("the standard output", error))
}

/// True if the reader of the output has closed the pipe.
pub(crate) fn is_closed_pipe(error: &anyhow::Error) -> bool {
    let cause = error.chain().find_map(|cause| cause.downcast_ref());
    cause.is_some_and(|cause: &io::Error| cause.kind() == ErrorKind::BrokenPipe)
}

/// Line below the warnings of a command, which names the page that explains them.
pub(crate) const ABOUT_WARNINGS: &str = "about warnings: docs/numbers.md";

/// Prints a line to the standard error; errors are ignored.
pub(crate) fn eprint_line(text: &str) {
    writeln!(io::stderr(), "{text}").ok();
}

/// CSV with a header of names separated by spaces; an empty header if the rows name their fields. Numbers read back exactly.
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

/// A Markdown table; the header is separated by bars.
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

/// An output file that is written atomically.
pub(crate) struct OutputFile {
    path: PathBuf,
    overwrite: bool,
}

impl OutputFile {
    /// Validates an output path; a symbolic link stands for its target. Errors: anything but a regular file, an input of this
    /// command, and an existing file without `overwrite`.
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
                path: link_target(path),
                overwrite,
            }),
        }
    }

    /// Path with links resolved.
    pub(crate) fn path(&self) -> &Path {
        &self.path
    }

    /// Writes a temporary file and renames it, so that an interruption leaves the old or the new file. Permissions of a replaced
    /// file are kept.
    pub(crate) fn write(&self, contents: &[u8]) -> Result<()> {
        self.persist(self.part(contents)?)
    }

    /// Writes the contents to a temporary file in the same folder.
    pub(crate) fn part(&self, contents: &[u8]) -> Result<NamedTempFile> {
        let write = || -> io::Result<NamedTempFile> {
            let folder = folder_of(&self.path);
            fs::create_dir_all(folder)?;
            remove_parts(folder, &[&name_of(&self.path)]);
            let mut part = new_part(&part_prefix(&name_of(&self.path)), folder)?;
            part.write_all(contents)?;
            if let Ok(replaced) = fs::metadata(&self.path) {
                part.as_file().set_permissions(replaced.permissions())?;
            }
            Ok(part)
        };
        write().map_err(|error| not_written(self.path.display(), error))
    }

    /// Renames a temporary file, made by [`Self::part`], to the output file. An error if the file exists and may not be
    /// replaced.
    pub(crate) fn persist(&self, part: NamedTempFile) -> Result<()> {
        // Another program may have written the file meanwhile.
        let persisted = if self.overwrite {
            part.persist(&self.path)
        } else {
            part.persist_noclobber(&self.path)
        };
        persisted
            .map(drop)
            .map_err(|error| not_written(self.path.display(), io::Error::from(error)))
    }

    /// Removes an existing file if it may be replaced.
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

/// Folder of a file; `.` for a name alone.
pub(crate) fn folder_of(path: &Path) -> &Path {
    match path.parent() {
        Some(folder) if !folder.as_os_str().is_empty() => folder,
        _ => Path::new("."),
    }
}

/// Last part of a path; invalid UTF-8 in it is replaced.
pub(crate) fn name_of(path: &Path) -> String {
    let name = path.file_name().unwrap_or_default();
    name.to_string_lossy().into_owned()
}

/// Prefix of the name of a temporary file. It uses 50 characters of the name, at most 200 bytes, since names have at most 255.
fn part_prefix(name: &str) -> String {
    let name: String = name.chars().take(50).collect();
    format!(".{name}.viscofriction-")
}

/// Suffix of temporary files and folders.
const PART_SUFFIX: &str = ".part";

/// A locked temporary file in `folder` whose name begins with `start`, with default permissions; removed when dropped.
fn new_part(start: &str, folder: &Path) -> io::Result<NamedTempFile> {
    let mut builder = tempfile::Builder::new();
    builder.prefix(start).suffix(PART_SUFFIX);
    #[cfg(unix)]
    {
        use std::os::unix::fs::PermissionsExt as _;
        // Ask for the rights of an ordinary file, because temporary files have fewer; the system applies the umask.
        builder.permissions(fs::Permissions::from_mode(0o666));
    }
    let part = builder.tempfile_in(folder)?;
    // The lock marks the temporary file as in use.
    part.as_file().try_lock().ok();
    Ok(part)
}

/// Removes temporary files left by interrupted runs; those of running programs are locked and stay.
pub(crate) fn remove_parts(folder: &Path, names: &[&str]) {
    for entry in fs::read_dir(folder).into_iter().flatten().flatten() {
        let part = entry.file_name().to_string_lossy().into_owned();
        let of = |name: &&str| part.starts_with(&part_prefix(name));
        let is_left = || File::open(entry.path()).is_ok_and(|part| part.try_lock().is_ok());
        let is_part = part.ends_with(PART_SUFFIX) && names.iter().any(of);
        if is_part && is_left() && !is_input(&entry.path()) {
            fs::remove_file(entry.path()).ok();
        }
    }
}

/// The last target of a chain of symbolic links, whether or not it exists; the path itself if it is no link.
fn link_target(path: &Path) -> PathBuf {
    match fs::read_link(path) {
        Ok(target) => link_target(&path.with_file_name(target)),
        Err(_) => path.to_owned(),
    }
}

/// Locks a file while it is open; an error if another program holds the lock.
pub(crate) fn lock(file: &File, path: &Path) -> Result<(), WrongInput> {
    match file.try_lock() {
        Err(TryLockError::WouldBlock) => Err(WrongInput(format!(
            "--out {}: another viscofriction is writing it",
            path.display()
        ))),
        // Some file systems do not support locks.
        Ok(()) | Err(TryLockError::Error(_)) => Ok(()),
    }
}
