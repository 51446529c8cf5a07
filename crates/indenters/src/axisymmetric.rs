//! Bodies of revolution and their equivalent lines.
//!
//! ```text
//! h̃(x) = |x| ∫₀^|x| h'(r) / √(x² − r²) dr        (Heß 2011; Kürschner 2014, Eq. 8 for powers)
//! ```

use std::f64::consts::FRAC_PI_2;

use auto_impl::auto_impl;

use crate::IndenterError;
use crate::right_triangle::arc_cosine;
use numerics::integrate_from_ends;

/// A jump of the slope h', or of the curvature h'', at a radius greater than zero.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Kink {
    /// Where the slope jumps, \[m].
    pub radius: f64,
    /// h'(r + 0) − h'(r − 0); zero where only the curvature jumps.
    pub slope_jump: f64,
}

/// A profile at one radius; the default is that of a flat end.
#[derive(Debug, Clone, Copy, Default, PartialEq)]
pub struct ProfilePoint {
    /// Height h above the lowest point, \[m].
    pub height: f64,
    /// Slope h'.
    pub slope: f64,
    /// Second derivative h'', \[1/m], away from kinks.
    pub curvature: f64,
}

impl ProfilePoint {
    /// Where the body has ended.
    pub const ENDED: Self = Self {
        height: f64::INFINITY,
        slope: f64::INFINITY,
        curvature: f64::INFINITY,
    };
}

/// An equivalent line at one position; the default is that of a flat end.
#[derive(Debug, Clone, Copy, Default, PartialEq)]
pub struct LinePoint {
    /// Height h̃, \[m].
    pub height: f64,
    /// Slope h̃'.
    pub slope: f64,
}

impl LinePoint {
    /// Where the body has ended.
    pub const ENDED: Self = Self {
        height: f64::INFINITY,
        slope: f64::INFINITY,
    };
}

/// A body of revolution, given by the height h(r) of its surface above its lowest point.
///
/// Implementors give the profile and its exponent; the equivalent line follows by quadrature, unless there is a closed
/// form. The macro [`surface_of_revolution!`](crate::surface_of_revolution) makes a body of revolution a
/// [`Surface`](crate::Surface).
#[auto_impl(&, Box, Arc)]
pub trait Axisymmetric: Send + Sync {
    /// Height, slope and curvature at a `radius` r ≥ 0 \[m]; [`ProfilePoint::ENDED`] where the body has ended.
    fn profile(&self, radius: f64) -> ProfilePoint;

    /// Leading exponent p of h ∼ c r^p at the apex; `+∞` for a flat end.
    fn profile_exponent(&self) -> f64;

    /// Radius at which the body ends, \[m]; `+∞` if it does not.
    fn max_radius(&self) -> f64 {
        f64::INFINITY
    }

    /// Jumps of slope or curvature inside the body, by increasing radius.
    fn kinks(&self) -> Vec<Kink> {
        Vec::new()
    }

    /// The equivalent line at a position x ≥ 0 \[m] for bodies with a closed form.
    fn closed_line(&self, _x: f64) -> Option<LinePoint> {
        None
    }

    /// Radius at which the equivalent line has a height > 0, \[m], for bodies with a closed form of it.
    fn closed_radius(&self, _height: f64) -> Option<f64> {
        None
    }

    /// Height h(r) above the lowest point, \[m], at a `radius` r ≥ 0 \[m]; `+∞` where the body has ended.
    fn profile_height(&self, radius: f64) -> f64 {
        self.profile(radius).height
    }

    /// Slope h'(r), at a `radius` r with 0 < r < [`max_radius`](Self::max_radius).
    fn profile_slope(&self, radius: f64) -> f64 {
        self.profile(radius).slope
    }

    /// Height of the equivalent line h̃(x), \[m]; even in x, `+∞` where the body has ended.
    fn line_height(&self, x: f64) -> f64 {
        let x = x.abs();
        let closed = self.closed_line(x).map(|line| line.height);
        closed.unwrap_or_else(|| abel_height(self, x))
    }

    /// Slope of the equivalent line h̃'(x); odd in x.
    ///
    /// At a kink it is the slope on the side of the apex: on the other side the line is singular, like the inverse root of
    /// the distance. At the apex itself it is the slope towards positive x.
    fn line_slope(&self, x: f64) -> f64 {
        let closed = self.closed_line(x.abs()).map(|line| line.slope);
        x.signum() * closed.unwrap_or_else(|| abel_slope(self, x.abs()))
    }

    /// Height of the equivalent line h̃(x), \[m].
    ///
    /// # Errors
    /// [`IndenterError::OutOfDomain`] when `x` is not a number or the body has ended before |x|.
    fn checked_line_height(&self, x: f64) -> Result<f64, IndenterError> {
        let (radius, upper) = (x.abs(), self.max_radius());
        // A body of finite radius without a finite height there (the sphere at its equator) has ended.
        if radius <= upper && self.profile_height(radius).is_finite() {
            return Ok(self.line_height(radius));
        }
        Err(IndenterError::OutOfDomain {
            position: radius,
            lower: 0.0,
            upper,
        })
    }
}

/// The transform by quadrature at x ≥ 0: with r = x sin φ the root under the integral disappears,
/// h̃(x) = x ∫₀^{π/2} h'(x sin φ) dφ.
///
/// This is what [`Axisymmetric::line_height`] does where there is no closed form.
pub fn abel_height(body: &(impl Axisymmetric + ?Sized), x: f64) -> f64 {
    if x > body.max_radius() {
        return f64::INFINITY;
    }
    if x == 0.0 {
        return 0.0;
    }
    x * quarter_turn(body, x, |radius| body.profile_slope(radius))
}

/// The derivative of the transform by quadrature at x ≥ 0: a kink of h' at b adds Δh' b / √(x² − b²) to
/// ∫₀^{π/2} (h' + r h'')(x sin φ) dφ.
///
/// This is what [`Axisymmetric::line_slope`] does where there is no closed form.
pub fn abel_slope(body: &(impl Axisymmetric + ?Sized), x: f64) -> f64 {
    if x > body.max_radius() {
        return f64::INFINITY;
    }
    if x == 0.0 {
        return apex_slope(body);
    }
    let smooth = quarter_turn(body, x, |r| slope_of_moment(body, r));
    let kinks = body.kinks().into_iter().filter(|kink| kink.radius < x);
    let leg = |b: f64| ((x - b) * (x + b)).sqrt();
    let singular = kinks.map(|kink| kink.slope_jump * kink.radius / leg(kink.radius));
    smooth + singular.sum::<f64>()
}

/// (r h')' = h' + r h''.
fn slope_of_moment(body: &(impl Axisymmetric + ?Sized), r: f64) -> f64 {
    let point = body.profile(r);
    let change = r * point.curvature;
    if change.is_finite() {
        return point.slope + change;
    }
    // Close to a sharp apex h'' overflows before r h'' does; there h' ∼ r^(p−1).
    point.slope * body.profile_exponent()
}

/// h̃'(+0), from the leading exponent.
fn apex_slope(body: &(impl Axisymmetric + ?Sized)) -> f64 {
    match body.profile_exponent() {
        sharp if sharp < 1.0 => f64::INFINITY,
        blunt if blunt > 1.0 => 0.0,
        _ => FRAC_PI_2 * body.profile_slope(f64::MIN_POSITIVE),
    }
}

/// ∫₀^{π/2} f(x sin φ) dφ, split where the radius passes a kink.
fn quarter_turn(
    body: &(impl Axisymmetric + ?Sized),
    x: f64,
    integrand: impl Fn(f64) -> f64,
) -> f64 {
    let mut radii = vec![0.0];
    radii.extend(body.kinks().iter().map(|kink| kink.radius));
    radii.retain(|radius| *radius < x);
    radii.push(x);
    let ring = |ends: &[f64]| part_of_turn(x, [ends[0], ends[1]], &integrand);
    radii.windows(2).map(ring).sum()
}

/// ∫ f(x sin φ) dφ over a ring without kinks.
///
/// Integrated over ψ = π/2 − φ, because a kink close to x is known precisely as the small angle ψ = arccos(b / x).
fn part_of_turn(x: f64, [inner, outer]: [f64; 2], integrand: impl Fn(f64) -> f64) -> f64 {
    // Rounding must not carry a radius across the kink, nor an underflow to the apex, where slopes may be infinite.
    let range = [inner.next_up().max(f64::MIN_POSITIVE), outer.next_down()];
    let inside = |radius: f64| integrand(radius.max(range[0]).min(range[1]));
    let at = |end: f64, offset: f64| {
        if end >= FRAC_PI_2 {
            inside(x * offset.abs().sin())
        } else {
            inside(x * (end + offset).cos())
        }
    };
    let angles = [arc_cosine(outer, x), arc_cosine(inner, x)];
    integrate_from_ends(at, angles, 1e-14).value
}
