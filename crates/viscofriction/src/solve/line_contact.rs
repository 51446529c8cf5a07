//! A cylinder that is infinite along y, in plane strain: all forces and areas are per length.

use friction_analytic::cylinder_half_width_after_impulse;
use indenters::Cylinder;
use numerics::Estimate;
use rheology::Material;

use super::answer::{Answer, ContactBox, within};

use super::error::{Result, bail};
use super::half_space::{Simple, simple};
use super::problem::{Motion, Problem};
use super::{elements, pressing};
use crate::scene::{Accuracy, Control, Method, Model};

/// What a method answers that takes the cylinder.
pub(crate) fn answer(problem: &Problem, cylinder: &Cylinder, accuracy: Accuracy) -> Result<Answer> {
    let material = &*problem.material;
    match (problem.motion, problem.motion.control()) {
        (Motion::Sliding(load), _) => elements::line_contact(cylinder, material, &load, accuracy),
        (Motion::Pressing(load), Control::NormalForce(force)) => {
            pressed(cylinder, material, (force, load.duration()))
        }
        (_, Control::IndentationDepth(_)) => bail!("a line contact has no depth"),
    }
}

/// Relative rounding of the closed form.
const ROUNDING: f64 = 1e-14;

/// Under a constant force, in closed form.
fn pressed(
    cylinder: &Cylinder,
    material: &dyn Material,
    (force, duration): (f64, f64),
) -> Result<Answer> {
    let impulse = pressing::impulse(material, force, duration)?;
    let dashpot = pressing::unit_dashpot()?;
    let half_width = cylinder_half_width_after_impulse(cylinder, &dashpot, impulse)?;
    let peak_pressure = match simple(material)? {
        Some(Simple::Elastic) => Some(2.0 * std::f64::consts::FRAC_1_PI * (force / half_width)),
        _ => None,
    };
    Ok(Answer {
        is_per_length: true,
        contact_area: Some(within(2.0 * half_width, ROUNDING)),
        contact_box: Some(ContactBox::along(
            [-half_width, half_width],
            ROUNDING * half_width,
        )),
        peak_pressure: peak_pressure.map(|pressure| within(pressure, ROUNDING)),
        ..Answer::new(Method::Analytic, Model::HalfSpace, Estimate::exact(force))
    })
}
