//! The files that list all bodies, materials, interfaces, heat and strain dependences, written from the schema of the scene: the schema itself, the tables of keys
//! on pages of `docs/`, and the Python classes.

use std::fs;

use anyhow::{Context, Result};
use serde_json::Value as Json;
use viscofriction::scene::{Key, Kind, json_schema, keys, kinds, number, resolved, schema};

use crate::ci::workspace_root;

/// Definition and kind of a scene, and its class in Python, where the class is not the kind in camel case: those that read a file, and
/// those whose kind does not say what they are.
const CLASS_NAMES: [(&str, &str, &str); 9] = [
    ("Indenter", "table", "ProfileFile"),
    ("Indenter", "height-map", "HeightMapFile"),
    ("MaterialTable", "file", "MaterialFile"),
    ("Interface", "constant", "ConstantShear"),
    ("Interface", "bell", "BellShear"),
    ("Interface", "table", "ShearFile"),
    ("Heat", "", "Heat"),
    ("Strain", "kraus", "KrausStrain"),
    ("Strain", "table", "StrainFile"),
];
/// Definitions of the schema whose kinds are classes in Python, with the class that these are derived from.
const FAMILIES: [(&str, &str); 5] = [
    ("Indenter", "Body"),
    ("MaterialTable", "Material"),
    ("Interface", "Interface"),
    ("Heat", "Heated"),
    ("Strain", "StrainDependence"),
];
/// The material whose class is not generated but written by hand, in `_materials.py`: its constructor takes branches.
const BY_HAND: &str = "prony";
/// Sets of words in a scene that are also types of arguments of Python functions.
const CHOICES: [&str; 9] = [
    "Edges",
    "EnergyUnit",
    "HeightsAre",
    "LengthUnit",
    "Method",
    "Model",
    "StrainAmplitude",
    "StrainDeformation",
    "StrokeShape",
];
/// Begin of `_kinds.py`; `NAMES` is replaced by the quoted names of all classes, `CHOICES` by definitions of types.
const HEAD: &str = "\
\"\"\"Bodies, materials, interfaces, heat and strain dependences with the keys of a scene, in SI. `cargo xtask kinds` writes this file.\"\"\"

from __future__ import annotations

import os
from collections.abc import Mapping, Sequence
from dataclasses import KW_ONLY, dataclass
from typing import Literal

from ._tables import Body, Heated, Interface, Material, StrainDependence

__all__ = [
    NAMES,
]

# Words of a scene.
CHOICES
";

/// Pages with tables. The table of a definition of the schema stands between comments with its name: of a body or material all kinds,
/// of other tables their keys. Between comments with `NAME keys` are the keys of all kinds.
const PAGES: [&str; 3] = [
    "docs/scenes.md",
    "docs/height-maps.md",
    "docs/rough-surfaces.md",
];
/// Bodies whose keys have a table of their own.
const OWN_TABLES: [&str; 3] = ["height-map", "self-affine", "spectrum"];

/// Writes the generated files into the workspace and prints their paths.
pub(crate) fn write() -> Result<()> {
    for (path, text) in files()? {
        fs::write(workspace_root().join(path), text).context(path)?;
        println!("{path}");
    }
    Ok(())
}

/// Paths, from the root of the workspace, and contents of the generated files. Of [`PAGES`] only the text between the marks
/// `<!-- NAME -->` and `<!-- /NAME -->` is replaced.
fn files() -> Result<Vec<(&'static str, String)>> {
    let (mut classes, mut names) = (HEAD.to_owned(), Vec::new());
    for (definition, base) in FAMILIES {
        let kinds = kinds_or_keys(definition);
        for kind in kinds.iter().filter(|kind| kind.name != BY_HAND) {
            classes += &class(kind, (definition, base));
            names.push(format!("\"{}\"", class_name(definition, kind)));
        }
    }
    let schema = json_schema()?;
    let definitions: Json = serde_json::from_str(&schema)?;
    let choices = CHOICES.map(|name| {
        let words = literal(&definitions["$defs"][name]);
        format!("{name} = {words}")
    });
    let module = classes
        .replace("NAMES", &names.join(",\n    "))
        .replace("CHOICES", &choices.join("\n"));
    let mut files = vec![
        ("docs/scene.schema.json", schema),
        ("python/viscofriction/_kinds.py", module),
    ];
    for path in PAGES {
        let page = fs::read_to_string(workspace_root().join(path)).context(path)?;
        files.push((path, with_tables(&page)?));
    }
    Ok(files)
}

/// The kinds of a definition of the schema; of a definition without kinds one that has its keys, and no name.
fn kinds_or_keys(definition: &str) -> Vec<Kind> {
    let kinds = kinds(definition);
    if !kinds.is_empty() {
        return kinds;
    }
    let words = &schema()["$defs"][definition];
    vec![Kind {
        name: "",
        sentence: words["description"].as_str().unwrap_or_default(),
        keys: keys(words).collect(),
    }]
}

/// The page with the present table between each pair of marks; an error if the second mark of a pair is missing.
fn with_tables(page: &str) -> Result<String> {
    let mut parts = page.split("<!-- ");
    let mut text = parts.next().unwrap_or_default().to_owned();
    while let Some(part) = parts.next() {
        let (name, _) = part.split_once(" -->").context("an open comment")?;
        let end = parts.next().and_then(|part| part.strip_prefix('/'));
        let rest = end
            .and_then(|part| part.strip_prefix(name))
            .with_context(|| format!("no end of the table {name}"))?;
        text += &format!("<!-- {name} -->\n\n{}\n<!-- /{name}{rest}", table(name));
    }
    Ok(text)
}

/// The table of a mark in Markdown; the name of the mark is explained at [`PAGES`].
fn table(name: &str) -> String {
    let definition = name.trim_end_matches(" keys");
    let kinds = kinds(definition);
    let (head, rows): (_, Vec<String>) = if name != definition {
        let head = "key | of | unit | range | unless given | meaning";
        (head, rows_of_kinds(&kinds))
    } else if kinds.is_empty() {
        let head = "key | unit | range | unless given | meaning";
        let row = |key: Key| format!("{} | {}", name_cell(&key), cells(&key));
        (
            head,
            keys(&schema()["$defs"][definition]).map(row).collect(),
        )
    } else {
        let head = "kind | in Python | what it is | keys, and those that may be left out";
        (
            head,
            kinds.iter().map(|kind| row(definition, kind)).collect(),
        )
    };
    let line = vec!["---"; head.split(" | ").count()].join("|");
    let rows: String = rows.iter().map(|row| format!("| {row} |\n")).collect();
    format!("| {head} |\n|{line}|\n{rows}")
}

/// The row of a kind in Markdown, without its outer bars: first the required keys, then, behind a semicolon, the others.
fn row(definition: &str, kind: &Kind) -> String {
    let (required, others): (Vec<Key>, Vec<Key>) =
        kind.keys.iter().copied().partition(|key| key.is_required);
    let lists = [required, others].map(|keys| {
        let names: Vec<String> = keys.iter().map(name_cell).collect();
        names.join(", ")
    });
    let joined = lists.join("; ");
    let keys = joined.trim_end_matches("; ");
    let (name, class, sentence) = (kind.name, class_name(definition, kind), kind.sentence);
    format!("`{name}` | `{class}` | {sentence} | {keys}")
}

/// A row in Markdown, without its outer bars, for each key of the kinds; kinds that have the same key share its row.
fn rows_of_kinds(kinds: &[Kind]) -> Vec<String> {
    let kinds: Vec<&Kind> = kinds
        .iter()
        .filter(|kind| !OWN_TABLES.contains(&kind.name))
        .collect();
    let mut rows: Vec<([String; 2], Vec<&str>)> = Vec::new();
    for kind in &kinds {
        for key in &kind.keys {
            let row = [name_cell(key), cells(key)];
            match rows.iter_mut().find(|(known, _)| *known == row) {
                Some((_, of)) => of.push(kind.name),
                None => rows.push((row, vec![kind.name])),
            }
        }
    }
    let row = |([name, cells], of): &([String; 2], Vec<&str>)| {
        let names = kinds.iter().map(|kind| kind.name);
        let (word, listed) = if of.len() > 4 {
            (
                "all but ",
                names.filter(|kind| !of.contains(kind)).collect(),
            )
        } else {
            ("", of.clone())
        };
        format!("{name} | {word}`{}` | {cells}", listed.join("`, `"))
    };
    rows.iter().map(row).collect()
}

/// Name of a key in Markdown, with the keys of each table where it is a list of tables.
fn name_cell(key: &Key) -> String {
    let items = list_of(key).map(|keys| format!(", a list of `{{ {keys} }}`"));
    format!("`{}`{}", key.name, items.unwrap_or_default())
}

/// Unit, range, default and meaning of a key, as cells of a row in Markdown.
fn cells(key: &Key) -> String {
    let words = number(key.words).unwrap_or(key.words);
    let unit = words["x-unit"].as_str().unwrap_or_default();
    let range = match words["x-allowed"].as_str().unwrap_or_default() {
        "finite and greater than 0" => "> 0",
        "finite and at least 0" => "≥ 0",
        "finite and not 0" => "≠ 0",
        "greater than -1 and at most 0.5" => "−1 < ν ≤ 1/2",
        range => range,
    };
    // The doc comment states range, unit and default within its sentence.
    let description = key.words["description"].as_str().unwrap_or_default();
    let mut meaning = description.replace('\n', " ").replace('|', "\\|");
    for stated in [format!(" {range}"), format!(" \\[{unit}]")] {
        if !stated.trim().is_empty() {
            meaning = meaning.replacen(&format!(",{stated}"), "", 1);
            meaning = meaning.replacen(&stated, "", 1);
        }
    }
    let (meaning, stated) = match meaning.split_once("; without it ") {
        Some((meaning, default)) => (
            format!("{meaning}."),
            default.trim_end_matches('.').to_owned(),
        ),
        None => (meaning.clone(), String::new()),
    };
    let default = match &key.words["default"] {
        _ if key.is_required => "required".to_owned(),
        Json::Null => stated,
        default => format!("`{default}`"),
    };
    let list: String = choices(key)
        .map(|(name, meaning)| format!(" `{name}`: {meaning}"))
        .collect();
    format!("{unit} | {range} | {default} | {meaning}{list}")
}

/// The words in quotes or keys of tables that a key may have, each with its meaning.
fn choices(key: &Key) -> impl Iterator<Item = (String, String)> {
    let choices = resolved(key.words)["oneOf"].as_array();
    choices.into_iter().flatten().map(|choice| {
        let table = keys(choice).next().map(|key| key.name.to_owned());
        let name = table.unwrap_or_else(|| choice["const"].to_string());
        let meaning = choice["description"].as_str().unwrap_or_default();
        (name, meaning.replace('\n', " "))
    })
}

/// Name of the class in Python: of [`CLASS_NAMES`], or the kind in camel case.
fn class_name(definition: &str, kind: &Kind) -> String {
    let known = (CLASS_NAMES.iter()).find(|(of, name, _)| [*of, *name] == [definition, kind.name]);
    let words = kind.name.split('-');
    let capitalized = words.map(|word| word[..1].to_uppercase() + &word[1..]);
    known.map_or_else(
        || capitalized.collect(),
        |(_, _, class)| (*class).to_owned(),
    )
}

/// Source of the dataclass in Python of a kind of a definition, derived from `base`. Keys that may be left out are keyword-only and
/// have their defaults.
fn class(kind: &Kind, (definition, base): (&str, &str)) -> String {
    let (mut docs, mut fields, mut lists) = (String::new(), String::new(), String::new());
    for key in &kind.keys {
        let Key {
            name,
            words,
            is_required,
        } = key;
        let description = words["description"]
            .as_str()
            .unwrap_or_default()
            .replace('\\', "")
            .replace('\n', "\n    ");
        docs += &format!("    ``{name}``: {description}\n");
        for (choice, meaning) in choices(key) {
            let is_word = choice.starts_with('"');
            let literal = if is_word {
                choice
            } else {
                format!("{{\"{choice}\": …}}")
            };
            docs += &format!("    ``{literal}``: {}\n", meaning.replace('`', "``"));
        }
        if let Some(items) = list_of(key) {
            let pair = items.replace(", ", " and ");
            docs += &format!("    Each is a pair of {pair}.\n");
            let quoted = items.replace(", ", "\", \"");
            lists += &format!("    _lists = {{\"{name}\": (\"{quoted}\")}}\n");
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
    let (name, sentence) = (kind.name, kind.sentence);
    let class = class_name(definition, kind);
    format!(
        "\n\n@dataclass(frozen=True)\nclass {class}({base}):\n    \"\"\"{sentence}\n\n{docs}    \"\"\"\n\n{fields}    _kind = \"{name}\"\n{lists}"
    )
}

/// Names of the keys of each table, joined by commas, if `key` is a list of tables.
fn list_of(key: &Key) -> Option<String> {
    let keys: Vec<&str> = keys(key.words).map(|key| key.name).collect();
    (key.words["type"] == "array" && !keys.is_empty()).then(|| keys.join(", "))
}

/// Type in Python of the argument for a key of a scene.
fn type_of(key: &Key) -> String {
    let words = resolved(key.words);
    let name = match words["type"].as_str().or(words["type"][0].as_str()) {
        Some("number") => "float",
        Some("integer") => "int",
        Some("boolean") => "bool",
        Some("string") if words["oneOf"].is_null() => "str | os.PathLike[str]",
        Some("array") if list_of(key).is_some() => "Sequence[tuple[float, float]]",
        Some("array") => "tuple[float, float]",
        _ => return literal(words),
    };
    name.to_owned()
}

/// Type in Python of a definition that lists words, `Literal["a", "b"]`; a word with a number is a dictionary.
fn literal(words: &Json) -> String {
    let choices = words["oneOf"].as_array().into_iter().flatten();
    let (words, numbers): (Vec<&Json>, Vec<&Json>) = choices
        .map(|choice| &choice["const"])
        .partition(|word| word.is_string());
    let words: Vec<String> = words.into_iter().map(Json::to_string).collect();
    let literal = format!("Literal[{}]", words.join(", "));
    if numbers.is_empty() {
        literal
    } else {
        format!("{literal} | Mapping[str, float]")
    }
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
