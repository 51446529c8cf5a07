//! Checks of numbers against the ranges that their parameters may take.

use thiserror::Error;

/// A parameter that is not a number, or outside the range it may take.
#[derive(Debug, Clone, Copy, PartialEq, Error)]
#[error("{parameter} must be {allowed}, but is {value}")]
pub struct InvalidParameter {
    /// Name of the parameter.
    pub parameter: &'static str,
    /// The refused value.
    pub value: f64,
    /// The values it may take.
    pub allowed: &'static str,
}

/// The value of a parameter when it is one of those `allowed`, which `holds` says.
///
/// # Errors
/// [`InvalidParameter`] otherwise.
pub const fn in_range(
    parameter: &'static str,
    value: f64,
    holds: bool,
    allowed: &'static str,
) -> Result<f64, InvalidParameter> {
    if holds {
        return Ok(value);
    }
    Err(InvalidParameter {
        parameter,
        value,
        allowed,
    })
}

/// A value that is finite and greater than 0.
///
/// # Errors
/// [`InvalidParameter`] otherwise.
pub const fn positive(parameter: &'static str, value: f64) -> Result<f64, InvalidParameter> {
    let holds = value.is_finite() && value > 0.0;
    in_range(parameter, value, holds, "finite and greater than 0")
}

/// A value that is finite and at least 0.
///
/// # Errors
/// [`InvalidParameter`] otherwise.
pub const fn not_negative(parameter: &'static str, value: f64) -> Result<f64, InvalidParameter> {
    let holds = value.is_finite() && value >= 0.0;
    in_range(parameter, value, holds, "finite and at least 0")
}

/// A value that is finite.
///
/// # Errors
/// [`InvalidParameter`] otherwise.
pub const fn finite(parameter: &'static str, value: f64) -> Result<f64, InvalidParameter> {
    in_range(parameter, value, value.is_finite(), "finite")
}

/// A value between 0 and 1, which are excluded.
///
/// # Errors
/// [`InvalidParameter`] otherwise.
pub const fn between_zero_and_one(
    parameter: &'static str,
    value: f64,
) -> Result<f64, InvalidParameter> {
    let holds = value > 0.0 && value < 1.0;
    in_range(parameter, value, holds, "between 0 and 1")
}
