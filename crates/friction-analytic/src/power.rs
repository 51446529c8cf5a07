//! Stationary sliding of a power profile, in closed form.
//!
//! ```text
//! x_d = (d / (κ c))^(1/p)        μ = p² / (2p − 1) · d / x_d,    p > 1/2        (21) for p = 1, (22) for p = 2
//! ```
//! The profile c r^p has the equivalent line κ c x^p. d is the stationary depth, x_d the length of the contact, and μ the
//! friction coefficient.

use indenters::{PowerProfile, SlidingLoad};
use rheology::Viscous;

use crate::error::representable;
use crate::stationary::checked_depth;
use crate::{DivergenceCause, FrictionError, StationarySliding};

/// Stationary depth, contact line and friction coefficient of a power profile, from (12) and (16).
///
/// # Errors
/// [`FrictionError::FrictionDiverges`] for an exponent of 1/2 or less; [`FrictionError::OutOfRange`] when a result
/// overflows or underflows.
pub fn power_sliding(
    profile: &PowerProfile,
    material: &Viscous,
    load: &SlidingLoad,
) -> Result<StationarySliding, FrictionError> {
    let depth = checked_depth(material, load)?;
    let contact_length = profile.line_position(depth);
    let p = profile.exponent();
    if p <= 0.5 {
        return Err(FrictionError::FrictionDiverges {
            cause: DivergenceCause::ApexExponent { exponent: p },
            indentation_depth: depth,
            contact_length,
        });
    }
    representable("contact length", contact_length)?;
    // p − 1/2 is exact where it is small, and no product overflows for the largest p.
    let shape_factor = 0.5 * p * (p / (p - 0.5));
    let friction = shape_factor * (depth / contact_length);
    let friction_coefficient = representable("friction coefficient", friction)?;
    // The contact length is the exponential of a sum of logarithms, whose absolute rounding becomes a relative error.
    let logarithms = depth.ln().abs() + profile.coefficient().ln().abs() + profile.stretch().ln();
    let rounding = f64::EPSILON * (4.0 + logarithms / p);
    Ok(StationarySliding {
        indentation_depth: depth,
        contact_line: vec![[0.0, contact_length]],
        friction_coefficient,
        error: rounding * friction_coefficient,
    })
}

/// The power profiles with further closed forms: transients on a dashpot, stationary states on other materials.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) enum PowerShape {
    /// Cone: exponent 1.
    Cone,
    /// Paraboloid: exponent 2.
    Paraboloid,
}

impl PowerShape {
    /// The shape of a profile, whose exponent must be exactly 1 or 2.
    pub(crate) fn new(profile: &PowerProfile) -> Result<Self, FrictionError> {
        match profile.exponent() {
            1.0 => Ok(Self::Cone),
            2.0 => Ok(Self::Paraboloid),
            exponent => Err(FrictionError::UnsupportedExponent {
                exponent,
                supported: "1 or 2",
            }),
        }
    }
}
