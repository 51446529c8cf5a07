//! Transient of sliding, from first touch to the stationary state, exact for cone and paraboloid.
//!
//! At first both flanks carry load; the trailing one lifts off at the time t*. With `h̃ = s |x|` or `h̃ = k x²`, the
//! stationary depth D, the stationary contact length x_d, and `y e^(−y) = ½ e^(−1/2 − T)`, `T = v (t − t*)/x_d`:
//!
//! ```text
//! cone        t ≤ t* = x_d/(4v):  d = √(D s v t),           μ = 2 s d/D,     contact from −d/s to d/s
//!             t > t*:             d = D (1 − y),            μ = s,           contact from 0 to d/s
//! paraboloid  t ≤ t* = x_d/(6v):  d = (¾ D √k v t)^(2/3),   μ = 2 k v t,     contact from −√(d/k) to √(d/k)
//!             t > t*:             d = D (1 − y)²,  μ = ⁴⁄₃ √(k D) (1 − 3y/2),  contact from −y x_d to (1 − y) x_d
//! ```
//!
//! This solves the balance of forces behind (15), with the load of the trailing flank that (15) leaves out.

use std::f64::consts::LN_2;

use indenters::{PowerProfile, SlidingLoad};
use numerics::{bracketed_root, in_range, not_negative};
use rheology::Viscous;

use crate::FrictionError;
use crate::error::{out_of_range, representable};
use crate::power::PowerShape;
use crate::stationary::depth_under_force;

/// State at one time of the transient.
#[derive(Debug, Clone, Copy, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize))]
#[must_use]
pub struct TransientSliding {
    /// Indentation depth at that time, \[m].
    pub indentation_depth: f64,
    /// Rear and front end of the contact, measured from the apex, \[m].
    pub contact_line: [f64; 2],
    /// Friction coefficient at that time.
    pub friction_coefficient: f64,
}

/// Shape and stationary state, which scale the transient.
struct TransientScales {
    /// Cone or paraboloid.
    shape: PowerShape,
    /// Stationary depth D, (12), \[m].
    depth: f64,
    /// Stationary contact length x_d, \[m].
    length: f64,
}

/// State at a `time` ≥ 0 \[s] after a cone or paraboloid, already sliding, has touched the foundation.
///
/// # Errors
/// [`FrictionError::UnsupportedExponent`] unless the exponent of the profile is 1 or 2;
/// [`FrictionError::InvalidParameter`] for a time that is negative or not finite; [`FrictionError::OutOfRange`] when
/// depth or contact length overflow or underflow.
pub fn transient_sliding(
    profile: &PowerProfile,
    material: &Viscous,
    load: &SlidingLoad,
    time: f64,
) -> Result<TransientSliding, FrictionError> {
    let scales = TransientScales::new(profile, material, load)?;
    let distance = load.velocity() * not_negative("time", time)? / scales.length;
    Ok(match scales.shape {
        PowerShape::Cone => scales.cone_at(distance),
        PowerShape::Paraboloid => scales.paraboloid_at(distance),
    })
}

/// Sliding distance from first touch until the depth is the given `fraction` of the stationary one, \[m].
///
/// # Errors
/// [`FrictionError::InvalidParameter`] unless 0 ≤ fraction < 1; otherwise like [`transient_sliding`].
pub fn sliding_distance_to_depth(
    profile: &PowerProfile,
    material: &Viscous,
    load: &SlidingLoad,
    fraction: f64,
) -> Result<f64, FrictionError> {
    let scales = TransientScales::new(profile, material, load)?;
    let is_part = (0.0..1.0).contains(&fraction);
    in_range("fraction", fraction, is_part, "at least 0 and less than 1")?;
    Ok(scales.length
        * match scales.shape {
            // The distance has another form once the trailing flank has lifted off, which happens at the depth D/2 for a cone
            // and D/4 for a paraboloid.
            PowerShape::Cone if fraction <= 0.5 => fraction * fraction,
            PowerShape::Cone => {
                PowerShape::Cone.lift_off() + distance_since_lift_off(1.0 - fraction)
            }
            PowerShape::Paraboloid if fraction <= 0.25 => 4.0 / 3.0 * fraction * fraction.sqrt(),
            PowerShape::Paraboloid => {
                // `y` is 1 − √(d/D), computed without cancellation.
                let y = (1.0 - fraction) / (1.0 + fraction.sqrt());
                PowerShape::Paraboloid.lift_off() + distance_since_lift_off(y)
            }
        })
}

/// Depth of a cone by Eq. (15) as printed in Kürschner (2014), at a `time` ≥ 0 \[s] after first touch: \[m], from `−d/D − ln(1
/// − d/D) = v t/x_d`.
///
/// It presumes that only the leading flank touches, which is true from d = D/2 on; before, it gives up to √2 times the
/// depth of [`transient_sliding`].
///
/// # Errors
/// [`FrictionError::UnsupportedExponent`] unless the profile is a cone; otherwise like [`transient_sliding`].
pub fn cone_depth_by_equation_15(
    profile: &PowerProfile,
    material: &Viscous,
    load: &SlidingLoad,
    time: f64,
) -> Result<f64, FrictionError> {
    let scales = TransientScales::new(profile, material, load)?;
    if scales.shape != PowerShape::Cone {
        return Err(FrictionError::UnsupportedExponent {
            exponent: profile.exponent(),
            supported: "1",
        });
    }
    let distance = load.velocity() * not_negative("time", time)? / scales.length;
    let fraction = bracketed_root(|q| distance_by_equation_15(q) - distance, [0.0, 1.0]);
    let overflow = out_of_range("sliding distance", distance);
    Ok(scales.depth * fraction.ok_or(overflow)?)
}

impl TransientScales {
    /// Stationary depth and contact length of a cone or paraboloid on a viscous foundation, which the transient approaches.
    fn new(
        profile: &PowerProfile,
        material: &Viscous,
        load: &SlidingLoad,
    ) -> Result<Self, FrictionError> {
        let depth = depth_under_force(material, load)?;
        Ok(Self {
            shape: PowerShape::new(profile)?,
            depth,
            length: representable("contact length", profile.line_position(depth))?,
        })
    }

    /// State of a cone after a sliding distance, in stationary contact lengths x_d.
    fn cone_at(&self, distance: f64) -> TransientSliding {
        let slope = self.depth / self.length;
        // `fraction` is d/D, and also the front end divided by x_d. While both flanks touch, its square is v t/x_d.
        let (fraction, rear, friction_over_slope) = if is_two_sided(PowerShape::Cone, distance) {
            let fraction = distance.sqrt();
            (fraction, -fraction, 2.0 * fraction)
        } else {
            let y = missing_fraction(distance - PowerShape::Cone.lift_off());
            (1.0 - y, 0.0, 1.0)
        };
        TransientSliding {
            indentation_depth: self.depth * fraction,
            contact_line: [rear, fraction].map(|end| end * self.length),
            friction_coefficient: friction_over_slope * slope,
        }
    }

    /// State of a paraboloid after a sliding distance, in stationary contact lengths x_d.
    fn paraboloid_at(&self, distance: f64) -> TransientSliding {
        // `slope` is √(k D) = k x_d = D/x_d, because k = D/x_d².
        let slope = self.depth / self.length;
        if is_two_sided(PowerShape::Paraboloid, distance) {
            // While both flanks touch, d/D = (¾ v t/x_d)^(2/3); the root of d/D is the half width of the contact divided by
            // x_d.
            let half_width = (0.75 * distance).cbrt();
            return TransientSliding {
                indentation_depth: self.depth * half_width * half_width,
                contact_line: [-half_width * self.length, half_width * self.length],
                friction_coefficient: 2.0 * slope * distance,
            };
        }
        let y = missing_fraction(distance - PowerShape::Paraboloid.lift_off());
        TransientSliding {
            indentation_depth: self.depth * (1.0 - y) * (1.0 - y),
            contact_line: [-y * self.length, (1.0 - y) * self.length],
            friction_coefficient: 4.0 / 3.0 * slope * (1.0 - 1.5 * y),
        }
    }
}

impl PowerShape {
    /// Sliding distance at which the trailing flank lifts off, divided by x_d: v t*/x_d.
    const fn lift_off(self) -> f64 {
        match self {
            Self::Cone => 0.25,
            Self::Paraboloid => 1.0 / 6.0,
        }
    }
}

/// Whether both flanks touch at a sliding distance, given as a multiple of x_d.
///
/// The time t* itself belongs to the two-sided state, also if rounding makes it later by a few units in the last place.
fn is_two_sided(shape: PowerShape, distance: f64) -> bool {
    distance <= shape.lift_off() * (1.0 + 16.0 * f64::EPSILON)
}

/// Distance T(y) = y − ln y − ½ − ln 2, the sliding distance after t* divided by x_d.
fn distance_since_lift_off(y: f64) -> f64 {
    y - y.ln() - 0.5 - LN_2
}

/// Number of Newton steps for y. Derived: the start is within e^z < ½ of the root, and 6 steps of quadratic convergence reach
/// rounding; two more are a margin.
const NEWTON_STEPS: usize = 8;

/// Relative distance y from the stationary state at the sliding distance T x_d ≥ 0 since lift-off. It solves y e^(−y) = ½ e^(−1/2 − T),
/// y ≤ ½, or y = −W₀(−½ e^(−1/2 − T)) with Lambert's function.
///
/// Newton's method solves e^z − z = c for z = ln y, with c = ½ + ln 2 + T. The function is convex and falls where y < 1, so that the
/// steps from z = −c, left of the root, approach it from one side. Neither late nor early times lose digits.
fn missing_fraction(since_lift_off: f64) -> f64 {
    let c = 0.5 + LN_2 + since_lift_off;
    if c.is_infinite() {
        return 0.0;
    }
    // Newton's method starts at z = −c, on the left of the root.
    let mut z = -c;
    for _ in 0..NEWTON_STEPS {
        let y = z.exp();
        z -= (y - z - c) / (y - 1.0);
    }
    z.exp()
}

/// Largest q for which −q − ln(1 − q) is summed as a series. Derived: its 17 terms reach rounding there, and above it the
/// difference enlarges rounding by a factor of 20 at most.
const MAX_LOG_SERIES_Q: f64 = 0.1;

/// Sliding distance of a cone to d/D = q by Eq. (15), divided by x_d: −q − ln(1 − q) for 0 ≤ q ≤ 1, without cancellation.
fn distance_by_equation_15(q: f64) -> f64 {
    if q > MAX_LOG_SERIES_Q {
        return -q - (-q).ln_1p();
    }
    // The distance is the series q²/2 + q³/3 + … + q¹⁸/18. At the largest q the first term left out is below 1e-17 of the
    // first.
    let terms = (2..=18_u32).rev().map(|k| f64::from(k).recip());
    terms.fold(0.0, |sum, term| sum * q + term) * q * q
}
