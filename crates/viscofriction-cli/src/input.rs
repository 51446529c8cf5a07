//! What the commands read: files and the standard input, none of them without end.

use std::fs::File;
use std::io::Read;
use std::path::Path;

use viscofriction::WrongInput;
use viscofriction::scene::Source;

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

/// Half of the memory that the machine has free, \[bytes]; none where the system does not say.
pub(crate) fn half_of_free_memory() -> Option<u64> {
    let table = std::fs::read_to_string("/proc/meminfo").ok()?;
    let free = table
        .lines()
        .find_map(|line| line.strip_prefix("MemAvailable:"))?;
    let kilobytes: u64 = free.trim().strip_suffix("kB")?.trim().parse().ok()?;
    Some(512 * kilobytes)
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
