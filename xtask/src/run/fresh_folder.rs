//! A folder that was not there before, for files that are not kept.

use std::fs;
use std::io::ErrorKind;
use std::path::{Path, PathBuf};

use anyhow::{Context, Result};

/// An empty folder that nobody else has, removed with all that is in it.
#[derive(Debug)]
pub(super) struct FreshFolder {
    path: PathBuf,
}

impl FreshFolder {
    /// A folder with the first free number of this process.
    ///
    /// # Errors
    /// When no folder can be made within `parent`; one that is there already is never taken.
    pub(super) fn within(parent: &Path) -> Result<Self> {
        let unusable = || format!("{} cannot hold files", parent.display());
        fs::create_dir_all(parent).with_context(unusable)?;
        let process = std::process::id();
        let mut number = 0_u64;
        loop {
            let path = parent.join(format!("{process}-{number}"));
            match fs::create_dir(&path) {
                Ok(()) => return Ok(Self { path }),
                Err(error) if error.kind() == ErrorKind::AlreadyExists => number += 1,
                Err(error) => return Err(error).with_context(unusable),
            }
        }
    }

    pub(super) fn path(&self) -> &Path {
        &self.path
    }

    /// Removes the folder, and says when that was not possible.
    pub(super) fn remove(self) -> Result<()> {
        let removed = fs::remove_dir_all(&self.path);
        removed.with_context(|| format!("removing {}", self.path.display()))
    }
}

impl Drop for FreshFolder {
    /// Also after a panic.
    fn drop(&mut self) {
        fs::remove_dir_all(&self.path).ok();
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_folder_that_is_there_is_neither_taken_nor_removed() {
        let parent = FreshFolder::within(&std::env::temp_dir()).expect("a parent");
        let first = FreshFolder::within(parent.path()).expect("a folder");
        let kept = first.path().join("kept");
        fs::write(&kept, "").expect("a file");
        let second = FreshFolder::within(parent.path()).expect("a folder");
        assert_ne!(first.path(), second.path(), "two folders at one time");
        let gone = second.path().to_owned();
        second.remove().expect("a folder to remove");
        assert!(
            kept.exists() && !gone.exists(),
            "{} is kept, {} is removed",
            kept.display(),
            gone.display()
        );
    }
}
