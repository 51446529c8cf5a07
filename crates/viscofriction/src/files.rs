//! The files that scenes name, and the memory that they may take.

use std::path::{Path, PathBuf};

use crate::scene::{Scene, SceneError};
use crate::text::WrongInput;

/// Reads a file of at most so many bytes; the sentence of a failure names it.
pub type ReadFile = fn(&Path, u64) -> Result<Vec<u8>, WrongInput>;

/// The files that a scene names.
#[derive(Debug, Clone, Copy)]
pub struct Files<'a> {
    /// Where they are.
    pub folder: &'a Path,
    /// How they are read.
    pub read: ReadFile,
    /// Memory that one of them may take with all that it stands for, \[bytes]; none for 4 GiB.
    pub memory: Option<u64>,
}

/// Memory for a row of a table while it is read, \[bytes]: the points of a history, thrice while their list grows.
const PER_ROW: u64 = 200;
/// A material is written by a person or a fit, which has the covariance of up to 200 branches, \[bytes].
const LARGEST_MATERIAL: u64 = 1 << 21;

impl<'a> Files<'a> {
    /// Those of a scene, in a folder.
    ///
    /// # Errors
    /// [`SceneError`] where the memory that it allows is no size.
    pub fn of(scene: &Scene, folder: &'a Path, read: ReadFile) -> Result<Self, SceneError> {
        let memory = scene.solve.checked_memory()?;
        Ok(Self {
            folder,
            read,
            memory,
        })
    }

    /// Memory that one of them may take, \[bytes].
    pub fn memory(&self) -> u64 {
        self.memory.unwrap_or(1 << 32)
    }

    /// A table of numbers, with its path.
    pub(crate) fn table(&self, name: &Path) -> Result<(PathBuf, Vec<u8>), WrongInput> {
        let memory = self.memory();
        let file = self.folder.join(name);
        let table = self.contents(name, memory)?;
        let ends = |end: u8| table.iter().filter(|byte| **byte == end).count() as u64;
        let rows = ends(b'\n').max(ends(b'\r'));
        let needed = table.len() as u64 + PER_ROW * rows;
        if needed > memory {
            let file = file.display();
            return Err(WrongInput(format!(
                "{file}: {rows} rows need {needed} bytes of memory, and {memory} are allowed"
            )));
        }
        Ok((file, table))
    }

    /// The text of a material, with its path.
    pub(crate) fn material(&self, name: &Path) -> Result<(PathBuf, Vec<u8>), WrongInput> {
        let contents = self.contents(name, LARGEST_MATERIAL)?;
        Ok((self.folder.join(name), contents))
    }

    /// A file of at most so many bytes.
    pub(crate) fn contents(&self, name: &Path, most: u64) -> Result<Vec<u8>, WrongInput> {
        (self.read)(&self.folder.join(name), most)
    }
}
