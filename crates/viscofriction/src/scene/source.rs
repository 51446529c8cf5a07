//! Parsing of scene files, and attribution of errors to lines.

use std::ops::Range;
use std::path::{Path, PathBuf};

use serde::Deserialize;
use serde::de::DeserializeOwned;
use serde_path_to_error::Segment;
use toml::de::{DeTable, DeValue};
use toml::{Table, Value};

use super::schema::{below, refused_choice, resolved, schema};
use super::{Heat, Indenter, Interface, MaterialTable, Scene, SceneError, Strain};
use crate::text::{WrongInput, line_of};

/// The text of a scene file with its path.
#[derive(Debug, Clone)]
pub struct Source {
    path: PathBuf,
    text: String,
}

impl Source {
    /// Wraps the contents of a file.
    ///
    /// # Errors
    /// [`WrongInput`] if the text is not UTF-8.
    pub fn new(path: &Path, contents: Vec<u8>) -> Result<Self, WrongInput> {
        let text = String::from_utf8(contents).map_err(|error| {
            let line = line_of(error.as_bytes(), error.utf8_error().valid_up_to());
            WrongInput(format!("{}:{line}: the text is no UTF-8", path.display()))
        })?;
        Ok(Self {
            path: path.to_owned(),
            text,
        })
    }

    /// Path of the scene file.
    pub fn path(&self) -> &Path {
        &self.path
    }

    /// Contents of the scene file.
    pub fn text(&self) -> &str {
        &self.text
    }

    /// Folder of the file, to which file names in the scene are relative.
    pub fn folder(&self) -> &Path {
        self.path.parent().unwrap_or(Path::new(""))
    }

    /// Parses the keys and values of the file.
    ///
    /// # Errors
    /// [`WrongInput`] if the text is not TOML, or if a path contains an escape.
    pub fn table(&self) -> Result<Table, WrongInput> {
        let wrong = |start: usize, problem: String| {
            let line = line_of(self.text.as_bytes(), start);
            self.locate(&SceneError::Syntax { line, problem })
        };
        let table = self.text.parse::<Table>().map_err(|error| {
            let start = error.span().map_or(0, |span| span.start);
            let line = self
                .text
                .lines()
                .nth(line_of(self.text.as_bytes(), start) - 1);
            let has_both = line.is_some_and(|line| line.contains('"') && line.contains('\\'));
            let advice = match line {
                _ if has_both => BACKSLASH_ADVICE,
                Some(line) if line.contains('=') && error.message().contains("expected") => {
                    VALUE_ADVICE
                }
                _ => "",
            };
            wrong(start, format!("{}{advice}", error.message()))
        })?;
        if let Ok(document) = DeTable::parse(&self.text)
            && let Some(path) = escaped_path(document.get_ref(), &self.text)
        {
            let problem = format!("{} is no path{BACKSLASH_ADVICE}", &self.text[path.clone()]);
            return Err(wrong(path.start, problem));
        }
        Ok(table)
    }

    /// Message of an error of the scene, with the file and the line of its key.
    pub fn locate(&self, error: &SceneError) -> WrongInput {
        let line = match error {
            SceneError::Syntax { line, .. } => *line,
            SceneError::Value { key, .. } | SceneError::At { key, .. } => self.line_of_key(key),
        };
        WrongInput(format!("{}:{line}: {error}", self.path.display()))
    }

    /// Line of the key with the path `key`, counted from 1. If it is absent the line of the innermost table on its path that
    /// exists, else 1.
    fn line_of_key(&self, key: &str) -> usize {
        let Ok(document) = DeTable::parse(&self.text) else {
            return 1;
        };
        let mut offset = 0;
        let mut tables = Some(document.get_ref());
        for segment in segments(key) {
            let (name, index) = split_index(segment);
            let Some((found, mut value)) = tables.and_then(|table| table.get_key_value(name))
            else {
                break;
            };
            offset = found.span().start;
            if let Some(element) = index.and_then(|index| value.get_ref().as_array()?.get(index)) {
                value = element;
                offset = value.span().start;
            }
            tables = value.get_ref().as_table();
        }
        line_of(self.text.as_bytes(), offset)
    }
}

/// Splits a path at its points into keys, except at points between quotes, as in `uncertainty."load.velocity"`; quotes are
/// removed.
fn segments(path: &str) -> Vec<&str> {
    let mut is_quoted = false;
    let parts = path.split(|letter| {
        is_quoted ^= letter == '"';
        letter == '.' && !is_quoted
    });
    parts.map(|part| part.trim_matches('"')).collect()
}

/// Path of a key in a table, quoted as in TOML if the key contains a point.
pub(crate) fn quoted(table: &str, key: &str) -> String {
    let key = if key.contains('.') {
        format!("{key:?}")
    } else {
        key.to_owned()
    };
    let between = if table.is_empty() { "" } else { "." };
    format!("{table}{between}{key}")
}

/// The path at which deserialization failed, in the notation of error messages: `a.b[2].c`.
fn path_of(path: &serde_path_to_error::Path) -> String {
    let start = String::new();
    path.iter()
        .fold(start, |before, segment| with_segment(&before, segment))
}

/// A path with one more segment.
fn with_segment(before: &str, segment: &Segment) -> String {
    match segment {
        Segment::Seq { index } => format!("{before}[{index}]"),
        Segment::Map { key } | Segment::Enum { variant: key } => quoted(before, key),
        Segment::Unknown => before.to_owned(),
    }
}

/// Rejects the path of an uncertain number without quotes, which TOML reads as nested tables.
fn check_quotes(table: &Table) -> Result<(), SceneError> {
    let uncertain = table.get("uncertainty").and_then(Value::as_table);
    let Some((first, mut inner)) = uncertain
        .into_iter()
        .flatten()
        .find(|(_, value)| value.is_table())
    else {
        return Ok(());
    };
    let mut path = first.clone();
    while let Some((key, value)) = inner.as_table().and_then(|table| table.iter().next()) {
        path = format!("{path}.{key}");
        inner = value;
    }
    let problem = format!("the path of an uncertain number is in quotes: \"{path}\" = {inner}");
    Err(SceneError::at(format!("uncertainty.{path}"), problem))
}

/// Advice for a Windows path between double quotes.
const BACKSLASH_ADVICE: &str = "; between double quotes a backslash begins an escape, as \\t a tab: write the path between single quotes, \
    '…', or with / in the place of every backslash";
/// Advice for a quantity with a unit.
const UNIT_ADVICE: &str = "; numbers of a scene are in SI units, and stand there without a unit";

/// Advice for a value that is not TOML, such as `radius = 5 mm`, `velocity = 0,1` or `model = line`.
const VALUE_ADVICE: &str =
    "; a number is in SI units, with a point and without a unit, and a text stands between quotes";

/// Keys of a scene whose values are file names.
pub(crate) const PATH_KEYS: [&str; 4] = ["file", "path", "history_file", "motion_file"];

/// Byte range in `text` of the first file name with an escape other than `\\` or `\"`, which is probably a Windows path with
/// single backslashes; `None` if there is none.
fn escaped_path(table: &DeTable<'_>, text: &str) -> Option<Range<usize>> {
    table.iter().find_map(|(key, value)| match value.get_ref() {
        DeValue::Table(table) => escaped_path(table, text),
        DeValue::String(_) if PATH_KEYS.contains(&&**key.get_ref()) => {
            let raw = text.get(value.span())?.strip_prefix('"')?;
            // Remove escaped backslashes and quotes; any backslash left begins another escape.
            let plain = raw.replace(r"\\", "").replace(r#"\""#, "");
            plain.contains('\\').then(|| value.span())
        }
        _ => None,
    })
}

/// Reads a scene; rejects unknown and missing keys and values of the wrong type.
pub(crate) fn scene_file(table: Table) -> Result<Scene, SceneError> {
    check_quotes(&table)?;
    checked(table)
}

/// Tables of a scene that contain exactly one table, named by its kind.
const TABLES_OF_ONE_KIND: [&str; 4] = ["indenter", "material", "interface", "strain"];

/// Deserializes the tables of a file.
fn checked<T: DeserializeOwned>(table: Table) -> Result<T, SceneError> {
    for (key, value) in &table {
        check_tables(key, value)?;
    }
    for key in TABLES_OF_ONE_KIND {
        check_kind(key, &table)?;
    }
    let value = Value::Table(table);
    serde_path_to_error::deserialize(value.clone()).map_err(|error| {
        refused_choice_at(error.path(), &value).unwrap_or_else(|| {
            let path = path_of(error.path());
            let problem = problem_of(error.inner());
            SceneError::at(full_key(&path, &problem), problem)
        })
    })
}

/// Reads a part of a scene from keys and values that contain nothing but its table, `[material.…]` for example.
macro_rules! read_alone {
    ($($key:ident: $Part:ty),+) => {
        $(impl TryFrom<Table> for $Part {
            type Error = SceneError;

            fn try_from(table: Table) -> Result<Self, SceneError> {
                #[derive(Deserialize)]
                #[serde(deny_unknown_fields)]
                struct Alone {
                    $key: $Part,
                }
                checked(table).map(|Alone { $key }| $key)
            }
        })+
    };
}

read_alone!(
    indenter: Indenter,
    material: MaterialTable,
    interface: Interface,
    heat: Heat,
    strain: Strain
);

/// The error of the first value on a path that is none of the choices of its key; `None` if there is none.
fn refused_choice_at(path: &serde_path_to_error::Path, mut value: &Value) -> Option<SceneError> {
    let (mut words, mut key) = (schema(), String::new());
    for segment in path {
        (words, value) = match segment {
            Segment::Seq { index } => (resolved(&words["items"]), value.get(index)?),
            Segment::Map { key } | Segment::Enum { variant: key } => {
                (below(words, key), value.get(key)?)
            }
            Segment::Unknown => return None,
        };
        key = with_segment(&key, segment);
        if let Some(problem) = refused_choice(words, value) {
            return Some(SceneError::at(key, problem));
        }
    }
    None
}

/// Message for a value of the wrong type, without Rust type names.
pub(super) fn problem_of(error: &toml::de::Error) -> String {
    let problem = error.message().trim();
    match problem.rsplit_once(", expected ") {
        Some((found, "f64")) => {
            let is_quantity =
                found.contains("string \"") && found.contains(|c: char| c.is_ascii_digit());
            let advice = if is_quantity { UNIT_ADVICE } else { "" };
            format!("{found}, expected a number{advice}")
        }
        Some((found, "usize" | "u64")) => format!("{found}, expected a whole number"),
        _ => problem.to_owned(),
    }
}

/// Ends of the paths of keys whose values are matrices, lists of lists of numbers.
const MATRIX_KEYS: [&str; 2] = [".covariance.relative", ".shift.vertical.table"];

/// Rejects lists in place of tables, whose values serde would assign to the keys by order.
fn check_tables(key: &str, value: &Value) -> Result<(), SceneError> {
    let table = value.as_table().ok_or_else(|| no_table(key, value))?;
    let is_kind = TABLES_OF_ONE_KIND.contains(&key);
    for (name, value) in table {
        let inner = format!("{key}.{name}");
        match value {
            // A matrix needs no tables.
            Value::Array(_) if MATRIX_KEYS.iter().any(|key| inner.ends_with(key)) => {}
            Value::Table(_) => check_tables(&inner, value)?,
            Value::Array(elements) => {
                // For a list of plain values serde reports the expected type itself.
                let is_plain =
                    |element: &Value| !matches!(element, Value::Array(_) | Value::Table(_));
                for (index, element) in elements.iter().enumerate() {
                    if is_kind || !is_plain(element) {
                        check_tables(&format!("{inner}[{index}]"), element)?;
                    }
                }
            }
            other if is_kind && table.len() == 1 => return Err(no_table(&inner, other)),
            _ => {}
        }
    }
    Ok(())
}

/// Error for a value in place of a table.
fn no_table(key: &str, value: &Value) -> SceneError {
    let found = value.type_str();
    let problem = format!("a table is needed, and not a value of type {found}");
    SceneError::at(key, problem)
}

/// Rejects a table at `key` that does not contain exactly one table, named by its kind, as `[material.prony]`. A missing table
/// is no error here.
fn check_kind(key: &str, table: &Table) -> Result<(), SceneError> {
    match table.get(key).and_then(Value::as_table) {
        Some(kinds) if kinds.len() != 1 => {
            let names: Vec<&str> = kinds.keys().map(String::as_str).collect();
            let found = format!("{}: {}", kinds.len(), names.join(", "));
            let needed = format!("exactly one kind is needed, as in [{key}.kind]");
            let problem = format!("{needed}, but there are {found}");
            Err(SceneError::at(key, problem))
        }
        _ => Ok(()),
    }
}

/// Path of the unknown or missing key that a message of serde names: `path` is where serde was, with or without that key.
fn full_key(path: &str, problem: &str) -> String {
    let starts = ["unknown field `", "unknown variant `", "missing field `"];
    let rest = starts.iter().find_map(|start| problem.strip_prefix(start));
    let named = rest.and_then(|rest| rest.split('`').next());
    let path = path.trim_matches('.');
    match named {
        Some(name) if path.rsplit('.').next() == Some(name) => path.to_owned(),
        Some(name) if path.is_empty() => name.to_owned(),
        Some(name) => format!("{path}.{name}"),
        None => path.to_owned(),
    }
}

/// The value at a path such as `material.prony.branches[0].modulus`; `None` if the scene does not have it.
pub(crate) fn value_at<'a>(scene: &'a mut Table, path: &str) -> Option<&'a mut Value> {
    let below = |table: &'a mut Table, segment: &str| {
        let (name, index) = split_index(segment);
        let value = table.get_mut(name)?;
        match index {
            Some(index) => value.get_mut(index),
            None => Some(value),
        }
    };
    let mut segments = path.split('.');
    let first = below(scene, segments.next()?)?;
    segments.try_fold(first, |value, segment| {
        below(value.as_table_mut()?, segment)
    })
}

/// Splits `branches[2]` into name and index.
pub(crate) fn split_index(segment: &str) -> (&str, Option<usize>) {
    match segment.split_once('[') {
        Some((name, rest)) => (name, rest.trim_end_matches(']').parse().ok()),
        None => (segment, None),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_backslash_in_a_path_is_explained() {
        let table = |file: &str| {
            let text = format!("[indenter.height-map]\nfile = {file}\n");
            let source = Source::new(Path::new("scene.toml"), text.into_bytes());
            source.expect("UTF-8").table()
        };
        for file in [
            r#""maps\tread.csv""#,
            r#""C:\Users\map.csv""#,
            r#""D:\data\map.csv""#,
            r#""a\u0041.csv""#,
        ] {
            let refused = table(file).expect_err(file).to_string();
            let is_explained = refused.starts_with("scene.toml:2: ")
                && refused.contains("single quotes, '…', or with /");
            assert!(is_explained, "{refused}");
        }
        for file in [
            r"'maps\tread.csv'",
            r#""maps/tread.csv""#,
            r#""maps\\tread.csv""#,
            "\"tread.csv\"",
        ] {
            table(file).expect(file);
        }
        let other = table("\"a\nb\"").expect_err("no TOML").to_string();
        assert!(!other.contains("backslash"), "{other}");
    }
}
