//! Static contact, long after pressing.
//!
//! ```text
//! F_N = 4 G_∞/(2 (1 − ν)) ∫ (d − h̃)⁺ dx
//! ```

use indenters::{Control, RigidLine};
use numerics::{Estimate, between_zero_and_one};
use rheology::{Elastic, Material};

use crate::MdrError;
use crate::steady::{Problem, SteadySliding};

/// A contact at rest.
#[derive(Debug, Clone, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize))]
#[must_use]
pub struct Pressed {
    /// Indentation depth d of the lowest point, \[m]; exact where it is prescribed.
    pub indentation_depth: Estimate,
    /// Normal force F_N, \[N]; exact where it is prescribed.
    pub normal_force: Estimate,
    /// Rear and front end of the contact, \[m].
    pub ends: [Estimate; 2],
    /// Contact intervals `[rear, front]` by increasing position on the line, \[m]; what is between them is open.
    pub contacts: Vec<[f64; 2]>,
}

/// Presses a line into a material and waits until that has come to rest: an elastic one at once, any other solid on its
/// equilibrium modulus.
///
/// Force and depth are known to `relative_error`, above 0 and below 1.
///
/// # Errors
/// [`MdrError::NoEquilibrium`] for a material that flows; otherwise like [`steady`](crate::steady()).
pub fn press(
    line: &(impl RigidLine + ?Sized),
    material: &(impl Material + ?Sized),
    control: Control,
    relative_error: f64,
) -> Result<Pressed, MdrError> {
    let relative_error = between_zero_and_one("relative_error", relative_error)?;
    let modulus = material.relaxation().equilibrium_modulus();
    if modulus == 0.0 {
        return Err(MdrError::NoEquilibrium);
    }
    // At rest the stress of the line is that of springs, whatever its speed was.
    let spring = Elastic::new(modulus / material.half_space_factor())?;
    let problem = Problem::new(line, &spring, 1.0)?;
    let sought = match control {
        Control::NormalForce(_) => |state: &SteadySliding| state.indentation_depth,
        Control::IndentationDepth(_) => |state: &SteadySliding| state.normal_force,
    };
    let state = problem.refine(control, relative_error, sought)?;
    Ok(Pressed {
        indentation_depth: state.indentation_depth,
        normal_force: state.normal_force,
        ends: state.ends,
        contacts: state.contacts,
    })
}
