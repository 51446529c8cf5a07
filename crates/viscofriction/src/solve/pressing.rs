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
use bem_halfspace::indent::IndentStep;
use rheology::{Material, RheologyError, Viscous};

use crate::scene::Control;

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

/// What does in a second on the dashpot of unit viscosity what the control does to the material.
pub(crate) fn on_unit_dashpot(
    material: &dyn Material,
    (control, duration): (Control, f64),
) -> Result<Control> {
    Ok(match control {
        Control::NormalForce(force) => Control::NormalForce(impulse(material, force, duration)?),
        depth @ Control::IndentationDepth(_) => depth,
    })
}

/// A second of a constant force, or of a depth that grows in proportion to time.
pub(crate) fn in_steps(control: Control, n_steps: usize) -> Vec<IndentStep> {
    let step = |step: usize| {
        let time = step as f64 / n_steps as f64;
        let control = match control {
            Control::NormalForce(force) => Control::NormalForce(force),
            Control::IndentationDepth(depth) => Control::IndentationDepth(time * depth),
        };
        IndentStep { time, control }
    };
    (1..=n_steps).map(step).collect()
}
