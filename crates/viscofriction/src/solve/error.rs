//! Why a problem has no answer.

use bem_halfspace::BemError;
use friction_analytic::FrictionError;
use indenters::IndenterError;
use mdr_core::MdrError;
use numerics::{Estimate, MessageNumber};
use rheology::RheologyError;
use thiserror::Error;

use super::advice::{of_body, of_closed_form, of_half_space, of_line};
use super::answer::Answer;
use super::sensitivity::EXACT;
use crate::scene::{Method, SceneError};

/// Why a problem that is well posed has no answer.
#[derive(Debug, Clone, PartialEq, Error)]
#[non_exhaustive]
pub enum SolveError {
    /// Of the half space.
    #[error("{_0}{}", of_half_space(_0))]
    HalfSpace(BemError),
    /// Of the one-dimensional model.
    #[error("{_0}{}", of_line(_0))]
    Line(MdrError),
    /// Of closed forms and quadrature.
    #[error("{_0}{}", of_closed_form(_0))]
    Analytic(FrictionError),
    /// Of the rigid body.
    #[error("{_0}{}", of_body(_0))]
    Indenter(IndenterError),
    /// Of the material.
    #[error(transparent)]
    Material(#[from] RheologyError),
    /// The method needs more memory than the scene or the caller allows.
    #[error(transparent)]
    TooMuchMemory(#[from] SceneError),
    /// A refinement ended before a grid that needs more memory, or more steps in time, than allowed.
    #[error("{reached}; {refused}")]
    MemoryReached {
        /// What was reached.
        reached: Box<Self>,
        /// What is needed, and what is allowed.
        refused: Box<Self>,
    },
    /// What was found is not what was asked.
    #[error("{why}")]
    NotReached {
        /// All that was found, with its bars.
        answer: Box<Answer>,
        /// What is missing.
        why: Box<Self>,
    },
    /// No method was asked.
    #[error(transparent)]
    NotOffered(#[from] NotOffered),
    /// The error of the series that stands for the material is too large for the error asked for.
    #[error(
        "the friction coefficient was not reached to the relative error {}, because the series of the material is off by \
         {series:.1e}: it is {}; give a larger solve.relative_error, or a material with a smaller relative_error",
        MessageNumber(*asked),
        Estimate::new(*value, *error)
    )]
    SeriesTooCoarse {
        /// Relative error asked for.
        asked: f64,
        /// Relative error of the series.
        series: f64,
        /// Value that was found.
        value: f64,
        /// Its absolute error.
        error: f64,
    },
    /// The mean of all surfaces that may be drawn is not known as well as asked for.
    #[error(
        "the relative standard error {} of the mean was not reached: it is {:.1e} after {surfaces} surfaces; give a larger \
         standard_error, more realisations, or a larger period",
        MessageNumber(*asked),
        MessageNumber(*reached)
    )]
    TooFewSurfaces {
        /// Relative standard error asked for.
        asked: f64,
        /// How many were drawn.
        surfaces: usize,
        /// Relative standard error that was reached; infinite where the mean is 0.
        reached: f64,
    },
    /// An answer whose derivatives are not known.
    #[error(
        "{} knows no derivatives of this answer; stationary sliding has some by bem-steady, and so have slow sliding and \
         whatever closed forms and mdr-steady know to {EXACT:e}",
        method.name()
    )]
    NoSensitivity {
        /// The method of the answer.
        method: Method,
    },
    /// An answer whose derivatives by the moduli at each frequency are not known.
    #[error(
        "{} knows no derivatives of this answer by the moduli at each frequency; stationary sliding by bem-steady has them",
        method.name()
    )]
    NoSpectralSensitivity {
        /// The method of the answer.
        method: Method,
    },
    /// A quantity that no number can hold.
    #[error(
        "{quantity} is {} in units of SI; check the units of indenter, material and load, from which it follows",
        MessageNumber(*value)
    )]
    OutOfRange {
        /// Its name.
        quantity: String,
        /// Infinite, not a number, or so close to 0 that digits are missing.
        value: f64,
    },
    /// A friction by which the material would give back more energy than it takes.
    #[error(
        "the friction coefficient came out as {}, and a material that slides gives no energy back; give more solve.elements, or a \
         smaller solve.relative_error",
        Estimate::new(*value, *error)
    )]
    NegativeFriction {
        /// Its value.
        value: f64,
        /// Its error.
        error: f64,
    },
    /// A method that does not answer the problem was asked by its name.
    #[error("{} does not answer this scene: {why}", method.name())]
    Refused {
        /// The method.
        method: Method,
        /// Why it does not.
        why: &'static str,
    },
    /// At a depth that is held so long the force has relaxed.
    #[error(
        "at a depth held for {duration} s the force has relaxed: the relaxation modulus is {modulus:.1e} Pa there; shorten solve.duration, or give load.normal_force"
    )]
    Relaxed {
        /// Time, \[s].
        duration: f64,
        /// Relaxation modulus at that time, \[Pa].
        modulus: f64,
    },
    /// What happens is faster or slower than a series stands for its law.
    #[error(
        "the contact takes {time:.1e} s, and time_range of the material is from {shortest:e} to {longest:e} s: widen it"
    )]
    OutsideTimeRange {
        /// Time of a contact length, of the pressing, of the sliding, or between points of a history, \[s].
        time: f64,
        /// Shortest time of the range, \[s].
        shortest: f64,
        /// Longest time of the range, \[s].
        longest: f64,
    },
    /// Long waves under a line contact strain a material for longer than its series stands for it.
    #[error(
        "a part of up to {part:.2} of the friction of this line contact comes from times longer than time_range of the material, \
         {longest:e} s, and the relative error asked for is {asked:e}: widen time_range"
    )]
    BeyondTimeRange {
        /// The part, relative to the friction.
        part: f64,
        /// Relative error asked for.
        asked: f64,
        /// Longest time of the range, \[s].
        longest: f64,
    },
    /// No front of the contact carries the force.
    #[error("no front of the contact was found that carries the normal force {}", MessageNumber(*normal_force))]
    FrontNotFound {
        /// The force, \[N].
        normal_force: f64,
    },
}

impl SolveError {
    /// What was found where that is not what was asked, as an answer.
    pub fn reached(&self) -> Option<&Answer> {
        match self {
            Self::NotReached { answer, .. } => Some(answer),
            _ => None,
        }
    }

    /// Whether the scene asks for what has no meaning, so that no computation leads to an answer: a number out of range, a material
    /// that never comes to rest, a track that is too short.
    pub fn is_wrong_input(&self) -> bool {
        match self {
            Self::HalfSpace(error) => match error {
                BemError::InvalidParameter(_)
                | BemError::InvalidHeight { .. }
                | BemError::DepthFromRest
                | BemError::FlowsUnderWaves
                | BemError::NoCycle
                | BemError::NoEquilibrium
                | BemError::SlidingDistanceMissing { .. }
                | BemError::TrackTooShort { .. } => true,
                BemError::Indenter(error) => is_wrong_body(error),
                _ => false,
            },
            Self::Line(error) => match error {
                MdrError::InvalidParameter(_)
                | MdrError::NoCycle
                | MdrError::NoEquilibrium
                | MdrError::TrackTooShort { .. } => true,
                MdrError::Indenter(error) => is_wrong_body(error),
                _ => false,
            },
            Self::Analytic(FrictionError::InvalidParameter(_)) | Self::NotOffered(_) => true,
            Self::Analytic(FrictionError::Indenter(error)) | Self::Indenter(error) => {
                is_wrong_body(error)
            }
            Self::Refused { .. } => true,
            _ => false,
        }
    }
}

const fn is_wrong_body(error: &IndenterError) -> bool {
    matches!(
        error,
        IndenterError::InvalidParameter(_)
            | IndenterError::LengthMismatch { .. }
            | IndenterError::NotIncreasing { .. }
            | IndenterError::TooFew { .. }
    )
}

// Not by the attribute `from`, which would say the cause a second time.
macro_rules! causes {
    ($($cause:ty => $variant:ident,)*) => {
        $(impl From<$cause> for SolveError {
            fn from(error: $cause) -> Self {
                Self::$variant(error)
            }
        })*
    };
}
causes! {
    BemError => HalfSpace,
    MdrError => Line,
    FrictionError => Analytic,
    IndenterError => Indenter,
}

/// An answer or why there is none.
pub type Result<T, E = SolveError> = std::result::Result<T, E>;

/// Why a method does not answer.
pub(crate) type Refusal = &'static str;

/// Why no method is asked.
#[derive(Debug, Clone, PartialEq, Error)]
#[non_exhaustive]
pub enum NotOffered {
    /// The method that the scene names does not answer it.
    #[error("{} does not answer this scene: {why}; {}", method.name(), others(offered))]
    Method {
        /// The method.
        method: Method,
        /// Why it does not.
        why: Refusal,
        /// Methods that do.
        offered: Vec<Method>,
    },
    /// No method does.
    #[error("no method answers this scene yet: {}", reasons(refusals))]
    AnyMethod {
        /// Why each of them does not.
        refusals: Vec<(Method, Refusal)>,
    },
}

fn others(offered: &[Method]) -> String {
    if offered.is_empty() {
        return "no other method does either".to_owned();
    }
    let names: Vec<&str> = offered.iter().map(|method| method.name()).collect();
    format!("these do: {}", names.join(", "))
}

fn reasons(refusals: &[(Method, Refusal)]) -> String {
    let mut methods: Vec<(Refusal, Vec<&str>)> = Vec::new();
    for (method, why) in refusals {
        match methods.iter_mut().find(|(known, _)| known == why) {
            Some((_, names)) => names.push(method.name()),
            None => methods.push((why, vec![method.name()])),
        }
    }
    let reason = |(why, names): &(Refusal, Vec<&str>)| format!("{}: {why}", names.join(", "));
    methods.iter().map(reason).collect::<Vec<_>>().join("; ")
}
