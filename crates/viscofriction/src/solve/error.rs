//! Errors of the solution of a problem.

use bem_halfspace::BemError;
use friction_analytic::FrictionError;
use indenters::IndenterError;
use mdr_core::MdrError;
use numerics::{Estimate, MessageNumber};
use rheology::RheologyError;
use thiserror::Error;

use super::advice::{of_body, of_closed_form, of_half_space, of_line};
use super::answer::Answer;
use super::sensitivity::MAX_DIFFERENCED_ERROR;
use crate::scene::{Method, SceneError};

/// Reason why a problem has no answer, or not the requested one.
#[derive(Debug, Clone, PartialEq, Error)]
#[non_exhaustive]
pub enum SolveError {
    /// An error of the half-space methods.
    #[error("{_0}{}", of_half_space(_0))]
    HalfSpace(BemError),
    /// An error of the one-dimensional model.
    #[error("{_0}{}", of_line(_0))]
    Line(MdrError),
    /// An error of the closed forms or of their quadrature.
    #[error("{_0}{}", of_closed_form(_0))]
    Analytic(FrictionError),
    /// An error of the rigid body.
    #[error("{_0}{}", of_body(_0))]
    Indenter(IndenterError),
    /// An error of the material.
    #[error(transparent)]
    Material(#[from] RheologyError),
    /// A key of the scene is to be changed: the method needs more memory than allowed, or a number has no temperature.
    #[error(transparent)]
    Scene(#[from] SceneError),
    /// The refinement stopped before a grid that needs more memory, or more time steps, than allowed.
    #[error("{reached}; {refused}")]
    MemoryReached {
        /// The error that the refinement had reached.
        reached: Box<Self>,
        /// The refusal of the next grid, with what it needs and what is allowed.
        refused: Box<Self>,
    },
    /// The answer does not meet the request.
    #[error("{why}")]
    NotReached {
        /// The answer so far, with its errors.
        answer: Box<Answer>,
        /// The reason.
        why: Box<Self>,
    },
    /// No method was started.
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
        /// Friction coefficient, or other requested quantity.
        value: f64,
        /// Absolute error of this quantity.
        error: f64,
    },
    /// The sum of hysteresis and shear does not have the requested error.
    #[error(
        "the friction coefficient was not reached to the relative error {}: it is {friction}, of which {shear} from the shear of the \
         contact area; give a larger solve.relative_error{}",
        MessageNumber(*asked),
        hysteresis.as_ref().map_or_else(String::new, |why| format!(" (of the part from hysteresis alone: {why})"))
    )]
    ShearNotReached {
        /// Relative error asked for.
        asked: f64,
        /// Friction coefficient.
        friction: Estimate,
        /// Its part from the shear of the contact area.
        shear: Estimate,
        /// Reason why the part from hysteresis misses the error that the sum needs; `None` if it does not.
        hysteresis: Option<Box<Self>>,
    },
    /// The friction at the temperature of the contact does not have the requested error.
    #[error(
        "the friction coefficient was not reached to the relative error {}: it is {friction} at the temperature of the contact, \
         {temperature} °C, whose error is a part of it; give another solve.relative_error, or solve.elements",
        MessageNumber(*asked)
    )]
    HeatNotReached {
        /// Relative error asked for.
        asked: f64,
        /// Friction coefficient.
        friction: Estimate,
        /// Temperature of material and shear strength, \[°C].
        temperature: Estimate,
    },
    /// The friction at the strain of the contact does not have the requested error.
    #[error(
        "the friction coefficient was not reached to the relative error {}: it is {friction} at the strain amplitude {strain}, whose \
         error is a part of it; give another solve.relative_error, or solve.elements",
        MessageNumber(*asked)
    )]
    StrainNotReached {
        /// Relative error asked for.
        asked: f64,
        /// Friction coefficient.
        friction: Estimate,
        /// Amplitude of the equivalent strain.
        strain: Estimate,
    },
    /// No strain was found at which the contact has the same strain.
    #[error(
        "no strain amplitude of the contact was found that the moduli at this strain cause; it is between {smallest:.3e} and {largest:.3e}"
    )]
    NoContactStrain {
        /// Largest tried strain at which the contact is strained more.
        smallest: f64,
        /// Smallest tried strain at which it is strained less.
        largest: f64,
    },
    /// The contact is heated beyond the highest temperature at which material and shear strength are known.
    #[error(
        "the contact is heated from {} °C beyond {} °C, the highest temperature at which material and shear strength are known{}: there \
         friction would heat it to {caused:.1} °C; slide more slowly, or give laws of a wider range",
        MessageNumber(*ambient),
        MessageNumber(*highest),
        friction_coefficient.map(|friction| format!(", with the friction coefficient {friction:.3}")).unwrap_or_default()
    )]
    TooHot {
        /// Highest temperature of the laws, \[°C].
        highest: f64,
        /// Temperature far from the contact, \[°C].
        ambient: f64,
        /// Temperature to which the contact is heated at the highest temperature of the laws, \[°C].
        caused: f64,
        /// Friction coefficient at the highest temperature of the laws; `None` if it is not known.
        friction_coefficient: Option<f64>,
    },
    /// No temperature was found at which the friction heats the contact to the same temperature.
    #[error(
        "no temperature of the contact was found that its friction causes; it is between {coldest} °C and {hottest} °C"
    )]
    NoContactTemperature {
        /// Highest tried temperature at which friction heats the contact further, \[°C].
        coldest: f64,
        /// Lowest tried temperature at which it heats the contact less, \[°C].
        hottest: f64,
    },
    /// The pressure in the contact, from which heat and strain below it follow, is not known.
    #[error(
        "{} does not give the pressure in the contact, from which heat and strain below it follow; bem-steady does",
        method.name()
    )]
    NoPressureBelow {
        /// The method of the answer.
        method: Method,
    },
    /// The contact area, on which shear acts, is not known.
    #[error(
        "{} has not found the contact area, on which the shear of the interface acts; give more solve.elements, or a smaller \
         solve.relative_error",
        method.name()
    )]
    NoAreaForShear {
        /// The method of the answer.
        method: Method,
    },
    /// The derivatives of the contact area, on which shear acts, are not known.
    #[error(
        "the derivatives of the contact area, on which the shear of the interface acts, are not known under a body with edges; keep \
         the moduli and the shift law of the scene, and let the interface be free alone"
    )]
    NoAreaDerivative,
    /// The mean over the random surfaces does not have the requested standard error.
    #[error(
        "the relative standard error {} of the mean was not reached: it is {:.1e} after {surfaces} surfaces; give a larger \
         standard_error, more realisations, or a larger period",
        MessageNumber(*asked),
        MessageNumber(*reached)
    )]
    TooFewSurfaces {
        /// Relative standard error asked for.
        asked: f64,
        /// Number of sampled surfaces.
        surfaces: usize,
        /// Relative standard error reached; infinite if the mean is 0 or fewer than 10 surfaces are known.
        reached: f64,
    },
    /// The derivatives of this answer are not available.
    #[error(
        "{} knows no derivatives of this answer; stationary sliding has some by bem-steady, and so have slow sliding and \
         whatever closed forms and mdr-steady know to {MAX_DIFFERENCED_ERROR:e}",
        method.name()
    )]
    NoSensitivity {
        /// The method of the answer.
        method: Method,
    },
    /// The derivatives of this answer with respect to the moduli at each frequency are not available.
    #[error(
        "{} knows no derivatives of this answer by the moduli at each frequency; stationary sliding by bem-steady has them",
        method.name()
    )]
    NoSpectralSensitivity {
        /// The method of the answer.
        method: Method,
    },
    /// A quantity over- or underflows f64.
    #[error(
        "{quantity} is {} in units of SI; check the units of indenter, material and load, from which it follows",
        MessageNumber(*value)
    )]
    OutOfRange {
        /// Name of the quantity.
        quantity: String,
        /// Value of the quantity: infinite, not a number, or so small that digits are lost.
        value: f64,
    },
    /// Negative friction, by which the material would return more energy than it receives.
    #[error(
        "the friction coefficient came out as {}, and a material that slides gives no energy back; give more solve.elements, or a \
         smaller solve.relative_error",
        Estimate::new(*value, *error)
    )]
    NegativeFriction {
        /// Friction coefficient.
        value: f64,
        /// Absolute error of the friction coefficient.
        error: f64,
    },
    /// The method that was named does not answer the problem.
    #[error("{} does not answer this scene: {why}", method.name())]
    Refused {
        /// The method.
        method: Method,
        /// Why it does not.
        why: &'static str,
    },
    /// The force at a constant depth has relaxed to zero within rounding, or is not finite.
    #[error(
        "at a depth held for {duration} s the force has relaxed: the relaxation modulus is {modulus:.1e} Pa there; shorten solve.duration, or give load.normal_force"
    )]
    Relaxed {
        /// Time for which the depth is held, \[s].
        duration: f64,
        /// Relaxation modulus at that time, \[Pa].
        modulus: f64,
    },
    /// A time scale of the contact is outside the time range of the Prony series.
    #[error(
        "the contact takes {time:.1e} s, and time_range of the material is from {shortest:e} to {longest:e} s: widen it"
    )]
    OutsideTimeRange {
        /// Offending time, \[s]: per contact length, of the indentation or sliding, or between points of a history.
        time: f64,
        /// Shortest time of the range, \[s].
        shortest: f64,
        /// Longest time of the range, \[s].
        longest: f64,
    },
    /// Long waves under a line contact reach times beyond the range of the Prony series.
    #[error(
        "a part of up to {part:.2} of the friction of this line contact comes from times longer than time_range of the material, \
         {longest:e} s, and the relative error asked for is {asked:e}: widen time_range"
    )]
    BeyondTimeRange {
        /// Upper bound of that fraction of the friction.
        part: f64,
        /// Relative error asked for.
        asked: f64,
        /// Longest time of the range, \[s].
        longest: f64,
    },
    /// The search for the contact front found none that carries the force.
    #[error("no front of the contact was found that carries the normal force {}", MessageNumber(*normal_force))]
    FrontNotFound {
        /// Normal force, \[N].
        normal_force: f64,
    },
}

impl SolveError {
    /// The answer so far, if it does not meet the request; `None` for all other errors.
    pub fn reached(&self) -> Option<&Answer> {
        match self {
            Self::NotReached { answer, .. } => Some(answer),
            _ => None,
        }
    }

    /// True if the input itself is invalid, so that no computation can answer it: a number out of range, a material without
    /// equilibrium, a track that is too short.
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
            Self::Refused { .. } | Self::Scene(_) => true,
            _ => false,
        }
    }
}

/// True if the error says that the body itself is invalid, and not that a computation with it failed.
const fn is_wrong_body(error: &IndenterError) -> bool {
    matches!(
        error,
        IndenterError::InvalidParameter(_)
            | IndenterError::InvalidHeight { .. }
            | IndenterError::LowestPointNotZero { .. }
            | IndenterError::LengthMismatch { .. }
            | IndenterError::NotIncreasing { .. }
            | IndenterError::TooFew { .. }
    )
}

// The attribute `from` would also make each cause a `source`, and its message would be printed twice.
macro_rules! causes {
    ($($cause:ty => $variant:ident,)*) => {
        $(impl From<$cause> for SolveError {
            /// Wraps an error of a library, whose message becomes that of the variant.
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

/// An answer, or the reason why there is none.
pub type Result<T, E = SolveError> = std::result::Result<T, E>;

/// Reason why a method does not answer a problem.
pub(crate) type Refusal = &'static str;

/// Reason why no method was started.
#[derive(Debug, Clone, PartialEq, Error)]
#[non_exhaustive]
pub enum NotOffered {
    /// The method named by the scene does not answer it.
    #[error("{} does not answer this scene: {why}; {}", method.name(), others(offered))]
    Method {
        /// The method.
        method: Method,
        /// The reason.
        why: Refusal,
        /// Methods that answer the scene.
        offered: Vec<Method>,
    },
    /// No method answers the scene.
    #[error("no method answers this scene yet: {}", reasons(refusals))]
    AnyMethod {
        /// Each method with its reason.
        refusals: Vec<(Method, Refusal)>,
    },
}

/// Names of the methods that answer the scene, as advice in a message.
fn others(offered: &[Method]) -> String {
    if offered.is_empty() {
        return "no other method does either".to_owned();
    }
    let names: Vec<&str> = offered.iter().map(|method| method.name()).collect();
    format!("these do: {}", names.join(", "))
}

/// Lists the reasons, each with the methods that share it.
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
