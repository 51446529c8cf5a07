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

/// The page whose text up to the tables of crates is kept, and whose tables CI compares with what is so now.
const COMMITTED: &str = "docs/dependencies.md";

/// Where the tables begin; tables of the text have other columns.
const CRATES_HEAD: &str = "\n| crate |";
const CRATES: &str = "
| crate | of this workspace | of others | for building only |
|---|---|---|---|
";

const DIRECT: &str = "
| crate | direct dependency | what comes with it, itself included |
|---|---|---|
";

const WITHIN: &str = "
| crate | of this workspace | of this workspace, in tests | optional |
|---|---|---|---|
";

/// Counts, and writes the page.
pub(crate) fn write(options: &Dependencies) -> Result<()> {
    let page = page(&committed()?, &Workspace::read()?)?;
    write_atomically(&options.out, page.as_bytes())?;
    print_line(&format!("written to {}", options.out.display()))
}

/// Compares the committed page with what is so now.
pub(super) fn check(workspace: &Workspace) -> Result<()> {
    let committed = committed()?;
    let is_current = page(&committed, workspace)? == committed;
    ensure!(
        is_current,
        "{COMMITTED} is out of date; `cargo xtask dependencies --out {COMMITTED}` makes it current"
    );
    Ok(())
}

/// The text of a page with the tables of what is so now.
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

fn committed() -> Result<String> {
    fs::read_to_string(workspace_root().join(COMMITTED)).context(COMMITTED)
}

/// The row of a crate, and one for each direct dependency, with the number of crates that it alone would
/// bring.
fn rows(library: &str) -> Result<Vec<String>> {
    let all = tree(library, "normal,build")?;
    let linked = tree(library, "normal,no-proc-macro")?;
    let [distinct_all, linked] = [&all[1..], &linked[1..]].map(distinct);
    // Behind the version of a crate of the workspace stands its folder.
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

/// The depth of each crate in the tree of one, and the crate, as `libm v0.2.16`.
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

fn distinct(nodes: &[(usize, String)]) -> BTreeSet<&str> {
    nodes.iter().map(|(_, package)| &**package).collect()
}
