//! `dependencies`: what each library crate pulls in when it is built alone and without its optional features.

use std::collections::BTreeSet;
use std::fs;
use std::path::PathBuf;

use anyhow::{Context, Result, ensure};
use clap::Args;

use super::cargo::{cargo, output, workspace_root};
use super::workspace::{Package, Workspace};
use crate::output::{print_line, write_atomically};

/// Arguments of the command.
#[derive(Debug, Args)]
pub(crate) struct Dependencies {
    /// The page that is written, in Markdown.
    #[arg(long, value_name = "FILE", default_value = "target/dependencies.md")]
    out: PathBuf,
}

/// The committed page. Its text above the tables of crates is written by hand and kept; its tables are generated, and CI
/// fails where they differ from the current dependencies.
const COMMITTED: &str = "docs/dependencies.md";

/// Text at whose first occurrence the generated part of the page begins; tables in the text above have another first column.
const CRATES_HEAD: &str = "\n| crate |";
/// Head of the table of how many crates each library pulls in.
const CRATES: &str = "
| crate | of this workspace | of others | for building only |
|---|---|---|---|
";

/// Head of the table of direct dependencies.
const DIRECT: &str = "
| crate | direct dependency | what comes with it, itself included |
|---|---|---|
";

/// Head of the table of dependencies within the workspace.
const WITHIN: &str = "
| crate | of this workspace | of this workspace, in tests | optional |
|---|---|---|---|
";

/// Counts the dependencies and writes the page to the file of `options`.
pub(crate) fn write(options: &Dependencies) -> Result<()> {
    let page = page(&committed()?, &Workspace::read()?)?;
    write_atomically(&options.out, page.as_bytes())?;
    print_line(&format!("written to {}", options.out.display()))
}

/// Fails if the committed page is not what [`write`] would write now.
pub(super) fn check(workspace: &Workspace) -> Result<()> {
    let committed = committed()?;
    let is_current = page(&committed, workspace)? == committed;
    ensure!(
        is_current,
        "{COMMITTED} is out of date; `cargo xtask dependencies --out {COMMITTED}` makes it current"
    );
    Ok(())
}

/// The page with the hand-written text of `committed` and new tables.
fn page(committed: &str, workspace: &Workspace) -> Result<String> {
    let text = committed.split(CRATES_HEAD).next().unwrap_or_default();
    let [mut crates, mut direct] = [CRATES, DIRECT].map(str::to_owned);
    for library in workspace.libraries() {
        let rows = rows(library)?;
        crates += &rows[0];
        direct += &rows[1..].concat();
    }
    let within: String = workspace.packages.iter().map(Package::row).collect();
    Ok([text, &crates, &direct, WITHIN, &within].concat())
}

/// Text of the committed page; fails if it cannot be read.
fn committed() -> Result<String> {
    fs::read_to_string(workspace_root().join(COMMITTED)).context(COMMITTED)
}

/// First the row of the table [`CRATES`] for a library, then a row of [`DIRECT`] for each of its direct dependencies.
fn rows(library: &str) -> Result<Vec<String>> {
    let all = tree(library, "normal,build")?;
    let linked = tree(library, "normal,no-proc-macro")?;
    let [distinct_all, linked] = [&all[1..], &linked[1..]].map(distinct);
    // Tell the crates of this workspace from others by the folder that is listed behind their version.
    let ours = linked.iter().filter(|name| name.ends_with(')')).count();
    let others = linked.len() - ours;
    let building = distinct_all.difference(&linked).count();
    let mut rows = vec![format!(
        "| `{library}` | {ours} | {others} | {building} |\n"
    )];
    for start in (1..all.len()).filter(|start| all[*start].0 == 1) {
        let inner = all[start + 1..].iter().take_while(|(depth, _)| *depth > 1);
        let count = distinct(&all[start..=start + inner.count()]).len();
        let name = all[start].1.split(' ').next().unwrap_or_default();
        rows.push(format!("| `{library}` | `{name}` | {count} |\n"));
    }
    Ok(rows)
}

/// The tree of dependencies of a library without its optional features, in preorder: depth (0 for the library itself) and
/// crate, as `libm v0.2.16`, repeated wherever it occurs. `edges` is the argument `--edges` of `cargo tree`.
fn tree(library: &str, edges: &str) -> Result<Vec<(usize, String)>> {
    let text = output(&mut cargo(&format!(
        "tree --package {library} --no-default-features --edges {edges} --no-dedupe \
         --target x86_64-unknown-linux-gnu --prefix depth --format :{{p}}"
    )))?;
    let node = |line: &str| {
        let (depth, package) = line.split_once(':').context("no line of a tree")?;
        Ok((depth.parse()?, package.to_owned()))
    };
    text.lines().map(node).collect()
}

/// Names of the crates in a tree of dependencies, each once.
fn distinct(nodes: &[(usize, String)]) -> BTreeSet<&str> {
    nodes.iter().map(|(_, package)| &**package).collect()
}
