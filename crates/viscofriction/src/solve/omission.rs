//! Parts of the work that a scene may not need.

use serde::Serialize;
use strum::IntoStaticStr;

/// A part of the work that was left out.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, IntoStaticStr)]
#[serde(into = "&'static str")]
#[strum(serialize_all = "kebab-case")]
#[non_exhaustive]
pub enum Omission {
    /// Elements, where there is a closed form.
    NumericalSolution,
    /// Steps in time, where only the state at the end is asked for.
    TimeSteps,
    /// Elements of the half space, where the one-dimensional model has the same depth.
    HalfSpace,
    /// One side of a plane of symmetry.
    MirrorHalf,
    /// Elements that do not touch.
    OutsideContact,
    /// Fourier transforms, where the contact is small.
    Transforms,
    /// Rows of elements that the body has left and does not meet again.
    RowsBehind,
    /// Fields that remember a history, where the result does not depend on it.
    HistoryFields,
    /// Slopes of the surface, where nothing slides.
    Gradients,
    /// Files, where none are asked for.
    Files,
}

impl Omission {
    /// The name of JSON with spaces for hyphens.
    pub fn name(self) -> String {
        let name: &str = self.into();
        name.replace('-', " ")
    }

    /// Why it was not needed.
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
