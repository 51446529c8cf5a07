//! Cone and paraboloid on a Kelvin–Voigt and on a Maxwell foundation, in closed form.
//!
//! With h̃ = s |x| or k x², l = v τ and the leading edge x_r, the foundation carries `4 w` per length, and the contact ends
//! at x_l:
//!
//! ```text
//! Kelvin–Voigt   w = G u + η v h̃'           paraboloid: x_l = −x_r²/(l + √(l² + x_r²))     cone: x_l = −(x_r − l)⁺
//! Maxwell        l w' = w − G l h̃'          paraboloid: x_r/l = z/(1 − e^(−z)) − 1,  z = (x_r − x_l)/l
//!                                           cone: x_l = −l ln(1 + q),  q = 1 − e^(−x_r/l)
//! F_N = 4 ∫ w dx        F_h = 4 ∫ w h̃' dx
//! ```
//! The integrals are written so that nothing cancels at any ratio of l and x_r.

use indenters::PowerProfile;
use numerics::{NEGLIGIBLE_EXPONENT, bracketed_root, positive};
use rheology::{KelvinVoigt, Maxwell};

use crate::FrictionError;
use crate::error::{out_of_range, representable};
use crate::pieces::{accept_accurate, integrate_pieces};
use crate::power::PowerShape;

/// Front and speed of a sliding contact.
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
/// [`FrictionError::UnsupportedExponent`] for other profiles; [`FrictionError::InvalidParameter`] for a front or a speed that
/// is not positive; [`FrictionError::OutOfRange`] when a result overflows or underflows.
pub fn kelvin_voigt_sliding(
    profile: &PowerProfile,
    material: &KelvinVoigt,
    contact: SlidingContact,
) -> Result<ViscoelasticSliding, FrictionError> {
    let problem = SlidingProfile::new(profile, contact)?;
    let modulus = material.shear_modulus();
    // `shift` is l = v τ, the distance of retardation.
    let shift = material.viscosity() / modulus * contact.velocity;
    let length = positive("distance of retardation", shift)?;
    // `ratio` is l/x_r, the distance of retardation divided by the position of the leading edge.
    let ratio = length / problem.front;
    let relative = match problem.shape {
        // The cone lifts off at −(x_r − l)⁺; both flanks touch while l < x_r.
        PowerShape::Cone => {
            let rear_extent = (1.0 - ratio).max(0.0);
            let two_sided = (4.0 * ratio - ratio * ratio) / (2.0 + ratio * ratio);
            RelativeSliding {
                rear: -rear_extent,
                load: 0.5 * (1.0 + 2.0 * ratio + rear_extent * rear_extent),
                friction: if ratio < 1.0 { two_sided } else { 1.0 },
            }
        }
        PowerShape::Paraboloid => {
            let rear = -(ratio + ratio.hypot(1.0)).recip();
            // The dashpot carries a part in proportion to x_r² − x_l², which is −2 l x_l and needs no difference.
            let elastic = (1.0 - rear) - (1.0 - rear.powi(3)) / 3.0;
            let load = elastic - 2.0 * ratio * ratio * rear;
            let work = 2.0 * (ratio * rear).powi(2) + 4.0 / 3.0 * ratio * (1.0 - rear.powi(3));
            RelativeSliding {
                rear,
                load,
                friction: work / load,
            }
        }
    };
    problem.result(modulus, relative)
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
    let relative = match problem.shape {
        PowerShape::Cone => maxwell_cone(ratio),
        PowerShape::Paraboloid => maxwell_paraboloid(ratio)?,
    };
    problem.result(modulus, relative)
}

/// Rear, load and friction of a contact in units of its front and depth.
struct RelativeSliding {
    /// Ratio of the position of the rear end to that of the front, x_l/x_r.
    rear: f64,
    /// Normal force divided by the product of four times the modulus, depth and front, ∫ w dx/(G d x_r).
    load: f64,
    /// Friction coefficient divided by the ratio of depth and front, μ x_r/d.
    friction: f64,
}

/// The cone on a Maxwell foundation for the `ratio` Y = x_r/l, with q = 1 − e^(−Y): `∫ w dx = −G s l² ln(1 − q²)`,
/// `∫ w h̃' dx = 2 G s² l² (artanh q − q)`.
fn maxwell_cone(ratio: f64) -> RelativeSliding {
    let q = -(-ratio).exp_m1();
    // `load` is −ln(1 − q²), which is Y − ln(1 + q) because 1 − q = e^(−Y).
    let load = if q < 0.5 {
        -(-q * q).ln_1p()
    } else {
        ratio - q.ln_1p()
    };
    // `work` is 2 (artanh q − q), which is Y + ln(1 + q) − 2 q.
    let work = if q < MAX_ARTANH_SERIES_Q {
        // For small q the terms of this difference cancel, and the series 2 (q³/3 + q⁵/5 + …) takes its place.
        let terms = (1..20).rev().map(|k| f64::from(2 * k + 1).recip());
        2.0 * q.powi(3) * terms.fold(0.0, |sum, term| sum * q * q + term)
    } else {
        ratio + q.ln_1p() - 2.0 * q
    };
    RelativeSliding {
        rear: -(q.ln_1p() / ratio),
        load: load / (ratio * ratio),
        friction: work / load,
    }
}

/// The paraboloid on a Maxwell foundation for the `ratio` Y = x_r/l, with the functions φ_k of [`Phi`].
fn maxwell_paraboloid(ratio: f64) -> Result<RelativeSliding, FrictionError> {
    // z = (x_r − x_l)/l is the root of z φ₂/φ₁ = Y. It lies between Y and 2 Y, because x_r < x_r − x_l < 2 x_r.
    let ratio_excess = |z: f64| {
        let Phi { one, two, .. } = Phi::new(z);
        z * two / one - ratio
    };
    let bracket = [ratio, 2.0 * ratio * (1.0 + BRACKET_MARGIN)];
    let overflow = out_of_range("contact length", ratio);
    let z = bracketed_root(ratio_excess, bracket).ok_or(overflow)?;
    let Phi { one, two, load } = Phi::new(z);
    let load_integral = z.powi(3) * load / one;

    // The work is the integral of a square with the factor φ₁(ζ) − φ₁(z), a difference of numbers near 1 where z is small.
    let difference = |zeta: f64| {
        let at_zeta = Phi::new(zeta);
        if z < 1.0 {
            z * two - zeta * at_zeta.two
        } else {
            at_zeta.one - one
        }
    };
    let square = |zeta: f64| (zeta * difference(zeta) / one).powi(2);
    let mut ends = vec![0.0, NEGLIGIBLE_EXPONENT.min(z), z];
    ends.dedup();
    let work = accept_accurate("friction work", integrate_pieces(square, &ends))?;
    // In units of x_r: l = 1/Y, w = 2 G k l² …, so that the friction of slope 2 k x_r is 2 ∫ / (Y load).
    let friction = 4.0 * work.value / (load_integral * ratio);
    Ok(RelativeSliding {
        rear: 1.0 - z / ratio,
        load: load_integral / ratio.powi(3),
        friction,
    })
}

/// Largest q for which artanh q − q is summed as a series. Derived: the series reaches rounding there, and above it the
/// difference enlarges rounding by a factor of 300 at most.
const MAX_ARTANH_SERIES_Q: f64 = 0.1;
/// Margin of the bracket of the contact length above its upper bound, for rounding. Chosen; it changes the number of evaluations
/// only: the root is the same.
const BRACKET_MARGIN: f64 = 0.1;

/// The functions φ₁ = (1 − e^(−z))/z and φ_(k+1) = (1/k! − φ_k)/z of z > 0, without cancellation.
struct Phi {
    /// Function φ₁.
    one: f64,
    /// Function φ₂.
    two: f64,
    /// Difference φ₂ − 2 φ₃, which the load contains.
    load: f64,
}

impl Phi {
    /// The functions at z > 0: from a series where z < 1, and from exponentials elsewhere.
    fn new(z: f64) -> Self {
        if z < 1.0 {
            // φ₃ is the series 1/3! − z/4! + z²/5! − …, and the recurrence gives the lower orders from it.
            let mut term = 1.0 / 6.0;
            let mut three = term;
            for k in 4..25 {
                term *= -z / f64::from(k);
                three += term;
            }
            let two = 0.5 - z * three;
            return Self {
                one: 1.0 - z * two,
                two,
                load: two - 2.0 * three,
            };
        }
        let one = -(-z).exp_m1() / z;
        Self {
            one,
            two: (1.0 - one) / z,
            load: (1.0 + (-z).exp() - 2.0 * one) / z / z,
        }
    }
}

/// A cone or paraboloid with a given front of the contact.
struct SlidingProfile {
    /// Cone or paraboloid.
    shape: PowerShape,
    /// Position x_r of the leading edge, \[m].
    front: f64,
    /// Indentation depth d = h̃(x_r), \[m].
    depth: f64,
}

impl SlidingProfile {
    /// The profile with its front at the position of the contact, which is checked, and the depth that belongs to it.
    fn new(profile: &PowerProfile, contact: SlidingContact) -> Result<Self, FrictionError> {
        let front = positive("front", contact.front)?;
        positive("velocity", contact.velocity)?;
        let shape = PowerShape::new(profile)?;
        // The depth is the height of the line at the leading edge, κ c x_r^p.
        let depth = profile.stretch() * profile.coefficient() * front.powf(profile.exponent());
        Ok(Self {
            shape,
            front,
            depth: representable("indentation depth", depth)?,
        })
    }

    /// The result in SI units, from a shear modulus \[Pa] and the relative one.
    fn result(
        &self,
        modulus: f64,
        relative: RelativeSliding,
    ) -> Result<ViscoelasticSliding, FrictionError> {
        let slope = self.depth / self.front;
        let force = 4.0 * (modulus * relative.load) * self.depth * self.front;
        Ok(ViscoelasticSliding {
            indentation_depth: self.depth,
            contact: [relative.rear * self.front, self.front],
            normal_force: representable("normal force", force)?,
            friction_coefficient: representable("friction coefficient", relative.friction * slope)?,
        })
    }
}
