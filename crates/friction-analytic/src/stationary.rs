//! Stationary sliding on a viscous foundation, the one-dimensional model.
//!
//! ```text
//! d = F_N / (4 η v)        (12)
//! ```
//! d is the indentation depth, F_N the normal force, η the viscosity of the foundation, and v the speed.

use indenters::{Control, SlidingLoad};
use numerics::Estimate;
use rheology::Viscous;

use crate::FrictionError;
use crate::error::representable;

/// Stationary sliding of a rigid line over a viscous foundation.
#[derive(Debug, Clone, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize))]
#[must_use]
pub struct StationarySliding {
    /// Indentation depth d of the lowest point, (12), \[m].
    pub indentation_depth: f64,
    /// Intervals of the contact line, from the rear to the front, in the frame of the body, \[m].
    pub contact_line: Vec<[f64; 2]>,
    /// Friction coefficient μ = F_h/F_N, (16).
    pub friction_coefficient: f64,
    /// Estimated absolute error of the friction coefficient; for a closed form, its rounding error.
    pub error: f64,
}

impl StationarySliding {
    /// The stationary state from ∫ h̃'² dx over the contact, (16), \[m].
    ///
    /// `end_sensitivity` \[m] is the change of the integral per relative change of the positions of its ends, which are rounded.
    pub(crate) fn from_energy(
        depth: f64,
        contact_line: Vec<[f64; 2]>,
        energy: Estimate,
        end_sensitivity: f64,
    ) -> Self {
        Self {
            indentation_depth: depth,
            contact_line,
            friction_coefficient: energy.value / depth,
            error: (energy.error + 4.0 * f64::EPSILON * (energy.value + end_sensitivity)) / depth,
        }
    }

    /// Length of the contact line, \[m].
    pub fn contact_length(&self) -> f64 {
        let intervals = self.contact_line.iter();
        intervals.map(|[start, end]| end - start).sum()
    }
}

/// Stationary indentation depth, \[m]: the prescribed one, or F_N/(4 η v), (12), which does not depend on the shape.
pub fn stationary_depth(material: &Viscous, load: &SlidingLoad) -> f64 {
    match load.control() {
        Control::IndentationDepth(depth) => depth,
        Control::NormalForce(force) => {
            quotient(0.25 * force, material.viscosity(), load.velocity())
        }
    }
}

/// The stationary depth, \[m], or the reason why it does not exist or is not representable.
pub(crate) fn checked_depth(material: &Viscous, load: &SlidingLoad) -> Result<f64, FrictionError> {
    load.require_stationary()?;
    load.require_fresh_ground()?;
    representable("indentation depth", stationary_depth(material, load))
}

/// The stationary depth under a prescribed force, \[m].
pub(crate) fn depth_under_force(
    material: &Viscous,
    load: &SlidingLoad,
) -> Result<f64, FrictionError> {
    load.require_normal_force()?;
    checked_depth(material, load)
}

/// Quotient numerator/(a b) of positive numbers, without overflow or underflow of an intermediate result unless the quotient itself
/// is out of range.
pub(crate) fn quotient(numerator: f64, a: f64, b: f64) -> f64 {
    // A numerator below 1 is divided by the smaller number first, so that it grows; one above by the larger one.
    if (numerator < 1.0) == (a < b) {
        numerator / a / b
    } else {
        numerator / b / a
    }
}
