//! What `cargo metadata` says about the workspace.

use std::path::PathBuf;

use anyhow::Result;
use serde::Deserialize;

use super::cargo::{cargo, output};

/// Crates of the workspace, as cargo knows them.
#[derive(Debug, Deserialize)]
pub(super) struct Workspace {
    /// The crates: those that may be published, or all.
    pub(super) packages: Vec<Package>,
    /// The folder where cargo builds.
    pub(super) target_directory: PathBuf,
}

/// A crate, as `cargo metadata` describes it.
#[derive(Debug, Deserialize)]
pub(super) struct Package {
    pub(super) name: String,
    pub(super) version: String,
    /// The registries where it may be published; none when it may be anywhere.
    publish: Option<Vec<String>>,
    /// Dependencies in its manifest, without those of the dependencies.
    dependencies: Vec<Dependency>,
    /// Library, programs, examples, tests and benchmarks.
    targets: Vec<Target>,
}

/// A direct dependency of a crate.
#[derive(Debug, Deserialize)]
struct Dependency {
    name: String,
    /// The name by which the crate calls it, if that is another one.
    rename: Option<String>,
    /// `dev` or `build`; none for one that the library itself needs.
    kind: Option<String>,
    optional: bool,
    /// Folder of the dependency, if it is a crate of the workspace.
    path: Option<PathBuf>,
}

/// Something that cargo builds of a crate.
#[derive(Debug, Deserialize)]
struct Target {
    name: String,
    /// Kinds of the target, such as `bin`, `lib` or `example`.
    kind: Vec<String>,
}

impl Workspace {
    /// Asks cargo; crates whose manifest restricts where they may be published are left out.
    pub(super) fn read() -> Result<Self> {
        let mut workspace = Self::read_all()?;
        let packages = &mut workspace.packages;
        packages.retain(|package| package.publish.is_none());
        Ok(workspace)
    }

    /// Asks cargo for all crates.
    pub(super) fn read_all() -> Result<Self> {
        let text = output(&mut cargo("metadata --no-deps --format-version 1"))?;
        Ok(serde_json::from_str(&text)?)
    }

    /// Names by which the library of the given name calls its dependencies, without those of its tests.
    pub(super) fn dependencies_of_library(&self, library: &str) -> Vec<String> {
        let is_library = |package: &&Package| package.targets("lib").any(|name| name == library);
        let packages = self.packages.iter().filter(is_library);
        let dependencies = packages.flat_map(|package| &package.dependencies);
        let needed = dependencies.filter(|dependency| dependency.kind.is_none());
        let names = needed.map(|own| own.rename.as_ref().unwrap_or(&own.name));
        names.map(|name| name.replace('-', "_")).collect()
    }

    /// Names of the crates without a program.
    pub(super) fn libraries(&self) -> impl Iterator<Item = &str> {
        let packages = self.packages.iter();
        let libraries = packages.filter(|package| package.targets("bin").next().is_none());
        libraries.map(|package| &*package.name)
    }

    /// Paths of the programs that the profile `ci` compiles from the examples of all crates.
    pub(super) fn example_files(&self) -> impl Iterator<Item = PathBuf> {
        let packages = self.packages.iter();
        let examples = packages.flat_map(|package| package.targets("example"));
        let folder = self.target_directory.join("ci/examples");
        examples.map(move |name| folder.join(name))
    }
}

impl Package {
    /// Names of its targets of a kind, such as `bin`.
    pub(super) fn targets(&self, kind: &str) -> impl Iterator<Item = &str> {
        let is_wanted = move |target: &&Target| target.kind.iter().any(|own| own == kind);
        let wanted = self.targets.iter().filter(is_wanted);
        wanted.map(|target| &*target.name)
    }

    /// A row of the table of dependencies within the workspace: those of the library, those of its tests only, and all
    /// dependencies, of the workspace or not, that are optional.
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
