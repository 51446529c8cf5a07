//! The folder of one result: its files are written into a temporary folder, which then replaces it.

use std::cell::RefCell;
use std::fs::{self, File};
use std::io;
use std::path::{Path, PathBuf};

use anyhow::Result;
use tempfile::TempDir;
use viscofriction::WrongInput;
use viscofriction_plot::Figure;

use super::{
    OutputFile, PART_SUFFIX, eprint_line, folder_of, link_target, lock, name_of, not_written,
    part_prefix, picture, remove_parts,
};
use crate::input::is_input;

/// A folder for the files of one result, locked against other runs while this value lives.
pub(crate) struct OutputFolder {
    /// Path as given.
    path: PathBuf,
    /// Path with links resolved.
    real: PathBuf,
    /// True if a result in the folder may be replaced.
    overwrite: bool,
    /// Names of all files that a result may have.
    names: Vec<&'static str>,
    /// Where the files are written at first.
    place: Place,
    /// The opened folder, whose lock ends with this value; `None` if folders cannot be opened.
    _lock: Option<File>,
}

/// Location of the files until all of them are written.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
enum Place {
    /// In a temporary folder beside this one, with which it is exchanged.
    Beside,
    /// In a temporary folder inside this one, which has no result yet; the files are then moved.
    Inside,
}

/// Suffix of a folder renamed out of the way, on systems that cannot exchange folders atomically.
const AWAY_SUFFIX: &str = ".away";

/// Message if a result cannot be replaced together with its folder.
const NO_EXCHANGE: &str = "the answer in it is replaced together with its folder, which must not be the one that the command runs in \
                           or a mounted disk, and must be in a folder that can be written; remove the files of the answer first, or \
                           give another folder";

impl OutputFolder {
    /// Creates the folder, or opens one without any of the named files (separated by spaces). Errors are those of
    /// [`OutputFile::new`] and [`lock`].
    pub(crate) fn new(
        path: &Path,
        overwrite: bool,
        names: &'static str,
    ) -> Result<Self, WrongInput> {
        let wrong = |problem: &str| WrongInput(format!("--out {}: {problem}", path.display()));
        let failed = |error: io::Error| wrong(&error.to_string());
        match path.metadata() {
            Ok(file) if !file.is_dir() => return Err(wrong("a folder is needed")),
            Err(error) if error.kind() != io::ErrorKind::NotFound => return Err(failed(error)),
            _ => {}
        }
        let names: Vec<&str> = names.split(' ').collect();
        let target = link_target(path);
        restore(&target);
        check_names(path, &names, overwrite)?;
        fs::create_dir_all(&target).map_err(failed)?;
        let real = target.canonicalize().map_err(failed)?;
        // Lock the folder against other runs. Some systems cannot open folders; then there is no lock.
        let folder = File::open(&real).ok();
        if let Some(folder) = &folder {
            lock(folder, path)?;
            remove_parts(&real, &names);
            clear_leftovers(&real, &names);
        }
        let place = place(&real, &names).map_err(failed)?;
        let folder = Self {
            path: path.to_owned(),
            real,
            overwrite,
            names,
            place: place.ok_or_else(|| wrong(NO_EXCHANGE))?,
            _lock: folder,
        };
        // Test that files can be written before anything is computed.
        folder.new_part().map_err(failed)?;
        Ok(folder)
    }

    /// Path of the folder as given.
    pub(crate) fn path(&self) -> &Path {
        &self.path
    }

    /// Creates a temporary folder for the files; it replaces the result only when all are written.
    pub(crate) fn begin(&self) -> Result<NewFiles<'_>> {
        let part = self
            .new_part()
            .map_err(|error| not_written(self.path.display(), error))?;
        Ok(NewFiles {
            folder: self,
            part,
            written: RefCell::default(),
        })
    }

    /// Creates the temporary folder next to the result, or inside it, according to its [`Place`].
    fn new_part(&self) -> io::Result<TempDir> {
        let within = match self.place {
            Place::Beside => self.real.parent().unwrap_or(&self.real),
            Place::Inside => &self.real,
        };
        new_part(&self.real, within)
    }
}

impl Drop for OutputFolder {
    /// Removes the folder if it is empty; otherwise the system refuses.
    fn drop(&mut self) {
        fs::remove_dir(&self.real).ok();
    }
}

/// New files that replace those of a folder together; they are discarded without [`Self::finish`].
pub(crate) struct NewFiles<'a> {
    folder: &'a OutputFolder,
    part: TempDir,
    /// Names in the order of writing.
    written: RefCell<Vec<String>>,
}

impl NewFiles<'_> {
    /// Writes the file `name` of an output folder.
    pub(crate) fn write(&self, name: &str, contents: &[u8]) -> Result<()> {
        let written = fs::write(self.part.path().join(name), contents);
        written.map_err(|error| not_written(self.folder.path.join(name).display(), error))?;
        self.written.borrow_mut().push(name.to_owned());
        Ok(())
    }

    /// Writes a picture as SVG and PNG. One that cannot be drawn is left out, with a line on standard error, because the numbers are worth
    /// more than the picture; then the result is false.
    pub(crate) fn draw(&self, name: &str, figure: &Figure) -> Result<bool> {
        let (svg, png) = match picture(figure) {
            Ok(drawn) => drawn,
            Err(problem) => {
                eprint_line(&format!("no picture {name}: {problem:#}"));
                return Ok(false);
            }
        };
        self.write(&format!("{name}.svg"), svg.as_bytes())?;
        self.write(&format!("{name}.png"), &png)?;
        Ok(true)
    }

    /// Moves the files into the folder. If that fails they remain where they are, and the error names the place.
    pub(crate) fn finish(self) -> Result<()> {
        let OutputFolder { real, names, .. } = self.folder;
        // Another program may have written there meanwhile.
        check_names(&self.folder.path, names, self.folder.overwrite)?;
        // The lock marks the temporary folder as in use.
        let lock = File::open(self.part.path()).ok();
        lock.as_ref().map(File::try_lock);
        let part = self.part.keep();
        let kept = |error| {
            let [given, part] = [&self.folder.path, &part].map(|path| path.display());
            not_written(format!("{given} (the files are in {part})"), error)
        };
        if self.folder.place == Place::Inside {
            let mut written = self.written.into_inner().into_iter();
            let moved =
                written.try_for_each(|name| rename_new(&part.join(&name), &real.join(name)));
            return moved.and_then(|()| fs::remove_dir(&part)).map_err(kept);
        }
        link_other_files(&part, real, names).map_err(kept)?;
        let old = exchange(&part, real).map_err(kept)?;
        keep_links(&old, real, names)?;
        clear(&old, real, names);
        Ok(())
    }
}

/// Applies the checks of [`OutputFile::new`] to each name in a folder.
fn check_names(folder: &Path, names: &[&str], overwrite: bool) -> Result<(), WrongInput> {
    names
        .iter()
        .try_for_each(|name| OutputFile::new(&folder.join(name), overwrite).map(drop))
}

/// Creates a temporary folder with the permissions of `folder`.
fn new_part(folder: &Path, within: &Path) -> io::Result<TempDir> {
    let start = part_prefix(&name_of(folder));
    let mut builder = tempfile::Builder::new();
    let part = builder
        .prefix(&start)
        .suffix(PART_SUFFIX)
        .tempdir_in(within)?;
    fs::set_permissions(part.path(), fs::metadata(folder)?.permissions())?;
    Ok(part)
}

/// Location for the new files; `None` if a result exists and the folder cannot be exchanged.
fn place(folder: &Path, names: &[&str]) -> io::Result<Option<Place>> {
    let entries = fs::read_dir(folder)?.flatten();
    let entries: Vec<_> = entries.map(|entry| entry.file_name()).collect();
    let has_answer = names
        .iter()
        .any(|name| entries.iter().any(|entry| entry == name));
    let runs_here = std::env::current_dir().is_ok_and(|current| {
        let current = current.canonicalize().unwrap_or(current);
        current.starts_with(folder)
    });
    let can_be_exchanged = folder.parent().is_some_and(|parent| {
        !runs_here && is_on_one_disk(folder, parent) && new_part(folder, parent).is_ok()
    });
    Ok(match (has_answer, can_be_exchanged) {
        (true, false) => None,
        // A first answer is put into the folder itself if folders cannot be exchanged, or if it has other files, which then need
        // not be moved.
        (false, _) if !(can_be_exchanged && entries.is_empty()) => Some(Place::Inside),
        _ => Some(Place::Beside),
    })
}

/// True if both folders are on one file system.
#[cfg(unix)]
fn is_on_one_disk(folder: &Path, parent: &Path) -> bool {
    use std::os::unix::fs::MetadataExt as _;
    let disk = |path: &Path| fs::metadata(path).map(|folder| folder.dev()).ok();
    disk(folder) == disk(parent)
}
/// Assumes one file system, on systems other than Unix; a move across file systems then fails with its own message.
#[cfg(not(unix))]
fn is_on_one_disk(_: &Path, _: &Path) -> bool {
    true
}

/// Hard-links the files of a folder that are not of the result into its successor `part`, and gives the new files of the result
/// the permissions of those that they replace.
fn link_other_files(part: &Path, folder: &Path, names: &[&str]) -> io::Result<()> {
    for entry in fs::read_dir(folder)?.flatten() {
        let [old, new] = [entry.path(), part.join(entry.file_name())];
        if !is_of_answer(&old, names) {
            // Entries that cannot be hard-linked, such as folders, are moved later.
            fs::hard_link(&old, &new).ok();
        } else if new.exists() && !old.is_symlink() {
            fs::set_permissions(&new, fs::metadata(&old)?.permissions())?;
        }
    }
    Ok(())
}

/// Exchanges two folders, atomically where possible; returns the new path of the old one.
fn exchange(part: &Path, folder: &Path) -> io::Result<PathBuf> {
    #[cfg(any(target_os = "linux", target_os = "android", target_vendor = "apple"))]
    {
        use rustix::fs::{CWD, RenameFlags, renameat_with};
        if renameat_with(CWD, part, CWD, folder, RenameFlags::EXCHANGE).is_ok() {
            return Ok(part.to_owned());
        }
    }
    exchange_by_renaming(part, folder)
}

/// Exchanges two folders by two renames; [`restore`] recovers from an interruption between them.
fn exchange_by_renaming(part: &Path, folder: &Path) -> io::Result<PathBuf> {
    let away = part.with_extension(&AWAY_SUFFIX[1..]);
    fs::rename(folder, &away)?;
    fs::rename(part, folder).inspect_err(|_| {
        fs::rename(&away, folder).ok();
    })?;
    Ok(away)
}

/// Renames a file or folder; an error if the new name exists.
fn rename_new(from: &Path, to: &Path) -> io::Result<()> {
    #[cfg(any(target_os = "linux", target_os = "android", target_vendor = "apple"))]
    {
        use rustix::fs::{CWD, RenameFlags, renameat_with};
        use rustix::io::Errno;
        match renameat_with(CWD, from, CWD, to, RenameFlags::NOREPLACE) {
            // Some file systems do not support this flag.
            Err(Errno::INVAL | Errno::NOSYS | Errno::NOTSUP) => {}
            renamed => return Ok(renamed?),
        }
    }
    if to.symlink_metadata().is_ok() {
        return Err(io::ErrorKind::AlreadyExists.into());
    }
    fs::rename(from, to)
}

/// Keeps symbolic links among the replaced files of the result: the new contents are written to the targets, and the links
/// moved into the new folder.
fn keep_links(old: &Path, folder: &Path, names: &[&str]) -> Result<()> {
    for name in names {
        let [link, new] = [old, folder].map(|folder| folder.join(name));
        if link.is_symlink() && new.exists() {
            let failed = |error| not_written(new.display(), error);
            let contents = fs::read(&new).map_err(failed)?;
            let target = OutputFile {
                path: link_target(&link),
                overwrite: true,
            };
            target.write(&contents)?;
            fs::rename(&link, &new).map_err(failed)?;
        }
    }
    Ok(())
}

/// True if a file belongs to a result and is not an input of this command.
fn is_of_answer(file: &Path, names: &[&str]) -> bool {
    names.contains(&&*name_of(file)) && !is_input(file)
}

/// Removes a replaced folder `old`. Its files that are not of the result, and are not in the new `folder` yet, are moved there
/// first; if that fails, the old folder stays and a message says so.
fn clear(old: &Path, folder: &Path, names: &[&str]) {
    let cleared = || -> io::Result<()> {
        let entries = fs::read_dir(old)?.flatten();
        let paths = entries.map(|entry| (entry.path(), folder.join(entry.file_name())));
        let is_given_up =
            |(left, kept): &(PathBuf, PathBuf)| is_of_answer(left, names) || is_same(left, kept);
        let (given_up, others): (Vec<_>, Vec<_>) = paths.partition(is_given_up);
        // Move other files back before anything is removed.
        others
            .iter()
            .try_for_each(|(left, kept)| rename_new(left, kept))?;
        given_up
            .iter()
            .try_for_each(|(left, _)| fs::remove_file(left))?;
        fs::remove_dir(old)
    };
    if let Err(error) = cleared() {
        let [old, folder] = [old, folder].map(|path| path.display());
        eprint_line(&format!(
            "{old} has files that were in {folder}, and stays: {error}"
        ));
    }
}

/// True if both paths are the same file.
#[cfg(unix)]
fn is_same(one: &Path, other: &Path) -> bool {
    use std::os::unix::fs::MetadataExt as _;
    let identity = |path: &Path| {
        let file = path.symlink_metadata();
        file.map(|file| (file.dev(), file.ino())).ok()
    };
    identity(one).is_some() && identity(one) == identity(other)
}
/// True if both are files, on systems other than Unix, where the identity of a file is not read.
#[cfg(not(unix))]
fn is_same(one: &Path, other: &Path) -> bool {
    one.is_file() && other.is_file()
}

/// Temporary folders of interrupted runs for the result `folder`: those in `within` whose name has the suffix `end`. Those of
/// running programs are locked and left out.
fn leftovers(folder: &Path, within: &Path, end: &str) -> Vec<PathBuf> {
    let start = part_prefix(&name_of(folder));
    let is_left = |path: &PathBuf| {
        let name = name_of(path);
        let is_part = name.starts_with(&start) && name.ends_with(end) && path.is_dir();
        is_part && !path.is_symlink() && File::open(path).is_ok_and(|part| part.try_lock().is_ok())
    };
    let entries = fs::read_dir(within).into_iter().flatten().flatten();
    let paths = entries.map(|entry| entry.path());
    paths.filter(is_left).collect()
}

/// Renames a folder back that an interrupted run had renamed out of the way.
fn restore(folder: &Path) {
    if folder.symlink_metadata().is_err()
        && let Some(away) = leftovers(folder, folder_of(folder), AWAY_SUFFIX).first()
    {
        fs::rename(away, folder).ok();
    }
}

/// Removes the temporary folders of interrupted runs.
fn clear_leftovers(folder: &Path, names: &[&str]) {
    for within in [folder_of(folder), folder] {
        for end in [PART_SUFFIX, AWAY_SUFFIX] {
            for part in leftovers(folder, within, end) {
                clear(&part, folder, names);
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn text(folder: &Path, name: &str) -> Option<String> {
        fs::read_to_string(folder.join(name)).ok()
    }

    /// A file system without atomic exchange, on which a run may be killed between both renames.
    #[test]
    fn a_folder_that_was_moved_away_comes_back() {
        let scratch = TempDir::new().expect("a folder");
        let [folder, part] =
            ["out", ".out.viscofriction-1.part"].map(|name| scratch.path().join(name));
        for (path, contents) in [(&folder, "old"), (&part, "new")] {
            fs::create_dir(path).expect("a folder");
            fs::write(path.join("result.json"), contents).expect("a file");
        }
        let away = exchange_by_renaming(&part, &folder).expect("an exchange");
        assert_eq!(text(&folder, "result.json").as_deref(), Some("new"));
        fs::rename(&folder, &part).expect("the first step only");
        restore(&folder);
        assert!(!away.exists(), "{} stays", away.display());
        assert_eq!(text(&folder, "result.json").as_deref(), Some("old"));
        clear_leftovers(&folder, &["result.json"]);
        assert!(!part.exists(), "{} stays", part.display());
    }
}
