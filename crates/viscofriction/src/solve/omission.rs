//! What a scene does not need, decided here and nowhere else.

use indenters::Surface;
use rheology::CreepSpectrum;
use serde::Serialize;

use super::answer::{Answer, Grid};
use super::body::Body;
use super::offer::answers;
use super::problem::{Motion, Problem};
use crate::scene::{Control, Method, Model};

/// A part of the work that was left out.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize)]
#[serde(rename_all = "kebab-case")]
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
    /// Rows of elements that the body has left for ever.
    RowsBehind,
    /// Fields that remember a history, where the result does not depend on it.
    HistoryFields,
    /// Slopes of the surface, where nothing slides.
    Gradients,
    /// Files, where none are asked for.
    Files,
}

impl Omission {
    /// The name in JSON with spaces for hyphens.
    #[must_use]
    pub const fn name(self) -> &'static str {
        match self {
            Self::NumericalSolution => "numerical solution",
            Self::TimeSteps => "time steps",
            Self::HalfSpace => "half space",
            Self::MirrorHalf => "mirror half",
            Self::OutsideContact => "outside contact",
            Self::Transforms => "transforms",
            Self::RowsBehind => "rows behind",
            Self::HistoryFields => "history fields",
            Self::Gradients => "gradients",
            Self::Files => "files",
        }
    }

    /// Why it was not needed.
    #[must_use]
    pub const fn because(self) -> &'static str {
        match self {
            Self::NumericalSolution => "there is a closed form or a quadrature",
            Self::TimeSteps => "only the state at the end is asked for",
            Self::HalfSpace => "without sliding the line has the same depth",
            Self::MirrorHalf => "body and motion are mirror symmetric",
            Self::OutsideContact => "pressure is in the contact only",
            Self::Transforms => "the contact is small enough to be factorised",
            Self::RowsBehind => "what the footprint has left does not come back",
            Self::HistoryFields => "a dashpot under the same impulse has the same depth",
            Self::Gradients => "nothing slides, so that no slope enters",
            Self::Files => "there is no --out",
        }
    }

    /// The method that does the work of an omission too, where another method does.
    #[must_use]
    pub const fn done_by(self, answer: &Answer, motion: Motion) -> Option<Method> {
        match (self, answer.model, motion) {
            (Self::NumericalSolution, Model::Line, Motion::Sliding(_)) => Some(Method::MdrSteady),
            (Self::NumericalSolution, Model::HalfSpace, Motion::Sliding(_)) => {
                Some(Method::BemSteady)
            }
            (Self::NumericalSolution, _, Motion::Pressing(_))
            | (Self::TimeSteps, Model::Line, _) => Some(Method::MdrTransient),
            (Self::TimeSteps, Model::HalfSpace, Motion::Sliding(_)) | (Self::HalfSpace, _, _) => {
                Some(Method::BemTransient)
            }
            _ => None,
        }
    }
}

/// What the method of the answer left out; what only another method would do counts where that answers the scene too.
pub(crate) fn plan(problem: &Problem, answer: &Answer) -> Vec<Omission> {
    let mut left_out = candidates(problem, answer);
    left_out.retain(|omission| {
        let other = omission.done_by(answer, problem.motion);
        other.is_none_or(|method| answers(method, problem))
    });
    left_out
}

fn candidates(problem: &Problem, answer: &Answer) -> Vec<Omission> {
    if matches!(problem.body, Body::Cylinder(_)) {
        // No other method answers for it, and one element along y leaves nothing to leave out.
        return Vec::new();
    }
    match (answer.method, problem.motion) {
        (Method::Analytic, Motion::Sliding(_)) => {
            vec![Omission::NumericalSolution, Omission::TimeSteps]
        }
        (Method::Analytic, Motion::Pressing(_)) => {
            vec![Omission::NumericalSolution, Omission::HalfSpace]
        }
        (Method::MdrSteady, _) => vec![Omission::TimeSteps],
        (Method::MdrTransient, Motion::Pressing(_)) => vec![Omission::HalfSpace],
        (Method::MdrTransient, Motion::Sliding(_)) => Vec::new(),
        (Method::BemSteady, Motion::Sliding(load)) => {
            let mut left_out = Vec::new();
            left_out.extend(mirrors(&problem.body)[1].then_some(Omission::MirrorHalf));
            left_out.push(outside_or_transforms(answer));
            // After a distance the friction is not yet that of the stationary state.
            left_out.extend(
                load.sliding_distance()
                    .is_none()
                    .then_some(Omission::TimeSteps),
            );
            left_out
        }
        (Method::BemSteady, Motion::Pressing(_)) => Vec::new(),
        (Method::BemTransient, Motion::Sliding(_)) => {
            let mut left_out = Vec::new();
            left_out.extend(mirrors(&problem.body)[1].then_some(Omission::MirrorHalf));
            left_out.extend([Omission::OutsideContact, Omission::RowsBehind]);
            left_out
        }
        (Method::BemTransient, Motion::Pressing(_)) => {
            let mut left_out = vec![Omission::TimeSteps];
            let is_even = mirrors(&problem.body) != [false; 2];
            left_out.extend(is_even.then_some(Omission::MirrorHalf));
            left_out.push(Omission::Gradients);
            // A depth that is held needs another force at every time.
            let constant = matches!(problem.motion.control(), Control::NormalForce(_));
            let remembers = n_fields(&problem.material.creep()) > 1;
            left_out.extend((constant && remembers).then_some(Omission::HistoryFields));
            left_out
        }
    }
}

/// Whether a body is its own mirror image along x and y.
fn mirrors(body: &Body) -> [bool; 2] {
    match body {
        Body::Revolution(body) => body.mirrors(),
        Body::Cylinder(cylinder) => cylinder.mirrors(),
        Body::HeightMap(map) => map.mirrors(),
    }
}

/// A box is transformed unless its contact is factorised.
fn outside_or_transforms(answer: &Answer) -> Omission {
    match answer.grid {
        Some(Grid::Stationary {
            factorised: true, ..
        }) => Omission::Transforms,
        _ => Omission::OutsideContact,
    }
}

/// Values that an element of the half space remembers; the dashpot in its place remembers one.
fn n_fields(creep: &CreepSpectrum) -> usize {
    creep.elements().len() + usize::from(creep.fluidity() > 0.0)
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Programs read these names.
    const NAMES: [(Omission, &str); 10] = [
        (Omission::NumericalSolution, "numerical-solution"),
        (Omission::TimeSteps, "time-steps"),
        (Omission::HalfSpace, "half-space"),
        (Omission::MirrorHalf, "mirror-half"),
        (Omission::OutsideContact, "outside-contact"),
        (Omission::Transforms, "transforms"),
        (Omission::RowsBehind, "rows-behind"),
        (Omission::HistoryFields, "history-fields"),
        (Omission::Gradients, "gradients"),
        (Omission::Files, "files"),
    ];

    #[test]
    fn json_and_the_table_name_what_is_left_out_alike() {
        for (omission, expected) in NAMES {
            let json = serde_json::to_value(omission).expect("a name");
            assert_eq!(json, expected, "{omission:?} in JSON");
            let in_table = omission.name().replace(' ', "-");
            assert_eq!(in_table, expected, "{omission:?} in the table");
        }
    }
}
