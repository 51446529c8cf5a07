//! Computations that a scene may not need.

use serde::Serialize;
use strum::IntoStaticStr;

/// A computation that was skipped.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, IntoStaticStr)]
#[serde(into = "&'static str")]
#[strum(serialize_all = "kebab-case")]
#[non_exhaustive]
pub enum Omission {
    /// No elements, because there is a closed form.
    NumericalSolution,
    /// No time steps, because only the final state is requested.
    TimeSteps,
    /// No elements of the half space, because the one-dimensional model has the same depth.
    HalfSpace,
    /// Only one side of a plane of symmetry.
    MirrorHalf,
    /// No elements outside the contact.
    OutsideContact,
    /// No Fourier transforms, because the contact is small enough to be factorised.
    Transforms,
    /// No rows of elements behind the body, which it does not meet again.
    RowsBehind,
    /// No history variables, because the result does not depend on the history.
    HistoryFields,
    /// No surface slopes, because nothing slides.
    Gradients,
    /// No files, because none are requested.
    Files,
}

impl Omission {
    /// Name of the omission in words: that in JSON with spaces for hyphens.
    pub fn name(self) -> String {
        let name: &str = self.into();
        name.replace('-', " ")
    }

    /// Reason why the work was not needed, as a clause after "because".
    pub const fn because(self) -> &'static str {
        match self {
            Self::NumericalSolution => "there is a closed form or a quadrature",
            Self::TimeSteps => "only the state at the end is asked for",
            Self::HalfSpace => "without sliding the line has the same depth",
            Self::MirrorHalf => "body and motion are mirror symmetric",
            Self::OutsideContact => "pressure is in the contact only",
            Self::Transforms => "the contact is small enough to be factorised",
            Self::RowsBehind => "what the footprint has left does not come back",
            Self::HistoryFields => "a spring of the same compliance has the same depth",
            Self::Gradients => "nothing slides, so that no slope enters",
            Self::Files => "there is no --out",
        }
    }
}
