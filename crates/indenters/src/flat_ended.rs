//! Bodies with a flat end of radius b.
//!
//! ```text
//! cone        h(r) = t (r − b)          h̃(x) = t x arccos(b / x)            outside the flat end
//! paraboloid  h(r) = c (r² − b²)        h̃(x) = 2 c x √(x² − b²)
//! punch       infinitely steep
//! ```

use crate::right_triangle::{arc_cosine, leg};
use crate::shape::shape;
use crate::{Axisymmetric, Kink, LinePoint, ProfilePoint, surface_of_revolution};

shape! {
    /// A truncated cone, flat up to its `radius` and rising with its `slope` beyond.
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

shape! {
    /// A truncated or worn paraboloid, flat up to its `radius`.
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

shape! {
    /// A flat-ended cylindrical punch; its contact radius is its own radius at every depth.
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
