//! Slow sliding over a solid half space, to second order in the speed.
//!
//! ```text
//! F_h = E* v [m₁ ∫₀^a h̃'² dx − (2/3π) Λ v h̃'(a)² − (8/3π) n₂ v h̃'(0)²]        E* = 4 G_∞/(2 (1 − ν))
//! m₁ = η_0/G_∞      n_k = Σ (G_i/G_∞) τ_i^k      Λ = m₁² + 2 n₂
//! ```
//!
//! The load that an elastic half space would need for the same displacements, p* = Φ p with Φ = G_∞/G, looks ahead only:
//! it ends at the front where p does, and inside the contact it is the elastic one. The first term is the friction of the
//! pressure shifted by x_s = m₁ v. The second is what the rear edge loses, which moves by x_s while the front stays: near
//! an edge p* = k √d, and by ln Φ = −m₁ s + Λ s²/2 + … the loss is (π/4) (Λ v²/E*) ∮ k² cos³θ ds over the front half. In
//! plane strain the same term follows from Hunter's cylinder (1961). The third is that of the tip of a cone, from the
//! spectrum of h = κ r.

use std::f64::consts::{FRAC_1_PI, PI};
use std::mem;

use indenters::Axisymmetric;
use numerics::{Estimate, in_range, positive};
use rheology::{Material, RelaxationBranch};

use crate::FrictionError;
use crate::elastic_limit::{ElasticContact, ElasticLimitFriction, low_speed_friction};
use crate::indentation::known_moment;

/// A body of revolution that slides slowly over a solid half space.
#[derive(Debug, Clone, Copy, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize))]
#[must_use]
pub struct SlowSliding {
    /// Coefficient of friction, with what terms of higher order may be.
    pub friction_coefficient: Estimate,
    /// Normal force \[N] of the elastic contact.
    pub normal_force: f64,
    /// Relative difference that sliding makes at most to the force at a given depth, or to the depth under a given force.
    pub elastic_error: f64,
    /// Contact area, \[m²].
    pub contact_area: Estimate,
    /// Rear end of the contact relative to the lowest point, \[m]; the front and the sides stay at a.
    pub rear: Estimate,
}

/// Terms of the third order relative to the first, over their scale Λ₃ v²/(m₁ a²) and over the square of the second order;
/// and the next term of an apex between cone and paraboloid, over (Λ v/(m₁ a))^(2p − 1). Boundary elements find up to 0.19,
/// 1.1 and 0.45 for 1 ≤ p ≤ 10. Behind the tip of a cone a part of the contact opens, by which the first grows with the
/// logarithm of a/x_s, by up to 0.3 of itself for each factor of e.
const THIRD: f64 = 0.3;
const SQUARE: f64 = 1.5;
const APEX: f64 = 0.6;
const OPENED: f64 = 0.5;
/// Steepest line a h̃'(a)/h̃(a) for which that was tried, and longest memory Λ v/m₁ over a.
const STEEPEST: f64 = 10.0;
const LONGEST: f64 = 1.0;
/// The next terms of area and ends over Λ v² and Λ v²/a, and of the depth over Λ v² h̃'(a)/(a d). Boundary elements find
/// up to 1.3, 1 and 0.13.
const AREA: f64 = 2.5;
const REAR: f64 = 2.0;
const DEPTH: f64 = 0.25;

/// A body that slides slowly over a solid half space, from the elastic contact of the same radius.
///
/// # Errors
/// [`FrictionError::InvalidParameter`] for an apex sharper than that of a cone, a body with kinks, a line that is steeper at
/// the edge than r^10, an elastic solid, and a speed at which the solid remembers more than a radius; and the errors of
/// [`low_speed_friction`].
pub fn slow_sliding(
    body: &dyn Axisymmetric,
    solid: &dyn Material,
    contact: ElasticContact,
) -> Result<SlowSliding, FrictionError> {
    let exponent = body.profile_exponent();
    in_range("apex exponent", exponent, exponent >= 1.0, "at least 1")?;
    let n_kinks = body.kinks().len();
    in_range("number of kinks", n_kinks as f64, n_kinks == 0, "0")?;
    let first: ElasticLimitFriction = low_speed_friction(body, solid, contact)?;
    let radius = contact.contact_radius;
    let Moments {
        shift,
        second,
        third,
        branches,
    } = Moments::of(solid, contact.velocity)?;
    // Over F_N = 2 E* ∫ x h̃' dx.
    let small = second / (shift * radius);
    in_range("memory over radius", small, small <= LONGEST, "at most 1")?;
    let slope = body.line_slope(radius);
    let steepness = slope * radius / body.line_height(radius);
    let allowed = "at most 10";
    in_range("steepness", steepness, steepness <= STEEPEST, allowed)?;
    let moment = known_moment(body, radius)?;
    let per_square = FRAC_1_PI / (3.0 * moment);
    let of_rear = per_square * second * slope * slope;
    let mu = first.half_space;
    let [tip, apex] = match exponent {
        cone if cone <= 1.0 => [body.line_slope(0.0), 0.0],
        sharp if sharp < 2.0 => [0.0, APEX * small.powf(2.0 * exponent - 1.0)],
        _ => [0.0; 2],
    };
    let of_tip = 4.0 * per_square * branches * tip * tip;
    let square = (of_rear / mu).powi(2);
    // (1/a) ∫₀^a h̃'² dx, which is h̃'(0)² of a cone.
    let mean_square = 2.0 * mu * moment / (shift * radius);
    let opened = body.line_slope(small * radius).powi(2) / mean_square;
    let logarithm = 1.0 - OPENED * opened.min(1.0) * small.ln();
    let third = THIRD * logarithm * third / (shift * radius * radius);
    let inside = inside(body, solid, contact, tip) / (shift * radius * mean_square);
    let error = QUADRATURE + third + SQUARE * square + apex + inside;
    Ok(SlowSliding {
        friction_coefficient: Estimate::new(mu - of_rear - of_tip, error * mu),
        normal_force: first.normal_force,
        elastic_error: DEPTH * steepness * second / (radius * radius),
        // The disc, less where the disc does not reach that is shifted by x_s.
        contact_area: Estimate::new(PI * radius * radius - 2.0 * radius * shift, AREA * second),
        rear: Estimate::new(shift - radius, REAR * second / radius),
    })
}

/// Relative error of the integrals of the first term, at most.
const QUADRATURE: f64 = 1e-10;

/// What branches lose, over E* = 1, where the slope changes around the apex within the distance l = v τ, beside a `tip`:
///
/// ```text
/// Σ (G_i/G_∞) (l/2π) ∮ cos²θ B(l |cos θ|) dθ      B(l) = ½ ∬ (h̃'(x) − h̃'(y))² e^(−|x − y|/l)/(2l) dx dy
/// ```
///
/// B grows with l, which bounds the mean over θ; it is 2 h̃'(0)² l at the tip of a cone and l² ∫ h̃''² dx where the line is
/// smooth. A round tip that is smaller than l is thus a tip of its own. The outer part, a/4 < |x|, is in the other terms.
fn inside(body: &dyn Axisymmetric, solid: &dyn Material, contact: ElasticContact, tip: f64) -> f64 {
    let rest = |x: f64| body.line_slope(x) - tip;
    let of_branch = |branch: &RelaxationBranch, modulus: f64| {
        let length = contact.velocity * branch.relaxation_time;
        let outermost = 0.25 * contact.contact_radius;
        let mut x = length.clamp(QUADRATURE * outermost, outermost);
        let mut slope = rest(x);
        let mut sum = x * slope.powi(2);
        while x < outermost {
            let width = x.min(outermost - x);
            x += width;
            let before = mem::replace(&mut slope, rest(x));
            sum += (slope - before).powi(2) * (length / width) * length;
        }
        // With the product of both, where there is a tip.
        let both = 2.0 * sum + 4.0 * (length * sum).sqrt() * tip.abs();
        0.5 * (branch.modulus / modulus) * length * both
    };
    let relaxation = solid.relaxation();
    let modulus = relaxation.equilibrium_modulus();
    let branches = relaxation.branches().iter();
    branches.map(|branch| of_branch(branch, modulus)).sum()
}

/// What the surface remembers, as lengths and their powers.
struct Moments {
    /// x_s = m₁ v.
    shift: f64,
    /// Λ v² and Λ₃ v³, the sums of λ² − τ² and λ³ − τ³ over retardation and relaxation times.
    second: f64,
    third: f64,
    /// n₂ v².
    branches: f64,
}

impl Moments {
    fn of(solid: &dyn Material, velocity: f64) -> Result<Self, FrictionError> {
        let relaxation = solid.relaxation();
        let modulus = positive("equilibrium_modulus", relaxation.equilibrium_modulus())?;
        let moment = |power: i32| {
            let branches = relaxation.branches().iter();
            let lengths = branches.map(|branch| {
                branch.modulus / modulus * (velocity * branch.relaxation_time).powi(power)
            });
            lengths.sum::<f64>()
        };
        // A spring remembers nothing, and there is no friction to expand.
        let shift = relaxation.zero_shear_viscosity() / modulus * velocity;
        let name = "zero_shear_viscosity × velocity / equilibrium_modulus";
        let shift = positive(name, shift)?;
        let branches = moment(2);
        Ok(Self {
            shift,
            second: shift * shift + 2.0 * branches,
            third: 3.0 * moment(3) + 3.0 * shift * branches + shift.powi(3),
            branches,
        })
    }
}
