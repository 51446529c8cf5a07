//! What can be wrong with a scene, with the key it is wrong at.

use numerics::{InvalidParameter, MessageNumber};
use thiserror::Error;

/// Why a scene is refused; the key is a path such as `material.prony.branches[2].modulus`.
#[derive(Debug, Clone, PartialEq, Error)]
#[non_exhaustive]
pub enum SceneError {
    /// A number is outside the range it may take.
    #[error("{key} must be {allowed}, but is {}", MessageNumber(*value))]
    Value {
        /// Where.
        key: String,
        /// The refused value.
        value: f64,
        /// The values it may take.
        allowed: &'static str,
    },
    /// Something else is wrong at a key, alone or together with others: an unknown key, a missing one, a text instead of a
    /// number, numbers that contradict each other.
    #[error("{key}: {problem}")]
    At {
        /// The key, or the one that is best changed.
        key: String,
        /// What is wrong.
        problem: String,
    },
    /// No TOML.
    #[error("{problem}")]
    Syntax {
        /// Counted from 1.
        line: usize,
        /// What is wrong.
        problem: String,
    },
}

impl SceneError {
    /// Something is wrong at a key, or at several, of which this one is best changed.
    pub fn at(key: impl Into<String>, problem: impl Into<String>) -> Self {
        Self::At {
            key: key.into(),
            problem: problem.into(),
        }
    }

    /// Refuses the first key of these that is given.
    pub(crate) fn none_given(keys: &[(&str, Option<f64>)], problem: &str) -> Result<(), Self> {
        let given = keys.iter().find(|(_, value)| value.is_some());
        given.map_or(Ok(()), |(key, _)| Err(Self::at(*key, problem)))
    }

    pub(crate) fn within(table: &str, refused: InvalidParameter) -> Self {
        Self::value(format!("{table}.{}", refused.parameter), refused)
    }

    /// The number at a key is refused.
    pub(crate) const fn value(key: String, refused: InvalidParameter) -> Self {
        let InvalidParameter { value, allowed, .. } = refused;
        Self::Value {
            key,
            value,
            allowed,
        }
    }
}

/// A parameter whose name is the whole key.
impl From<InvalidParameter> for SceneError {
    fn from(refused: InvalidParameter) -> Self {
        Self::value(refused.parameter.to_owned(), refused)
    }
}
