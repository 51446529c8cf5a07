//! Bodies of revolution and their equivalent lines.
//!
//! ```text
//! h̃(x) = |x| ∫₀^|x| h'(r) / √(x² − r²) dr        (Heß 2011; Kürschner 2014, Eq. 8 for powers)
//! ```

use std::f64::consts::FRAC_PI_2;

use crate::IndenterError;
use crate::forward::forward;
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

/// A body of revolution, given by the height h(r) of its surface above its lowest point.
///
/// Implementors give the profile and two derivatives; the equivalent line follows by quadrature. Shapes with a closed
/// form override [`line_height`](Self::line_height) and [`line_slope`](Self::line_slope). The macro
/// [`surface_of_revolution!`](crate::surface_of_revolution) makes a body of revolution a [`Surface`](crate::Surface).
pub trait Axisymmetric: Send + Sync {
    /// Height h(r) above the lowest point, \[m], at a `radius` r ≥ 0 \[m]; `+∞` where the body has ended.
    fn profile_height(&self, radius: f64) -> f64;

    /// Slope h'(r), at a `radius` r with 0 < r < [`max_radius`](Self::max_radius).
    fn profile_slope(&self, radius: f64) -> f64;

    /// Second derivative h''(r), \[1/m], away from kinks.
    fn profile_curvature(&self, radius: f64) -> f64;

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

    /// Height of the equivalent line h̃(x), \[m]; even in x, `+∞` where the body has ended.
    fn line_height(&self, x: f64) -> f64 {
        abel_height(self, x)
    }

    /// Slope of the equivalent line h̃'(x); odd in x.
    ///
    /// At a kink it is the slope on the side of the apex: on the other side the line is singular, like the inverse root of
    /// the distance. At the apex itself it is the slope towards positive x.
    fn line_slope(&self, x: f64) -> f64 {
        abel_slope(self, x)
    }

    /// Height h(r), \[m].
    ///
    /// # Errors
    /// [`IndenterError::OutOfDomain`] when `radius` is negative, not a number, or the body has ended before it.
    fn checked_height(&self, radius: f64) -> Result<f64, IndenterError> {
        within(self, radius).map(|radius| self.profile_height(radius))
    }

    /// Height of the equivalent line h̃(x), \[m].
    ///
    /// # Errors
    /// [`IndenterError::OutOfDomain`] when `x` is not a number or the body has ended before |x|.
    fn checked_line_height(&self, x: f64) -> Result<f64, IndenterError> {
        within(self, x.abs()).map(|radius| self.line_height(radius))
    }
}

forward!(Axisymmetric, {
    fn profile_height(&self, radius: f64) -> f64;
    fn profile_slope(&self, radius: f64) -> f64;
    fn profile_curvature(&self, radius: f64) -> f64;
    fn profile_exponent(&self) -> f64;
    fn max_radius(&self) -> f64;
    fn kinks(&self) -> Vec<Kink>;
    fn line_height(&self, x: f64) -> f64;
    fn line_slope(&self, x: f64) -> f64;
});

fn within(body: &(impl Axisymmetric + ?Sized), radius: f64) -> Result<f64, IndenterError> {
    let upper = body.max_radius();
    // A body of finite radius without a finite height there (the sphere at its equator) has ended.
    if radius >= 0.0 && radius <= upper && body.profile_height(radius).is_finite() {
        return Ok(radius);
    }
    Err(IndenterError::OutOfDomain {
        position: radius,
        lower: 0.0,
        upper,
    })
}

/// The transform by quadrature: with r = x sin φ the root under the integral disappears,
/// h̃(x) = x ∫₀^{π/2} h'(x sin φ) dφ.
///
/// This is what [`Axisymmetric::line_height`] does unless a shape overrides it.
pub fn abel_height(body: &(impl Axisymmetric + ?Sized), x: f64) -> f64 {
    let x = x.abs();
    if x > body.max_radius() {
        return f64::INFINITY;
    }
    if x == 0.0 {
        return 0.0;
    }
    x * quarter_turn(body, x, |radius| body.profile_slope(radius))
}

/// The derivative of the transform by quadrature: a kink of h' at b adds Δh' b / √(x² − b²) to
/// ∫₀^{π/2} (h' + r h'')(x sin φ) dφ.
///
/// This is what [`Axisymmetric::line_slope`] does unless a shape overrides it.
pub fn abel_slope(body: &(impl Axisymmetric + ?Sized), x: f64) -> f64 {
    let radius = x.abs();
    if radius > body.max_radius() {
        return x.signum() * f64::INFINITY;
    }
    if radius == 0.0 {
        return x.signum() * apex_slope(body);
    }
    let smooth = quarter_turn(body, radius, |r| slope_of_moment(body, r));
    let kinks: f64 = body
        .kinks()
        .iter()
        .filter(|kink| kink.radius < radius)
        .map(|kink| {
            kink.slope_jump * kink.radius / ((radius - kink.radius) * (radius + kink.radius)).sqrt()
        })
        .sum();
    x.signum() * (smooth + kinks)
}

/// (r h')' = h' + r h''.
fn slope_of_moment(body: &(impl Axisymmetric + ?Sized), r: f64) -> f64 {
    let slope = body.profile_slope(r);
    let change = r * body.profile_curvature(r);
    if change.is_finite() {
        return slope + change;
    }
    // Close to a sharp apex h'' overflows before r h'' does; there h' ∼ r^(p−1).
    slope * body.profile_exponent()
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
