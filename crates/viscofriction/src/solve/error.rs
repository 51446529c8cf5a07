//! Why a problem has no answer.

use bem_halfspace::BemError;
use friction_analytic::FrictionError;
use indenters::IndenterError;
use mdr_core::MdrError;
use rheology::RheologyError;
use thiserror::Error;

/// Why a problem that is well posed has no answer.
#[derive(Debug, Clone, PartialEq, Error)]
pub enum SolveError {
    /// Of the half space.
    #[error(transparent)]
    HalfSpace(#[from] BemError),
    /// Of the one-dimensional model.
    #[error(transparent)]
    Line(#[from] MdrError),
    /// Of closed forms and quadrature.
    #[error(transparent)]
    Analytic(#[from] FrictionError),
    /// Of the rigid body.
    #[error(transparent)]
    Indenter(#[from] IndenterError),
    /// Of the material.
    #[error(transparent)]
    Material(#[from] RheologyError),
    /// No method was asked.
    #[error(transparent)]
    NotOffered(#[from] super::NotOffered),
    /// The error asked for was not reached on the finest resolution.
    #[error(transparent)]
    TooCoarse(#[from] numerics::NotReached),
    /// A quantity that no number can hold.
    #[error("{quantity} is {value} in units of SI: no number is as large")]
    Overflow {
        /// Its name.
        quantity: String,
        /// Infinite, or not a number.
        value: f64,
    },
    /// What was asked for was not reached; the sentence says what was.
    #[error("{0}")]
    NotReached(String),
}

/// An answer or why there is none.
pub type Result<T, E = SolveError> = std::result::Result<T, E>;

macro_rules! bail {
    ($($text:tt)*) => {
        return Err($crate::solve::error::SolveError::NotReached(format!($($text)*)))
    };
}
pub(crate) use bail;

/// A value that is needed.
pub(crate) trait Context<T> {
    fn context(self, what: &str) -> Result<T>;
}

impl<T, E> Context<T> for std::result::Result<T, E> {
    fn context(self, what: &str) -> Result<T> {
        self.map_err(|_| SolveError::NotReached(what.to_owned()))
    }
}

impl<T> Context<T> for Option<T> {
    fn context(self, what: &str) -> Result<T> {
        self.ok_or_else(|| SolveError::NotReached(what.to_owned()))
    }
}
