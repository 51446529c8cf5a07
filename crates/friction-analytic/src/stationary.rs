//! The stationary state of sliding on a viscous line.
//!
//! ```text
//! d = F_N / (4 η v)        (12)
//! ```

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
    /// Coefficient of friction μ = F_h/F_N, (16).
    pub friction_coefficient: f64,
    /// Estimated absolute error of the coefficient of friction; for a closed form, of its rounding.
    pub error: f64,
}

impl StationarySliding {
    /// From ∫ h̃'² dx over the contact, (16); `ends` is what the rounding of its ends is multiplied with, whose integrand is
    /// cut there.
    pub(crate) fn of_energy(
        depth: f64,
        contact_line: Vec<[f64; 2]>,
        energy: Estimate,
        ends: f64,
    ) -> Self {
        Self {
            indentation_depth: depth,
            contact_line,
            friction_coefficient: energy.value / depth,
            error: (energy.error + 4.0 * f64::EPSILON * (energy.value + ends)) / depth,
        }
    }

    /// Length of the contact line, \[m].
    pub fn contact_length(&self) -> f64 {
        let intervals = self.contact_line.iter();
        intervals.map(|[start, end]| end - start).sum()
    }
}

/// Stationary indentation depth, \[m]: the one of the load, or F_N/(4 η v), (12), which does not depend on the shape.
pub fn stationary_depth(material: &Viscous, load: &SlidingLoad) -> f64 {
    match load.control() {
        Control::IndentationDepth(depth) => depth,
        Control::NormalForce(force) => {
            quotient(0.25 * force, [material.viscosity(), load.velocity()])
        }
    }
}

/// The stationary depth, or the reason why it is not a number.
pub(crate) fn checked_depth(material: &Viscous, load: &SlidingLoad) -> Result<f64, FrictionError> {
    load.require_stationary()?;
    load.require_fresh_ground()?;
    representable("indentation depth", stationary_depth(material, load))
}

/// The stationary depth of a load that sinks on its own.
pub(crate) fn depth_under_force(
    material: &Viscous,
    load: &SlidingLoad,
) -> Result<f64, FrictionError> {
    load.require_normal_force()?;
    checked_depth(material, load)
}

/// The numerator over both divisors, all positive, without an intermediate result outside the range of numbers unless
/// the quotient itself lies there.
pub(crate) fn quotient(numerator: f64, [one, other]: [f64; 2]) -> f64 {
    // A numerator below one must not shrink first, one above must not grow first.
    if (numerator < 1.0) == (one < other) {
        numerator / one / other
    } else {
        numerator / other / one
    }
}
