//! Sliding of a rigid cylinder on a solid with one relaxation time, in plane strain (Hunter 1961, J. Appl. Mech. 28, 611).
//!
//! Let T = v τ, L = T G(0)/G_∞ the retardation length, and s = (x − x₀)/l in a contact of length 2l around x₀. There
//! u = d − x²/(2R), and the combination q of the pressure removes the history integral:
//!
//! ```text
//! q = p − T p'         (1/π) ∫ q ds/(s₀ − s) = 2 G_∞ (x − L)/(f R),   f = 2 (1 − ν)                              (1)
//! f R q/(2 G_∞) = [l (1 − s²) + (L − x₀) s + C]/√(1 − s²)                                                       (2)
//! ```
//!
//! x₀ and C follow from p = 0 at the rear, ∫ e^(−zs) q ds = 0 with z = l/T, and from the slope of the surface ahead of the
//! front, ∫₁^∞ e^(−ks) [C − x₀ s]/√(s² − 1) ds = 0 with k = l/L. With a = I₁/I₀(z), a₂ = I₂/I₀(z), b = K₀/K₁(k) and
//! D = L − T,
//!
//! ```text
//! x₀ = D a b/(1 + a b)       C = D a/(1 + a b)                                                                  (3)
//! F' = π G_∞ l (l + 2C)/(f R)       μ R = D [2 x₀ a/(1 + a b) + l (a b + a₂)/(1 + a b)]/(l + 2C)                (4)
//! p(s) = z ∫_s^1 e^(−z(σ − s)) q(σ) dσ                                                                          (5)
//! ```
//!
//! No term of (3) and (4) is a difference. (1) to (5) are derived here and numbered as here. Kelvin–Voigt is a = a₂ = 1,
//! T = 0. For G_∞ → 0, Maxwell, the force tends to 2π η v a l/(f R), and x₀ to infinity like l a ln(1/k): there is no
//! stationary state of a fluid in plane strain.

use std::f64::consts::PI;

use indenters::Cylinder;
use numerics::{NEGLIGIBLE_EXPONENT, in_range, integrate, positive};
use rheology::{Material, check_spectra};

use crate::FrictionError;
use crate::error::representable;

/// Number of intervals of the trapezoidal rule in the limit of a short range of integration; longer ranges have
/// [`INTERVALS_PER_UNIT_LENGTH`] more. Chosen so that the Bessel functions have all digits, because the rule converges
/// exponentially. More intervals cost time only.
const MIN_INTERVALS: f64 = 64.0;
/// Number of intervals of the trapezoidal rule, beyond [`MIN_INTERVALS`], per unit of the length of its range. Chosen so that the
/// Bessel functions have all digits; more intervals cost time only.
const INTERVALS_PER_UNIT_LENGTH: f64 = 8.0;
/// Requested relative accuracy of a pressure. Chosen: 450 units in the last place, which the integrand allows; a smaller one
/// would only take more nodes.
const PRESSURE_ACCURACY: f64 = 1e-13;

/// Length and speed of a sliding line contact.
#[derive(Debug, Clone, Copy, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize))]
pub struct LineContact {
    /// Half length l of the contact, \[m].
    pub half_length: f64,
    /// Sliding speed v, \[m/s].
    pub velocity: f64,
}

/// Stationary sliding of a cylinder in plane strain.
#[derive(Debug, Clone, Copy, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize))]
#[must_use]
pub struct CylinderSliding {
    /// Rear and front of the contact relative to the lowest point of the cylinder, \[m].
    pub contact: [f64; 2],
    /// Normal force per length F', \[N/m].
    pub line_load: f64,
    /// Friction coefficient μ.
    pub friction_coefficient: f64,
    /// Scale of the pressure, 2 G_∞ l/(f R), \[Pa].
    stress: f64,
    /// Relaxation length T/l.
    relaxation: f64,
    /// Strength C/l of the singular part of q at the ends.
    singular: f64,
}

/// Sliding of a rigid cylinder on a three-element solid, Kelvin–Voigt or elastic half space, (3) and (4).
///
/// # Errors
/// [`FrictionError::InvalidParameter`] for a length or speed that is not positive, a material that flows, or more than one
/// relaxing element; [`FrictionError::OutOfRange`] when a result overflows or underflows. An elastic solid has μ = 0.
pub fn cylinder_sliding(
    cylinder: &Cylinder,
    material: &dyn Material,
    contact: LineContact,
) -> Result<CylinderSliding, FrictionError> {
    check_spectra(material)?;
    let half_length = positive("half_length", contact.half_length)?;
    let velocity = positive("velocity", contact.velocity)?;
    let spectrum = material.relaxation();
    let modulus = positive("equilibrium_modulus", spectrum.equilibrium_modulus())?;
    let (branches, dashpot) = (spectrum.branches(), spectrum.viscosity());
    let relaxing = branches.len() + usize::from(dashpot > 0.0);
    let parameter = "number of relaxing elements";
    in_range(parameter, relaxing as f64, relaxing < 2, "0 or 1")?;

    // `relaxation` is T/l and `difference` is D/l; both are 0 on an elastic solid.
    let relaxation_time = branches
        .first()
        .map_or(0.0, |branch| branch.relaxation_time);
    let relaxation = velocity * relaxation_time / half_length;
    let difference = velocity * (spectrum.zero_shear_viscosity() / modulus) / half_length;

    // (3) gives the centre x₀/l and the strength C/l of the singular part of q; (4) gives force and friction.
    let [a, a2] = bessel_i_ratios(relaxation.recip());
    let b = bessel_k_ratio((relaxation + difference).recip());
    let factor = (1.0 + a * b).recip();
    let centre = difference * a * b * factor;
    let singular = difference * a * factor;
    let bracket = 2.0 * centre * a * factor + (a * b + a2) * factor;
    let friction_over_slope = difference * bracket / (1.0 + 2.0 * singular);
    // Scale the results by the slope l/R of the cylinder at the distance l from its lowest point.
    let slope = half_length / cylinder.radius();
    let stress = 2.0 * modulus / material.half_space_factor() * slope;
    let line_load = 0.5 * PI * stress * half_length * (1.0 + 2.0 * singular);
    let friction_coefficient = friction_over_slope * slope;
    if relaxing > 0 {
        representable("friction coefficient", friction_coefficient)?;
    }
    Ok(CylinderSliding {
        contact: [centre - 1.0, centre + 1.0].map(|end| end * half_length),
        line_load: representable("line load", line_load)?,
        friction_coefficient,
        stress,
        relaxation,
        singular,
    })
}

impl CylinderSliding {
    /// Pressure at a distance from the lowest point of the cylinder, (5), \[Pa]; 0 outside the contact and at its ends. On
    /// a Kelvin–Voigt solid it is infinite at the front.
    pub fn pressure(&self, x: f64) -> f64 {
        let [rear, front] = self.contact;
        let [ahead, behind] = [front - x, x - rear];
        if ahead.min(behind) <= 0.0 {
            return 0.0;
        }
        // `angle` is φ in s = cos φ, computed from the distances to both ends of the contact.
        let angle = 2.0 * ahead.sqrt().atan2(behind.sqrt());
        let z = self.relaxation.recip();
        let [a, _] = bessel_i_ratios(z);
        // With s = cos φ, q √(1 − s²) is the sum of an even and of an odd part in s; L − x₀ = T + C/a.
        let odd = self.relaxation + self.singular / a;
        let even = |sine: f64| sine * sine + self.singular;
        // A Kelvin–Voigt solid has no relaxation length: the pressure is q.
        if z.is_infinite() {
            let cotangent = (0.5 * angle).tan().recip();
            return self.stress * (angle.sin() + self.singular * cotangent);
        }
        let integrand = |phi: f64| {
            let distance = 2.0 * (0.5 * (angle - phi)).sin() * (0.5 * (angle + phi)).sin();
            let (sine, cosine) = phi.sin_cos();
            z * (-z * distance).exp() * (even(sine) + odd * cosine)
        };
        // The exponential is negligible far ahead of s.
        let first = (angle.cos() + NEGLIGIBLE_EXPONENT / z).min(1.0).acos();
        self.stress * integrate(integrand, [first, angle], PRESSURE_ACCURACY).value
    }
}

/// Ratios I₁/I₀ and I₂/I₀ of modified Bessel functions of z > 0, in this order, from ∫₀^π e^(z cos θ) sin^(2n) θ dθ (NIST DLMF
/// 10.32.2); 1 at infinity.
fn bessel_i_ratios(z: f64) -> [f64; 2] {
    if z.is_infinite() {
        return [1.0; 2];
    }
    // The integrand e^(z (cos θ − 1)) is negligible beyond this angle.
    let end = 2.0 * (0.5 * NEGLIGIBLE_EXPONENT / z).sqrt().min(1.0).asin();
    let weight = |theta: f64| (-2.0 * z * (0.5 * theta).sin().powi(2)).exp();
    let integral = |power: i32| trapezoid(end, |theta| weight(theta) * theta.sin().powi(2 * power));
    let zeroth = integral(0);
    [
        z * integral(1) / zeroth,
        z * z * integral(2) / (3.0 * zeroth),
    ]
}

/// Ratio K₀/K₁ of modified Bessel functions of k > 0, from ∫₀^∞ e^(−k cosh t) cosh νt dt (NIST DLMF 10.32.9); 1 at infinity.
fn bessel_k_ratio(k: f64) -> f64 {
    if k.is_infinite() {
        return 1.0;
    }
    // The integrand e^(−k (cosh t − 1)) is negligible beyond this t.
    let end = 2.0 * (0.5 * NEGLIGIBLE_EXPONENT / k).sqrt().asinh();
    let weight = |t: f64| (-2.0 * k * (0.5 * t).sinh().powi(2)).exp();
    trapezoid(end, weight) / trapezoid(end, |t| weight(t) * t.cosh())
}

/// Trapezoidal rule from 0 to `end` for an even function that is even about `end` too, or negligible there.
fn trapezoid(end: f64, integrand: impl Fn(f64) -> f64) -> f64 {
    let intervals = (MIN_INTERVALS + INTERVALS_PER_UNIT_LENGTH * end).ceil();
    let step = end / intervals;
    let inner_nodes = (1_u32..).map(f64::from).take_while(|k| *k < intervals);
    let inner_sum: f64 = inner_nodes.map(|k| integrand(k * step)).sum();
    step * (inner_sum + 0.5 * (integrand(0.0) + integrand(end)))
}
