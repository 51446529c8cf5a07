//! Errors of a scene, each with its key.

use indenters::IndenterError;
use numerics::{InvalidParameter, MessageNumber};
use thiserror::Error;

/// Reason why a scene is rejected; the key is a path such as `material.prony.branches[2].modulus`.
#[derive(Debug, Clone, PartialEq, Error)]
#[non_exhaustive]
pub enum SceneError {
    /// A number is out of range.
    #[error("{key} must be {allowed}, but is {}", MessageNumber(*value))]
    Value {
        /// Path of the number.
        key: String,
        /// The rejected value.
        value: f64,
        /// The allowed range.
        allowed: &'static str,
    },
    /// Another error at a key, alone or together with others: an unknown or missing key, a text instead of a number, contradictory
    /// numbers.
    #[error("{key}: {problem}")]
    At {
        /// Path of the key, or of the key to change.
        key: String,
        /// What is wrong.
        problem: String,
    },
    /// The text is not valid TOML.
    #[error("{problem}")]
    Syntax {
        /// Line, counted from 1.
        line: usize,
        /// What is wrong.
        problem: String,
    },
}

impl SceneError {
    /// An error at a key, or at several, of which `key` is the one to change.
    pub fn at(key: impl Into<String>, problem: impl Into<String>) -> Self {
        Self::At {
            key: key.into(),
            problem: problem.into(),
        }
    }

    /// Rejects the first of these keys that has a value, with `problem` as message.
    pub(crate) fn none_given(keys: &[(&str, Option<f64>)], problem: &str) -> Result<(), Self> {
        let given = keys.iter().find(|(_, value)| value.is_some());
        given.map_or(Ok(()), |(key, _)| Err(Self::at(*key, problem)))
    }

    /// Error for a number out of range whose name is the last part of its path; `table` is the path of its table.
    pub(crate) fn within(table: &str, refused: InvalidParameter) -> Self {
        Self::value(format!("{table}.{}", refused.parameter), refused)
    }

    /// The same error at another `key`.
    pub(crate) fn moved_to(self, key: &str) -> Self {
        match self {
            Self::At { problem, .. } => Self::at(key, problem),
            other => Self::at(key, other.to_string()),
        }
    }

    /// The same error, which also says that `option` may be left out.
    pub(crate) fn or_without(self, option: &str) -> Self {
        match self {
            Self::At { key, problem } => Self::at(key, format!("{problem}, or leave {option} out")),
            other => other,
        }
    }

    /// Error for a body that cannot be built from the table at the path `table`, at the number that the error names.
    pub(crate) fn of_body(table: &str, error: IndenterError) -> Self {
        match error {
            IndenterError::InvalidParameter(refused) => Self::within(table, refused),
            other => Self::at(table, other.to_string()),
        }
    }

    /// Error for a number out of range at the path `key`.
    pub(crate) const fn value(key: String, refused: InvalidParameter) -> Self {
        let InvalidParameter { value, allowed, .. } = refused;
        Self::Value {
            key,
            value,
            allowed,
        }
    }
}

/// Converts the error of a parameter whose name is the whole key.
impl From<InvalidParameter> for SceneError {
    fn from(refused: InvalidParameter) -> Self {
        Self::value(refused.parameter.to_owned(), refused)
    }
}
