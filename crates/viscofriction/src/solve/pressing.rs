//! Normal indentation, on any material.
//!
//! While the contact grows, or stays as it is, half space and line agree exactly (Lee & Radok 1960), and a constant force
//! acts on every material like the impulse F J(t) on a dashpot of unit viscosity:
//!
//! ```text
//! 8 ∫₀^a x h̃' dx = 2 (1 − ν) F J(t)         constant force
//! F(t) = 8 G(t)/(2 (1 − ν)) ∫₀^a x h̃' dx    constant depth, contact radius a
//! ```

use super::error::{Result, SolveError};
use rheology::{Material, RheologyError, Viscous};

/// The dashpot on which an impulse does what the material does with F J(t).
pub(crate) fn unit_dashpot() -> Result<Viscous, RheologyError> {
    Viscous::new(1.0)
}

pub(crate) fn impulse(material: &dyn Material, force: f64, duration: f64) -> Result<f64> {
    let compliance = material.half_space_factor() * material.creep_compliance(duration)?;
    Ok(force * compliance)
}

/// Force at a depth that was held for a duration, over the impulse that leads to it on the unit dashpot, [1/s].
pub(crate) fn stiffness(material: &dyn Material, duration: f64) -> Result<f64> {
    let modulus = material.relaxation_modulus(duration)?;
    let stiffness = modulus / material.half_space_factor();
    if !(stiffness.is_finite() && stiffness > 0.0) {
        return Err(SolveError::Relaxed { duration, modulus });
    }
    Ok(stiffness)
}
