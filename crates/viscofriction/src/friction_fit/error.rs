//! Errors of the fit of measured friction.

use measurements::MeasurementError;
use thiserror::Error;

use crate::scene::SceneError;
use crate::solve::SolveError;

/// Reason why measured friction cannot be fitted.
#[derive(Debug, Clone, PartialEq, Error)]
#[non_exhaustive]
pub enum FrictionFitError {
    /// An error of the scene or of the choice of free parameters.
    #[error(transparent)]
    Scene(#[from] SceneError),
    /// An error of the measured points.
    #[error(transparent)]
    Points(#[from] MeasurementError),
    /// The friction of a point was not solved.
    #[error("the friction at point {point}, {velocity} m/s: {why}")]
    NotSolved {
        /// Number of the point, counted from 1.
        point: usize,
        /// Sliding velocity of the point, \[m/s].
        velocity: f64,
        /// The error of the solution.
        why: SolveError,
    },
    /// The least squares converged from none of the starts.
    #[error(
        "no material of this kind has friction like that of the points; the last that was tried has none: {why}"
    )]
    NotConverged {
        /// The last error of the model.
        why: Box<Self>,
    },
}
