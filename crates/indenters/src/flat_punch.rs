//! The cylindrical punch with a flat end.

use crate::shape::shape;
use crate::{Axisymmetric, surface_of_revolution};

shape! {
    /// A flat end with a vertical edge around it; the contact circle is its rim at every depth.
    FlatPunch;
    /// A punch of `radius` > 0 \[m].
    new;
    /// Radius of the flat end, \[m].
    radius: radius;
}

impl FlatPunch {
    fn inside_or_edge(&self, radius: f64) -> f64 {
        if radius <= self.radius {
            0.0
        } else {
            f64::INFINITY
        }
    }
}

impl Axisymmetric for FlatPunch {
    fn profile_height(&self, radius: f64) -> f64 {
        self.inside_or_edge(radius)
    }

    fn profile_slope(&self, radius: f64) -> f64 {
        self.inside_or_edge(radius)
    }

    fn profile_curvature(&self, radius: f64) -> f64 {
        self.inside_or_edge(radius)
    }

    fn profile_exponent(&self) -> f64 {
        f64::INFINITY
    }

    fn max_radius(&self) -> f64 {
        self.radius
    }

    fn line_height(&self, x: f64) -> f64 {
        self.inside_or_edge(x.abs())
    }

    fn line_slope(&self, x: f64) -> f64 {
        x.signum() * self.inside_or_edge(x.abs())
    }
}

surface_of_revolution!(FlatPunch);
