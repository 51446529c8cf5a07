//! Why measured friction has no fit.

use measurements::MeasurementError;
use thiserror::Error;

use crate::scene::SceneError;
use crate::solve::SolveError;

/// Why measured friction has no fit.
#[derive(Debug, Clone, PartialEq, Error)]
#[non_exhaustive]
pub enum FrictionFitError {
    /// The scene, or what of it is to be found.
    #[error(transparent)]
    Scene(#[from] SceneError),
    /// The points.
    #[error(transparent)]
    Points(#[from] MeasurementError),
    /// The friction of a point has no answer.
    #[error("the friction at point {point}, {velocity} m/s: {why}")]
    NotSolved {
        /// Its number, from 1.
        point: usize,
        /// Its speed, \[m/s].
        velocity: f64,
        /// Why.
        why: SolveError,
    },
    /// No start leads to a minimum.
    #[error(
        "no material of this kind has friction like that of the points; the last that was tried has none: {why}"
    )]
    NotConverged {
        /// What the model refused.
        why: Box<Self>,
    },
}
