//! What `cargo tree` says about a crate.

use std::collections::BTreeSet;

use anyhow::{Context, Result};

use crate::ci::LIBRARIES;
use crate::ci::command::cargo_output;

/// Which crates there are depends on the platform.
const TARGET: &str = "x86_64-unknown-linux-gnu";

/// The crates that one crate pulls in without its optional features.
#[derive(Debug, PartialEq, Eq)]
pub(super) struct Tree {
    /// With what is needed while building only.
    all: Vec<Node>,
    /// Without procedural macros and build scripts.
    linked: Vec<Node>,
}

#[derive(Debug, Clone, PartialEq, Eq)]
struct Node {
    depth: usize,
    name: String,
    version: String,
    is_macro: bool,
}

impl Tree {
    pub(super) fn of(library: &str) -> Result<Self> {
        let [all, linked] = ["normal,build", "normal"].map(|edges| {
            let arguments = [
                "tree",
                "--package",
                library,
                "--no-default-features",
                "--edges",
                edges,
            ];
            let form = [
                "--target",
                TARGET,
                "--no-dedupe",
                "--prefix",
                "depth",
                "--format",
                " {p}",
            ];
            nodes(&cargo_output(&[&arguments[..], &form].concat())?)
        });
        Ok(Self {
            all: all?,
            linked: without_macros(linked?),
        })
    }

    /// Crates of this workspace, crates of others, and crates for building only.
    pub(super) fn counts(&self) -> [usize; 3] {
        let [all, linked] = [&self.all[1..], &self.linked[1..]].map(distinct);
        let ours = linked
            .iter()
            .filter(|(name, _)| LIBRARIES.contains(name))
            .count();
        [ours, linked.len() - ours, all.difference(&linked).count()]
    }

    /// The direct dependencies, each with the number of crates that it alone would bring.
    pub(super) fn direct(&self) -> Vec<(String, usize)> {
        let starts = (0..self.all.len()).filter(|index| self.all[*index].depth == 1);
        starts
            .map(|start| {
                let inner = self.all[start + 1..]
                    .iter()
                    .take_while(|node| node.depth > 1)
                    .count();
                let subtree = &self.all[start..=start + inner];
                (self.all[start].name.clone(), distinct(subtree).len())
            })
            .collect()
    }
}

fn distinct(nodes: &[Node]) -> BTreeSet<(&str, &str)> {
    nodes
        .iter()
        .map(|node| (&*node.name, &*node.version))
        .collect()
}

/// Lines such as `2 paste v1.0.15 (proc-macro)`.
fn nodes(text: &str) -> Result<Vec<Node>> {
    let node = |line: &str| {
        let mut words = line.split_whitespace();
        Some(Node {
            depth: words.next()?.parse().ok()?,
            name: words.next()?.to_owned(),
            version: words.next()?.to_owned(),
            is_macro: words.next() == Some("(proc-macro)"),
        })
    };
    let read = |line: &str| node(line).with_context(|| format!("no line of a tree: {line:?}"));
    text.lines().map(read).collect()
}

fn without_macros(nodes: Vec<Node>) -> Vec<Node> {
    let mut inside = None;
    let mut linked = Vec::new();
    for node in nodes {
        if inside.is_some_and(|depth| node.depth > depth) {
            continue;
        }
        inside = node.is_macro.then_some(node.depth);
        if !node.is_macro {
            linked.push(node);
        }
    }
    linked
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn macros_and_what_they_need_are_for_building_only() {
        let all = "0 mdr-core v0.1.0 (/x)\n1 indenters v0.1.0 (/x)\n2 libm v0.2.16\n2 thiserror v2.0.21\n\
                   3 thiserror-impl v2.0.21 (proc-macro)\n4 syn v3.0.9\n1 libm v0.2.16\n1 gemm v0.19.0\n\
                   2 autocfg v1.5.1\n";
        let linked = all.replace("2 autocfg v1.5.1\n", "");
        let tree = Tree {
            all: nodes(all).expect("a tree"),
            linked: without_macros(nodes(&linked).expect("a tree")),
        };
        assert_eq!(tree.counts(), [1, 3, 3], "{tree:?}");
        let direct = [("indenters", 5), ("libm", 1), ("gemm", 2)];
        assert_eq!(
            tree.direct(),
            direct.map(|(name, count)| (name.to_owned(), count)),
            "{tree:?}"
        );
        assert!(nodes("warning: unused\n").is_err(), "no line of a tree");
    }
}
