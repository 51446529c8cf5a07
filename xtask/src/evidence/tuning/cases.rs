//! The constants that are changed and the scenes that are solved, as `cases.toml` holds them.

use std::path::PathBuf;

use anyhow::{Context, Result};
use serde::Deserialize;

use super::program::Tried;

/// Contents of `cases.toml`, whose head describes the keys.
#[derive(Debug, Deserialize)]
#[serde(deny_unknown_fields)]
pub(super) struct Cases {
    /// Scenes to which cases refer by name.
    #[serde(rename = "scene")]
    pub(super) scenes: Vec<BenchmarkScene>,
    /// Cases, one for each constant.
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
    /// Table `[solve]` of the scene with which the reference is computed.
    pub(super) reference: toml::Table,
}

/// A constant, the values that it is given, and the scenes that exercise it.
#[derive(Debug, Deserialize)]
#[serde(deny_unknown_fields)]
pub(super) struct Case {
    /// Name of the constant.
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
    /// Names of the scenes that exercise the constant.
    pub(super) scenes: Vec<String>,
    /// True if a quick run tries the constant.
    #[serde(default)]
    pub(super) is_quick: bool,
}

impl Cases {
    /// Cases of `cases.toml`: constants with the values to try.
    pub(super) fn read() -> Result<Self> {
        toml::from_str(include_str!("cases.toml")).context("xtask/src/evidence/tuning/cases.toml")
    }
}

impl Case {
    /// Initialisers of the constant that are tried in place of the present one, smaller ones first, numbered from 1.
    pub(super) fn tried(&self) -> impl Iterator<Item = Tried<'_>> {
        let values = self.smaller.iter().chain(&self.larger);
        (1..).zip(values).map(|(place, value)| Tried {
            case: self,
            place,
            value,
        })
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::ci::workspace_root;
    use crate::evidence::tuning::checkout::{sources, tracked_files};
    use crate::evidence::tuning::transformation::transform;

    #[test]
    fn every_constant_has_its_present_value_and_known_scenes() {
        let cases = Cases::read().expect("cases.toml");
        let root = workspace_root();
        let sources = sources(&tracked_files().expect("files")).expect("texts");
        transform(&cases.cases, &sources).unwrap_or_else(|error| panic!("{error:#}"));
        for name in cases.cases.iter().flat_map(|case| &case.scenes) {
            let mut scenes = cases.scenes.iter();
            let scene = scenes.find(|scene| scene.name == *name);
            let scene = scene.unwrap_or_else(|| panic!("no scene {name}"));
            assert!(root.join(&scene.file).exists(), "{}", scene.file.display());
        }
    }
}
