//! The invariants of `docs/architecture.md`, checked from manifests and sources.

mod code;
mod manifests;
mod sources;
mod usage;

use std::fs;
use std::path::{Path, PathBuf};

use anyhow::{Context, Result, ensure};

use crate::ci::command::workspace_root;

/// Checks the workspace; the error lists each file with the rule that it breaks.
pub(super) fn check() -> Result<()> {
    let root = workspace_root();
    let mut broken = manifests::check_workspace(&read(&root, Path::new("Cargo.toml"))?)?;
    let crates = list(&root, Path::new("crates"))?;
    for folder in &crates {
        let (file, text) = manifest(&root, folder)?;
        broken.extend(manifests::check_crate(&file, &text)?);
        for source in rust_files(&root, &folder.join("src"))? {
            let text = read(&root, &source)?;
            broken.extend(sources::check(&source.display().to_string(), &text));
        }
    }
    let xtask = PathBuf::from("xtask");
    for folder in crates.iter().chain([&xtask]) {
        broken.extend(unused(&root, folder)?);
    }
    ensure!(broken.is_empty(), "{}", broken.join("\n"));
    println!("{} crates keep the invariants", crates.len());
    Ok(())
}

/// Dependencies that a crate declares for nothing.
fn unused(root: &Path, folder: &Path) -> Result<Vec<String>> {
    let (file, text) = manifest(root, folder)?;
    let sources = |name: &str| {
        let files = rust_files(root, &folder.join(name))?;
        files
            .iter()
            .map(|source| read(root, source))
            .collect::<Result<Vec<_>>>()
    };
    let mut all = sources("src")?;
    let mut broken = usage::check(&file, &text, "dependencies", &all)?;
    if root.join(folder).join("tests").is_dir() {
        all.extend(sources("tests")?);
    }
    broken.extend(usage::check(&file, &text, "dev-dependencies", &all)?);
    Ok(broken)
}

/// Name and text of the manifest of a crate.
fn manifest(root: &Path, folder: &Path) -> Result<(String, String)> {
    let file = folder.join("Cargo.toml");
    Ok((file.display().to_string(), read(root, &file)?))
}

fn read(root: &Path, file: &Path) -> Result<String> {
    fs::read_to_string(root.join(file)).with_context(|| format!("reading {}", file.display()))
}

/// What a folder holds, relative to the root and in order.
fn list(root: &Path, folder: &Path) -> Result<Vec<PathBuf>> {
    let say = || format!("reading {}", folder.display());
    let mut entries = fs::read_dir(root.join(folder))
        .with_context(say)?
        .map(|entry| Ok(folder.join(entry?.file_name())))
        .collect::<Result<Vec<_>>>()?;
    entries.sort();
    Ok(entries)
}

fn rust_files(root: &Path, folder: &Path) -> Result<Vec<PathBuf>> {
    let mut files = Vec::new();
    for entry in list(root, folder)? {
        if root.join(&entry).is_dir() {
            files.extend(rust_files(root, &entry)?);
        } else if entry.extension().is_some_and(|extension| extension == "rs") {
            files.push(entry);
        }
    }
    Ok(files)
}
