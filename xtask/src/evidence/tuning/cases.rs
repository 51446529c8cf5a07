//! The constants that are changed and the scenes that are solved, as `cases.toml` holds them.

use std::fs;
use std::path::{Path, PathBuf};

use anyhow::{Context, Result, bail, ensure};
use serde::Deserialize;

/// Contents of `cases.toml`, whose head describes the keys.
#[derive(Debug, Deserialize)]
#[serde(deny_unknown_fields)]
pub(super) struct Cases {
    /// Scenes to which cases refer by name.
    #[serde(rename = "scene")]
    scenes: Vec<BenchmarkScene>,
    /// One for each constant.
    #[serde(rename = "case")]
    pub(super) cases: Vec<Case>,
}

/// A scene whose answer may depend on a constant.
#[derive(Debug, Deserialize)]
#[serde(deny_unknown_fields)]
pub(super) struct BenchmarkScene {
    pub(super) name: String,
    /// Scene file, from the root of the checkout.
    pub(super) file: PathBuf,
    /// Further arguments of `viscofriction run`.
    #[serde(default)]
    pub(super) arguments: Vec<String>,
    /// Keys of the answer that are compared.
    pub(super) quantities: Vec<String>,
    /// `[solve]` of the reference.
    pub(super) reference: toml::Table,
}

/// A constant, the values that it is given, and the scenes that exercise it.
#[derive(Debug, Deserialize)]
#[serde(deny_unknown_fields)]
pub(super) struct Case {
    /// Its name.
    pub(super) constant: String,
    /// The source file that declares it, or a folder in which one file does, from the root of the checkout.
    pub(super) source: PathBuf,
    /// Present initialiser, as it stands in the source file.
    pub(super) present: String,
    /// Smaller initialisers that are tried instead, the nearest first.
    #[serde(default)]
    pub(super) smaller: Vec<String>,
    /// Larger initialisers that are tried instead, the nearest first.
    #[serde(default)]
    pub(super) larger: Vec<String>,
    /// Names of scenes.
    pub(super) scenes: Vec<String>,
    /// Whether a quick run tries it.
    #[serde(default)]
    pub(super) is_quick: bool,
}

impl Cases {
    /// Parses `cases.toml`.
    pub(super) fn read() -> Result<Self> {
        toml::from_str(include_str!("cases.toml")).context("xtask/src/evidence/tuning/cases.toml")
    }

    /// The scene with this name; fails where there is none.
    pub(super) fn scene(&self, name: &str) -> Result<&BenchmarkScene> {
        let scene = self.scenes.iter().find(|scene| scene.name == name);
        scene.with_context(|| format!("cases.toml has no scene {name:?}"))
    }
}

impl Case {
    /// All initialisers that are tried.
    pub(super) fn tried(&self) -> impl Iterator<Item = &String> {
        self.smaller.iter().chain(&self.larger)
    }

    /// The one file among `tracked`, paths from `root`, that declares the constant; fails where there is none or more than one.
    pub(super) fn file<'a>(
        &self,
        root: &Path,
        tracked: impl IntoIterator<Item = &'a PathBuf>,
    ) -> Result<&'a Path> {
        let mut found = Vec::new();
        for file in tracked {
            let is_source =
                file.starts_with(&self.source) && file.extension() == Some("rs".as_ref());
            if is_source && fs::read_to_string(root.join(file))?.contains(&self.declaration()) {
                found.push(file.as_path());
            }
        }
        let Self {
            constant, source, ..
        } = self;
        ensure!(
            found.len() == 1,
            "{} files of {} declare {constant}, instead of one: {found:?}",
            found.len(),
            source.display()
        );
        Ok(found[0])
    }

    /// Begin of the declaration of the constant, as its source has it.
    fn declaration(&self) -> String {
        format!("const {}: ", self.constant)
    }

    /// The text of a source file with the initialiser `tried` in place of the present one. Fails unless the constant is
    /// declared once and its initialiser is that of `cases.toml`.
    pub(super) fn edit(&self, text: &str, tried: &str) -> Result<String> {
        let Self {
            constant, present, ..
        } = self;
        let declaration = self.declaration();
        let parts: Vec<&str> = text.split(&declaration).collect();
        let [before, rest] = parts[..] else {
            bail!("{constant} is declared {} times", parts.len() - 1);
        };
        let (kind, rest) = rest.split_once(" = ").unwrap_or_default();
        let (value, after) = rest.split_once(';').unwrap_or_default();
        let is_present = value.split_whitespace().eq(present.split_whitespace());
        ensure!(
            is_present,
            "{constant} is {value}, but {present} in cases.toml"
        );
        Ok(format!("{before}{declaration}{kind} = {tried};{after}"))
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::ci::workspace_root;
    use crate::evidence::tuning::checkout::tracked_files;

    #[test]
    fn every_constant_has_its_present_value_and_known_scenes() {
        let cases = Cases::read().expect("cases.toml");
        let root = workspace_root();
        let tracked = tracked_files().expect("files");
        for case in &cases.cases {
            let file = case
                .file(&root, &tracked)
                .unwrap_or_else(|error| panic!("{error:#}"));
            let text = fs::read_to_string(root.join(file)).expect("a source");
            for tried in case.tried() {
                let edited = case
                    .edit(&text, tried)
                    .unwrap_or_else(|error| panic!("{error:#}"));
                assert_ne!(edited, text, "{} = {tried}", case.constant);
            }
            for name in &case.scenes {
                let scene = cases
                    .scene(name)
                    .unwrap_or_else(|error| panic!("{error:#}"));
                assert!(root.join(&scene.file).exists(), "{}", scene.file.display());
            }
        }
    }

    #[test]
    fn other_texts_are_refused() {
        let case = r#"
            constant = "RATIO"
            source = "a.rs"
            present = "[0.5, 1.5]"
            smaller = ["[0.25, 1.5]"]
            scenes = []
        "#;
        let case: Case = toml::from_str(case).expect("a case");
        let edit = |text| {
            let edited = case.edit(text, &case.smaller[0]);
            edited.map_err(|error| error.to_string())
        };
        let text = "/// Ratio.\npub(super) const RATIO: [f64; 2] = [0.5,\n    1.5];\nfn f() {}\n";
        let edited = "/// Ratio.\npub(super) const RATIO: [f64; 2] = [0.25, 1.5];\nfn f() {}\n";
        assert_eq!(edit(text), Ok(edited.to_owned()), "{text}");
        for (text, complaint) in [
            ("const RATIOS: f64 = 1.0;", "declared 0 times"),
            ("const RATIO: f64 = 1.0;", "RATIO is 1.0, but [0.5, 1.5]"),
            ("const RATIO: f64 = 1.0; const RATIO: f64 = 1.0;", "2 times"),
        ] {
            let error = edit(text).expect_err(text);
            assert!(error.contains(complaint), "{text}: {error}");
        }
    }
}
