//! Cone and paraboloid on a Kelvin–Voigt and on a Maxwell foundation, in closed form.
//!
//! With h̃ = s |x| or k x², l = v τ and the leading edge x_r, the foundation carries `4 w` per length, and the contact ends at x_l:
//!
//! ```text
//! Kelvin–Voigt   w = G u + η v h̃'           paraboloid: x_l = −x_r²/(l + √(l² + x_r²))     cone: x_l = −(x_r − l)⁺
//! Maxwell        l w' = w − G l h̃'          paraboloid: x_r/l = z/(1 − e^(−z)) − 1,  z = (x_r − x_l)/l
//!                                           cone: x_l = −l ln(1 + q),  q = 1 − e^(−x_r/l)
//! F_N = 4 ∫ w dx        F_h = 4 ∫ w h̃' dx
//! ```
//! The integrals are written so that nothing cancels at any ratio of l and x_r.

use indenters::PowerProfile;
use numerics::{bracketed_root, positive};
use rheology::{KelvinVoigt, Maxwell};

use crate::FrictionError;
use crate::error::{out_of_range, representable};
use crate::pieces::{accepted, over_pieces};
use crate::power::Shape;

/// A contact of which the front and the speed are known.
#[derive(Debug, Clone, Copy, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize))]
pub struct SlidingContact {
    /// Position x_r of the leading edge in front of the apex, \[m].
    pub front: f64,
    /// Sliding speed v, \[m/s].
    pub velocity: f64,
}

/// Stationary sliding on a viscoelastic foundation.
#[derive(Debug, Clone, Copy, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize))]
#[must_use]
pub struct ViscoelasticSliding {
    /// Indentation depth d = h̃(x_r), \[m].
    pub indentation_depth: f64,
    /// Rear and front of the contact relative to the apex, \[m].
    pub contact: [f64; 2],
    /// Normal force F_N, \[N].
    pub normal_force: f64,
    /// Friction coefficient μ = F_h/F_N.
    pub friction_coefficient: f64,
}

/// Sliding of a cone or paraboloid on a Kelvin–Voigt foundation.
///
/// # Errors
/// [`FrictionError::UnsupportedExponent`] for other profiles, [`FrictionError::InvalidParameter`] for a contact that
/// cannot be, [`FrictionError::OutOfRange`] when a result overflows or underflows.
pub fn kelvin_voigt_sliding(
    profile: &PowerProfile,
    material: &KelvinVoigt,
    contact: SlidingContact,
) -> Result<ViscoelasticSliding, FrictionError> {
    let problem = SlidingProfile::new(profile, contact)?;
    let modulus = material.shear_modulus();
    let shift = material.viscosity() / modulus * contact.velocity;
    let length = positive("distance of retardation", shift)?;
    let SlidingProfile { front, shape, .. } = problem;
    let ratio = length / front;
    let [rear, load, friction] = match shape {
        Shape::Cone => {
            let closing = (1.0 - ratio).max(0.0);
            let load = 0.5 * (1.0 + 2.0 * ratio + closing * closing);
            let share = (4.0 * ratio - ratio * ratio) / (2.0 + ratio * ratio);
            [-closing, load, if ratio < 1.0 { share } else { 1.0 }]
        }
        Shape::Paraboloid => {
            let rear = -(ratio + ratio.hypot(1.0)).recip();
            // x_r² − x_l² = −2 l x_l.
            let elastic = (1.0 - rear) - (1.0 - rear.powi(3)) / 3.0;
            let load = elastic - 2.0 * ratio * ratio * rear;
            let work = 2.0 * (ratio * rear).powi(2) + 4.0 / 3.0 * ratio * (1.0 - rear.powi(3));
            [rear, load, work / load]
        }
    };
    problem.result(rear, modulus * load, friction)
}

/// Sliding of a cone or paraboloid on a Maxwell foundation.
///
/// # Errors
/// Like [`kelvin_voigt_sliding`]; [`FrictionError::NotConverged`] when the work of the paraboloid is known to less than
/// ten digits.
pub fn maxwell_sliding(
    profile: &PowerProfile,
    material: &Maxwell,
    contact: SlidingContact,
) -> Result<ViscoelasticSliding, FrictionError> {
    let problem = SlidingProfile::new(profile, contact)?;
    let modulus = material.shear_modulus();
    let length = material.viscosity() / modulus * contact.velocity;
    let ratio = positive("ratio of front and distance", problem.front / length)?;
    let [rear, load, friction] = match problem.shape {
        Shape::Cone => maxwell_cone(ratio),
        Shape::Paraboloid => maxwell_paraboloid(ratio)?,
    };
    problem.result(rear, modulus * load, friction)
}

/// x_l/x_r, ∫ w dx/(G s x_r²) and μ/s for Y = x_r/l: `∫ w dx = −G s l² ln(1 − q²)`, `∫ w h̃' dx = 2 G s² l² (artanh q − q)`.
fn maxwell_cone(ratio: f64) -> [f64; 3] {
    let q = -(-ratio).exp_m1();
    let rear = q.ln_1p() / ratio;
    let sum = if q < 0.5 {
        -(-q * q).ln_1p()
    } else {
        ratio - q.ln_1p()
    };
    let work = if q < SMALL {
        // 2 (q³/3 + q⁵/5 + …)
        let terms = (1..20).rev().map(|k| f64::from(2 * k + 1).recip());
        2.0 * q.powi(3) * terms.fold(0.0, |s, term| s * q * q + term)
    } else {
        ratio + q.ln_1p() - 2.0 * q
    };
    [-rear, sum / (ratio * ratio), work / sum]
}

/// x_l/x_r, ∫ w dx/(G k x_r³) and μ/(k x_r) of the paraboloid, with `φ_1 = (1 − e^(−z))/z`, `φ_(k+1) = (1/k! − φ_k)/z`.
fn maxwell_paraboloid(ratio: f64) -> Result<[f64; 3], FrictionError> {
    let excess = |z: f64| {
        let [one, two, _] = phi(z);
        z * two / one - ratio
    };
    let failed = out_of_range("contact length", ratio);
    // x_r < x_r − x_l < 2 x_r.
    let z = bracketed_root(excess, [ratio, 2.0 * ratio * (1.0 + SMALL)]).ok_or(failed)?;
    let [one, two, rest] = phi(z);
    let load = z.powi(3) * rest / one;
    // φ_1(ζ) − φ_1(z); near z = 0 both are one.
    let difference = |zeta: f64| match phi(zeta) {
        [_, part, _] if z < 1.0 => z * two - zeta * part,
        [part, ..] => part - one,
    };
    let square = |zeta: f64| (zeta * difference(zeta) / one).powi(2);
    let mut ends = vec![0.0, LAYER.min(z), z];
    ends.dedup();
    let work = accepted("friction work", over_pieces(square, &ends))?;
    // In units of x_r: l = 1/Y, w = 2 G k l² …, so that the friction of slope 2 k x_r is 2 ∫ / (Y load).
    let friction = 4.0 * work.value / (load * ratio);
    Ok([1.0 - z / ratio, load / ratio.powi(3), friction])
}

/// Below this a difference is summed as a series.
const SMALL: f64 = 0.1;
/// Beyond this e^(−ζ) is rounded away.
const LAYER: f64 = 40.0;

/// φ_1, φ_2 and φ_2 − 2 φ_3 of z > 0.
fn phi(z: f64) -> [f64; 3] {
    if z < 1.0 {
        // φ_3 = 1/3! − z/4! + z²/5! − …, then upwards without cancellation.
        let mut term = 1.0 / 6.0;
        let mut three = term;
        for k in 4..25 {
            term *= -z / f64::from(k);
            three += term;
        }
        let two = 0.5 - z * three;
        return [1.0 - z * two, two, two - 2.0 * three];
    }
    let one = -(-z).exp_m1() / z;
    let rest = (1.0 + (-z).exp() - 2.0 * one) / z / z;
    [one, (1.0 - one) / z, rest]
}

struct SlidingProfile {
    shape: Shape,
    front: f64,
    depth: f64,
}

impl SlidingProfile {
    fn new(profile: &PowerProfile, contact: SlidingContact) -> Result<Self, FrictionError> {
        let front = positive("front", contact.front)?;
        positive("velocity", contact.velocity)?;
        let shape = Shape::of(profile)?;
        // κ c x_r^p.
        let depth = profile.stretch() * profile.coefficient() * front.powf(profile.exponent());
        Ok(Self {
            shape,
            front,
            depth: representable("indentation depth", depth)?,
        })
    }

    /// `rear` in units of x_r, `load` ∫ w dx in units of d x_r, `friction` in units of d/x_r.
    fn result(
        &self,
        rear: f64,
        load: f64,
        friction: f64,
    ) -> Result<ViscoelasticSliding, FrictionError> {
        let slope = self.depth / self.front;
        Ok(ViscoelasticSliding {
            indentation_depth: self.depth,
            contact: [rear * self.front, self.front],
            normal_force: representable("normal force", 4.0 * load * self.depth * self.front)?,
            friction_coefficient: representable("friction coefficient", friction * slope)?,
        })
    }
}
