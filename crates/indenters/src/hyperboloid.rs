//! The hyperboloid: a cone with a smoothly rounded tip.
//!
//! ```text
//! h(r) = t (√(r² + b²) − b)        h̃(x) = t x arctan(x / b)
//! ```

use crate::shape::shape;
use crate::{Axisymmetric, surface_of_revolution};

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
    fn profile_height(&self, radius: f64) -> f64 {
        self.slope * radius * (radius / (radius.hypot(self.radius) + self.radius))
    }

    fn profile_slope(&self, radius: f64) -> f64 {
        self.slope * (radius / radius.hypot(self.radius))
    }

    fn profile_curvature(&self, radius: f64) -> f64 {
        let distance = radius.hypot(self.radius);
        self.slope * (self.radius / distance).powi(2) / distance
    }

    fn profile_exponent(&self) -> f64 {
        2.0
    }

    fn line_height(&self, x: f64) -> f64 {
        self.slope * x * (x / self.radius).atan()
    }

    fn line_slope(&self, x: f64) -> f64 {
        let distance = x.hypot(self.radius);
        self.slope * ((x / self.radius).atan() + (x / distance) * (self.radius / distance))
    }
}

surface_of_revolution!(Hyperboloid);
