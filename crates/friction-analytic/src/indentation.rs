//! Normal indentation of a viscous half space without sliding; exact in three dimensions too.
//!
//! ```text
//! ∫ F_N dt = 8 η ∫₀^a x h̃'(x) dx = 8 η ∫₀^a h'(r) r² / √(a² − r²) dr,     d = h̃(a)
//! ```
//!
//! So force enters only through its impulse, and any force F(t) ≥ 0 is allowed (Kürschner & Filippov 2012, Phys. Mesomech.
//! 15, 270, for power profiles; Radok 1957 for the principle). Where the force vanishes, the body rests.

use std::f64::consts::PI;

use indenters::{Axisymmetric, Cylinder, PowerProfile, contact_radius};
use numerics::{Estimate, bracketed_root, golden_section, in_range, not_negative, positive};
use rheology::Viscous;

use crate::FrictionError;
use crate::error::{out_of_range, representable};
use crate::pieces::{accepted, ends_outside_apex, over_pieces};
use crate::stationary::quotient;

/// The contact of a body pressed into a half space without sliding.
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
    // In logarithms, because for large p the power a^(p+1) overflows long before a does.
    let stiffness =
        (8.0 * p / (p + 1.0)).ln() + eta.ln() + profile.stretch().ln() + profile.coefficient().ln();
    let radius = ((impulse.ln() - stiffness) / (p + 1.0)).exp();
    let radius = representable("contact radius", radius)?;
    let depth = 0.125 * (1.0 + p.recip()) * quotient(impulse, [eta, radius]);
    Ok(Indentation {
        contact_radius: radius,
        indentation_depth: representable("indentation depth", depth)?,
    })
}

/// Contact of any body of revolution after an `impulse` ∫ F_N dt ≥ 0 \[N s]; for a constant force, force times time.
///
/// No impulse, no contact: both results are zero then, also for a flat end.
///
/// # Errors
/// [`FrictionError::InvalidParameter`] for an impulse that is negative or not finite; [`FrictionError::Indenter`] when
/// the line of the body turns downwards or ends inside the contact; [`FrictionError::BeyondEdge`] when the contact would
/// reach a vertical edge, as the equator of a sphere; [`FrictionError::OutOfRange`] when no contact takes as much, because
/// the line falls without limit; [`FrictionError::NotConverged`] when the integral is known to less than ten digits.
pub fn indentation_after_impulse(
    body: &dyn Axisymmetric,
    material: &Viscous,
    impulse: f64,
) -> Result<Indentation, FrictionError> {
    if not_negative("impulse", impulse)? == 0.0 {
        return Ok(Indentation::default());
    }
    let target = representable("impulse over 8 η", 0.125 * impulse / material.viscosity())?;
    let Some(radius) = radius_of_moment(body, target)? else {
        // Beyond the moment of the whole body only a flat punch goes on; any other one is not high enough.
        let end = body.max_radius();
        let depth = body.line_height(end) + (target - moment(body, end).value) / end;
        return Ok(Indentation {
            contact_radius: contact_radius(body, depth)?,
            indentation_depth: depth,
        });
    };
    known_moment(body, radius)?;
    let depth = representable("indentation depth", body.line_height(radius))?;
    // Refuses a line that turns down before.
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
    let moment = known_moment(body, radius)?;
    // Zero up to rounding except for a flat punch, which sinks with a constant contact.
    let beyond = radius * (depth - body.line_height(radius));
    representable("impulse", 8.0 * material.viscosity() * (moment + beyond))
}

/// Half the width b of the contact of a cylinder \[m] in plane strain after an impulse per length ∫ F' dt ≥ 0 \[N s/m]:
/// `π η b²/R = ∫ F' dt`.
///
/// This is the elastic contact `π G b²/R = F'` (Hertz 1881) with the viscosity in the place of the modulus, as long as the
/// contact grows (Lee & Radok 1960). A depth does not exist: it grows with the logarithm of the length of the cylinder.
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
    // Roots of the factors, because their product may overflow where b does not.
    let roots = [impulse_per_length, cylinder.radius()].map(f64::sqrt);
    let divisors = [PI, material.viscosity()].map(f64::sqrt);
    let half_width = roots[0] / divisors[0] / divisors[1] * roots[1];
    representable("half width", half_width)
}

/// Pressure at a `radius` r below that of the contact, under a body that is pressed without sliding to an indentation
/// `depth` > 0 \[m], over the modulus G/(2 (1 − ν)) of an elastic half space (Sneddon 1965, Int. J. Eng. Sci. 3, 47):
/// `(4/π) [∫_r^a h̃'(x)/√(x² − r²) dx + (d − h̃(a))/√(a² − r²)]`.
///
/// On a viscous half space it is the impulse per area ∫ p dt since first touch, over the viscosity.
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
    let blunt = radius > 0.0 || body.profile_exponent() > 1.0;
    let inside = (0.0..contact).contains(&radius) && blunt;
    let allowed = "inside the contact, and not at a tip";
    in_range("radius", radius, inside, allowed)?;
    let leg = |x: f64| ((x - radius) * (x + radius)).sqrt();
    let ends = ends_outside_apex(body, contact).into_iter();
    let ends = [radius].into_iter().chain(ends.filter(|end| *end > radius));
    // x = r cosh t removes the root, and there is none at r = 0.
    let angle = |x: f64| (leg(x) / radius).asinh();
    let over_angle = |t: f64| body.line_slope((radius * t.cosh()).min(contact));
    let integral = if radius > 0.0 {
        over_pieces(over_angle, &ends.map(angle).collect::<Vec<f64>>())
    } else {
        over_pieces(|x| body.line_slope(x) / x, &ends.collect::<Vec<f64>>())
    };
    let smooth = accepted("pressure", integral)?.value;
    let punch = (depth - body.line_height(contact)) / leg(contact);
    Ok(4.0 / PI * (smooth + punch))
}

/// Largest pressure under a power profile with p > 1 that touches up to a `contact_radius` a, in the unit of
/// [`indentation_pressure`]: `(4/π) p h̃(a)/a` times the largest of
///
/// ```text
/// f(ρ) = ∫_ρ^1 x^(p−1)/√(x² − ρ²) dx = l ∫₀^1 (1 − l² (1 − s²))^(p/2 − 1) ds,   l² = 1 − ρ²
/// ```
///
/// which is f(0) = 1/(p − 1) for p ≤ 2. Above it lies off the axis: `ρ f' = (p − 1) f − 1/l` makes `f'' = −1/l³` wherever
/// f' = 0, so that f has one maximum.
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
    let off_axis = |l: f64| {
        let power = |s: f64| (0.5 * p - 1.0) * (-l * l * (1.0 - s) * (1.0 + s)).ln_1p();
        l * over_pieces(|s| power(s).exp(), &[0.0, 1.0]).value
    };
    let mut largest = (p - 1.0).recip();
    if p > 2.0 {
        let place = golden_section(|l| -off_axis(l), [0.0, 1.0]);
        largest = largest.max(off_axis(place));
    }
    let slope = profile.line_height(radius) / radius;
    representable("peak pressure", 4.0 / PI * (p * largest) * slope)
}

/// ∫₀^a x h̃' dx = ∫₀^a (h̃(a) − h̃(x)) dx, [m²], from the profile alone.
///
/// With r = a cos ψ it is a² ∫ h'(a cos ψ) cos²ψ dψ, which needs neither the line nor a difference of heights.
fn moment(body: &dyn Axisymmetric, radius: f64) -> Estimate {
    let integrand = |psi: f64| {
        let cosine = psi.cos();
        body.profile_slope(radius * cosine) * cosine * cosine
    };
    let angle = |b: f64| ((radius - b) * (radius + b)).sqrt().atan2(b);
    // From the rim at ψ = 0 to the apex at ψ = π/2.
    let radii = ends_outside_apex(body, radius).into_iter().rev();
    let angles: Vec<f64> = radii.chain([0.0]).map(angle).collect();
    let angular = over_pieces(integrand, &angles);
    // One factor at a time, because the square alone underflows for small bodies.
    angular * radius * radius
}

/// The moment, if it is known well enough.
pub(crate) fn known_moment(body: &dyn Axisymmetric, radius: f64) -> Result<f64, FrictionError> {
    let end = body.max_radius();
    match accepted("contact moment", moment(body, radius)) {
        Err(_) if end.is_finite() && body.line_height(end).is_infinite() => {
            Err(FrictionError::BeyondEdge { radius: end })
        }
        moment => Ok(moment?.value),
    }
}

/// The contact radius whose moment is `target`, or `None` when the whole body does not have as much.
fn radius_of_moment(body: &dyn Axisymmetric, target: f64) -> Result<Option<f64>, FrictionError> {
    let end = body.max_radius();
    // A body that never ends in height (the sphere) has an infinite moment at its end, whatever a sum gives there.
    let endless = end.is_finite() && body.line_height(end).is_infinite();
    let excess = |radius: f64| {
        if endless && radius >= end {
            return f64::INFINITY;
        }
        moment(body, radius).value - target
    };
    let bracket = if end.is_infinite() {
        bracket(&excess)
    } else if excess(end) < 0.0 {
        return Ok(None);
    } else {
        [0.0, end]
    };
    let failed = out_of_range("contact radius", bracket[1]);
    bracketed_root(excess, bracket).ok_or(failed).map(Some)
}

/// Two radii between which the moment passes its target. The search starts at 1 m, which stands for "anywhere".
fn bracket(excess: &impl Fn(f64) -> f64) -> [f64; 2] {
    const STEP: f64 = 64.0;
    let mut upper = 1.0;
    while excess(upper) < 0.0 && upper < f64::MAX / STEP {
        upper *= STEP;
    }
    let mut lower = upper / STEP;
    while excess(lower) > 0.0 && lower > f64::MIN_POSITIVE {
        upper = lower;
        lower /= STEP;
    }
    [lower, upper]
}
