//! The cylindrical punch with a flat end.

use crate::error::positive;
use crate::{Axisymmetric, IndenterError, surface_of_revolution};

/// A flat end with a vertical wall around it; the contact circle is its rim at every depth.
#[derive(Debug, Clone, Copy, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize))]
pub struct FlatPunch {
    radius: f64,
}

impl FlatPunch {
    /// A punch of `radius` > 0 \[m].
    ///
    /// # Errors
    /// [`IndenterError::InvalidParameter`] when the radius is not finite and greater than zero.
    pub fn new(radius: f64) -> Result<Self, IndenterError> {
        Ok(Self {
            radius: positive("radius", radius)?,
        })
    }

    /// Radius of the flat end, \[m].
    #[must_use]
    pub const fn radius(&self) -> f64 {
        self.radius
    }

    fn inside_or_wall(&self, radius: f64) -> f64 {
        if radius <= self.radius {
            0.0
        } else {
            f64::INFINITY
        }
    }
}

impl Axisymmetric for FlatPunch {
    fn profile_height(&self, radius: f64) -> f64 {
        self.inside_or_wall(radius)
    }

    fn profile_slope(&self, radius: f64) -> f64 {
        self.inside_or_wall(radius)
    }

    fn profile_curvature(&self, radius: f64) -> f64 {
        self.inside_or_wall(radius)
    }

    fn profile_exponent(&self) -> f64 {
        f64::INFINITY
    }

    fn max_radius(&self) -> f64 {
        self.radius
    }

    fn line_height(&self, x: f64) -> f64 {
        self.inside_or_wall(x.abs())
    }

    fn line_slope(&self, x: f64) -> f64 {
        x.signum() * self.inside_or_wall(x.abs())
    }
}

surface_of_revolution!(FlatPunch);
