//! What `cargo metadata` says about the workspace, and the rules of `docs/architecture.md` that follow from it.

use std::fs;
use std::path::PathBuf;
use std::process::Command;

use anyhow::{Context, Result, ensure};
use serde::Deserialize;

use super::cargo::{cargo_output, workspace_root};

/// What each published crate may depend on: a new dependency is a decision, made here and in its manifest together.
/// Those with a question mark must be optional; with a star the crate may use any of others.
const ALLOWED: &str = "
viscofriction-numerics: thiserror serde?
indenters: viscofriction-numerics libm thiserror serde?
rheology: viscofriction-numerics libm thiserror nalgebra? serde?
friction-analytic: viscofriction-numerics indenters rheology thiserror serde?
mdr-core: viscofriction-numerics indenters rheology thiserror rayon? serde?
bem-halfspace: viscofriction-numerics indenters rheology faer realfft rustfft thiserror rayon? serde?
viscofriction: viscofriction-numerics indenters rheology friction-analytic mdr-core bem-halfspace
               csv schemars serde serde_json serde_path_to_error strum thiserror toml
viscofriction-plot: colorous resvg thiserror ttf-parser xmlwriter
viscofriction-cli: rheology viscofriction viscofriction-plot *
";

/// What the tests of a published crate may use besides; the closed forms are the oracle of both solvers.
const IN_TESTS: [&str; 3] = ["casebook", "friction-analytic", "indenters"];

/// Files are split before they get longer; their unit tests do not count.
const MOST_LINES: usize = 500;

/// The published crates of the workspace, as cargo knows them.
#[derive(Debug, Deserialize)]
pub(super) struct Workspace {
    packages: Vec<Package>,
    target_directory: PathBuf,
}

#[derive(Debug, Deserialize)]
struct Package {
    name: String,
    /// The registries where it may be published; none when it may be anywhere.
    publish: Option<Vec<String>>,
    dependencies: Vec<Dependency>,
    targets: Vec<Target>,
}

#[derive(Debug, Deserialize)]
struct Dependency {
    name: String,
    kind: Option<String>,
    rename: Option<String>,
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
        let text = cargo_output("metadata --no-deps --format-version 1")?;
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

    /// All examples, as a release build compiles them.
    pub(super) fn example_files(&self) -> impl Iterator<Item = PathBuf> {
        let packages = self.packages.iter();
        let examples = packages.flat_map(|package| package.targets("example"));
        let folder = self.target_directory.join("release/examples");
        examples.map(move |name| folder.join(name))
    }

    /// Checks who depends on whom, and how long files are; the error lists all that breaks a rule.
    pub(super) fn check(&self) -> Result<()> {
        let mut broken: Vec<String> = self.packages.iter().flat_map(Package::broken).collect();
        broken.extend(long_files()?);
        ensure!(broken.is_empty(), "{}", broken.join("\n"));
        Ok(())
    }
}

impl Package {
    /// Names of its targets of a kind.
    fn targets(&self, kind: &str) -> impl Iterator<Item = &str> {
        let is_wanted = move |target: &&Target| target.kind.iter().any(|own| own == kind);
        let wanted = self.targets.iter().filter(is_wanted);
        wanted.map(|target| &*target.name)
    }

    fn broken(&self) -> Vec<String> {
        let Some((_, rule)) = ALLOWED.split_once(&format!("\n{}: ", self.name)) else {
            return vec![format!("`{}` has no rule in {}", self.name, file!())];
        };
        // The rule ends where the name of the next crate begins.
        let names = rule.split_whitespace();
        let allowed: Vec<&str> = names.take_while(|name| !name.ends_with(':')).collect();
        let refused = self.dependencies.iter().filter_map(|dependency| {
            let why = dependency.refused(&allowed)?;
            Some(format!("{}: `{}` {why}", self.name, dependency.name))
        });
        refused.collect()
    }
}

impl Dependency {
    /// Why it is not allowed, if it is not.
    fn refused(&self, allowed: &[&str]) -> Option<&'static str> {
        let name = &*self.name;
        let is_allowed = |name: &str| allowed.contains(&name);
        let in_tests = self.kind.as_deref() == Some("dev");
        let is_free = self.path.is_none() && (in_tests || is_allowed("*"));
        if self.rename.is_some() && self.path.is_none() {
            Some("is renamed, which hides what it is")
        } else if is_free || is_allowed(name) || (in_tests && IN_TESTS.contains(&name)) {
            None
        } else if is_allowed(&format!("{name}?")) {
            (!self.optional).then_some("must be optional")
        } else {
            Some("is not allowed")
        }
    }
}

fn long_files() -> Result<Vec<String>> {
    let mut git = Command::new("git");
    git.args(["ls-files", "*.rs"]).current_dir(workspace_root());
    let files = String::from_utf8(git.output().context("git ls-files")?.stdout)?;
    let mut long = Vec::new();
    for file in files.lines() {
        let text = fs::read_to_string(workspace_root().join(file)).context(file.to_owned())?;
        let code = text.split("#[cfg(test)]\nmod ").next().unwrap_or_default();
        let lines = code.lines().count();
        if lines > MOST_LINES {
            long.push(format!("{file} has {lines} lines without unit tests"));
        }
    }
    Ok(long)
}

#[cfg(test)]
mod unit_tests {
    use super::Dependency;

    #[test]
    fn only_what_the_table_allows_is_allowed() {
        let [forbidden, needed] = [Some("is not allowed"), Some("must be optional")];
        let cases = [
            ("libm", None),
            ("csv", forbidden),
            ("build cc", forbidden),
            ("serde", needed),
            ("serde optional", None),
            ("mdr-core", forbidden),
            ("casebook", forbidden),
            ("dev casebook", None),
            ("dev proptest", None),
            ("dev mdr-core", forbidden),
        ];
        for (words, expected) in cases {
            let has = |word: &str| words.split(' ').any(|own| own == word);
            let kind = ["dev", "build"].into_iter().find(|kind| has(kind));
            let dependency = Dependency {
                name: words
                    .trim_start_matches("dev ")
                    .replace(" optional", "")
                    .replace("build ", ""),
                kind: kind.map(str::to_owned),
                rename: None,
                optional: has("optional"),
                path: (has("casebook") || has("mdr-core")).then(Default::default),
            };
            let got = dependency.refused(&["libm", "serde?"]);
            assert_eq!(got, expected, "{words}");
        }
    }
}
