//! Slow sliding over a solid half space, to second order in the speed.
//!
//! ```text
//! F_h = E* v [m₁ ∫₀^a h̃'² dx − (2/3π) Λ v h̃'(a)² − (8/3π) n₂ v h̃'(0)²]        E* = 4 G_∞/(2 (1 − ν))
//! m₁ = η_0/G_∞      n_k = Σ (G_i/G_∞) τ_i^k      Λ = m₁² + 2 n₂
//! ```
//! h̃ is the height of the equivalent line, a the contact radius, and v the speed. G_i and τ_i are the branches, G_∞ is the
//! equilibrium modulus, and η_0 = ∫₀^∞ (G(t) − G_∞) dt.
//!
//! The load that an elastic half space would need for the same displacements, p* = Φ p with Φ = G_∞/G, depends on p at and
//! ahead of a point only: it ends at the front where p does, and inside the contact it is the elastic one.
//!
//! - The first term is the friction of the pressure shifted by x_s = m₁ v.
//! - The second is the loss at the rear edge, which moves by x_s while the front stays. Near an edge p* = k √d, and by
//!   ln Φ = −m₁ s + Λ s²/2 + … the loss is (π/4) (Λ v²/E*) ∮ k² cos³θ ds over the front half. In plane strain the same
//!   term follows from Hunter's cylinder (1961).
//! - The third is that of the tip of a cone, from the spectrum of h = κ r.
//!
//! The bounds on the omitted terms were measured with boundary elements under the profiles r^p, 1 ≤ p ≤ 10. The test
//! `slow_sliding_is_that_of_the_expansion_to_second_order` of `bem-halfspace` repeats this for five scenes.
//!
//! Derivation: docs/theory/stationary-half-space.md, "Any linear viscoelastic material".

use std::f64::consts::{FRAC_1_PI, PI};
use std::mem;

use indenters::Axisymmetric;
use numerics::{Estimate, in_range, positive};
use rheology::{Material, RelaxationBranch};

use crate::FrictionError;
use crate::elastic_limit::{ElasticContact, low_speed_friction};
use crate::indentation::checked_moment;

/// A body of revolution that slides slowly over a solid half space.
#[derive(Debug, Clone, Copy, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize))]
#[must_use]
pub struct SlowSliding {
    /// Friction coefficient, with a bound on the terms of higher order as its error.
    pub friction_coefficient: Estimate,
    /// Normal force \[N] of the elastic contact.
    pub normal_force: f64,
    /// Bound on the relative change by sliding of the force at a given depth, or of the depth under a given force.
    pub elastic_error: f64,
    /// Contact area, \[m²].
    pub contact_area: Estimate,
    /// Rear end of the contact relative to the lowest point, \[m]; the front and the sides remain at a.
    pub rear: Estimate,
}

/// Bound on the third-order terms relative to the first term: this factor times Λ₃ v²/(m₁ a²), with the third moment Λ₃ v³ of
/// [`MemoryMoments`].
///
/// Measured (head of this file): up to 0.19; the rest is a safety factor.
const THIRD_ORDER_BOUND: f64 = 0.3;
/// Bound on the third-order terms relative to the first term: this factor times the square of the second-order term at the rear
/// edge, relative to the first term.
///
/// Measured (head of this file): up to 1.1; the rest is a safety factor.
const SQUARED_SECOND_ORDER_BOUND: f64 = 1.5;
/// Bound on the first omitted term of an apex r^p with 1 < p < 2, relative to the first term: this factor times
/// (Λ v/(m₁ a))^(2p − 1).
///
/// Measured (head of this file): up to 0.45; the rest is a safety factor.
const APEX_BOUND: f64 = 0.6;
/// Bound on the relative growth of the third-order terms per e-fold of the ratio m₁ a/(Λ v) of contact radius to memory length.
///
/// Behind the tip of a cone a part of the contact opens, which makes these terms grow with the logarithm of the ratio. Measured
/// (head of this file): up to 0.3; the rest is a safety factor.
const OPENING_BOUND: f64 = 0.5;
/// Largest steepness a h̃'(a)/h̃(a) of a line for which slow sliding is answered. Chosen as the largest one at which the bounds on
/// the omitted terms were measured (head of this file).
const MAX_STEEPNESS: f64 = 10.0;
/// Largest ratio of the memory length Λ v/m₁ to the contact radius a for which slow sliding is answered. Chosen as the largest one
/// at which the bounds on the omitted terms were measured (head of this file).
const MAX_MEMORY_OVER_RADIUS: f64 = 1.0;
/// Bound on the first omitted term of the contact area: this factor times Λ v². Measured (head of this file): up to 1.3; the rest
/// is a safety factor.
const AREA_BOUND: f64 = 2.5;
/// Bound on the first omitted term of the position of the rear end: this factor times Λ v²/a. Measured (head of this file): up to
/// 1; the rest is a safety factor.
const REAR_BOUND: f64 = 2.0;
/// Bound on the relative change of the depth: this factor times Λ v² h̃'(a)/(a d). Measured (head of this file): up to
/// 0.13; the rest is a safety factor.
const DEPTH_BOUND: f64 = 0.25;
/// Upper bound of the relative error of the integrals of the first term. Chosen far below the bounds on the terms of higher
/// order; an integral with a larger error is refused.
const QUADRATURE_ERROR: f64 = 1e-10;
/// Distance from the apex, divided by the contact radius, beyond which changes of the slope count in the other terms. Chosen; the
/// bounds of the terms were measured with it, and would have to be measured again for another distance.
const APEX_REGION: f64 = 0.25;

/// Slow sliding over a solid half space, from the elastic contact of the same radius.
///
/// # Errors
/// [`FrictionError::InvalidParameter`] for an apex sharper than that of a cone, a body with kinks, a line that is steeper at
/// the edge than r^10, an elastic solid, and a speed at which the memory length of the solid exceeds the radius; and the
/// errors of [`low_speed_friction`].
pub fn slow_sliding(
    body: &dyn Axisymmetric,
    solid: &dyn Material,
    contact: ElasticContact,
) -> Result<SlowSliding, FrictionError> {
    // Check the body, the solid and the speed.
    let exponent = body.profile_exponent();
    in_range("apex exponent", exponent, exponent >= 1.0, "at least 1")?;
    let n_kinks = body.kinks().len();
    in_range("number of kinks", n_kinks as f64, n_kinks == 0, "0")?;
    let first_order = low_speed_friction(body, solid, contact)?;
    let radius = contact.contact_radius;
    let memory = MemoryMoments::new(solid, contact.velocity)?;
    let MemoryMoments { shift, second, .. } = memory;
    let memory_ratio = second / (shift * radius);
    let is_slow = memory_ratio <= MAX_MEMORY_OVER_RADIUS;
    in_range("memory over radius", memory_ratio, is_slow, "at most 1")?;
    let slope = body.line_slope(radius);
    let steepness = slope * radius / body.line_height(radius);
    let is_moderate = steepness <= MAX_STEEPNESS;
    in_range("steepness", steepness, is_moderate, "at most 10")?;

    // The terms of first and second order are divided by the normal force F_N = 2 E* ∫ x h̃' dx.
    let moment = checked_moment(body, radius)?;
    let per_square = FRAC_1_PI / (3.0 * moment);
    let mu = first_order.half_space;
    let rear_term = per_square * second * slope * slope;
    let (tip_slope, apex_error) = if exponent <= 1.0 {
        (body.line_slope(0.0), 0.0)
    } else if exponent < 2.0 {
        (0.0, APEX_BOUND * memory_ratio.powf(2.0 * exponent - 1.0))
    } else {
        (0.0, 0.0)
    };
    let tip_term = 4.0 * per_square * memory.branches * tip_slope * tip_slope;

    // The error is a sum of bounds on the terms of higher order, relative to the first term.
    let square = (rear_term / mu).powi(2);
    // `mean_square_slope` is (1/a) ∫₀^a h̃'² dx, which is h̃'(0)² for a cone.
    let mean_square_slope = 2.0 * mu * moment / (shift * radius);
    let opened = body.line_slope(memory_ratio * radius).powi(2) / mean_square_slope;
    let logarithm = 1.0 - OPENING_BOUND * opened.min(1.0) * memory_ratio.ln();
    let third_error = THIRD_ORDER_BOUND * logarithm * memory.third / (shift * radius * radius);
    let inner_error =
        apex_loss(body, solid, contact, tip_slope) / (shift * radius * mean_square_slope);
    let error = QUADRATURE_ERROR
        + third_error
        + SQUARED_SECOND_ORDER_BOUND * square
        + apex_error
        + inner_error;
    Ok(SlowSliding {
        friction_coefficient: Estimate::new(mu - rear_term - tip_term, error * mu),
        normal_force: first_order.normal_force,
        elastic_error: DEPTH_BOUND * steepness * second / (radius * radius),
        // The contact is the disc without the part that the same disc, shifted by x_s, does not cover.
        contact_area: Estimate::new(
            PI * radius * radius - 2.0 * radius * shift,
            AREA_BOUND * second,
        ),
        rear: Estimate::new(shift - radius, REAR_BOUND * second / radius),
    })
}

/// Bound on the loss of the branches where the slope changes around the apex within the distance l = v τ, for E* = 1:
///
/// ```text
/// Σ (G_i/G_∞) (l/2π) ∮ cos²θ B(l |cos θ|) dθ      B(l) = ½ ∬ (h̃'(x) − h̃'(y))² e^(−|x − y|/l)/(2l) dx dy
/// ```
///
/// B grows with l, which bounds the mean over θ; it is 2 h̃'(0)² l at the tip of a cone and l² ∫ h̃''² dx where the line is
/// smooth. A round tip that is smaller than l is thus a tip of its own. The slope `tip_slope` of the tip of a cone is not
/// counted, but its product with the other changes is. The outer part, a/4 < |x|, is in the other terms.
fn apex_loss(
    body: &dyn Axisymmetric,
    solid: &dyn Material,
    contact: ElasticContact,
    tip_slope: f64,
) -> f64 {
    let slope_change = |x: f64| body.line_slope(x) - tip_slope;
    let loss = |branch: &RelaxationBranch, modulus: f64| {
        // `sum` is the bound of B(l) on one side of the apex, without the tip: l times the squared change of the slope up to
        // l = v τ, and l² ∫ h̃''² dx beyond, over intervals of doubling length.
        let length = contact.velocity * branch.relaxation_time;
        let outermost = APEX_REGION * contact.contact_radius;
        let mut x = length.clamp(QUADRATURE_ERROR * outermost, outermost);
        let mut slope = slope_change(x);
        let mut sum = x * slope.powi(2);
        while x < outermost {
            let width = x.min(outermost - x);
            x += width;
            let before = mem::replace(&mut slope, slope_change(x));
            sum += (slope - before).powi(2) * (length / width) * length;
        }
        // The loss contains the square of the changes, and their product with the slope of a tip.
        let changes = 2.0 * sum + 4.0 * (length * sum).sqrt() * tip_slope.abs();
        0.5 * (branch.modulus / modulus) * length * changes
    };
    let relaxation = solid.relaxation();
    let modulus = relaxation.equilibrium_modulus();
    let branches = relaxation.branches().iter();
    branches.map(|branch| loss(branch, modulus)).sum()
}

/// Moments of the memory of a solid over a sliding distance, as lengths and their powers.
struct MemoryMoments {
    /// Shift of the pressure, x_s = m₁ v, \[m].
    shift: f64,
    /// Second moment Λ v², the sum of λ² − τ² over retardation and relaxation times, times v², \[m²].
    second: f64,
    /// Third moment Λ₃ v³, the sum of λ³ − τ³ over retardation and relaxation times, times v³, \[m³].
    third: f64,
    /// Second moment n₂ v² of the relaxation times alone, \[m²].
    branches: f64,
}

impl MemoryMoments {
    /// Moments m₁ v, Λ v², Λ₃ v³ and n₂ v² of a viscoelastic solid at a speed v, \[m/s].
    fn new(solid: &dyn Material, velocity: f64) -> Result<Self, FrictionError> {
        let relaxation = solid.relaxation();
        let modulus = positive("equilibrium_modulus", relaxation.equilibrium_modulus())?;
        let moment = |power: i32| {
            let branches = relaxation.branches().iter();
            let lengths = branches.map(|branch| {
                branch.modulus / modulus * (velocity * branch.relaxation_time).powi(power)
            });
            lengths.sum::<f64>()
        };
        // An elastic solid has no friction to expand.
        let shift = positive(
            "zero_shear_viscosity × velocity / equilibrium_modulus",
            relaxation.zero_shear_viscosity() / modulus * velocity,
        )?;
        let branches = moment(2);
        Ok(Self {
            shift,
            second: shift * shift + 2.0 * branches,
            third: 3.0 * moment(3) + 3.0 * shift * branches + shift.powi(3),
            branches,
        })
    }
}
