//! Access to the files that a scene names, within a memory limit.

use std::path::{Path, PathBuf};

use crate::scene::{Scene, SceneError};
use crate::text::WrongInput;

/// Reads a file of at most the given number of bytes; an error message names the file.
pub type ReadFile = fn(&Path, u64) -> Result<Vec<u8>, WrongInput>;

/// The files that a scene names.
#[derive(Debug, Clone, Copy)]
pub struct Files<'a> {
    /// Folder that relative names refer to.
    pub folder: &'a Path,
    /// Function that reads a file.
    pub read: ReadFile,
    /// Memory limit for one file with all data derived from it, \[bytes]; `None` stands for 4 GiB.
    pub memory: Option<u64>,
}

/// Bound of the memory per table row while it is read, \[bytes]. Derived: a parsed row with its line number has at most 56 bytes.
/// It counts three times, because a list that grows holds its old and its doubled storage at the same time.
const BYTES_PER_ROW: u64 = 200;
/// Size of a material file, \[bytes], above which it is refused. Chosen: the covariance that a fit of up to 200 branches writes
/// has room in it.
const MAX_MATERIAL_FILE: u64 = 1 << 21;

impl<'a> Files<'a> {
    /// The files of a scene in a folder.
    ///
    /// # Errors
    /// [`SceneError`] if the memory limit of the scene is invalid.
    pub fn of(scene: &Scene, folder: &'a Path, read: ReadFile) -> Result<Self, SceneError> {
        let memory = scene.solve.checked_memory()?;
        Ok(Self {
            folder,
            read,
            memory,
        })
    }

    /// Memory limit for one file with all data derived from it, \[bytes]; 4 GiB if none is given.
    pub fn memory(&self) -> u64 {
        self.memory.unwrap_or(1 << 32)
    }

    /// What `read` finds in a table of numbers in the folder of the scene; errors are at `key`.
    pub(crate) fn read_table<T>(
        &self,
        key: &str,
        name: &Path,
        read: impl FnOnce(&Path, &[u8]) -> Result<T, String>,
    ) -> Result<T, SceneError> {
        let table = self.table(name);
        let found = table.and_then(|(file, contents)| read(&file, &contents).map_err(WrongInput));
        found.map_err(|WrongInput(problem)| SceneError::at(key, problem))
    }

    /// Path and contents of a table of numbers in the folder of the scene. Refuses one whose rows would exceed the memory limit
    /// when parsed.
    fn table(&self, name: &Path) -> Result<(PathBuf, Vec<u8>), WrongInput> {
        let memory = self.memory();
        let file = self.folder.join(name);
        let table = self.contents(name, memory)?;
        let ends = |end: u8| table.iter().filter(|byte| **byte == end).count() as u64;
        let rows = ends(b'\n').max(ends(b'\r'));
        let needed = table.len() as u64 + BYTES_PER_ROW * rows;
        if needed > memory {
            let file = file.display();
            return Err(WrongInput(format!(
                "{file}: {rows} rows need {needed} bytes of memory, and {memory} are allowed"
            )));
        }
        Ok((file, table))
    }

    /// Path and contents of a material file in the folder of the scene, of at most [`MAX_MATERIAL_FILE`] bytes.
    pub(crate) fn material(&self, name: &Path) -> Result<(PathBuf, Vec<u8>), WrongInput> {
        let contents = self.contents(name, MAX_MATERIAL_FILE)?;
        Ok((self.folder.join(name), contents))
    }

    /// Contents of a file in the folder of the scene, of at most `max_bytes` bytes.
    pub(crate) fn contents(&self, name: &Path, max_bytes: u64) -> Result<Vec<u8>, WrongInput> {
        (self.read)(&self.folder.join(name), max_bytes)
    }
}
