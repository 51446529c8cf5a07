//! What the program reads, prints and writes; nothing that a person has is replaced unless they say so.

use std::fs;
use std::io::{ErrorKind, Read as _, Write as _};
use std::path::{Path, PathBuf};

use anyhow::{Context, Result};
use serde::Serialize;
use viscofriction::WrongInput;
use viscofriction_plot::{Figure, PNG_WIDTH, draw, render_png};

/// Larger files are no input of this program, \[bytes].
const LARGEST_INPUT: u64 = 1 << 30;

/// Reads a whole file that the command line or a scene names.
pub(crate) fn read_input(path: &Path) -> Result<Vec<u8>, WrongInput> {
    let wrong =
        |problem: &dyn std::fmt::Display| WrongInput(format!("{}: {problem}", path.display()));
    let file = fs::metadata(path).map_err(|error| wrong(&error))?;
    if !file.is_file() {
        return Err(wrong(
            &"a regular file is needed, and not a folder, a device or a pipe",
        ));
    }
    if file.len() > LARGEST_INPUT {
        return Err(wrong(&format!(
            "the file has {} bytes, and at most {LARGEST_INPUT} are read",
            file.len()
        )));
    }
    fs::read(path).map_err(|error| wrong(&error))
}

/// Reads the standard input to its end.
pub(crate) fn read_standard_input() -> Result<Vec<u8>, WrongInput> {
    let mut contents = Vec::new();
    let read = std::io::stdin()
        .take(LARGEST_INPUT)
        .read_to_end(&mut contents);
    read.map_err(|error| WrongInput(format!("-: {error}")))?;
    Ok(contents)
}

/// Prints a line; a reader that has seen enough is no error.
pub(crate) fn print_line(text: &dyn std::fmt::Display) -> Result<()> {
    print_text(&format!("{text}\n"))
}

/// Prints a text; a reader that has seen enough is no error.
pub(crate) fn print_text(text: &str) -> Result<()> {
    let mut output = std::io::stdout();
    match output
        .write_all(text.as_bytes())
        .and_then(|()| output.flush())
    {
        Err(error) if error.kind() != ErrorKind::BrokenPipe => Err(error).context("printing"),
        _ => Ok(()),
    }
}

/// CSV with a header line; numbers read back to the same f64.
pub(crate) fn to_csv<R: Serialize>(rows: &[R]) -> Result<String> {
    let mut writer = csv::Writer::from_writer(Vec::new());
    for row in rows {
        writer.serialize(row)?;
    }
    Ok(String::from_utf8(writer.into_inner()?)?)
}

/// A file that is whole or not there.
#[derive(Debug, Clone)]
pub(crate) struct OutputFile {
    path: PathBuf,
    replaces: bool,
}

impl OutputFile {
    /// A file to be written; a symbolic link stands for the file that it names.
    ///
    /// # Errors
    /// [`WrongInput`] for a device, a pipe, a socket or a folder, and for a file that is there unless it may be replaced.
    pub(crate) fn new(path: &Path, overwrite: bool) -> Result<Self, WrongInput> {
        let path = followed(path);
        match fs::metadata(&path) {
            Ok(file) if !file.is_file() => Err(WrongInput(format!(
                "--out {}: only a regular file is written, and this is none",
                path.display()
            ))),
            Ok(_) if !overwrite => Err(WrongInput(format!(
                "--out {}: the file is there already; --overwrite replaces it",
                path.display()
            ))),
            found => Ok(Self {
                path,
                replaces: found.is_ok(),
            }),
        }
    }

    pub(crate) fn path(&self) -> &Path {
        &self.path
    }

    /// Writes the file under another name and then gives it its own, so that an interruption leaves the old one or the
    /// new one. A file that is replaced keeps its permissions.
    pub(crate) fn write(&self, contents: &[u8]) -> Result<()> {
        let say = || format!("writing {}", self.path.display());
        let folder = match self.path.parent() {
            Some(folder) if !folder.as_os_str().is_empty() => folder,
            _ => Path::new("."),
        };
        fs::create_dir_all(folder).with_context(say)?;
        let mut part = tempfile::Builder::new()
            .prefix(".viscofriction-")
            .suffix(".part")
            .permissions(self.permissions()?)
            .tempfile_in(folder)
            .with_context(say)?;
        part.write_all(contents).with_context(say)?;
        if self.replaces {
            part.persist(&self.path).map(|_| ()).with_context(say)
        } else {
            part.persist_noclobber(&self.path)
                .map(|_| ())
                .with_context(say)
        }
    }

    fn permissions(&self) -> Result<fs::Permissions> {
        match fs::metadata(&self.path) {
            Ok(file) => Ok(file.permissions()),
            Err(_) => new_file_permissions(),
        }
    }
}

/// Those of any new file; what the umask forbids is taken away by the system.
#[cfg(unix)]
#[expect(clippy::unnecessary_wraps, reason = "elsewhere they must be asked for")]
fn new_file_permissions() -> Result<fs::Permissions> {
    use std::os::unix::fs::PermissionsExt as _;
    Ok(fs::Permissions::from_mode(0o666))
}

/// Those of any new file.
#[cfg(not(unix))]
fn new_file_permissions() -> Result<fs::Permissions> {
    Ok(tempfile::tempfile()?.metadata()?.permissions())
}

/// The file that a symbolic link names, whether or not that is there.
pub(crate) fn followed(path: &Path) -> PathBuf {
    let mut path = path.to_owned();
    // As many links as the system itself follows.
    for _ in 0..40 {
        let Ok(target) = fs::read_link(&path) else {
            break;
        };
        path = path.parent().unwrap_or(Path::new("")).join(target);
    }
    path
}

/// A folder for the files of one result.
#[derive(Debug, Clone)]
pub(crate) struct OutputFolder {
    path: PathBuf,
    overwrite: bool,
}

impl OutputFolder {
    /// A folder that can be made, or is there without any of the files that may be written.
    ///
    /// # Errors
    /// [`WrongInput`] as of [`OutputFile::new`], before anything is computed.
    pub(crate) fn new(path: &Path, overwrite: bool, names: &[&str]) -> Result<Self, WrongInput> {
        if path.exists() && !path.is_dir() {
            return Err(WrongInput(format!(
                "--out {}: a folder is needed",
                path.display()
            )));
        }
        let folder = Self {
            path: path.to_owned(),
            overwrite,
        };
        for name in names {
            folder.file(name)?;
        }
        Ok(folder)
    }

    pub(crate) fn path(&self) -> &Path {
        &self.path
    }

    fn file(&self, name: &str) -> Result<OutputFile, WrongInput> {
        OutputFile::new(&self.path.join(name), self.overwrite)
    }

    /// Writes a file into the folder.
    pub(crate) fn write(&self, name: &str, contents: &[u8]) -> Result<()> {
        self.file(name)?.write(contents)
    }

    /// Draws a picture as SVG and as PNG.
    pub(crate) fn draw(&self, name: &str, figure: &Figure) -> Result<()> {
        let say = || format!("drawing {name}");
        let drawing = draw(figure).with_context(say)?;
        self.write(&format!("{name}.svg"), drawing.svg.as_bytes())?;
        let png = render_png(&drawing, PNG_WIDTH).with_context(say)?;
        self.write(&format!("{name}.png"), &png)
    }
}
