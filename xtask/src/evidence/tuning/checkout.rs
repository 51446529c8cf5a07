//! A copy of the checkout in which one constant is changed, and the program that is built there.

use std::fs;
use std::path::{Path, PathBuf};
use std::process::Command;

use anyhow::{Context, Result};

use super::cases::{BenchmarkScene, Case};
use super::program::Program;
use crate::ci::{cargo, output, workspace_root};
use crate::output::write_atomically;

/// Arguments of cargo that build the program. Incremental compilation and many units of code make the build short after a
/// change of one constant.
const BUILD: &str = "build --quiet --profile ci --workspace --all-features --bin viscofriction \
                     --config profile.ci.incremental=true \
                     --config profile.ci.package.bem-halfspace.codegen-units=32 \
                     --config profile.ci.package.mdr-core.codegen-units=32";

/// The copy, in a folder with all that is built from it.
pub(super) struct Checkout {
    /// Of the copy and the builds.
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

    /// Makes the copy equal to the checkout but for one constant. Files whose contents stay are not written, so that cargo does
    /// not build them anew.
    pub(super) fn update(&self, change: Option<(&Case, &str)>) -> Result<()> {
        let root = workspace_root();
        let edited = change.map(|(case, _)| case.file(&root, &self.tracked));
        let edited = edited.transpose()?;
        for file in &self.tracked {
            let mut contents = read(&root.join(file))?;
            if let Some((case, tried)) = change.filter(|_| edited == Some(file)) {
                contents = case
                    .edit(&String::from_utf8(contents)?, tried)?
                    .into_bytes();
            }
            let copy = self.copy(file);
            if fs::read(&copy).ok().as_ref() != Some(&contents) {
                write_atomically(&copy, &contents)?;
            }
        }
        Ok(())
    }

    /// Builds the program from the copy and keeps it under a name.
    pub(super) fn build(&self, name: &str) -> Result<Program> {
        let target = self.folder.join("target");
        let mut command = cargo(BUILD);
        command.current_dir(self.copy(Path::new("")));
        output(command.env("CARGO_TARGET_DIR", &target))?;
        let program = Program::new(&self.folder, name);
        let built = target
            .join("ci/viscofriction")
            .with_extension(std::env::consts::EXE_EXTENSION);
        fs::copy(&built, program.file()).with_context(|| built.display().to_string())?;
        Ok(program)
    }

    /// Where a file of the checkout is in the copy.
    pub(super) fn copy(&self, file: &Path) -> PathBuf {
        self.folder.join("checkout").join(file)
    }

    /// Writes the scene of the reference beside the scene, so that it finds the same other files.
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
