//! Errors of the closed forms and quadratures.

use indenters::IndenterError;
use numerics::{Estimate, InvalidParameter, MessageNumber, Rounded};
use thiserror::Error;

/// Reason why the friction integral diverges.
#[derive(Debug, Clone, Copy, PartialEq, Error)]
#[cfg_attr(feature = "serde", derive(serde::Serialize))]
#[non_exhaustive]
pub enum DivergenceCause {
    /// The profile rises from its apex like `r^exponent` with an exponent of at most 1/2.
    #[error(
        "the profile rises from its apex with exponent {exponent}, and an exponent above 0.5 is needed"
    )]
    ApexExponent {
        /// Exponent of the profile at its apex.
        exponent: f64,
    },
    /// The slope of the profile jumps upwards inside the contact.
    ///
    /// The slope of the line behind the jump grows like the inverse root of the distance, and the integral diverges like a
    /// logarithm.
    #[error(
        "the slope of the profile jumps upwards by {} at radius {} m, inside the contact",
        Rounded(*jump), Rounded(*radius)
    )]
    SlopeJump {
        /// Radius of the jump, \[m].
        radius: f64,
        /// Increase of the slope at the jump, without unit.
        jump: f64,
    },
    /// The contact reaches a vertical edge.
    #[error("the contact reaches a vertical edge at radius {} m", Rounded(*radius))]
    VerticalEdge {
        /// Radius of the edge, \[m].
        radius: f64,
    },
}

/// Reason why friction, depth, contact or sinking velocity cannot be computed.
#[derive(Debug, Clone, PartialEq, Error)]
#[non_exhaustive]
pub enum FrictionError {
    /// The body does not admit the contact.
    #[error(transparent)]
    Indenter(#[from] IndenterError),
    /// A parameter is not a number, or outside the range it may take.
    #[error(transparent)]
    InvalidParameter(#[from] InvalidParameter),
    /// The integral of the squared slope is infinite, though depth and contact exist.
    #[error(
        "the friction of the one-dimensional model is infinite: {cause}; \
         depth {} m and contact length {} m exist",
        Rounded(*indentation_depth), Rounded(*contact_length)
    )]
    FrictionDiverges {
        /// Reason of the divergence.
        cause: DivergenceCause,
        /// Indentation depth, \[m].
        indentation_depth: f64,
        /// Length of the contact line, \[m].
        contact_length: f64,
    },
    /// The leading edge does not reach the stationary depth, Remark 4 of Kürschner (2014).
    #[error(
        "no stationary state: a depth of {} m is needed, but the leading edge rises only {} m",
        Rounded(*needed_depth), Rounded(*available_depth)
    )]
    NoStationaryState {
        /// The depth F/(4 η v), (12), \[m].
        needed_depth: f64,
        /// Rise of the leading edge, \[m].
        available_depth: f64,
    },
    /// The contact would reach the vertical edge with which the body ends, where the line is infinitely high.
    #[error(
        "the contact would reach the edge of the body at radius {} m (of a sphere: its equator): lower normal_force \
         or indentation_depth, or check the unit of shear_modulus or viscosity",
        Rounded(*radius)
    )]
    BeyondEdge {
        /// Radius at which the body ends, \[m].
        radius: f64,
    },
    /// A numerical integral, root or series did not reach the required accuracy.
    #[error("{quantity} is {}, and this error is too large", Estimate::new(*value, *error))]
    NotConverged {
        /// Name of the quantity.
        quantity: &'static str,
        /// Value that was reached.
        value: f64,
        /// Estimated absolute error of the value.
        error: f64,
    },
    /// A result is too large or too small for a floating-point number.
    #[error("{quantity} leaves the range of floating-point numbers: it is {}", MessageNumber(*value))]
    OutOfRange {
        /// Name of the quantity.
        quantity: &'static str,
        /// Computed value: zero, negative, infinite, or not a number.
        value: f64,
    },
    /// The exact solution exists only for other exponents.
    #[error("the closed form needs the exponent {supported}, but the profile has {exponent}")]
    UnsupportedExponent {
        /// Exponent of the profile.
        exponent: f64,
        /// Exponents for which there is a closed form.
        supported: &'static str,
    },
    /// A contact interval is empty, reversed, or not ahead of the previous one.
    #[error(
        "contact interval {index} must lie in front of {lower}, but reaches from {start} to {end}"
    )]
    InvalidContact {
        /// Index of the interval, counted from 0.
        index: usize,
        /// End of the previous interval, \[m].
        lower: f64,
        /// Start of the interval, \[m].
        start: f64,
        /// End of the interval, \[m].
        end: f64,
    },
    /// The contact is not the part of the leading edge that Eq. (15) assumes.
    #[error(
        "Eq. (15) needs a contact that starts at the lowest point and rises by the whole depth {depth}, \
         but this contact rises by {rise}"
    )]
    NotOneSided {
        /// Present depth, \[m].
        depth: f64,
        /// Sum of the heights gained over the contact intervals, \[m].
        rise: f64,
    },
    /// The body is deeper than the stationary depth, so that Eq. (15) does not describe sinking.
    #[error(
        "Eq. (15) describes sinking up to the depth {stationary_depth}, but the body is {depth} deep"
    )]
    BeyondStationaryDepth {
        /// Present depth, \[m].
        depth: f64,
        /// Stationary depth F/(4 η v), (12), \[m].
        stationary_depth: f64,
    },
}

/// The value if it is finite and positive, otherwise [`FrictionError::OutOfRange`]: a positive result has overflowed or
/// underflowed.
pub(crate) fn representable(quantity: &'static str, value: f64) -> Result<f64, FrictionError> {
    if value.is_finite() && value > 0.0 {
        return Ok(value);
    }
    Err(out_of_range(quantity, value))
}

/// The error that a result, or an intermediate result, is out of the range of floating-point numbers.
pub(crate) const fn out_of_range(quantity: &'static str, value: f64) -> FrictionError {
    FrictionError::OutOfRange { quantity, value }
}
