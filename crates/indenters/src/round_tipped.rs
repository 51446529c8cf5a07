//! Cones with a rounded tip.
//!
//! ```text
//! hyperboloid   h(r) = t (√(r² + b²) − b)      h̃(x) = t x arctan(x / b)
//! paraboloid    h(r) = t r² / (2b)              h̃(x) = t x² / b                                    up to r, x = b
//!               h(r) = t (r − b/2)              h̃(x) = t x [arccos(b / x) + (x − √(x² − b²)) / b]  beyond
//! ```

use crate::right_triangle::{arc_cosine, leg};
use crate::shape::shape;
use crate::{Axisymmetric, Kink, LinePoint, ProfilePoint, surface_of_revolution};

shape! {
    /// One sheet of a hyperboloid of revolution, which approaches a cone of its `slope`.
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

impl Axisymmetric for RoundTippedCone {
    fn profile(&self, radius: f64) -> ProfilePoint {
        if radius <= self.radius {
            return ProfilePoint {
                height: 0.5 * self.slope * radius * (radius / self.radius),
                slope: self.slope * (radius / self.radius),
                curvature: self.slope / self.radius,
            };
        }
        ProfilePoint {
            height: self.slope * (radius - 0.5 * self.radius),
            slope: self.slope,
            curvature: 0.0,
        }
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

    fn closed_line(&self, x: f64) -> Option<LinePoint> {
        if x <= self.radius {
            return Some(LinePoint {
                height: self.slope * x * (x / self.radius),
                slope: 2.0 * self.slope * (x / self.radius),
            });
        }
        let angle = arc_cosine(self.radius, x);
        // Compute (x − √(x² − b²))/b with the radius b of the tip in a form without cancellation.
        let overhang = self.radius / (x + leg(x, self.radius));
        Some(LinePoint {
            height: self.slope * x * (angle + overhang),
            slope: self.slope * (angle + 2.0 * overhang),
        })
    }
}

surface_of_revolution!(RoundTippedCone);
