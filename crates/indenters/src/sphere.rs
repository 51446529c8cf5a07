//! The exact sphere, as opposed to its osculating paraboloid.
//!
//! ```text
//! h(r) = R − √(R² − r²)        h̃(x) = x artanh(x / R)        (Segedin 1957, Mathematika 4, 156)
//! ```

use crate::right_triangle::leg;
use crate::shape::shape;
use crate::{Axisymmetric, LinePoint, ProfilePoint, surface_of_revolution};

shape! {
    /// The lower half of a sphere; it ends at the equator.
    Sphere;
    /// A sphere of `radius` R > 0 \[m].
    new;
    /// Radius R, \[m].
    radius: radius;
}

impl Axisymmetric for Sphere {
    fn profile(&self, radius: f64) -> ProfilePoint {
        if radius >= self.radius {
            return ProfilePoint::ENDED;
        }
        let leg = leg(self.radius, radius);
        ProfilePoint {
            height: radius * (radius / (self.radius + leg)),
            slope: radius / leg,
            curvature: (self.radius / leg).powi(2) / leg,
        }
    }

    fn profile_exponent(&self) -> f64 {
        2.0
    }

    fn max_radius(&self) -> f64 {
        self.radius
    }

    fn closed_line(&self, x: f64) -> Option<LinePoint> {
        if x >= self.radius {
            return Some(LinePoint::ENDED);
        }
        // Compute artanh(x/R), with the radius R of the sphere, from the exact difference R − x, so that it is accurate near the
        // equator.
        let rest = self.radius - x;
        let inverse_hyperbolic_tangent = 0.5 * (2.0 * x / rest).ln_1p();
        Some(LinePoint {
            height: x * inverse_hyperbolic_tangent,
            slope: inverse_hyperbolic_tangent + (x / rest) * (self.radius / (self.radius + x)),
        })
    }

    /// Radius x = R tanh y with y tanh y = h̃/R, by Newton's method.
    fn closed_radius(&self, height: f64) -> Option<f64> {
        let ratio = height / self.radius;
        // Start Newton's iteration from the series of y² in the ratio near the apex, and from y ≈ ratio far from it.
        let series = 1.0 + ratio * (1.0 / 3.0 + 4.0 / 45.0 * ratio);
        let mut y = (ratio * series.min(ratio + 0.5 / ratio.max(0.5))).sqrt();
        for _ in 0..8 {
            let tanh = y.tanh();
            let step = (y * tanh - ratio) / (tanh + y * (1.0 - tanh * tanh));
            y -= step;
            // Apply the last step to the radius, where it needs no further tanh.
            if step.abs() <= 1e-9 * y {
                return Some(self.radius * (tanh - step * (1.0 - tanh * tanh)));
            }
        }
        None
    }
}

surface_of_revolution!(Sphere);
