//! Why a table or a curve is refused.

use friction_analytic::FrictionError;
use mdr_core::MdrError;
use numerics::InvalidParameter;
use thiserror::Error;

use crate::indentation::Flag;

/// Why a table cannot be read, or a curve not be fitted.
#[derive(Debug, Clone, PartialEq, Error)]
#[non_exhaustive]
pub enum MeasurementError {
    /// An option is out of range.
    #[error(transparent)]
    InvalidParameter(#[from] InvalidParameter),
    /// What is wrong with a table, with file, line and column.
    #[error("{0}")]
    Table(String),
    /// The curve is damaged.
    #[error("{0}")]
    Damaged(Flag),
    /// The forward model refuses the curve.
    #[error(transparent)]
    Model(#[from] MdrError),
    /// The body is none whose force on a sample of finite thickness is known.
    #[error(transparent)]
    Sample(FrictionError),
    /// Too few points for the parameters.
    #[error(
        "at least {needed} points are needed for these parameters and the size of the noise, but there are {given}"
    )]
    TooFewPoints {
        /// How many are needed.
        needed: usize,
        /// How many there are.
        given: usize,
    },
    /// No start leads to a minimum.
    #[error("no material of this kind has a force like that of the curve")]
    NotConverged,
    /// Every material of the kind explains the curve as well.
    #[error(
        "the curve does not determine any quantity of the material: are depth, force and the size of the body right?"
    )]
    NotDetermined,
}

impl From<FrictionError> for MeasurementError {
    fn from(error: FrictionError) -> Self {
        match error {
            FrictionError::InvalidParameter(refused) => Self::InvalidParameter(refused),
            other => Self::Sample(other),
        }
    }
}
