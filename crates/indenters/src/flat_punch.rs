//! The cylindrical punch with a flat end.

use crate::shape::shape;
use crate::{Axisymmetric, LinePoint, ProfilePoint, surface_of_revolution};

shape! {
    /// A flat end with a vertical edge around it; the contact circle is its rim at every depth.
    FlatPunch;
    /// A punch of `radius` > 0 \[m].
    new;
    /// Radius of the flat end, \[m].
    radius: radius;
}

impl Axisymmetric for FlatPunch {
    fn profile(&self, radius: f64) -> ProfilePoint {
        if radius > self.radius {
            return ProfilePoint::ENDED;
        }
        ProfilePoint::default()
    }

    fn profile_exponent(&self) -> f64 {
        f64::INFINITY
    }

    fn max_radius(&self) -> f64 {
        self.radius
    }

    fn closed_line(&self, x: f64) -> Option<LinePoint> {
        let ProfilePoint { height, slope, .. } = self.profile(x);
        Some(LinePoint { height, slope })
    }
}

surface_of_revolution!(FlatPunch);
