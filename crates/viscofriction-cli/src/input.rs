//! What the commands read: files and the standard input, none of them without end.

use std::fs::File;
use std::io::Read;
use std::path::Path;

use viscofriction::WrongInput;
use viscofriction::scene::{Source, height_map, profile};
use viscofriction::solve::problem_of;

use crate::material::check_table;
use crate::sweep::check_rows;

/// Larger files are no input of this program, \[bytes].
const LARGEST_FILE: u64 = 1 << 30;
/// A scene is written by a person, and names the files that are large.
const LARGEST_SCENE: u64 = 1 << 24;

/// Reads a whole file that the command line or a scene names.
pub(crate) fn read_input(path: &Path) -> Result<Vec<u8>, WrongInput> {
    let wrong =
        |problem: &dyn std::fmt::Display| WrongInput(format!("{}: {problem}", path.display()));
    let file = path.metadata().map_err(|error| wrong(&error))?;
    if !file.is_file() {
        let needed = "a regular file is needed, and not a folder, a device or a pipe";
        return Err(wrong(&needed));
    }
    let file = File::open(path).map_err(|error| wrong(&error))?;
    read_at_most(LARGEST_FILE, file).map_err(|problem| wrong(&problem))
}

/// The scene in a file, or on the standard input.
pub(crate) fn read_scene(path: &Path) -> Result<Source, WrongInput> {
    let contents = if path == Path::new("-") {
        read_at_most(LARGEST_SCENE, std::io::stdin())
            .map_err(|problem| WrongInput(format!("-: {problem}")))?
    } else {
        read_input(path)?
    };
    Source::new(path, contents)
}

fn read_at_most(most: u64, file: impl Read) -> Result<Vec<u8>, String> {
    let mut contents = Vec::new();
    let read = file.take(most + 1).read_to_end(&mut contents);
    read.map_err(|error| error.to_string())?;
    if contents.len() as u64 > most {
        return Err(format!("there are more than {most} bytes"));
    }
    Ok(contents)
}

/// A kind of file that the commands read.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum InputKind {
    /// A scene, of `run` and `sweep`.
    Scene,
    /// Radii and heights that a scene names.
    Profile,
    /// A grid of heights that a scene names.
    HeightMap,
    /// Measured moduli, of `fit-material`.
    Moduli,
    /// Rows of a sweep, of `sweep --resume` and `sweep --merge`.
    SweepRows,
}

/// Checks the contents of a `file` like the command that reads it, up to the point where it would begin to compute.
///
/// The file need not be there; what a scene names is beside it.
///
/// # Errors
/// [`WrongInput`] with file and line.
pub fn check_input(kind: InputKind, file: &Path, contents: &[u8]) -> Result<(), WrongInput> {
    match kind {
        InputKind::Scene => {
            let source = Source::new(file, contents.to_vec())?;
            problem_of(&source, None, read_input).map(|_| ())
        }
        InputKind::Profile => profile(file, contents).map(|_| ()).map_err(WrongInput),
        InputKind::HeightMap => {
            let map = height_map(file, contents, [1.0; 2]);
            map.map(|_| ()).map_err(WrongInput)
        }
        InputKind::Moduli => check_table(file, contents),
        InputKind::SweepRows => check_rows(file, contents),
    }
}
