//! The hyperboloid: a cone with a smoothly rounded tip.
//!
//! ```text
//! h(r) = t (√(r² + b²) − b)        h̃(x) = t x arctan(x / b)
//! ```

use crate::shape::shape;
use crate::{Axisymmetric, LinePoint, ProfilePoint, surface_of_revolution};

shape! {
    /// One sheet of a hyperboloid of revolution; far from the tip it is a cone of its `slope`.
    Hyperboloid;
    /// A tip of the size `radius` b > 0 \[m] on a cone of `slope` t > 0; the radius of curvature of the tip is b / t.
    new;
    /// Size b of the tip, \[m].
    radius: radius;
    /// Slope t of the cone that the body approaches.
    slope: cone_slope;
}

impl Axisymmetric for Hyperboloid {
    fn profile(&self, radius: f64) -> ProfilePoint {
        let distance = radius.hypot(self.radius);
        ProfilePoint {
            height: self.slope * radius * (radius / (distance + self.radius)),
            slope: self.slope * (radius / distance),
            curvature: self.slope * (self.radius / distance).powi(2) / distance,
        }
    }

    fn profile_exponent(&self) -> f64 {
        2.0
    }

    fn closed_line(&self, x: f64) -> Option<LinePoint> {
        let (angle, distance) = ((x / self.radius).atan(), x.hypot(self.radius));
        Some(LinePoint {
            height: self.slope * x * angle,
            slope: self.slope * (angle + (x / distance) * (self.radius / distance)),
        })
    }
}

surface_of_revolution!(Hyperboloid);
