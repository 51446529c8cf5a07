//! Input files of limited size.

use std::fs;
use std::io::Error;
use std::path::Path;

use viscofriction::WrongInput;

/// Largest table of measurements, \[bytes]. Chosen: 128 MiB, far above the export of an instrument, so that a wrong file
/// does not fill the memory.
const LARGEST_TABLE: u64 = 1 << 27;

/// Reads a regular file of at most `most` bytes.
pub(crate) fn read_file(path: &Path, most: u64) -> Result<Vec<u8>, WrongInput> {
    let read = || {
        let file = path.metadata()?;
        if !file.is_file() || file.len() > most {
            let needed = format!("a regular file of at most {most} bytes is needed");
            return Err(Error::other(needed));
        }
        fs::read(path)
    };
    read().map_err(|error| WrongInput(format!("{}: {error}", path.display())))
}

/// Reads a table of measurements.
pub(crate) fn read_table(path: &Path) -> Result<Vec<u8>, WrongInput> {
    read_file(path, LARGEST_TABLE)
}
