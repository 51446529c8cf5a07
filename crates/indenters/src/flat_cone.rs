//! The cone with a flat end.
//!
//! ```text
//! h(r) = t (r − b)        h̃(x) = t x arccos(b / x)        outside the flat end of radius b
//! ```

use crate::error::positive;
use crate::right_triangle::{arc_cosine, leg};
use crate::{Axisymmetric, IndenterError, Kink, surface_of_revolution};

/// A cone whose tip is cut off; flat up to its `radius`, then rising with its `slope`.
#[derive(Debug, Clone, Copy, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize))]
pub struct FlatCone {
    radius: f64,
    slope: f64,
}

impl FlatCone {
    /// Flat up to the `radius` b > 0 \[m], then a cone of `slope` t > 0.
    ///
    /// # Errors
    /// [`IndenterError::InvalidParameter`] when one of them is not finite and greater than zero.
    pub fn new(radius: f64, slope: f64) -> Result<Self, IndenterError> {
        Ok(Self {
            radius: positive("radius", radius)?,
            slope: positive("slope", slope)?,
        })
    }

    /// Radius b of the flat end, \[m].
    #[must_use]
    pub const fn radius(&self) -> f64 {
        self.radius
    }

    /// Slope t of the cone.
    #[must_use]
    pub const fn cone_slope(&self) -> f64 {
        self.slope
    }
}

impl Axisymmetric for FlatCone {
    fn profile_height(&self, radius: f64) -> f64 {
        self.slope * (radius - self.radius).max(0.0)
    }

    fn profile_slope(&self, radius: f64) -> f64 {
        if radius <= self.radius {
            return 0.0;
        }
        self.slope
    }

    fn profile_curvature(&self, _radius: f64) -> f64 {
        0.0
    }

    fn profile_exponent(&self) -> f64 {
        f64::INFINITY
    }

    fn kinks(&self) -> Vec<Kink> {
        vec![Kink {
            radius: self.radius,
            slope_jump: self.slope,
        }]
    }

    fn line_height(&self, x: f64) -> f64 {
        let x = x.abs();
        if x <= self.radius {
            return 0.0;
        }
        self.slope * x * arc_cosine(self.radius, x)
    }

    fn line_slope(&self, x: f64) -> f64 {
        let distance = x.abs();
        if distance <= self.radius {
            return 0.0;
        }
        let singular = self.radius / leg(distance, self.radius);
        x.signum() * self.slope * (arc_cosine(self.radius, distance) + singular)
    }
}

surface_of_revolution!(FlatCone);
