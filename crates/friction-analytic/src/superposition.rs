//! Stationary sliding of a sum of power profiles, in closed form.
//!
//! ```text
//! h̃ = Σ h̃_i,  h̃_i = κ(p_i) c_i x^(p_i)        μ = 1/(d x_d) Σ_i Σ_j p_i p_j / (p_i + p_j − 1) h̃_i(x_d) h̃_j(x_d)
//! ```
//! h̃_i is the equivalent line of the term c_i r^(p_i), d the stationary depth, x_d the length of the contact, and μ the
//! friction coefficient.

use indenters::{Axisymmetric, PowerProfile, PowerTerm, SlidingLoad, Superposition};
use rheology::Viscous;

use crate::axisymmetric::radius_with_friction;
use crate::error::representable;
use crate::stationary::checked_depth;
use crate::{FrictionError, StationarySliding};

/// Stationary depth, contact line and friction coefficient of a sum of powers, from (12) and (16).
///
/// # Errors
/// [`FrictionError::FrictionDiverges`] when the lowest exponent is 1/2 or less; [`FrictionError::Indenter`] when the
/// line turns downwards inside the contact; [`FrictionError::OutOfRange`] when a result overflows or underflows.
pub fn superposition_sliding(
    profile: &Superposition,
    material: &Viscous,
    load: &SlidingLoad,
) -> Result<StationarySliding, FrictionError> {
    let depth = checked_depth(material, load)?;
    let radius = radius_with_friction(profile, depth)?;
    // `heights` holds exponent and line height of each term at the front of the contact.
    let heights = line_heights(profile.terms(), radius)?;
    // `sum` is the double sum for μ. `modulus` is that of the absolute values of its terms, which scales the rounding error.
    let mut sum = 0.0;
    let mut modulus = 0.0;
    for (p, height) in &heights {
        for (q, other) in &heights {
            // p + q − 1 is computed as the sum of two differences, which are exact near the divergence at p = q = 1/2.
            let term = p * q / ((p - 0.5) + (q - 0.5)) * (height / depth) * (other / radius);
            sum += term;
            modulus += term.abs();
        }
    }
    let friction_coefficient = representable("friction coefficient", sum)?;
    // Powers are rounded in proportion to their exponent; the end of the contact moves with its own rounding.
    let largest_exponent = heights
        .iter()
        .fold(1.0, |largest: f64, (p, _)| largest.max(*p));
    let end_sensitivity = profile.line_slope(radius).powi(2) * (radius / depth);
    Ok(StationarySliding {
        indentation_depth: depth,
        contact_line: vec![[0.0, radius]],
        friction_coefficient,
        error: 4.0 * f64::EPSILON * (largest_exponent * modulus + end_sensitivity),
    })
}

/// Exponent and line height \[m] of each term at the position x; the height has the sign of the coefficient.
fn line_heights(terms: &[PowerTerm], x: f64) -> Result<Vec<(f64, f64)>, FrictionError> {
    let height = |term: &PowerTerm| {
        let magnitude = PowerProfile::new(term.coefficient.abs(), term.exponent)?.line_height(x);
        Ok((term.exponent, magnitude.copysign(term.coefficient)))
    };
    terms.iter().map(height).collect()
}
