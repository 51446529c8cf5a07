//! What can be wrong with a material.

use thiserror::Error;

/// Why a material, or a question about it, is refused.
#[derive(Debug, Clone, PartialEq, Error)]
pub enum RheologyError {
    /// A parameter is not a number, or outside the range it may take.
    #[error("{parameter} must be {allowed}, but is {value}")]
    InvalidParameter {
        /// Name of the parameter.
        parameter: &'static str,
        /// The refused value.
        value: f64,
        /// The values it may take.
        allowed: &'static str,
    },
}

/// Checks that `value` is finite and greater than zero.
///
/// # Errors
/// [`RheologyError::InvalidParameter`] naming `parameter` otherwise.
pub(crate) fn positive(parameter: &'static str, value: f64) -> Result<f64, RheologyError> {
    if value.is_finite() && value > 0.0 {
        return Ok(value);
    }
    Err(RheologyError::InvalidParameter {
        parameter,
        value,
        allowed: "finite and greater than 0",
    })
}

/// Checks that `value` is finite and not negative.
///
/// # Errors
/// [`RheologyError::InvalidParameter`] naming `parameter` otherwise.
pub(crate) fn not_negative(parameter: &'static str, value: f64) -> Result<f64, RheologyError> {
    if value.is_finite() && value >= 0.0 {
        return Ok(value);
    }
    Err(RheologyError::InvalidParameter {
        parameter,
        value,
        allowed: "finite and at least 0",
    })
}
