//! Conversion of Python dictionaries to tables of a scene.

use std::path::Path;

use pyo3::exceptions::PyValueError;
use pyo3::prelude::*;
use pyo3::types::{PyBool, PyDict, PyList, PyString, PyTuple};
use toml::{Table, Value};
use viscofriction::Files;
use viscofriction::scene::{Heat, Indenter, Interface, MaterialTable, SceneError, Strain};
use viscofriction::solve::{body, half_space};

use crate::reading::read_file;

/// Exception `ValueError` with a message.
pub(crate) fn wrong(problem: impl std::fmt::Display) -> PyErr {
    PyValueError::new_err(problem.to_string())
}

/// Converts a dictionary to a table; `path` names it in errors.
pub(crate) fn table(dictionary: &Bound<'_, PyDict>, path: &str) -> PyResult<Table> {
    let mut table = Table::new();
    for (key, value) in dictionary {
        let key: String = key
            .extract()
            .map_err(|_| wrong(format!("{path}: keys must be texts, but one is {key}")))?;
        let inner = if path.is_empty() {
            key.clone()
        } else {
            format!("{path}.{key}")
        };
        // None stands for an absent key.
        if !value.is_none() {
            table.insert(key, self::value(&value, &inner)?);
        }
    }
    Ok(table)
}

/// Checks a table `indenter`, `material`, `interface`, `heat` or `strain`: its keys, the types of their values, and the ranges of its numbers. Bodies and
/// materials that need no file and no random surface are also built, which checks their numbers against one another.
#[pyfunction]
pub(crate) fn check_table(dictionary: &Bound<'_, PyDict>) -> PyResult<()> {
    let table = table(dictionary, "")?;
    if table.contains_key("indenter") {
        Indenter::try_from(table).and_then(|body| check_body(&body))
    } else if table.contains_key("interface") {
        // The file of a table is read with the first answer.
        Interface::try_from(table).and_then(|interface| interface.check())
    } else if table.contains_key("heat") {
        Heat::try_from(table).and_then(|heat| heat.check())
    } else if table.contains_key("strain") {
        // The file of a table is read with the first answer.
        Strain::try_from(table).and_then(|strain| strain.check())
    } else {
        MaterialTable::try_from(table).and_then(|material| check_material(&material))
    }
    .map_err(wrong)
}

/// Text of a file with these tables.
#[pyfunction]
pub(crate) fn toml_text(dictionary: &Bound<'_, PyDict>) -> PyResult<String> {
    Ok(table(dictionary, "")?.to_string())
}

/// Files of the current folder, for objects that are built without any.
fn no_files() -> Files<'static> {
    Files {
        folder: Path::new(""),
        read: read_file,
        memory: None,
    }
}

/// Checks a body; files and random surfaces are built with their first answer.
fn check_body(indenter: &Indenter) -> Result<(), SceneError> {
    match indenter {
        Indenter::Table { .. }
        | Indenter::HeightMap(_)
        | Indenter::SelfAffine(_)
        | Indenter::Spectrum(_) => {
            indenter.check()?;
            indenter.realisations().map(drop)
        }
        _ => body(indenter, &no_files()).map(drop),
    }
}

/// Checks a material; a file is read with its first answer.
fn check_material(material: &MaterialTable) -> Result<(), SceneError> {
    material.check()?;
    match material {
        MaterialTable::File { .. } => Ok(()),
        _ => half_space(material, &no_files()).map(drop),
    }
}

/// Converts an object to a value of a scene.
fn value(object: &Bound<'_, PyAny>, path: &str) -> PyResult<Value> {
    if let Ok(dictionary) = object.cast::<PyDict>() {
        return Ok(Value::Table(table(dictionary, path)?));
    }
    if object.is_instance_of::<PyList>() || object.is_instance_of::<PyTuple>() {
        let elements = object.try_iter()?.enumerate();
        let element = |(index, element): (usize, PyResult<Bound<'_, PyAny>>)| {
            value(&element?, &format!("{path}[{index}]"))
        };
        let elements: PyResult<_> = elements.map(element).collect();
        return elements.map(Value::Array);
    }
    if object.is_instance_of::<PyString>() {
        return Ok(Value::String(object.extract()?));
    }
    if object.is_instance_of::<PyBool>() {
        return Ok(Value::Boolean(object.extract()?));
    }
    if let Ok(integer) = object.extract::<i64>() {
        return Ok(Value::Integer(integer));
    }
    // Includes NumPy scalars.
    if let Ok(number) = object.extract::<f64>() {
        return Ok(Value::Float(number));
    }
    // Includes file paths.
    if let Ok(file) = object.extract::<std::path::PathBuf>() {
        return Ok(Value::String(file.to_string_lossy().into_owned()));
    }
    let kind = object.get_type();
    Err(wrong(format!(
        "{path}: a value of the type {kind} has no place in a scene"
    )))
}
