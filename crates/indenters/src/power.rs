//! Power profiles, the family of the paper.
//!
//! ```text
//! h(r) = c r^p                (7)
//! h̃(x) = κ(p) c |x|^p         (8)
//! ```

use std::f64::consts::FRAC_2_PI;

use crate::{Axisymmetric, IndenterError, LinePoint, ProfilePoint, stretch, surface_of_revolution};
use numerics::positive;

/// A body of revolution `h(r) = c r^p` with any p > 0.
#[derive(Debug, Clone, Copy, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize))]
pub struct PowerProfile {
    /// Coefficient c, in metres to the power 1 − p.
    coefficient: f64,
    /// Exponent p.
    exponent: f64,
    /// Stretch κ(p), stored because every height of the line needs it.
    #[cfg_attr(feature = "serde", serde(skip))]
    stretch: f64,
}

impl PowerProfile {
    /// The profile `coefficient · r^exponent`; the coefficient c > 0 has the unit [m^(1−p)].
    ///
    /// # Errors
    /// [`IndenterError::InvalidParameter`] when one of them is not finite and greater than zero.
    pub fn new(coefficient: f64, exponent: f64) -> Result<Self, IndenterError> {
        Ok(Self {
            coefficient: positive("coefficient", coefficient)?,
            exponent: positive("exponent", exponent)?,
            stretch: stretch(exponent)?,
        })
    }

    /// The cone `slope · r`, slope > 0.
    ///
    /// # Errors
    /// [`IndenterError::InvalidParameter`] when the slope is not finite and greater than zero.
    pub fn cone(slope: f64) -> Result<Self, IndenterError> {
        Self::new(positive("slope", slope)?, 1.0)
    }

    /// The cone with the elastic force of a four-sided pyramid, whose faces have the `slope` > 0 along their line of
    /// steepest descent.
    ///
    /// The force is F = 0.7453 E* d²/slope for the pyramid (Bilodeau 1992, J. Appl. Mech. 59, 519, DOI 10.1115/1.2893754)
    /// and (2/π) E* d²/slope for a cone. Unloading is an approximation, because the contact of a pyramid is not a disc.
    ///
    /// # Errors
    /// [`IndenterError::InvalidParameter`] when the slope is not finite and greater than zero.
    pub fn pyramid(slope: f64) -> Result<Self, IndenterError> {
        Self::cone(FRAC_2_PI / 0.7453 * positive("slope", slope)?)
    }

    /// The paraboloid of revolution `curvature · r²`, curvature > 0 in \[1/m]; its radius of curvature is
    /// `1 / (2 curvature)`.
    ///
    /// # Errors
    /// [`IndenterError::InvalidParameter`] when the curvature is not finite and greater than zero.
    pub fn paraboloid(curvature: f64) -> Result<Self, IndenterError> {
        Self::new(positive("curvature", curvature)?, 2.0)
    }

    /// Coefficient c, [m^(1−p)].
    pub const fn coefficient(&self) -> f64 {
        self.coefficient
    }

    /// Exponent p.
    pub const fn exponent(&self) -> f64 {
        self.exponent
    }

    /// Stretch κ(p) of the equivalent line, (9).
    pub const fn stretch(&self) -> f64 {
        self.stretch
    }

    /// Position x > 0 \[m] at which the equivalent line has the `height` ≥ 0 \[m]: `x = (height / (κ c))^(1/p)`.
    ///
    /// A ratio height / (κ c) that overflows or underflows is replaced by its logarithm.
    pub fn line_position(&self, height: f64) -> f64 {
        if height == 0.0 {
            return 0.0;
        }
        let ratio = height / self.stretch / self.coefficient;
        if ratio.is_normal() {
            let is_paraboloid = self.exponent.total_cmp(&2.0).is_eq();
            let power = || ratio.powf(self.exponent.recip());
            return if is_paraboloid { ratio.sqrt() } else { power() };
        }
        ((height.ln() - self.stretch.ln() - self.coefficient.ln()) / self.exponent).exp()
    }
}

impl Axisymmetric for PowerProfile {
    fn profile(&self, radius: f64) -> ProfilePoint {
        let (c, p) = (self.coefficient, self.exponent);
        ProfilePoint {
            height: scaled_power(c, radius, p),
            slope: scaled_power(c * p, radius, p - 1.0),
            curvature: scaled_power(c * p * (p - 1.0), radius, p - 2.0),
        }
    }

    fn profile_exponent(&self) -> f64 {
        self.exponent
    }

    fn closed_line(&self, x: f64) -> Option<LinePoint> {
        Some(LinePoint {
            height: self.stretch * self.profile_height(x),
            slope: self.stretch * self.profile_slope(x),
        })
    }

    fn closed_radius(&self, height: f64) -> Option<f64> {
        Some(self.line_position(height))
    }
}

surface_of_revolution!(PowerProfile);

/// Product `factor · radius^exponent`, also if the power alone overflows or underflows.
pub(crate) fn scaled_power(factor: f64, radius: f64, exponent: f64) -> f64 {
    if factor == 0.0 {
        return 0.0;
    }
    let power = radius.powf(exponent);
    if power.is_normal() {
        return factor * power;
    }
    // Multiply by half of the power twice, because the whole one leaves the range of numbers.
    let square_root = radius.powf(0.5 * exponent);
    factor * square_root * square_root
}
