//! A copy of the checkout in which the constants of the cases are functions, and the program that is built there.

use std::fs;
use std::path::{Path, PathBuf};
use std::process::Command;

use anyhow::{Context, Result};

use super::cases::{BenchmarkScene, Cases};
use super::program::Program;
use super::transformation::{Source, Sources, transform};
use crate::ci::{cargo, output, workspace_root};
use crate::output::write_atomically;

/// Arguments of cargo that build the program.
const BUILD: &str = "build --quiet --profile ci --workspace --all-features --bin viscofriction";

/// The copy, in a folder with all that is built from it.
pub(super) struct Checkout {
    /// Folder of the copy and the builds.
    folder: PathBuf,
    /// Files that are copied, from the root of the checkout.
    tracked: Vec<PathBuf>,
}

impl Checkout {
    /// The copy in `target/tuning`, which [`Self::update`] makes or brings up to date.
    pub(super) fn new() -> Result<Self> {
        Ok(Self {
            folder: workspace_root().join("target/tuning"),
            tracked: tracked_files()?,
        })
    }

    /// Makes the copy equal to the checkout but for the constants. Files whose contents stay are not written, so that cargo does
    /// not build them anew.
    pub(super) fn update(&self, cases: &Cases) -> Result<()> {
        let root = workspace_root();
        let mut transformed = transform(&cases.cases, &sources(&self.tracked)?)?;
        for file in &self.tracked {
            let contents = match transformed.remove(file) {
                Some(text) => text.into_bytes(),
                None => read(&root.join(file))?,
            };
            let copy = self.copy(file);
            if fs::read(&copy).ok().as_ref() != Some(&contents) {
                write_atomically(&copy, &contents)?;
            }
        }
        Ok(())
    }

    /// Builds the ordinary program of the checkout and that of the copy, in this order.
    pub(super) fn build(&self) -> Result<[Program; 2]> {
        let folders = [workspace_root(), self.copy(Path::new(""))];
        let targets = [workspace_root(), self.folder.clone()].map(|folder| folder.join("target"));
        for (folder, target) in folders.iter().zip(&targets) {
            let mut command = cargo(BUILD);
            command.current_dir(folder);
            output(command.env("CARGO_TARGET_DIR", target))?;
        }
        Ok(targets.map(|target| Program::new(&target.join("ci"))))
    }

    /// Where a file of the checkout is in the copy.
    pub(super) fn copy(&self, file: &Path) -> PathBuf {
        self.folder.join("checkout").join(file)
    }

    /// Writes the scene of the reference into the folder of the scene, so that it finds the same other files.
    pub(super) fn write_reference(&self, scene: &BenchmarkScene) -> Result<PathBuf> {
        let file = self.copy(&scene.file);
        let text = String::from_utf8(read(&file)?)?;
        let mut table: toml::Table = toml::from_str(&text)?;
        table.insert("solve".to_owned(), scene.reference.clone().into());
        let finer = file.with_extension("reference.toml");
        write_atomically(&finer, toml::to_string(&table)?.as_bytes())?;
        Ok(finer)
    }
}

/// Sources of the libraries among `tracked`, paths from the root of the checkout.
pub(super) fn sources(tracked: &[PathBuf]) -> Result<Sources> {
    let root = workspace_root();
    let is_source = |file: &&PathBuf| {
        let is_library = file.starts_with("crates") && file.iter().nth(2) == Some("src".as_ref());
        is_library && file.extension() == Some("rs".as_ref())
    };
    let sources = tracked.iter().filter(is_source).map(|file| {
        let text = String::from_utf8(read(&root.join(file))?)?;
        Ok((file.clone(), Source::new(text)))
    });
    sources.collect()
}

/// Files that git tracks and that are there, from the root of the checkout.
pub(super) fn tracked_files() -> Result<Vec<PathBuf>> {
    let root = workspace_root();
    let mut git = Command::new("git");
    git.arg("-C").arg(&root).args(["ls-files", "-z"]);
    let list = output(&mut git)?;
    let files = list.split_terminator('\0').map(PathBuf::from);
    Ok(files.filter(|file| root.join(file).exists()).collect())
}

/// Contents of a file; an error names it.
fn read(file: &Path) -> Result<Vec<u8>> {
    fs::read(file).with_context(|| format!("reading {}", file.display()))
}
