//! A folder of one answer: its files are written into another one, which then takes its place.

use std::cell::RefCell;
use std::fs::{self, File};
use std::io;
use std::path::{Path, PathBuf};

use anyhow::{Context as _, Result};
use tempfile::TempDir;
use viscofriction::WrongInput;
use viscofriction_plot::Figure;

use super::{
    OutputFile, PART_END, folder_of, followed, lock, name_of, not_written, part_start, picture,
    remove_parts, say,
};
use crate::input::is_input;

/// A folder for the files of one result; nobody else writes into it as long as this value lives.
pub(crate) struct OutputFolder {
    /// As it was given.
    path: PathBuf,
    /// Behind links.
    real: PathBuf,
    overwrite: bool,
    names: Vec<&'static str>,
    place: Place,
    _lock: Option<File>,
}

/// Where the files are until all of them are written.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
enum Place {
    /// In a folder beside, which is exchanged with this one.
    Beside,
    /// In a folder inside this one, which has no answer, and from which they are moved.
    Inside,
}

/// What the name of a folder ends with that makes room for another one, where the system cannot exchange them.
const AWAY_END: &str = ".away";

const NO_EXCHANGE: &str = "the answer in it is replaced together with its folder, which must not be the one that the command runs in \
                           or a mounted disk, and must be in a folder that can be written; remove the files of the answer first, or \
                           give another folder";

impl OutputFolder {
    /// A folder that was made, or is there without any of the files that may be written, named between spaces; refused as
    /// by [`OutputFile::new`] and [`lock`].
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
        let real = followed(path);
        restore(&real);
        check_names(path, &names, overwrite)?;
        fs::create_dir_all(&real).map_err(failed)?;
        let real = real.canonicalize().map_err(failed)?;
        // Not every system opens folders.
        let folder = File::open(&real).ok();
        if let Some(folder) = &folder {
            lock(folder, path)?;
            remove_parts(&real, &names);
            clear_left(&real, &names);
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
        // Nothing is computed that cannot be written.
        folder.new_part().map_err(failed)?;
        Ok(folder)
    }

    /// The folder as it was given.
    pub(crate) fn path(&self) -> &Path {
        &self.path
    }

    /// Begins to write the files.
    pub(crate) fn begin(&self) -> Result<NewFiles<'_>> {
        let part = self.new_part();
        let part = part.map_err(|error| not_written(self.path.display(), error))?;
        Ok(NewFiles {
            folder: self,
            part,
            written: RefCell::default(),
        })
    }

    fn new_part(&self) -> io::Result<TempDir> {
        let within = match self.place {
            Place::Beside => self.real.parent().unwrap_or(&self.real),
            Place::Inside => &self.real,
        };
        new_part(&self.real, within)
    }
}

impl Drop for OutputFolder {
    /// A folder without files says nothing; one that has some is not removed by the system.
    fn drop(&mut self) {
        fs::remove_dir(&self.real).ok();
    }
}

/// Files that are to become those of a folder, all at once; without [`Self::finish`] there are none.
pub(crate) struct NewFiles<'a> {
    folder: &'a OutputFolder,
    part: TempDir,
    /// In the order in which they were written.
    written: RefCell<Vec<String>>,
}

impl NewFiles<'_> {
    /// Writes one of the files.
    pub(crate) fn write(&self, name: &str, contents: &[u8]) -> Result<()> {
        let written = fs::write(self.part.path().join(name), contents);
        written.map_err(|error| not_written(self.folder.path.join(name).display(), error))?;
        self.written.borrow_mut().push(name.to_owned());
        Ok(())
    }

    /// Draws a picture as SVG and as PNG.
    pub(crate) fn draw(&self, name: &str, figure: &Figure) -> Result<()> {
        let (svg, png) = picture(figure).with_context(|| format!("drawing {name}"))?;
        self.write(&format!("{name}.svg"), svg.as_bytes())?;
        self.write(&format!("{name}.png"), &png)
    }

    /// Makes them the files of the folder; where that cannot be done, they stay where they are, and the error says where.
    pub(crate) fn finish(self) -> Result<()> {
        let OutputFolder { real, names, .. } = self.folder;
        // Somebody else may have written there meanwhile.
        check_names(&self.folder.path, names, self.folder.overwrite)?;
        // As long as it is open, nobody takes it for one that was left.
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
        take_over(&part, real, names).map_err(kept)?;
        let old = exchange(&part, real).map_err(kept)?;
        keep_links(&old, real, names)?;
        clear(&old, real, names);
        Ok(())
    }
}

/// Refuses as [`OutputFile::new`] each of the names in a folder.
fn check_names(folder: &Path, names: &[&str], overwrite: bool) -> Result<(), WrongInput> {
    let mut names = names.iter();
    names.try_for_each(|name| OutputFile::new(&folder.join(name), overwrite).map(drop))
}

/// A folder for files on the way to another one, with its permissions.
fn new_part(folder: &Path, within: &Path) -> io::Result<TempDir> {
    let start = part_start(&name_of(folder));
    let mut builder = tempfile::Builder::new();
    let part = builder.prefix(&start).suffix(PART_END).tempdir_in(within)?;
    fs::set_permissions(part.path(), fs::metadata(folder)?.permissions())?;
    Ok(part)
}

/// Where the files can be written; none where an answer is there and the folder cannot be exchanged.
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
        // What else is there need not be moved.
        (false, _) if !(can_be_exchanged && entries.is_empty()) => Some(Place::Inside),
        _ => Some(Place::Beside),
    })
}

#[cfg(unix)]
fn is_on_one_disk(folder: &Path, parent: &Path) -> bool {
    use std::os::unix::fs::MetadataExt as _;
    let disk = |path: &Path| fs::metadata(path).map(|folder| folder.dev()).ok();
    disk(folder) == disk(parent)
}
#[cfg(not(unix))]
fn is_on_one_disk(_: &Path, _: &Path) -> bool {
    true
}

/// Gives a folder what another one has beside its answer, and its files the permissions of those that they replace.
fn take_over(part: &Path, folder: &Path, names: &[&str]) -> io::Result<()> {
    for entry in fs::read_dir(folder)?.flatten() {
        let [old, new] = [entry.path(), part.join(entry.file_name())];
        if !is_of_answer(&old, names) {
            // What has no second name, as a folder, is moved later.
            fs::hard_link(&old, &new).ok();
        } else if new.exists() && !old.is_symlink() {
            fs::set_permissions(&new, fs::metadata(&old)?.permissions())?;
        }
    }
    Ok(())
}

/// Exchanges a folder and another one, and says where the old one is then.
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

/// The same in two steps, between which [`restore`] finds the old folder.
fn exchange_by_renaming(part: &Path, folder: &Path) -> io::Result<PathBuf> {
    let away = part.with_extension(&AWAY_END[1..]);
    fs::rename(folder, &away)?;
    fs::rename(part, folder).inspect_err(|_| {
        fs::rename(&away, folder).ok();
    })?;
    Ok(away)
}

/// Renames a file or a folder, unless something has the new name.
fn rename_new(from: &Path, to: &Path) -> io::Result<()> {
    #[cfg(any(target_os = "linux", target_os = "android", target_vendor = "apple"))]
    {
        use rustix::fs::{CWD, RenameFlags, renameat_with};
        use rustix::io::Errno;
        match renameat_with(CWD, from, CWD, to, RenameFlags::NOREPLACE) {
            // Some file systems do not know how.
            Err(Errno::INVAL | Errno::NOSYS | Errno::NOTSUP) => {}
            renamed => return Ok(renamed?),
        }
    }
    if to.symlink_metadata().is_ok() {
        return Err(io::ErrorKind::AlreadyExists.into());
    }
    fs::rename(from, to)
}

/// Where a file of the old answer was a symbolic link, writes the new one into the file that it names, and keeps the link.
fn keep_links(old: &Path, folder: &Path, names: &[&str]) -> Result<()> {
    for name in names {
        let [link, new] = [old, folder].map(|folder| folder.join(name));
        if link.is_symlink() && new.exists() {
            let failed = |error| not_written(new.display(), error);
            let contents = fs::read(&new).map_err(failed)?;
            let target = OutputFile {
                path: followed(&link),
                overwrite: true,
            };
            target.write(&contents)?;
            fs::rename(&link, &new).map_err(failed)?;
        }
    }
    Ok(())
}

/// Whether a file is one of an answer, which the command has made.
fn is_of_answer(file: &Path, names: &[&str]) -> bool {
    names.contains(&&*name_of(file)) && !is_input(file)
}

/// Removes a folder with an answer that is given up; what else is in it stays, or goes, into the other folder.
fn clear(old: &Path, folder: &Path, names: &[&str]) {
    let cleared = || -> io::Result<()> {
        let entries = fs::read_dir(old)?.flatten();
        let paths = entries.map(|entry| (entry.path(), folder.join(entry.file_name())));
        let is_given_up =
            |(left, kept): &(PathBuf, PathBuf)| is_of_answer(left, names) || is_same(left, kept);
        let (given_up, others): (Vec<_>, Vec<_>) = paths.partition(is_given_up);
        // What is not of an answer comes back first.
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
        say(&format!(
            "{old} has files that were in {folder}, and stays: {error}"
        ));
    }
}

#[cfg(unix)]
fn is_same(one: &Path, other: &Path) -> bool {
    use std::os::unix::fs::MetadataExt as _;
    let identity = |path: &Path| {
        let file = path.symlink_metadata();
        file.map(|file| (file.dev(), file.ino())).ok()
    };
    identity(one).is_some() && identity(one) == identity(other)
}
#[cfg(not(unix))]
fn is_same(one: &Path, other: &Path) -> bool {
    one.is_file() && other.is_file()
}

/// Folders beside or inside a folder that a run of this program has left, with names of this end; what another one writes is
/// locked.
fn left(folder: &Path, within: &Path, end: &str) -> Vec<PathBuf> {
    let start = part_start(&name_of(folder));
    let is_left = |path: &PathBuf| {
        let name = name_of(path);
        let is_part = name.starts_with(&start) && name.ends_with(end) && path.is_dir();
        is_part && !path.is_symlink() && File::open(path).is_ok_and(|part| part.try_lock().is_ok())
    };
    let entries = fs::read_dir(within).into_iter().flatten().flatten();
    let paths = entries.map(|entry| entry.path());
    paths.filter(is_left).collect()
}

/// Gives a folder its name again that a run has made room with, and that was killed then.
fn restore(folder: &Path) {
    if folder.symlink_metadata().is_err()
        && let Some(away) = left(folder, folder_of(folder), AWAY_END).first()
    {
        fs::rename(away, folder).ok();
    }
}

/// Clears away what runs that were killed have left of a folder.
fn clear_left(folder: &Path, names: &[&str]) {
    for within in [folder_of(folder), folder] {
        for end in [PART_END, AWAY_END] {
            for part in left(folder, within, end) {
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

    /// As on a file system without an exchange, where a kill may come between both steps.
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
        clear_left(&folder, &["result.json"]);
        assert!(!part.exists(), "{} stays", part.display());
    }
}
