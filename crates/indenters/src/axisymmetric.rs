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
    /// Radius of the jump, \[m].
    pub radius: f64,
    /// Jump h'(r + 0) − h'(r − 0) of the slope; zero if only the curvature jumps.
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
    /// Value of a profile beyond the end of the body, where height, slope and curvature are infinite.
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
    /// Value of an equivalent line beyond the end of the body, where height and slope are infinite.
    pub const ENDED: Self = Self {
        height: f64::INFINITY,
        slope: f64::INFINITY,
    };
}

/// A body of revolution, given by the height h(r) of its surface above its lowest point.
///
/// Only the profile and its exponent must be implemented; the equivalent line follows by quadrature unless a closed form
/// is given. The macro [`surface_of_revolution!`](crate::surface_of_revolution) implements [`Surface`](crate::Surface) for
/// the body.
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

    /// Radius beyond which the equivalent line only rises, \[m]: up to it the body may come down again outside a contact.
    ///
    /// The default is the end of the body, and 0 for an endless one, which is taken to rise outside its contact.
    fn falling_up_to(&self) -> f64 {
        Some(self.max_radius())
            .filter(|end| end.is_finite())
            .unwrap_or_default()
    }

    /// Jumps of slope or curvature inside the body, by increasing radius.
    fn kinks(&self) -> Vec<Kink> {
        Vec::new()
    }

    /// Closed form of the equivalent line at a position x ≥ 0 \[m]; `None` if there is none.
    fn closed_line(&self, _x: f64) -> Option<LinePoint> {
        None
    }

    /// Closed form of the radius at which the equivalent line has a height > 0, \[m]; `None` if there is none.
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
    /// At a kink it is the slope on the side of the apex, because on the other side it has an inverse square root
    /// singularity. At the apex it is the slope towards positive x.
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

/// Height of the equivalent line at x ≥ 0 by quadrature, h̃(x) = x ∫₀^{π/2} h'(x sin φ) dφ.
///
/// The substitution r = x sin φ removes the square root of the integrand. [`Axisymmetric::line_height`] calls this function
/// if there is no closed form.
pub fn abel_height(body: &(impl Axisymmetric + ?Sized), x: f64) -> f64 {
    if x > body.max_radius() {
        return f64::INFINITY;
    }
    if x == 0.0 {
        return 0.0;
    }
    x * integrate_quarter_turn(body, x, |radius| body.profile_slope(radius))
}

/// Slope of the equivalent line at x ≥ 0 by quadrature, h̃'(x) = ∫₀^{π/2} (h' + r h'')(x sin φ) dφ + Σ Δh' b / √(x² − b²).
///
/// The sum is over the kinks with radius b < x. [`Axisymmetric::line_slope`] calls this function if there is no closed form.
pub fn abel_slope(body: &(impl Axisymmetric + ?Sized), x: f64) -> f64 {
    if x > body.max_radius() {
        return f64::INFINITY;
    }
    if x == 0.0 {
        return apex_slope(body);
    }
    // Integrate the smooth part of the slope by quadrature, and add the inverse square root that each kink of the profile
    // contributes behind it.
    let smooth = integrate_quarter_turn(body, x, |r| moment_slope(body, r));
    let kinks = body.kinks().into_iter().filter(|kink| kink.radius < x);
    let leg = |b: f64| ((x - b) * (x + b)).sqrt();
    let singular = kinks.map(|kink| kink.slope_jump * kink.radius / leg(kink.radius));
    smooth + singular.sum::<f64>()
}

/// Derivative (r h')' = h' + r h'' of the moment r h' at a radius r \[m].
fn moment_slope(body: &(impl Axisymmetric + ?Sized), r: f64) -> f64 {
    let point = body.profile(r);
    let change = r * point.curvature;
    if change.is_finite() {
        return point.slope + change;
    }
    // Use the leading power close to a sharp apex, where h'' overflows before r h'' does: from h' ∼ r^(p−1) follows (r h')' = p
    // h'.
    point.slope * body.profile_exponent()
}

/// Slope h̃'(+0) at the apex, from the leading exponent.
fn apex_slope(body: &(impl Axisymmetric + ?Sized)) -> f64 {
    match body.profile_exponent() {
        sharp if sharp < 1.0 => f64::INFINITY,
        blunt if blunt > 1.0 => 0.0,
        _ => FRAC_PI_2 * body.profile_slope(f64::MIN_POSITIVE),
    }
}

/// Integral ∫₀^{π/2} f(x sin φ) dφ of an integrand f of the radius \[m], split at the kinks of the body.
fn integrate_quarter_turn(
    body: &(impl Axisymmetric + ?Sized),
    x: f64,
    integrand: impl Fn(f64) -> f64,
) -> f64 {
    let mut radii = vec![0.0];
    radii.extend(body.kinks().iter().map(|kink| kink.radius));
    radii.retain(|radius| *radius < x);
    radii.push(x);
    let ring = |ends: &[f64]| integrate_ring(x, [ends[0], ends[1]], &integrand);
    radii.windows(2).map(ring).sum()
}

/// Integral ∫ f(x sin φ) dφ over a ring without kinks.
///
/// The variable is ψ = π/2 − φ, because the small angle ψ = arccos(b / x) of a kink close to x has no cancellation.
fn integrate_ring(x: f64, [inner, outer]: [f64; 2], integrand: impl Fn(f64) -> f64) -> f64 {
    // Keep rounded radii off the kinks, and underflowing ones off the apex, where slopes may be infinite.
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
