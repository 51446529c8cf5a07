//! Normal indentation of a viscous half space without sliding, exact in three dimensions as well.
//!
//! ```text
//! ∫ F_N dt = 8 η ∫₀^a x h̃'(x) dx = 8 η ∫₀^a h'(r) r² / √(a² − r²) dr,     d = h̃(a)
//! ```
//! h(r) is the profile of the body, h̃(x) its equivalent line, a the contact radius, d the depth, and η the viscosity.
//!
//! The force enters only through its impulse, and every force F(t) ≥ 0 is allowed (Kürschner & Filippov 2012, Phys. Mesomech.
//! 15, 270, for power profiles; Radok 1957 for the principle). While the force vanishes, the body rests. The solvers are
//! compared with it in docs/theory/transient-half-space.md, "Pressing without sliding".

use std::f64::consts::PI;

use indenters::{Axisymmetric, Cylinder, IndenterError, PowerProfile, contact_radius};
use numerics::{Estimate, bracketed_root, golden_section, in_range, not_negative, positive};
use rheology::Viscous;

use crate::FrictionError;
use crate::error::{out_of_range, representable};
use crate::pieces::{accept_accurate, ends_outside_apex, integrate_pieces};
use crate::stationary::quotient;

/// Contact radius and depth of a body pressed into a half space without sliding.
#[derive(Debug, Clone, Copy, Default, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize))]
#[must_use]
pub struct Indentation {
    /// Radius a of the contact circle, \[m].
    pub contact_radius: f64,
    /// Indentation depth d, \[m].
    pub indentation_depth: f64,
}

/// Contact of a power profile after an `impulse` ∫ F_N dt ≥ 0 \[N s], in closed form:
/// `a^(p+1) = (1 + 1/p) I/(8 η κ c)`, `d = (1 + 1/p) I/(8 η a)`.
///
/// # Errors
/// [`FrictionError::InvalidParameter`] for an impulse that is negative or not finite; [`FrictionError::OutOfRange`] when
/// a result overflows or underflows.
pub fn power_indentation_after_impulse(
    profile: &PowerProfile,
    material: &Viscous,
    impulse: f64,
) -> Result<Indentation, FrictionError> {
    if not_negative("impulse", impulse)? == 0.0 {
        return Ok(Indentation::default());
    }
    let p = profile.exponent();
    let eta = material.viscosity();
    // The radius is computed in logarithms, because for large p the power a^(p+1) overflows long before a does.
    let log_stiffness =
        (8.0 * p / (p + 1.0)).ln() + eta.ln() + profile.stretch().ln() + profile.coefficient().ln();
    let radius = representable(
        "contact radius",
        ((impulse.ln() - log_stiffness) / (p + 1.0)).exp(),
    )?;
    let depth = 0.125 * (1.0 + p.recip()) * quotient(impulse, eta, radius);
    Ok(Indentation {
        contact_radius: radius,
        indentation_depth: representable("indentation depth", depth)?,
    })
}

/// Contact of any body of revolution after an `impulse` ∫ F_N dt ≥ 0 \[N s]; for a constant force, force times time.
///
/// Without an impulse there is no contact: both results are 0, also for a flat end.
///
/// # Errors
/// [`FrictionError::InvalidParameter`] for an impulse that is negative or not finite; [`FrictionError::Indenter`] when
/// the line of the body turns downwards or ends inside the contact; [`FrictionError::BeyondEdge`] when the contact would
/// reach a vertical edge, as the equator of a sphere; [`FrictionError::OutOfRange`] when no contact carries the impulse,
/// because the line falls without limit; [`FrictionError::NotConverged`] when the integral is known to less than ten digits.
pub fn indentation_after_impulse(
    body: &dyn Axisymmetric,
    material: &Viscous,
    impulse: f64,
) -> Result<Indentation, FrictionError> {
    if not_negative("impulse", impulse)? == 0.0 {
        return Ok(Indentation::default());
    }
    // The contact radius a solves moment(a) = I/(8 η), where I is the impulse.
    let target = representable("impulse over 8 η", 0.125 * impulse / material.viscosity())?;
    let Some(radius) = radius_of_moment(body, target)? else {
        // Beyond the largest moment only a flat punch sinks further; any other body is not high enough.
        let end = largest_contact(body);
        let depth = body.line_height(end) + (target - moment(body, end).value) / end;
        return Ok(Indentation {
            contact_radius: contact_radius(body, depth)?,
            indentation_depth: depth,
        });
    };
    // Refuse a moment whose error is too large.
    checked_moment(body, radius)?;
    let depth = representable("indentation depth", body.line_height(radius))?;
    // `contact_radius` refuses a line that turns downwards inside the contact.
    contact_radius(body, depth)?;
    Ok(Indentation {
        contact_radius: radius,
        indentation_depth: depth,
    })
}

/// Impulse ∫ F_N dt \[N s] that presses a body to an indentation `depth` > 0 \[m]; over a constant force, the time.
///
/// # Errors
/// [`FrictionError::Indenter`] when the depth is out of its range or the line of the body turns downwards or ends before
/// it; [`FrictionError::BeyondEdge`] and [`FrictionError::NotConverged`] like [`indentation_after_impulse`].
pub fn impulse_to_depth(
    body: &dyn Axisymmetric,
    material: &Viscous,
    depth: f64,
) -> Result<f64, FrictionError> {
    let radius = contact_radius(body, depth)?;
    let moment = checked_moment(body, radius)?;
    // `punch_moment` is 0 up to rounding except for a flat punch, which sinks with a constant contact.
    let punch_moment = radius * (depth - body.line_height(radius));
    representable(
        "impulse",
        8.0 * material.viscosity() * (moment + punch_moment),
    )
}

/// Half the width b of the contact of a cylinder \[m] in plane strain after an impulse per length ∫ F' dt ≥ 0 \[N s/m]:
/// `π η b²/R = ∫ F' dt`.
///
/// This is the elastic contact `π G b²/R = F'` (Hertz 1881) with the viscosity in the place of the modulus, as long as the
/// contact grows (Lee & Radok 1960). There is no depth: it grows with the logarithm of the length of the cylinder.
///
/// # Errors
/// [`FrictionError::InvalidParameter`] for an impulse that is negative or not finite; [`FrictionError::OutOfRange`] when
/// the result overflows or underflows.
pub fn cylinder_half_width_after_impulse(
    cylinder: &Cylinder,
    material: &Viscous,
    impulse_per_length: f64,
) -> Result<f64, FrictionError> {
    if not_negative("impulse_per_length", impulse_per_length)? == 0.0 {
        return Ok(0.0);
    }
    // The roots of the factors are taken first, because the product of the factors may overflow where b does not.
    let roots = [impulse_per_length, cylinder.radius()].map(f64::sqrt);
    let divisors = [PI, material.viscosity()].map(f64::sqrt);
    let half_width = roots[0] / divisors[0] / divisors[1] * roots[1];
    representable("half width", half_width)
}

/// Pressure under a body that is pressed without sliding, divided by the modulus G/(2 (1 − ν)) of an elastic half space.
///
/// At a `radius` r inside the contact \[m] and an indentation `depth` d > 0 \[m] it is (Sneddon 1965, Int. J. Eng. Sci. 3, 47)
/// `(4/π) [∫_r^a h̃'(x)/√(x² − r²) dx + (d − h̃(a))/√(a² − r²)]`.
///
/// On a viscous half space it is the impulse per area ∫ p dt since first touch, divided by the viscosity.
///
/// # Errors
/// Like [`impulse_to_depth`]; [`FrictionError::InvalidParameter`] for a radius outside the contact, or under the tip of a
/// body as sharp as a cone, where the pressure is infinite; [`FrictionError::NotConverged`] when the integral is known to
/// less than ten digits, as it is below a body with a flat end and a flank.
pub fn indentation_pressure(
    body: &dyn Axisymmetric,
    depth: f64,
    radius: f64,
) -> Result<f64, FrictionError> {
    let contact = contact_radius(body, depth)?;
    // Check that the pressure is finite at this radius.
    let is_finite = radius > 0.0 || body.profile_exponent() > 1.0;
    let is_allowed = (0.0..contact).contains(&radius) && is_finite;
    let allowed = "inside the contact, and not at a tip";
    in_range("radius", radius, is_allowed, allowed)?;
    let root = |x: f64| ((x - radius) * (x + radius)).sqrt();
    let kinks_and_contact = ends_outside_apex(body, contact).into_iter();
    let ends = [radius]
        .into_iter()
        .chain(kinks_and_contact.filter(|end| *end > radius));
    // x = r cosh t removes the root in the denominator; at r = 0 there is none.
    let angle = |x: f64| (root(x) / radius).asinh();
    let over_angle = |t: f64| body.line_slope((radius * t.cosh()).min(contact));
    let integral = if radius > 0.0 {
        integrate_pieces(over_angle, &ends.map(angle).collect::<Vec<f64>>())
    } else {
        integrate_pieces(|x| body.line_slope(x) / x, &ends.collect::<Vec<f64>>())
    };
    let smooth_part = accept_accurate("pressure", integral)?.value;
    let punch_part = (depth - body.line_height(contact)) / root(contact);
    Ok(4.0 / PI * (smooth_part + punch_part))
}

/// Largest pressure under a power profile with p > 1 and a `contact_radius` a \[m], divided by the modulus G/(2 (1 − ν)) as in
/// [`indentation_pressure`]: `(4/π) p h̃(a)/a` times the maximum of
///
/// ```text
/// f(ρ) = ∫_ρ^1 x^(p−1)/√(x² − ρ²) dx = l ∫₀^1 (1 − l² (1 − s²))^(p/2 − 1) ds,   l² = 1 − ρ²
/// ```
///
/// which is f(0) = 1/(p − 1) for p ≤ 2. For p > 2 the maximum lies off the axis: `ρ f' = (p − 1) f − 1/l` makes
/// `f'' = −1/l³` wherever f' = 0, so that there is only one.
///
/// # Errors
/// [`FrictionError::InvalidParameter`] for p ≤ 1, whose pressure is infinite at the tip, and a radius that is no positive
/// number; [`FrictionError::OutOfRange`] when the result overflows or underflows.
pub fn power_peak_pressure(
    profile: &PowerProfile,
    contact_radius: f64,
) -> Result<f64, FrictionError> {
    let p = profile.exponent();
    in_range("exponent", p, p > 1.0, "above 1")?;
    let radius = positive("contact_radius", contact_radius)?;
    // `f` is the function f(ρ) of the formula above, with l = √(1 − ρ²) as its argument.
    let f = |l: f64| {
        let log_integrand = |s: f64| (0.5 * p - 1.0) * (-l * l * (1.0 - s) * (1.0 + s)).ln_1p();
        l * integrate_pieces(|s| log_integrand(s).exp(), &[0.0, 1.0]).value
    };
    // On the axis f is 1/(p − 1); for p > 2 the maximum lies off the axis, where it is searched for.
    let mut maximum = (p - 1.0).recip();
    if p > 2.0 {
        let l = golden_section(|l| -f(l), [0.0, 1.0]);
        maximum = maximum.max(f(l));
    }
    let slope = profile.line_height(radius) / radius;
    representable("peak pressure", 4.0 / PI * (p * maximum) * slope)
}

/// Contact moment ∫₀^a x h̃' dx = ∫₀^a (h̃(a) − h̃(x)) dx, \[m²], from the profile without the line.
///
/// With r = a cos ψ it is a² ∫ h'(a cos ψ) cos²ψ dψ, which needs no difference of heights.
fn moment(body: &dyn Axisymmetric, radius: f64) -> Estimate {
    let integrand = |psi: f64| {
        let cosine = psi.cos();
        body.profile_slope(radius * cosine) * cosine * cosine
    };
    let angle = |b: f64| ((radius - b) * (radius + b)).sqrt().atan2(b);
    // The pieces of the integral go from the contact boundary at ψ = 0 to the apex at ψ = π/2, with kinks of the body in
    // between.
    let radii = ends_outside_apex(body, radius).into_iter().rev();
    let angles: Vec<f64> = radii.chain([0.0]).map(angle).collect();
    let angular = integrate_pieces(integrand, &angles);
    // The radius is multiplied one factor at a time, because its square alone underflows for small bodies.
    angular * radius * radius
}

/// Contact moment of a body at a radius, \[m²]; fails if its relative error is larger than is accepted.
pub(crate) fn checked_moment(body: &dyn Axisymmetric, radius: f64) -> Result<f64, FrictionError> {
    let end = body.max_radius();
    match accept_accurate("contact moment", moment(body, radius)) {
        Err(_) if end.is_finite() && body.line_height(end).is_infinite() => {
            Err(FrictionError::BeyondEdge { radius: end })
        }
        moment => Ok(moment?.value),
    }
}

/// Radius of the largest contact of a body, \[m]: its end, or the radius at which its line turns downwards before.
fn largest_contact(body: &dyn Axisymmetric) -> f64 {
    let end = body.max_radius();
    // An endless line need not be followed to infinity: a contact in which it turns downwards is refused when it is found.
    match end.is_finite().then(|| contact_radius(body, f64::MAX)) {
        Some(Err(IndenterError::NonMonotoneLine {
            limiting_radius, ..
        })) => limiting_radius,
        _ => end,
    }
}

/// The contact radius whose moment is `target` \[m²], or `None` if that of the largest contact is smaller.
fn radius_of_moment(body: &dyn Axisymmetric, target: f64) -> Result<Option<f64>, FrictionError> {
    let end = largest_contact(body);
    // A body that ends with a vertical edge, such as a sphere, has an infinite moment there, whatever the quadrature gives.
    let has_vertical_edge = end.is_finite() && body.line_height(end).is_infinite();
    // The moment grows with the radius: bracket its target, and solve.
    let moment_excess = |radius: f64| {
        if has_vertical_edge && radius >= end {
            return f64::INFINITY;
        }
        moment(body, radius).value - target
    };
    let bracket = if end.is_infinite() {
        bracket(&moment_excess)
    } else if moment_excess(end) < 0.0 {
        return Ok(None);
    } else {
        [0.0, end]
    };
    let overflow = out_of_range("contact radius", bracket[1]);
    bracketed_root(moment_excess, bracket)
        .ok_or(overflow)
        .map(Some)
}

/// Factor between two radii of the search for a bracket. Chosen; it changes the number of evaluations only: the root is the same.
const BRACKET_FACTOR: f64 = 64.0;

/// Two radii \[m] between which the excess of the moment changes its sign.
///
/// The search starts at 1 m for lack of a scale, and reaches every representable radius.
fn bracket(moment_excess: &impl Fn(f64) -> f64) -> [f64; 2] {
    let mut upper = 1.0;
    while moment_excess(upper) < 0.0 && upper < f64::MAX / BRACKET_FACTOR {
        upper *= BRACKET_FACTOR;
    }
    let mut lower = upper / BRACKET_FACTOR;
    while moment_excess(lower) > 0.0 && lower > f64::MIN_POSITIVE {
        upper = lower;
        lower /= BRACKET_FACTOR;
    }
    [lower, upper]
}
