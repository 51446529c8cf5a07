//! What was decided for the caller, who is told.

use super::model::Kind;
use super::search::Found;
use super::{FitOptions, Rheology};

/// What a fit or the reader of a file decided.
#[derive(Debug, Clone, PartialEq, Eq, thiserror::Error)]
#[non_exhaustive]
pub enum Note {
    /// The material that was asked for relaxes, which the curve does not show.
    #[error(
        "the curve does not determine how the material relaxes: an elastic one explains it as well, and its modulus, at the \
         rates of this curve, is given"
    )]
    ElasticInstead,
    /// What was guessed about a file.
    #[error("{0}")]
    File(String),
}

/// As its sentence.
#[cfg(feature = "serde")]
impl serde::Serialize for Note {
    fn serialize<S: serde::Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        serializer.collect_str(self)
    }
}

/// What was decided about the material.
pub(super) fn of_material(options: &FitOptions, found: &Found) -> Option<Note> {
    let is_elastic = found.model.kind == Kind::Branches(0);
    (is_elastic && options.rheology != Rheology::Elastic).then_some(Note::ElasticInstead)
}
