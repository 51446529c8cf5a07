//! Bodies of revolution as surfaces.

use crate::Axisymmetric;
use numerics::bracketed_root;

/// Implements [`Surface`](crate::Surface) for a type that implements [`Axisymmetric`](crate::Axisymmetric).
///
/// ```
/// use indenters::{Axisymmetric, ProfilePoint, Surface, surface_of_revolution};
///
/// struct Trumpet;
///
/// impl Axisymmetric for Trumpet {
///     fn profile(&self, radius: f64) -> ProfilePoint {
///         ProfilePoint {
///             height: radius.exp_m1(),
///             slope: radius.exp(),
///             curvature: radius.exp(),
///         }
///     }
///
///     fn profile_exponent(&self) -> f64 {
///         1.0
///     }
/// }
///
/// surface_of_revolution!(Trumpet);
///
/// assert_eq!(Trumpet.height([3.0, -4.0]), 5.0_f64.exp_m1());
/// ```
#[macro_export]
macro_rules! surface_of_revolution {
    ($body:ty) => {
        impl $crate::Surface for $body {
            fn height(&self, position: [f64; 2]) -> f64 {
                $crate::revolution::height(self, position)
            }

            fn gradient(&self, position: [f64; 2]) -> [f64; 2] {
                $crate::revolution::gradient(self, position)
            }

            fn mirrors(&self) -> [bool; 2] {
                [true; 2]
            }

            fn extent_below(&self, height: f64) -> [[f64; 2]; 2] {
                let radius = $crate::revolution::radius_below(self, height);
                [[-radius, radius]; 2]
            }

            fn apex_exponent(&self) -> f64 {
                $crate::Axisymmetric::profile_exponent(self)
            }

            fn as_axisymmetric(&self) -> Option<&dyn $crate::Axisymmetric> {
                Some(self)
            }
        }
    };
}

surface_of_revolution!(dyn Axisymmetric + '_);

/// Height of a body of revolution at a point, \[m].
pub fn height(body: &(impl Axisymmetric + ?Sized), [x, y]: [f64; 2]) -> f64 {
    body.profile_height(x.hypot(y))
}

/// Gradient of a body of revolution at a point; 0 at the apex, at a vertical edge, and outside.
pub fn gradient(body: &(impl Axisymmetric + ?Sized), [x, y]: [f64; 2]) -> [f64; 2] {
    let radius = x.hypot(y);
    if radius == 0.0 || radius > body.max_radius() {
        return [0.0, 0.0];
    }
    let slope = body.profile_slope(radius);
    // A vertical edge, as at the equator of a sphere, is the end of the body.
    if slope == f64::INFINITY {
        return [0.0, 0.0];
    }
    // Avoid ∞ · 0 if the slope overflows.
    [x, y].map(|along| match along {
        0.0 => 0.0,
        _ => slope * (along / radius),
    })
}

/// Radius at which the body reaches `height` \[m]; the end of the body if it stays lower.
pub fn radius_below(body: &(impl Axisymmetric + ?Sized), height: f64) -> f64 {
    if height <= 0.0 {
        return 0.0;
    }
    let end = body.max_radius();
    let above = |radius: f64| body.profile_height(radius) >= height;
    // Bracket the radius between r/2 and r; the search may start anywhere.
    let mut radius = if end.is_finite() { end } else { 1.0 };
    while !above(radius) && radius < 0.25 * f64::MAX && radius < end {
        radius *= 2.0;
    }
    if !above(radius) {
        return end;
    }
    while above(0.5 * radius) && radius > f64::MIN_POSITIVE {
        radius *= 0.5;
    }
    // Clamp the difference of heights, because the height may be infinite beyond the end of the body.
    let excess = |radius: f64| (body.profile_height(radius) - height).clamp(-height, height);
    bracketed_root(excess, [0.5 * radius, radius]).unwrap_or(radius)
}
