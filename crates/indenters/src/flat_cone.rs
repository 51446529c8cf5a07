//! The cone with a flat end.
//!
//! ```text
//! h(r) = t (r − b)        h̃(x) = t x arccos(b / x)        outside the flat end of radius b
//! ```

use crate::right_triangle::{arc_cosine, leg};
use crate::shape::shape;
use crate::{Axisymmetric, Kink, LinePoint, ProfilePoint, surface_of_revolution};

shape! {
    /// A cone whose tip is cut off; flat up to its `radius`, then rising with its `slope`.
    FlatCone;
    /// Flat up to the `radius` b > 0 \[m], then a cone of `slope` t > 0.
    new;
    /// Radius b of the flat end, \[m].
    radius: radius;
    /// Slope t of the cone.
    slope: cone_slope;
}

impl Axisymmetric for FlatCone {
    fn profile(&self, radius: f64) -> ProfilePoint {
        if radius <= self.radius {
            return ProfilePoint::default();
        }
        ProfilePoint {
            height: self.slope * (radius - self.radius),
            slope: self.slope,
            curvature: 0.0,
        }
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

    fn closed_line(&self, x: f64) -> Option<LinePoint> {
        if x <= self.radius {
            return Some(LinePoint::default());
        }
        let angle = arc_cosine(self.radius, x);
        Some(LinePoint {
            height: self.slope * x * angle,
            slope: self.slope * (angle + self.radius / leg(x, self.radius)),
        })
    }
}

surface_of_revolution!(FlatCone);
