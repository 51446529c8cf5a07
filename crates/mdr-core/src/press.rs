//! Contact without sliding: after a time under a constant control, and long after pressing.
//!
//! ```text
//! F_N = 4 G_∞/(2 (1 − ν)) ∫ (d − h̃)⁺ dx          at rest
//! ∫ (d − h̃)⁺ dx = 2 (1 − ν) J(t) F_N/4           under a force that has been there for the time t
//! F_N = 4 G(t)/(2 (1 − ν)) ∫ (d − h̃)⁺ dx         at a depth that has been there for the time t
//! ```
//! d is the depth and h̃ the height of the line above its lowest point; (d − h̃)⁺ is d − h̃ where that is positive, and 0
//! elsewhere. G(t) is the relaxation modulus, G_∞ its limit, J(t) the creep compliance, and ν the Poisson ratio.
//!
//! Up to the time t the contact only grows, or stays as it is (Lee & Radok 1960).

use indenters::{Control, PressingLoad, RigidLine};
use numerics::{Estimate, between_zero_and_one};
use rheology::{Elastic, Material, check_spectra};

use crate::MdrError;
use crate::steady::{LineProblem, SteadySliding};

/// Presses a line into a material until it is at rest: on the equilibrium modulus of a solid.
///
/// Force and depth are known to `relative_error`, above 0 and below 1; the friction coefficient is 0.
///
/// ```
/// use mdr_core::indenters::{Control, EquivalentLine, PowerProfile};
/// use mdr_core::{press, rheology::Elastic};
///
/// // Hertz (1882), with the modulus 4 G of an incompressible half space.
/// let (ball, rubber) = (PowerProfile::paraboloid(50.0)?, Elastic::new(1e6)?);
/// let pressed = press(&EquivalentLine(&ball), &rubber, Control::IndentationDepth(1e-4), 1e-6)?;
/// let hertz = 4.0 / 3.0 * 4e6 * 0.01_f64.sqrt() * 1e-4_f64.powf(1.5);
/// assert!((pressed.normal_force.value - hertz).abs() <= pressed.normal_force.error);
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
///
/// # Errors
/// [`MdrError::NoEquilibrium`] for a material that flows; otherwise like [`steady`](crate::steady()).
pub fn press(
    line: &dyn RigidLine,
    material: &dyn Material,
    control: Control,
    relative_error: f64,
) -> Result<SteadySliding, MdrError> {
    check_spectra(material)?;
    let equilibrium_modulus = material.relaxation().equilibrium_modulus();
    if equilibrium_modulus == 0.0 {
        return Err(MdrError::NoEquilibrium);
    }
    let modulus = equilibrium_modulus / material.half_space_factor();
    on_springs(line, modulus, control, relative_error)
}

/// Presses a line into an undeformed material under a constant force, or at a constant depth, for a time.
///
/// Force and depth are known to `relative_error`, above 0 and below 1. At a depth a parallel dashpot carries an impulse
/// at first touch, and nothing afterwards.
///
/// # Errors
/// Like [`steady`](crate::steady()).
pub fn indent(
    line: &dyn RigidLine,
    material: &dyn Material,
    load: &PressingLoad,
    relative_error: f64,
) -> Result<SteadySliding, MdrError> {
    check_spectra(material)?;
    let (control, time) = (load.control(), load.duration());
    let compliance = material.creep_compliance(time)?;
    let modulus = (material.half_space_factor() * compliance).recip();
    let mut pressed = on_springs(line, modulus, control, relative_error)?;
    if let Control::IndentationDepth(_) = control {
        // At a depth the contact is that on springs of another modulus, so that force and load change by the ratio of the
        // moduli.
        let ratio = material.relaxation_modulus(time)? * compliance;
        pressed.normal_force = pressed.normal_force * ratio;
        pressed.load.iter_mut().for_each(|[_, load]| *load *= ratio);
    }
    Ok(pressed)
}

/// The contact on springs of one modulus, \[Pa]: a contact at rest has their stress.
fn on_springs(
    line: &dyn RigidLine,
    modulus: f64,
    control: Control,
    relative_error: f64,
) -> Result<SteadySliding, MdrError> {
    let relative_error = between_zero_and_one("relative_error", relative_error)?;
    let spring = Elastic::new(modulus)?;
    // On springs the state does not depend on the speed.
    let problem = LineProblem::new(line, &spring, 1.0)?;
    let (quantity, sought): (_, fn(&SteadySliding) -> Estimate) = match control {
        Control::NormalForce(_) => ("indentation depth [m]", |state| state.indentation_depth),
        Control::IndentationDepth(_) => ("normal force [N]", |state| state.normal_force),
    };
    let state = problem.refine(control, relative_error, quantity, sought)?;
    Ok(SteadySliding {
        friction_coefficient: Estimate::exact(0.0),
        normal_force: match control {
            Control::NormalForce(force) => Estimate::exact(force),
            Control::IndentationDepth(_) => state.normal_force,
        },
        ..state
    })
}
