//! Every kind of body and material, and every number of a scene, is known wherever a new one has to be entered by hand.
//!
//! The kinds and their keys are those of `docs/scene.schema.json`, which a test of the program keeps current.

use std::collections::BTreeSet;

use anyhow::{Context as _, Result};
use serde_json::Value;
use toml::Table;

const SCHEMA: &str = include_str!("../../../docs/scene.schema.json");
const RECIPES: &str = include_str!("../../src/evidence/sample/recipes.toml");
const UNITS: &str = include_str!("../../src/evidence/agreement/units.csv");
const SCENES_PAGE: &str = include_str!("../../../docs/scenes.md");
const MALFORMED: &str = include_str!("../../../crates/viscofriction/tests/data/malformed.txt");
const AXIS_LABELS: &str = include_str!("../../../crates/viscofriction-cli/src/sweep/picture.rs");
const PYTHON_BODIES: &str = include_str!("../../../python/viscofriction/_bodies.py");
const PYTHON_MATERIALS: &str = include_str!("../../../python/viscofriction/_materials.py");

/// Numbers without a row in `units.csv`: the unit of a coefficient depends on the exponent beside it, and an uncertainty has the
/// unit of the number that it is about.
const WITHOUT_UNIT: [&str; 2] = ["coefficient", "uncertainty"];
/// Numbers that no sweep draws an axis for under a name of their own, so that the key itself labels it.
const WITHOUT_LABEL: [&str; 15] = [
    "arrhenius",
    "coefficient",
    "period",
    "position",
    "relative",
    "relative_error",
    "spacing",
    "standard_error",
    "table",
    "temperature_range",
    "time",
    "time_range",
    "uncertainty",
    "valid_frequencies",
    "wlf",
];

/// A table of the scene file of which exactly one kind is given.
struct Family {
    table: &'static str,
    definition: &'static str,
    python: &'static str,
}

const FAMILIES: [Family; 2] = [
    Family {
        table: "indenter",
        definition: "Indenter",
        python: PYTHON_BODIES,
    },
    Family {
        table: "material",
        definition: "MaterialTable",
        python: PYTHON_MATERIALS,
    },
];

/// The places in which a kind or a number of the schema is missing.
fn missing(schema: &Value) -> Result<Vec<String>> {
    let recipes: Table = toml::from_str(RECIPES)?;
    let mut missing = Vec::new();
    for family in FAMILIES {
        let table = family.table;
        let known = recipes.get(table).and_then(toml::Value::as_table);
        let known = known.context("recipes of a family")?;
        for kind in kinds(schema, family.definition)? {
            let places = [
                ("evidence/sample/recipes.toml", known.contains_key(&kind)),
                ("docs/scenes.md", SCENES_PAGE.contains(&format!("`{kind}`"))),
                (
                    "viscofriction/tests/data/malformed.txt",
                    MALFORMED.contains(&format!("{table}.{kind}")),
                ),
                (
                    "python/viscofriction",
                    family.python.contains(&format!("_kind = \"{kind}\"")),
                ),
            ];
            let absent = places.iter().filter(|(_, is_there)| !is_there);
            missing.extend(absent.map(|(place, _)| format!("{table}.{kind}: {place}")));
        }
    }
    let mut numbers = BTreeSet::new();
    collect_numbers(schema, schema, "scene", &mut numbers);
    let has_unit = |key: &str| UNITS.lines().any(|row| row.split(',').next() == Some(key));
    let has_label =
        |key: &str| key.ends_with("modulus") || AXIS_LABELS.contains(&format!("(\"{key}\", \""));
    for key in &numbers {
        let key = key.as_str();
        if !has_unit(key) && !WITHOUT_UNIT.contains(&key) {
            missing.push(format!("{key}: evidence/agreement/units.csv"));
        }
        if !has_label(key) && !WITHOUT_LABEL.contains(&key) {
            missing.push(format!("{key}: viscofriction-cli/src/sweep/picture.rs"));
        }
    }
    Ok(missing)
}

/// The kinds of a family, which are alternatives with one key each.
fn kinds(schema: &Value, definition: &str) -> Result<Vec<String>> {
    let alternatives = schema["$defs"][definition]["oneOf"].as_array();
    let alternatives = alternatives.context("alternatives of a family")?.iter();
    let kind = |one: &Value| {
        let keys = one["properties"].as_object();
        let key = keys.and_then(|keys| keys.keys().next());
        key.cloned().context("the key of a kind")
    };
    alternatives.map(kind).collect()
}

/// Adds the keys whose values are numbers, or lists or maps of numbers.
fn collect_numbers(schema: &Value, value: &Value, key: &str, numbers: &mut BTreeSet<String>) {
    if let Some(reference) = value["$ref"].as_str() {
        let name = reference.rsplit('/').next().unwrap_or(reference);
        return collect_numbers(schema, &schema["$defs"][name], key, numbers);
    }
    let is_number = |kind: &Value| kind == "number";
    let kind = &value["type"];
    if is_number(kind)
        || kind
            .as_array()
            .is_some_and(|kinds| kinds.iter().any(is_number))
    {
        numbers.insert(key.to_owned());
    }
    if let Some(properties) = value["properties"].as_object() {
        for (key, value) in properties {
            collect_numbers(schema, value, key, numbers);
        }
    }
    for part in ["items", "additionalProperties"] {
        collect_parts(
            schema,
            value[part].as_object().map(|_| &value[part]),
            key,
            numbers,
        );
    }
    for part in ["prefixItems", "oneOf", "anyOf", "allOf"] {
        collect_parts(
            schema,
            value[part].as_array().into_iter().flatten(),
            key,
            numbers,
        );
    }
}

fn collect_parts<'a>(
    schema: &Value,
    parts: impl IntoIterator<Item = &'a Value>,
    key: &str,
    numbers: &mut BTreeSet<String>,
) {
    for part in parts {
        collect_numbers(schema, part, key, numbers);
    }
}

#[test]
fn every_kind_and_number_of_a_scene_is_known_everywhere() -> Result<()> {
    let missing = missing(&serde_json::from_str(SCHEMA)?)?;
    assert!(missing.is_empty(), "missing: {missing:#?}");
    Ok(())
}

/// A spheroid that is only in the schema is missed in all places.
#[test]
fn a_forgotten_body_is_found() -> Result<()> {
    let mut schema: Value = serde_json::from_str(SCHEMA)?;
    let bodies = schema["$defs"]["Indenter"]["oneOf"].as_array_mut();
    bodies.context("bodies")?.push(serde_json::json!({
        "type": "object",
        "properties": {"spheroid": {"type": "object", "properties": {"semi_axis": {"type": "number"}}}},
    }));
    let expected = [
        "indenter.spheroid: evidence/sample/recipes.toml",
        "indenter.spheroid: docs/scenes.md",
        "indenter.spheroid: viscofriction/tests/data/malformed.txt",
        "indenter.spheroid: python/viscofriction",
        "semi_axis: evidence/agreement/units.csv",
        "semi_axis: viscofriction-cli/src/sweep/picture.rs",
    ];
    assert_eq!(
        missing(&schema)?,
        expected,
        "places of a body that is only in the schema"
    );
    Ok(())
}
