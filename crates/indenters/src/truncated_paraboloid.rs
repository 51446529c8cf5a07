//! The paraboloid with a flat end.
//!
//! ```text
//! h(r) = c (r² − b²)        h̃(x) = 2 c x √(x² − b²)        outside the flat end of radius b
//! ```

use crate::right_triangle::leg;
use crate::shape::shape;
use crate::{Axisymmetric, Kink, LinePoint, ProfilePoint, surface_of_revolution};

shape! {
    /// A paraboloid whose tip is cut off or worn away; flat up to its `radius`.
    TruncatedParaboloid;
    /// Flat up to the `radius` b > 0 \[m], then `curvature · (r² − b²)`, curvature c > 0 in \[1/m]; the radius of
    /// curvature is `1 / (2 curvature)`.
    new;
    /// Radius b of the flat end, \[m].
    radius: radius;
    /// Coefficient c of the paraboloid, \[1/m].
    curvature: paraboloid_curvature;
}

impl Axisymmetric for TruncatedParaboloid {
    fn profile(&self, radius: f64) -> ProfilePoint {
        if radius <= self.radius {
            return ProfilePoint::default();
        }
        ProfilePoint {
            height: self.curvature * (radius - self.radius) * (radius + self.radius),
            slope: 2.0 * self.curvature * radius,
            curvature: 2.0 * self.curvature,
        }
    }

    fn profile_exponent(&self) -> f64 {
        f64::INFINITY
    }

    fn kinks(&self) -> Vec<Kink> {
        vec![Kink {
            radius: self.radius,
            slope_jump: 2.0 * self.curvature * self.radius,
        }]
    }

    fn closed_line(&self, x: f64) -> Option<LinePoint> {
        if x <= self.radius {
            return Some(LinePoint::default());
        }
        let leg = leg(x, self.radius);
        Some(LinePoint {
            height: 2.0 * self.curvature * x * leg,
            slope: 2.0 * self.curvature * (leg + x * (x / leg)),
        })
    }
}

surface_of_revolution!(TruncatedParaboloid);
