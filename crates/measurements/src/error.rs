//! Errors of tables and of fits.

use friction_analytic::FrictionError;
use mdr_core::MdrError;
use numerics::InvalidParameter;
use thiserror::Error;

use crate::indentation::Flag;

/// The reason for which a table cannot be read, or a curve not be fitted.
#[derive(Debug, Clone, PartialEq, Error)]
#[non_exhaustive]
pub enum MeasurementError {
    /// An option is out of range.
    #[error(transparent)]
    InvalidParameter(#[from] InvalidParameter),
    /// A malformed table; the message has file, line and column.
    #[error("{0}")]
    Table(String),
    /// The curve is damaged.
    #[error("{0}")]
    Damaged(Flag),
    /// The forward model refuses the curve.
    #[error(transparent)]
    Model(#[from] MdrError),
    /// The force of the body on a sample of finite thickness is not known.
    #[error(transparent)]
    Sample(FrictionError),
    /// Too few points for the parameters.
    #[error(
        "at least {needed} points are needed for these parameters and the size of the noise, but there are {given}"
    )]
    TooFewPoints {
        /// Number of points needed.
        needed: usize,
        /// Number of points given.
        given: usize,
    },
    /// No initial value leads to a minimum.
    #[error("no material of this kind has a force like that of the curve")]
    NotConverged,
    /// All materials of the kind explain the curve equally well.
    #[error(
        "the curve does not determine any quantity of the material: are depth, force and the size of the body right?"
    )]
    NotDetermined,
}

impl From<FrictionError> for MeasurementError {
    /// Error of the moduli or of the contact that a computation of `friction-analytic` met.
    fn from(error: FrictionError) -> Self {
        match error {
            FrictionError::InvalidParameter(refused) => Self::InvalidParameter(refused),
            other => Self::Sample(other),
        }
    }
}
