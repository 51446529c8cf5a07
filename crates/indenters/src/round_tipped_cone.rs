//! The cone with a paraboloidal tip.
//!
//! ```text
//! h(r) = t r² / (2b)  up to r = b,   t (r − b/2)  beyond
//! h̃(x) = t x² / b     up to x = b,   t x [arccos(b / x) + (x − √(x² − b²)) / b]  beyond
//! ```

use crate::right_triangle::{arc_cosine, leg};
use crate::shape::shape;
use crate::{Axisymmetric, Kink, surface_of_revolution};

shape! {
    /// A cone that touches a paraboloid at `radius`, where slope and height agree.
    RoundTippedCone;
    /// A tip up to the `radius` b > 0 \[m], then a cone of `slope` t > 0.
    new;
    /// Radius b at which the tip ends, \[m].
    radius: radius;
    /// Slope t of the cone.
    slope: cone_slope;
}

impl RoundTippedCone {
    /// (x − √(x² − b²)) / b without cancellation.
    fn overhang(&self, x: f64) -> f64 {
        self.radius / (x + leg(x, self.radius))
    }
}

impl Axisymmetric for RoundTippedCone {
    fn profile_height(&self, radius: f64) -> f64 {
        if radius <= self.radius {
            return 0.5 * self.slope * radius * (radius / self.radius);
        }
        self.slope * (radius - 0.5 * self.radius)
    }

    fn profile_slope(&self, radius: f64) -> f64 {
        self.slope * (radius / self.radius).min(1.0)
    }

    fn profile_curvature(&self, radius: f64) -> f64 {
        if radius <= self.radius {
            return self.slope / self.radius;
        }
        0.0
    }

    fn profile_exponent(&self) -> f64 {
        2.0
    }

    fn kinks(&self) -> Vec<Kink> {
        vec![Kink {
            radius: self.radius,
            slope_jump: 0.0,
        }]
    }

    fn line_height(&self, x: f64) -> f64 {
        let x = x.abs();
        if x <= self.radius {
            return self.slope * x * (x / self.radius);
        }
        self.slope * x * (arc_cosine(self.radius, x) + self.overhang(x))
    }

    fn line_slope(&self, x: f64) -> f64 {
        let distance = x.abs();
        if distance <= self.radius {
            return 2.0 * self.slope * (x / self.radius);
        }
        let angle = arc_cosine(self.radius, distance);
        x.signum() * self.slope * (angle + 2.0 * self.overhang(distance))
    }
}

surface_of_revolution!(RoundTippedCone);
