//! What `cargo metadata` says about the workspace.

use std::path::PathBuf;

use anyhow::Result;
use serde::Deserialize;

use super::cargo::{cargo, output};

/// The published crates of the workspace, as cargo knows them.
#[derive(Debug, Deserialize)]
pub(super) struct Workspace {
    pub(super) packages: Vec<Package>,
    pub(super) target_directory: PathBuf,
}

#[derive(Debug, Deserialize)]
pub(super) struct Package {
    pub(super) name: String,
    pub(super) version: String,
    /// The registries where it may be published; none when it may be anywhere.
    publish: Option<Vec<String>>,
    dependencies: Vec<Dependency>,
    targets: Vec<Target>,
}

#[derive(Debug, Deserialize)]
struct Dependency {
    name: String,
    kind: Option<String>,
    optional: bool,
    /// Its folder, for a crate of the workspace.
    path: Option<PathBuf>,
}

#[derive(Debug, Deserialize)]
struct Target {
    name: String,
    kind: Vec<String>,
}

impl Workspace {
    pub(super) fn read() -> Result<Self> {
        let text = output(&mut cargo("metadata --no-deps --format-version 1"))?;
        let mut workspace: Self = serde_json::from_str(&text)?;
        let packages = &mut workspace.packages;
        packages.retain(|package| package.publish.is_none());
        Ok(workspace)
    }

    /// Names of the crates without a program.
    pub(super) fn libraries(&self) -> impl Iterator<Item = &str> {
        let packages = self.packages.iter();
        let libraries = packages.filter(|package| package.targets("bin").next().is_none());
        libraries.map(|package| &*package.name)
    }

    /// All examples, as the profile `ci` compiles them.
    pub(super) fn example_files(&self) -> impl Iterator<Item = PathBuf> {
        let packages = self.packages.iter();
        let examples = packages.flat_map(|package| package.targets("example"));
        let folder = self.target_directory.join("ci/examples");
        examples.map(move |name| folder.join(name))
    }
}

impl Package {
    /// Names of its targets of a kind.
    pub(super) fn targets(&self, kind: &str) -> impl Iterator<Item = &str> {
        let is_wanted = move |target: &&Target| target.kind.iter().any(|own| own == kind);
        let wanted = self.targets.iter().filter(is_wanted);
        wanted.map(|target| &*target.name)
    }

    /// A row of the page: what it depends on within the workspace, what its tests use of it besides, and what is
    /// optional.
    pub(super) fn row(&self) -> String {
        let names = |is_wanted: fn(&Dependency) -> bool| {
            let wanted = self.dependencies.iter().filter(|own| is_wanted(own));
            let names: Vec<String> = wanted.map(|own| format!("`{}`", own.name)).collect();
            names.join(" ")
        };
        let ours = names(|own| own.path.is_some() && own.kind.is_none());
        let tests = names(|own| own.path.is_some() && own.kind.is_some());
        let optional = names(|own| own.optional);
        format!("| `{}` | {ours} | {tests} | {optional} |\n", self.name)
    }
}
