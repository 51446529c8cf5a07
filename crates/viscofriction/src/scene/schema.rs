//! The JSON Schema of the scene file, from which everything that lists bodies and materials follows.
//!
//! The doc comment of a number states quantity, range and unit, as "Radius > 0, \[m]". Here the range becomes words of the schema,
//! against which the numbers of bodies and materials are checked, and the unit the word `x-unit`.

use std::collections::BTreeMap;
use std::sync::LazyLock;

use numerics::in_range;
use schemars::transform::{RecursiveTransform, Transform};
use schemars::{JsonSchema, Schema};
use serde::Serialize;
use serde_json::{Value as Json, json};
use toml::Value;

use super::{Scene, SceneError};

/// Ranges as doc comments state them, with the keywords that they become in the schema. `x-allowed` is the wording in messages,
/// where it differs from that of the comment.
fn ranges() -> [(&'static str, Json); 13] {
    [
        (
            "> 0",
            json!({ "x-allowed": "finite and greater than 0", "exclusiveMinimum": 0 }),
        ),
        (
            "≥ 0",
            json!({ "x-allowed": "finite and at least 0", "minimum": 0 }),
        ),
        (
            "≠ 0",
            json!({ "x-allowed": "finite and not 0", "not": { "const": 0 } }),
        ),
        (
            "between 0 and 1",
            json!({ "exclusiveMinimum": 0, "exclusiveMaximum": 1 }),
        ),
        ("from 0 to 1", json!({ "minimum": 0, "maximum": 1 })),
        ("from 0 to 0.1", json!({ "minimum": 0, "maximum": 0.1 })),
        (
            "from 0.01 to 0.99",
            json!({ "minimum": 0.01, "maximum": 0.99 }),
        ),
        ("from 1 to 1000", json!({ "minimum": 1, "maximum": 1000 })),
        ("from 1 to 1024", json!({ "minimum": 1, "maximum": 1024 })),
        (
            "from 8 to 100000",
            json!({ "minimum": 8, "maximum": 100_000 }),
        ),
        (
            "above 0 and at most 0.1",
            json!({ "exclusiveMinimum": 0, "maximum": 0.1 }),
        ),
        (
            "0, 90, 180 or 270",
            json!({ "minimum": 0, "maximum": 270, "multipleOf": 90 }),
        ),
        (
            "−1 < ν ≤ 1/2",
            json!({ "x-allowed": "greater than -1 and at most 0.5", "exclusiveMinimum": -1, "maximum": 0.5 }),
        ),
    ]
}

/// The schema of a scene with its units and ranges.
static SCHEMA: LazyLock<Schema> = LazyLock::new(|| {
    let ranges = ranges();
    let mut schema = schemars::schema_for!(Scene);
    RecursiveTransform(|schema: &mut Schema| add_range_and_unit(schema, &ranges))
        .transform(&mut schema);
    schema
});

/// The JSON Schema of the scene file. Numbers, also those of a list, have their unit as the word `x-unit`, and their range as messages
/// state it as `x-allowed`.
pub fn schema() -> &'static Json {
    SCHEMA.as_value()
}

/// The text of the JSON Schema of the scene file.
///
/// # Errors
/// If the schema cannot be written as JSON.
pub fn json_schema() -> Result<String, serde_json::Error> {
    let mut text = serde_json::to_string_pretty(&*SCHEMA)?;
    text.push('\n');
    Ok(text)
}

/// Adds the keywords of the range and unit that its description states to the schema of a number, of the numbers of a list, or of the
/// only key of a table. Other schemas stay unchanged.
fn add_range_and_unit(schema: &mut Schema, ranges: &[(&str, Json)]) {
    let description = schema
        .get("description")
        .and_then(Json::as_str)
        .unwrap_or_default()
        .to_owned();
    let is_list = schema.get("items").is_some();
    let words = match schema.get_mut(if is_list { "items" } else { "properties" }) {
        Some(items) if is_list => items.as_object_mut(),
        Some(Json::Object(keys)) if keys.len() == 1 => {
            keys.values_mut().next().and_then(Json::as_object_mut)
        }
        _ => schema.as_object_mut(),
    };
    let Some(words) = words.filter(|words| {
        is_of_type(words.get("type"), "number") || is_of_type(words.get("type"), "integer")
    }) else {
        return;
    };
    if let Some((stated, range)) = ranges
        .iter()
        .find(|(stated, _)| description.contains(stated))
    {
        words.insert("x-allowed".to_owned(), (*stated).into());
        words.extend(range.as_object().cloned().into_iter().flatten());
    }
    let behind = description.split_once('[').map(|(_, behind)| behind);
    if let Some((unit, _)) = behind.and_then(|behind| behind.split_once(']')) {
        words.insert("x-unit".to_owned(), unit.into());
    }
}

/// True if a value of this type is allowed; a value that may be left out has two types.
fn is_of_type(kind: Option<&Json>, name: &str) -> bool {
    kind.is_some_and(|kind| kind == name || kind[0] == name)
}

/// The part of the schema that describes a number, or the numbers of a list; `None` for the schema of another value.
pub fn number(words: &Json) -> Option<&Json> {
    if is_of_type(words.get("type"), "number") {
        return Some(words);
    }
    words.get("items").and_then(number)
}

/// Units of all numbers of a scene by their keys: an empty text without a unit, `None` if numbers of this key have different ones.
pub fn units() -> BTreeMap<&'static str, Option<&'static str>> {
    let mut units = BTreeMap::new();
    add_units(schema(), &mut units);
    units
}

/// Adds the units of all numbers below a part of the schema, by their keys; `None` if two numbers of one key have different
/// units.
fn add_units(words: &'static Json, units: &mut BTreeMap<&'static str, Option<&'static str>>) {
    for (key, words) in words["properties"].as_object().into_iter().flatten() {
        if let Some(number) = number(words) {
            let unit = Some(number["x-unit"].as_str().unwrap_or_default());
            let known = units.entry(key).or_insert(unit);
            *known = known.filter(|known| Some(*known) == unit);
        }
    }
    match words {
        Json::Object(words) => words.values().for_each(|words| add_units(words, units)),
        Json::Array(words) => words.iter().for_each(|words| add_units(words, units)),
        _ => {}
    }
}

/// A body or a material.
#[derive(Debug, Clone)]
pub struct Kind {
    /// Its name in a scene.
    pub name: &'static str,
    /// What it is, in one sentence.
    pub sentence: &'static str,
    /// The keys that it needs, in their order, and after them those that may be left out.
    pub keys: Vec<Key>,
}

/// A key of a body or a material, or of a table in it.
#[derive(Debug, Clone, Copy)]
pub struct Key {
    /// Its name.
    pub name: &'static str,
    /// Its words in the schema: description, default, and its type, or a reference to that.
    pub words: &'static Json,
    /// False if it may be left out.
    pub is_required: bool,
}

/// All bodies (`Indenter`) or all materials (`MaterialTable`).
pub fn kinds(definition: &str) -> Vec<Kind> {
    let kinds = schema()["$defs"][definition]["oneOf"].as_array();
    let kind = |words: &'static Json| {
        let kind = keys(words).next()?;
        Some(Kind {
            name: kind.name,
            sentence: words["description"].as_str()?,
            keys: keys(kind.words).collect(),
        })
    };
    kinds.into_iter().flatten().filter_map(kind).collect()
}

/// The keys of a table, or of each table of a list: those that it needs, in their order, and after them the others.
pub fn keys(words: &'static Json) -> impl Iterator<Item = Key> {
    let list_or_table = resolved(words);
    let table = list_or_table.get("items").map_or(list_or_table, resolved);
    let all = table["properties"].as_object();
    let required = table["required"].as_array().into_iter().flatten();
    let required: Vec<&str> = required.filter_map(Json::as_str).collect();
    let others = all.into_iter().flatten().map(|(key, _)| &**key);
    let others: Vec<&str> = others.filter(|key| !required.contains(key)).collect();
    let key = move |(name, is_required)| Key {
        name,
        words: &table["properties"][name],
        is_required,
    };
    required
        .into_iter()
        .map(|name| (name, true))
        .chain(others.into_iter().map(|name| (name, false)))
        .map(key)
}

/// The schema of a type in place of a reference (`$ref`) to it, also if the value may be left out (`anyOf`).
pub fn resolved(words: &'static Json) -> &'static Json {
    let mut types = [words, &words["anyOf"][0]].into_iter();
    let reference = types.find_map(|words| words["$ref"].as_str());
    let name = reference.and_then(|path| path.strip_prefix("#/$defs/"));
    name.map_or(words, |name| &schema()["$defs"][name])
}

/// Checks all numbers of a table of the scene against their ranges.
pub(super) fn check_ranges<T: JsonSchema + Serialize>(
    table: &str,
    value: &T,
) -> Result<(), SceneError> {
    let words = &schema()["$defs"][&*T::schema_name()];
    let value = Value::try_from(value).map_err(|error| SceneError::at(table, error.to_string()))?;
    check_value(words, &value, table)
}

/// Checks all numbers of a value against its part `words` of the schema; `path` is its key in messages.
fn check_value(words: &'static Json, value: &Value, path: &str) -> Result<(), SceneError> {
    let words = resolved(words);
    match value {
        Value::Table(table) => table.iter().try_for_each(|(key, value)| {
            check_value(below(words, key), value, &format!("{path}.{key}"))
        }),
        Value::Array(items) => items.iter().enumerate().try_for_each(|(index, item)| {
            check_value(&words["items"], item, &format!("{path}[{index}]"))
        }),
        Value::Float(number) => check_number(words, *number, path),
        Value::Integer(number) => check_number(words, *number as f64, path),
        _ => Ok(()),
    }
}

/// The part of the schema for a key of a table, or of a table that is named by its kind; null if there is none.
pub(super) fn below(words: &'static Json, key: &str) -> &'static Json {
    let kinds = words["oneOf"].as_array().into_iter().flatten();
    let mut tables = std::iter::once(words).chain(kinds);
    let found = tables.find_map(|table| table["properties"].get(key));
    found.map_or(&Json::Null, resolved)
}

/// The refusal of a value that is none of the texts and tables of one key that the schema lists for it; `None` if it is one of them, and
/// where the schema lists nothing, or kinds of tables alone.
pub(super) fn refused_choice(words: &'static Json, value: &Value) -> Option<String> {
    let choices = words["oneOf"].as_array()?;
    let is_met = |choice: &Json| match value {
        Value::String(text) => choice["const"] == **text,
        Value::Table(table) if table.len() == 1 => {
            table.keys().all(|key| !choice["properties"][key].is_null())
        }
        _ => false,
    };
    let is_kind = |choice| keys(choice).any(|key| keys(key.words).next().is_some());
    if choices.iter().any(is_met) || choices.iter().all(is_kind) {
        return None;
    }
    let mut allowed: Vec<String> = choices.iter().map(form).collect();
    let last = allowed.pop()?;
    let found = match value {
        Value::String(text) => format!("{text:?}"),
        Value::Table(table) if table.is_empty() => "an empty table".to_owned(),
        Value::Table(table) => {
            let keys: Vec<&str> = table.keys().map(String::as_str).collect();
            format!("a table of {}", keys.join(", "))
        }
        Value::Array(_) => "a list".to_owned(),
        other => other.to_string(),
    };
    Some(format!(
        "it must be {} or {last}, but is {found}",
        allowed.join(", ")
    ))
}

/// How a value is written of which this is the part of the schema.
fn form(words: &'static Json) -> String {
    let (items, key) = (&words["items"], keys(words).next());
    match (words["const"].as_str(), key, words["x-allowed"].as_str()) {
        (Some(text), ..) => format!("{text:?}"),
        (_, Some(key), _) => format!("{{ {} = {} }}", key.name, form(key.words)),
        _ if !items.is_null() => {
            let length = words["minItems"].as_u64().unwrap_or(1);
            let items: Vec<String> = (0..length).map(|_| form(items)).collect();
            format!("[{}]", items.join(", "))
        }
        (.., Some(allowed)) => format!("number {allowed}"),
        _ => "number".to_owned(),
    }
}

/// Checks a number against the range that its part `words` of the schema states; one without a range may have any value.
fn check_number(words: &'static Json, value: f64, path: &str) -> Result<(), SceneError> {
    let Some(allowed) = words["x-allowed"].as_str() else {
        return Ok(());
    };
    let bound = |word: &str| words[word].as_f64();
    let holds = value.is_finite()
        && bound("minimum").is_none_or(|least| value >= least)
        && bound("exclusiveMinimum").is_none_or(|least| value > least)
        && bound("maximum").is_none_or(|most| value <= most)
        && bound("exclusiveMaximum").is_none_or(|most| value < most)
        && bound("multipleOf").is_none_or(|step| value % step == 0.0)
        && (words["not"].is_null() || value != 0.0);
    let refused = in_range("", value, holds, allowed);
    refused
        .map_err(|refused| SceneError::value(path.to_owned(), refused))
        .map(drop)
}
