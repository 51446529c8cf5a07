//! Notes on decisions of a fit or of a reader.

use super::model::Kind;
use super::search::Found;
use super::{FitOptions, Rheology};

/// Decision of a fit or of the reader of a file.
#[derive(Debug, Clone, PartialEq, Eq, thiserror::Error)]
#[non_exhaustive]
pub enum Note {
    /// The curve does not determine the relaxation that was asked for.
    #[error(
        "the curve does not determine how the material relaxes: an elastic one explains it as well, and its modulus, at the \
         rates of this curve, is given"
    )]
    ElasticInstead,
    /// Assumption about a file.
    #[error("{0}")]
    File(String),
}

/// Serialised as its message.
#[cfg(feature = "serde")]
impl serde::Serialize for Note {
    fn serialize<S: serde::Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        serializer.collect_str(self)
    }
}

/// Note on the fitted material; `None` if it is of the kind that was asked for.
pub(super) fn of_material(options: &FitOptions, found: &Found) -> Option<Note> {
    let is_elastic = found.model.kind == Kind::Branches(0);
    (is_elastic && options.rheology != Rheology::Elastic).then_some(Note::ElasticInstead)
}
