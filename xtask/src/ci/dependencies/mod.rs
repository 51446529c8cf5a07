//! `dependencies`: what each library crate pulls in when it is built alone and without its optional features, and what
//! building it takes.

mod build;
mod tree;

use std::fs;
use std::path::PathBuf;

use anyhow::{Context, Result, ensure};
use clap::Args;

use super::LIBRARIES;
use super::command::workspace_root;
use crate::output::{print_line, write_atomically};
use crate::progress;
use tree::Tree;

/// Arguments of the command.
#[derive(Debug, Args)]
pub(crate) struct Dependencies {
    /// The page that is written, in Markdown.
    #[arg(long, value_name = "FILE", default_value = "target/dependencies.md")]
    out: PathBuf,
}

/// The page that CI compares the counts with.
const COMMITTED: &str = "docs/dependencies.md";

const HEAD: &str = "\
# Dependencies

What each library crate pulls in when it is built alone and without its optional features, and what that takes.
`cargo xtask dependencies --out docs/dependencies.md` writes this page; `cargo xtask ci` compares its counts with `Cargo.lock`, and refuses a dependency that no source names.

The crates are those for x86-64 Linux, `cargo tree --no-default-features`; two versions of a crate are two crates.
Those for building only are procedural macros, build scripts and what these need.
The time is that of the processor, user and system, of `cargo build --release --no-default-features` into an empty folder, after everything was downloaded; it compares the crates, and is another one elsewhere.

| crate | of this workspace | of others | for building only | processor time \\[s] |
|---|---|---|---|---|
";

const DIRECT: &str = "
| crate | direct dependency | what comes with it, itself included |
|---|---|---|
";

/// Counts, builds, and writes the page.
pub(crate) fn measure(options: &Dependencies) -> Result<()> {
    let [mut page, mut direct] = [HEAD, DIRECT].map(str::to_owned);
    let bar = progress::bar("crates built", LIBRARIES.len());
    for library in LIBRARIES {
        let tree = Tree::of(library)?;
        let seconds = build::processor_seconds(library)?;
        page += &format!("{} {seconds:.0} |\n", counts(library, &tree));
        direct += &rows(library, &tree).concat();
        bar.inc(1);
    }
    bar.finish_and_clear();
    page += &direct;
    write_atomically(&options.out, page.as_bytes())?;
    print_line(&format!("written to {}", options.out.display()))
}

/// Compares the counts of the committed page with those of now.
pub(super) fn check() -> Result<()> {
    let page = fs::read_to_string(workspace_root().join(COMMITTED)).context(COMMITTED)?;
    for library in LIBRARIES {
        let tree = Tree::of(library)?;
        let begins = counts(library, &tree);
        let is_there = page.lines().any(|line| line.starts_with(&begins));
        let missing = rows(library, &tree)
            .into_iter()
            .find(|row| !page.contains(row.as_str()));
        let missing = if is_there { missing } else { Some(begins) };
        ensure!(
            missing.is_none(),
            "{COMMITTED} has no row {}; `cargo xtask dependencies --out {COMMITTED}` makes it current",
            missing.unwrap_or_default().trim_end()
        );
    }
    println!("{COMMITTED} is current");
    Ok(())
}

/// The row of a crate up to its time.
fn counts(library: &str, tree: &Tree) -> String {
    let [ours, others, building] = tree.counts();
    format!("| `{library}` | {ours} | {others} | {building} |")
}

/// One row for each direct dependency.
fn rows(library: &str, tree: &Tree) -> Vec<String> {
    let row = |(name, count): (String, usize)| format!("| `{library}` | `{name}` | {count} |\n");
    tree.direct().into_iter().map(row).collect()
}
