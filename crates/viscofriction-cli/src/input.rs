//! What the commands read: files and the standard input, none of them without end.

use std::collections::BTreeSet;
use std::fs::File;
use std::io::{self, Read};
use std::path::Path;
use std::sync::{Mutex, PoisonError};

use viscofriction::WrongInput;
use viscofriction::scene::Source;

/// Larger files are no input of this program, \[bytes].
const LARGEST_FILE: u64 = 1 << 30;
/// A scene is written by a person, and names the files that are large.
const LARGEST_SCENE: u64 = 1 << 24;

/// A file whatever name or link it is opened by: its device and its number there.
#[cfg(unix)]
type Identity = (u64, u64);
/// A file whatever link it is opened by, with the name that it has in its folder.
#[cfg(not(unix))]
type Identity = std::path::PathBuf;

fn identity(path: &Path) -> io::Result<Identity> {
    #[cfg(unix)]
    return {
        use std::os::unix::fs::MetadataExt as _;
        path.metadata().map(|file| (file.dev(), file.ino()))
    };
    #[cfg(not(unix))]
    path.canonicalize()
}

/// The inputs of this command, none of which any option replaces.
static INPUTS: Mutex<BTreeSet<Identity>> = Mutex::new(BTreeSet::new());

/// Keeps a file from being replaced by this command; [`read_input`] does so too.
pub(crate) fn protect(path: &Path) {
    let mut inputs = INPUTS.lock().unwrap_or_else(PoisonError::into_inner);
    inputs.extend(identity(path));
}

/// Whether this command reads the file, under this name or another.
pub(crate) fn is_input(path: &Path) -> bool {
    let inputs = INPUTS.lock().unwrap_or_else(PoisonError::into_inner);
    identity(path).is_ok_and(|file| inputs.contains(&file))
}

/// Reads a whole file that the command line or a scene names.
pub(crate) fn read_input(path: &Path) -> Result<Vec<u8>, WrongInput> {
    protect(path);
    read_file(path)
}

/// Reads a whole file that the command may also write.
pub(crate) fn read_file(path: &Path) -> Result<Vec<u8>, WrongInput> {
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
        // A file that a shell has opened for it is an input too.
        protect(Path::new("/dev/stdin"));
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
