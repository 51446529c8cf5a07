//! `[solve]`: method, accuracy and resources.

use numerics::{Accuracy, in_range, positive};
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};
use strum::{EnumIter, IntoStaticStr};

use super::SceneError;

/// What is asked, and how well.
#[derive(Debug, Clone, PartialEq, Default, Deserialize, Serialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct Solve {
    /// How the answer is computed; without it by the cheapest method of the model that answers the scene.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub method: Option<Method>,
    /// What the elastomer is; without it the half space, or the one-dimensional model of the method.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub model: Option<Model>,
    /// Relative error of the friction coefficient, or of the depth where nothing slides, above 0 and at most 0.1; without it 1e-3, with heat or strain 1e-2.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub relative_error: Option<f64>,
    /// Number of elements along the contact, or along the longer edge of a period in elements, from 8 to 100000, instead of a
    /// relative error.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub elements: Option<usize>,
    /// Time > 0 from first touch to the requested state, \[s]; without it the stationary state.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub duration: Option<f64>,
    /// Distance > 0 from first touch to the requested state, \[m]; without it the stationary state.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub sliding_distance: Option<f64>,
    /// Number of threads, from 1 to 1024; without it all that the machine has.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub threads: Option<usize>,
    /// Memory that one solution may take, such as "8 GiB"; without it half of what the machine has free.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub max_memory: Option<String>,
}

/// How the answer is computed.
#[derive(
    Debug,
    Clone,
    Copy,
    Default,
    PartialEq,
    Eq,
    Deserialize,
    Serialize,
    JsonSchema,
    IntoStaticStr,
    EnumIter,
)]
#[cfg_attr(feature = "clap", derive(clap::ValueEnum))]
#[serde(rename_all = "kebab-case")]
#[strum(serialize_all = "kebab-case")]
pub enum Method {
    /// Closed forms, quadrature, and the table of s(p) on the half space.
    #[default]
    Analytic,
    /// Stationary sliding on the one-dimensional model.
    MdrSteady,
    /// The one-dimensional model from first touch on.
    MdrTransient,
    /// Stationary sliding on the half space.
    BemSteady,
    /// The half space from first touch on.
    BemTransient,
}

/// What the elastomer is.
#[derive(
    Debug, Clone, Copy, Default, PartialEq, Eq, Deserialize, Serialize, JsonSchema, IntoStaticStr,
)]
#[serde(rename_all = "kebab-case")]
#[strum(serialize_all = "kebab-case")]
pub enum Model {
    /// The one-dimensional model of the method of dimensionality reduction.
    Line,
    /// The half space.
    #[default]
    HalfSpace,
}

impl Model {
    /// Name of the model in a scene file.
    pub fn name(self) -> &'static str {
        self.into()
    }
}

/// Units of memory with their size, \[bytes].
const MEMORY_UNITS: [(&str, f64); 9] = [
    ("B", 1.0),
    ("kB", 1e3),
    ("MB", 1e6),
    ("GB", 1e9),
    ("TB", 1e12),
    ("KiB", 1024.0),
    ("MiB", 1_048_576.0),
    ("GiB", 1_073_741_824.0),
    ("TiB", 1_099_511_627_776.0),
];
/// Largest memory limit that a scene may give, \[bytes]: whole numbers are exact in f64 up to 2⁵³.
const MAX_BYTES: f64 = (1_u64 << 53) as f64;

/// Relative error of the requested quantity if the scene gives neither error nor elements (chosen; below the error of measured
/// moduli).
const DEFAULT_RELATIVE_ERROR: f64 = 1e-3;
/// Relative error of a scene with heat or strain dependence that states none. Chosen: the temperature and the strain of a contact take long
/// to be known to better than 1 %, and measured laws are hardly better.
const DEFAULT_ERROR_WITH_FIXED_POINT: f64 = 1e-2;

impl Method {
    /// Name of the method in a scene file.
    pub fn name(self) -> &'static str {
        self.into()
    }

    /// Model of the method; `None` for closed forms, which exist for both models.
    pub const fn model(self) -> Option<Model> {
        match self {
            Self::Analytic => None,
            Self::MdrSteady | Self::MdrTransient => Some(Model::Line),
            Self::BemSteady | Self::BemTransient => Some(Model::HalfSpace),
        }
    }
}

impl Solve {
    /// The accuracy that the scene requests, validated: relative error or number of elements. Without either it depends on whether the
    /// answer is a fixed point of its temperature or its strain.
    pub(crate) fn accuracy(&self, is_fixed_point: bool) -> Result<Accuracy, SceneError> {
        match (self.relative_error, self.elements) {
            (Some(_), Some(_)) => Err(SceneError::at(
                "solve.elements",
                "either relative_error or elements is given, not both",
            )),
            (_, Some(elements)) => {
                let holds = (8..=100_000).contains(&elements);
                let number = elements as f64;
                in_range("solve.elements", number, holds, "from 8 to 100000")?;
                Ok(Accuracy::Elements(elements))
            }
            (given, None) => {
                let default = if is_fixed_point {
                    DEFAULT_ERROR_WITH_FIXED_POINT
                } else {
                    DEFAULT_RELATIVE_ERROR
                };
                let value = given.unwrap_or(default);
                let holds = value > 0.0 && value <= 0.1;
                let allowed = "greater than 0 and at most 0.1";
                let value = in_range("solve.relative_error", value, holds, allowed)?;
                Ok(Accuracy::RelativeError(value))
            }
        }
    }

    /// The number of threads that the scene requests, validated; `None` for all available ones.
    pub(crate) fn checked_threads(&self) -> Result<Option<usize>, SceneError> {
        if let Some(threads) = self.threads {
            let holds = (1..=1024).contains(&threads);
            in_range("solve.threads", threads as f64, holds, "from 1 to 1024")?;
        }
        Ok(self.threads)
    }

    /// Validated memory limit of one solution, \[bytes]; `None` if the scene gives none.
    pub(crate) fn checked_memory(&self) -> Result<Option<u64>, SceneError> {
        let Some(text) = &self.max_memory else {
            return Ok(None);
        };
        let number = text.trim_end_matches(char::is_alphabetic);
        let unit = &text[number.len()..];
        let unit = MEMORY_UNITS.iter().find(|(name, _)| *name == unit);
        let number: Option<f64> = number.trim().parse().ok();
        let bytes = number
            .zip(unit)
            .map(|(number, (_, size))| number * size)
            .filter(|bytes| (1.0..=MAX_BYTES).contains(bytes));
        #[expect(
            clippy::cast_possible_truncation,
            clippy::cast_sign_loss,
            reason = "1 <= bytes <= 2^53"
        )]
        let whole = bytes.map(|bytes| bytes as u64);
        let needed = "a positive number with one of the units B, kB, MB, GB, TB, KiB, MiB, GiB, TiB is needed, as in \"8 GiB\"";
        let refused = || SceneError::at("solve.max_memory", needed);
        whole.ok_or_else(refused).map(Some)
    }

    /// Sets the limit to one of `parts` equal parts of the memory that the scene gives, else of `otherwise` \[bytes].
    ///
    /// # Errors
    /// [`SceneError`] if the memory limit of the scene is invalid.
    pub fn limit_memory(&mut self, otherwise: Option<u64>, parts: u64) -> Result<(), SceneError> {
        let whole = self.checked_memory()?.or(otherwise);
        self.max_memory = whole.map(|bytes| format!("{} B", (bytes / parts).max(1)));
        Ok(())
    }

    /// Validated sliding distance to the requested state, \[m]: that of the scene, or its duration times `velocity` \[m/s].
    /// `None` for the stationary state.
    pub(crate) fn distance(&self, velocity: f64) -> Result<Option<f64>, SceneError> {
        Ok(match (self.duration, self.sliding_distance) {
            (Some(_), Some(_)) => Err(SceneError::at(
                "solve.sliding_distance",
                "either duration or sliding_distance is given, not both",
            ))?,
            (Some(duration), None) => {
                positive("solve.duration", duration)?;
                Some(positive("solve.duration", velocity * duration)?)
            }
            (None, Some(distance)) => Some(positive("solve.sliding_distance", distance)?),
            (None, None) => None,
        })
    }

    /// Validated duration of an indentation without sliding, \[s].
    ///
    /// # Errors
    /// [`SceneError`] without a duration, with a sliding distance, or for a number out of range.
    pub fn indentation_time(&self) -> Result<f64, SceneError> {
        if self.sliding_distance.is_some() {
            let problem = "load.velocity is 0, so that nothing slides; give solve.duration";
            return Err(SceneError::at("solve.sliding_distance", problem));
        }
        let Some(duration) = self.duration else {
            let problem = "a velocity of 0 is pure indentation, which needs solve.duration [s]";
            return Err(SceneError::at("load.velocity", problem));
        };
        Ok(positive("solve.duration", duration)?)
    }
}
