//! Conversion of Python dictionaries to tables of a scene.

use pyo3::exceptions::PyValueError;
use pyo3::prelude::*;
use pyo3::types::{PyBool, PyDict, PyList, PyString, PyTuple};
use toml::{Table, Value};
use viscofriction::scene::{Indenter, MaterialTable};

/// A `ValueError` with a message.
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

/// Checks a table `indenter` or `material`: its keys, the types of their values, and the ranges of its numbers.
#[pyfunction]
pub(crate) fn check_table(dictionary: &Bound<'_, PyDict>) -> PyResult<()> {
    let table = table(dictionary, "")?;
    if table.contains_key("indenter") {
        Indenter::try_from(table).and_then(|body| body.check())
    } else {
        MaterialTable::try_from(table).and_then(|material| material.check())
    }
    .map_err(wrong)
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
        let file = file.to_string_lossy().into_owned();
        return Ok(Value::String(file));
    }
    let kind = object.get_type();
    Err(wrong(format!(
        "{path}: a value of the type {kind} has no place in a scene"
    )))
}
