//! The exact sphere, not its parabola.
//!
//! ```text
//! h(r) = R − √(R² − r²)        h̃(x) = x artanh(x / R)        (Segedin 1957, Mathematika 4, 156)
//! ```

use crate::right_triangle::leg;
use crate::shape::shape;
use crate::{Axisymmetric, surface_of_revolution};

shape! {
    /// The lower half of a sphere; it ends at the equator.
    Sphere;
    /// A sphere of `radius` R > 0 \[m].
    new;
    /// Radius R, \[m].
    radius: radius;
}

impl Axisymmetric for Sphere {
    fn profile_height(&self, radius: f64) -> f64 {
        if radius >= self.radius {
            return f64::INFINITY;
        }
        radius * (radius / (self.radius + leg(self.radius, radius)))
    }

    fn profile_slope(&self, radius: f64) -> f64 {
        if radius >= self.radius {
            return f64::INFINITY;
        }
        radius / leg(self.radius, radius)
    }

    fn profile_curvature(&self, radius: f64) -> f64 {
        if radius >= self.radius {
            return f64::INFINITY;
        }
        let leg = leg(self.radius, radius);
        (self.radius / leg).powi(2) / leg
    }

    fn profile_exponent(&self) -> f64 {
        2.0
    }

    fn max_radius(&self) -> f64 {
        self.radius
    }

    fn line_height(&self, x: f64) -> f64 {
        let x = x.abs();
        if x >= self.radius {
            return f64::INFINITY;
        }
        x * inverse_hyperbolic_tangent(x, self.radius)
    }

    fn line_slope(&self, x: f64) -> f64 {
        let distance = x.abs();
        if distance >= self.radius {
            return x.signum() * f64::INFINITY;
        }
        let rest = (distance / (self.radius - distance)) * (self.radius / (self.radius + distance));
        x.signum() * (inverse_hyperbolic_tangent(distance, self.radius) + rest)
    }
}

surface_of_revolution!(Sphere);

/// artanh(x / R) for 0 ≤ x < R, from the exact difference R − x.
fn inverse_hyperbolic_tangent(x: f64, radius: f64) -> f64 {
    0.5 * (2.0 * x / (radius - x)).ln_1p()
}
