//! The files that list all bodies and materials, written from the schema of the scene: the schema itself, the tables of
//! `docs/scenes.md`, and the Python classes.

use std::fs;

use anyhow::{Context, Result};
use serde_json::Value as Json;
use viscofriction::scene::{Key, Kind, json_schema, keys, kinds, number, resolved};

use crate::ci::workspace_root;

/// Kind of a scene, and its class in Python, where the class is not the kind in camel case: these three read a file.
const CLASS_NAMES: [(&str, &str); 3] = [
    ("table", "ProfileFile"),
    ("height-map", "HeightMapFile"),
    ("file", "MaterialFile"),
];
/// The material whose class is not generated but written by hand, in `_materials.py`: its constructor takes branches.
const BY_HAND: &str = "prony";
/// Begin of `_kinds.py`; `NAMES` is replaced by the quoted names of all classes.
const HEAD: &str = "\
\"\"\"Bodies and materials with the keys of a scene, in SI. `cargo xtask kinds` writes this file.\"\"\"

from __future__ import annotations

import os
from collections.abc import Sequence
from dataclasses import KW_ONLY, dataclass
from typing import Literal

from ._tables import Body, Material

__all__ = [
    NAMES,
]
";

/// Writes the three generated files into the workspace and prints their paths.
pub(crate) fn write() -> Result<()> {
    for (path, text) in files()? {
        fs::write(workspace_root().join(path), text).context(path)?;
        println!("{path}");
    }
    Ok(())
}

/// Paths, from the root of the workspace, and contents of the three generated files. Of `docs/scenes.md` only the text
/// between the marks `<!-- NAME -->` and `<!-- /NAME -->` is replaced; fails where a mark is missing.
fn files() -> Result<[(&'static str, String); 3]> {
    let page_path = "docs/scenes.md";
    let mut page = fs::read_to_string(workspace_root().join(page_path)).context(page_path)?;
    let (mut classes, mut names) = (HEAD.to_owned(), Vec::new());
    for (definition, base) in [("Indenter", "Body"), ("MaterialTable", "Material")] {
        let kinds = kinds(definition);
        let rows: String = kinds.iter().map(row).collect();
        let [begin, end] = ["", "/"].map(|slash| format!("<!-- {slash}{definition} -->\n"));
        let place = page.split_once(&begin).zip(page.split_once(&end));
        let ((before, _), (_, after)) = place.context(begin.clone())?;
        page = format!("{before}{begin}\n{ROWS}{rows}\n{end}{after}");
        for kind in kinds.iter().filter(|kind| kind.name != BY_HAND) {
            classes += &class(kind, base);
            names.push(format!("\"{}\"", class_name(kind)));
        }
    }
    let classes = classes.replace("NAMES", &names.join(",\n    "));
    Ok([
        ("docs/scene.schema.json", json_schema()?),
        (page_path, page),
        ("python/viscofriction/_kinds.py", classes),
    ])
}

/// Head of each table of `docs/scenes.md` in Markdown; [`row`] writes its rows.
const ROWS: &str =
    "| kind | in Python | what it is | keys, and those that may be left out |\n|---|---|---|---|\n";

/// The row of a kind in Markdown: first the required keys, then, behind a semicolon, those that may be left out.
fn row(kind: &Kind) -> String {
    let (required, others): (Vec<Key>, Vec<Key>) =
        kind.keys.iter().copied().partition(|key| key.is_required);
    let cells = [required, others].map(|keys| keys.iter().map(cell).collect::<Vec<_>>().join(", "));
    let cells = cells.join("; ");
    let (name, class, sentence) = (kind.name, class_name(kind), kind.sentence);
    format!(
        "| `{name}` | `{class}` | {sentence} | {} |\n",
        cells.trim_end_matches("; ")
    )
}

/// A key in Markdown, with its unit where it is a number, or with the keys of each table where it is a list of tables.
fn cell(key: &Key) -> String {
    let unit = number(key.words).and_then(|number| number["x-unit"].as_str());
    match (unit, list_of(key)) {
        (Some(unit), _) => format!("`{}` \\[{unit}]", key.name),
        (None, Some(keys)) => format!("`{}`, a list of `{{ {keys} }}`", key.name),
        (None, None) => format!("`{}`", key.name),
    }
}

/// Name of the class in Python: of [`CLASS_NAMES`], or the kind in camel case.
fn class_name(kind: &Kind) -> String {
    let known = CLASS_NAMES.iter().find(|(name, _)| *name == kind.name);
    let words = kind.name.split('-');
    let words = words.map(|word| word[..1].to_uppercase() + &word[1..]);
    known.map_or_else(|| words.collect(), |(_, class)| (*class).to_owned())
}

/// Source of the dataclass in Python, derived from `base`. Keys that may be left out are keyword-only and have their defaults.
fn class(kind: &Kind, base: &str) -> String {
    let (mut docs, mut fields, mut lists) = (String::new(), String::new(), String::new());
    for key in &kind.keys {
        let Key {
            name,
            words,
            is_required,
        } = key;
        let description = words["description"].as_str().unwrap_or_default();
        let description = description.replace('\\', "").replace('\n', "\n    ");
        docs += &format!("    ``{name}``: {description}\n");
        if let Some(items) = list_of(key) {
            let pair = items.replace(", ", " and ");
            docs += &format!("    Each is a pair of {pair}.\n");
            let items = items.replace(", ", "\", \"");
            lists += &format!("    _lists = {{\"{name}\": (\"{items}\")}}\n");
        }
        if !is_required && !fields.contains("KW_ONLY") {
            fields += "    _: KW_ONLY\n";
        }
        let default = match &words["default"] {
            _ if *is_required => String::new(),
            Json::Null => " | None = None".to_owned(),
            Json::Bool(default) => format!(" = {}", if *default { "True" } else { "False" }),
            default => format!(" = {default}"),
        };
        fields += &format!("    {name}: {}{default}\n", type_of(key));
    }
    let (class, name, sentence) = (class_name(kind), kind.name, kind.sentence);
    format!(
        "\n\n@dataclass(frozen=True)\nclass {class}({base}):\n    \"\"\"{sentence}\n\n{docs}    \"\"\"\n\n{fields}    _kind = \"{name}\"\n{lists}"
    )
}

/// Names of the keys of each table, joined by commas, if `key` is a list of tables.
fn list_of(key: &Key) -> Option<String> {
    let keys: Vec<&str> = keys(key.words).map(|key| key.name).collect();
    (key.words["type"] == "array" && !keys.is_empty()).then(|| keys.join(", "))
}

/// The type of a key in Python.
fn type_of(key: &Key) -> String {
    let words = resolved(key.words);
    let name = match words["type"].as_str().or(words["type"][0].as_str()) {
        Some("number") => "float",
        Some("integer") => "int",
        Some("boolean") => "bool",
        Some("string") if words["oneOf"].is_null() => "str | os.PathLike[str]",
        Some("array") if list_of(key).is_some() => "Sequence[tuple[float, float]]",
        Some("array") => "tuple[float, float]",
        _ => {
            let choices = words["oneOf"].as_array().into_iter().flatten();
            let choices: Vec<String> = choices.map(|choice| choice["const"].to_string()).collect();
            return format!("Literal[{}]", choices.join(", "));
        }
    };
    name.to_owned()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_committed_files_list_the_bodies_and_materials_of_the_types() {
        for (path, current) in files().expect("the files") {
            let committed = fs::read_to_string(workspace_root().join(path));
            let is_current = committed.is_ok_and(|committed| committed == current);
            assert!(
                is_current,
                "{path} is not current; `cargo xtask kinds` makes it so"
            );
        }
    }
}
