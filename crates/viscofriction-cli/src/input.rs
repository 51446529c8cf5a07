//! What the commands read: files and the standard input, none of them without end.

use std::fs::File;
use std::io::{self, Read};
use std::path::Path;

use viscofriction::WrongInput;
use viscofriction::scene::Source;

/// Larger files are no input of this program, \[bytes].
const LARGEST_FILE: u64 = 1 << 30;
/// A scene is written by a person, and names the files that are large.
const LARGEST_SCENE: u64 = 1 << 24;

/// Reads a whole file that the command line or a scene names.
pub(crate) fn read_input(path: &Path) -> Result<Vec<u8>, WrongInput> {
    let read = || {
        if !path.metadata()?.is_file() {
            let needed = "a regular file is needed, and not a folder, a device or a pipe";
            return Err(io::Error::other(needed));
        }
        read_at_most(LARGEST_FILE, File::open(path)?)
    };
    read().map_err(|error| WrongInput(format!("{}: {error}", path.display())))
}

/// The scene in a file, or on the standard input.
pub(crate) fn read_scene(path: &Path) -> Result<Source, WrongInput> {
    let contents = if path == Path::new("-") {
        let contents = read_at_most(LARGEST_SCENE, io::stdin());
        contents.map_err(|error| WrongInput(format!("-: {error}")))?
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

fn read_at_most(most: u64, file: impl Read) -> io::Result<Vec<u8>> {
    let mut contents = Vec::new();
    file.take(most + 1).read_to_end(&mut contents)?;
    if contents.len() as u64 > most {
        let problem = format!("there are more than {most} bytes");
        return Err(io::Error::other(problem));
    }
    Ok(contents)
}
