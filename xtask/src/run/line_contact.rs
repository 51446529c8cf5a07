//! A cylinder that is infinite along y, in plane strain: all forces and areas are per length.

use anyhow::{Context, Result, bail};
use bem_halfspace::steady::{
    LineLadder, LineOptions, LineSliding, steady_line, steady_line_friction,
};
use friction_analytic::cylinder_half_width_after_impulse;
use indenters::{Cylinder, SlidingLoad};
use rheology::Material;

use super::answer::{Answer, ContactBox};
use super::half_space::{Simple, simple};
use super::pressing;
use super::question::{Motion, Question};
use super::resolution::{Resolved, resolve};
use super::solve::load;
use crate::scene_file::{Accuracy, Control, Method, Model};

const TOLERANCE: f64 = 1e-10;
const MAX_ITERATIONS: usize = 500;
/// Coarsest elements along the contact of a cylinder on an elastic half space.
const COARSEST_ELEMENTS: f64 = 8.0;

/// What a method answers that takes the cylinder.
pub(super) fn answer(
    question: &Question,
    cylinder: &Cylinder,
    accuracy: Accuracy,
) -> Result<Answer> {
    let material = &*question.material;
    match (question.motion, question.control) {
        (Motion::Sliding { velocity, .. }, control) => {
            let load = load((control, velocity))?;
            slid(cylinder, (material, &load), accuracy)
        }
        (Motion::Pressing { duration }, Control::NormalForce(force)) => {
            pressed(cylinder, material, (force, duration))
        }
        (_, Control::IndentationDepth(_)) => bail!("a line contact has no depth"),
    }
}

/// The stationary state, to an error or on a grid.
fn slid(
    cylinder: &Cylinder,
    (material, load): (&dyn Material, &SlidingLoad),
    accuracy: Accuracy,
) -> Result<Answer> {
    let ladder = LineLadder::of_profile(cylinder, material, load)?;
    let on_grid = |spacing: f64| -> Result<LineSliding> {
        let options = LineOptions {
            spacing,
            phase: 0.0,
            footprint: ladder.footprint,
            tolerance: TOLERANCE,
            max_iterations: MAX_ITERATIONS,
        };
        Ok(steady_line(cylinder, material, load, &options)?)
    };
    let (friction, error, state) = match accuracy {
        Accuracy::RelativeError(relative_error) => {
            let estimate =
                steady_line_friction(cylinder, (material, load), &ladder, relative_error)?;
            let last = estimate.refinements.last();
            let spacing = last.context("no grid was refined")?.spacing;
            (
                estimate.friction_coefficient,
                estimate.error,
                on_grid(spacing)?,
            )
        }
        Accuracy::Elements(_) => {
            let length = COARSEST_ELEMENTS * ladder.coarsest_spacing;
            let solve = |elements: usize| on_grid(length / elements as f64);
            let Resolved {
                value,
                error: [error],
                ..
            } = resolve(accuracy, usize::MAX, solve, |state| {
                [state.friction_coefficient]
            })?;
            (value.friction_coefficient, error, value)
        }
    };
    let answer = Answer::new(Method::BemSteady, Model::HalfSpace, load.normal_force())
        .with_friction(friction, error);
    Ok(with_state(answer, state))
}

fn with_state(answer: Answer, state: LineSliding) -> Answer {
    let [rear, front] = state.contact;
    let mut answer = Answer {
        is_per_length: true,
        contact_area: Some(front - rear),
        contact_box: Some(ContactBox::along(state.contact)),
        unknowns: state.unknowns,
        iterations: state.iterations,
        ..answer
    };
    answer.fields.line_pressure = state.pressure;
    answer
}

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
        contact_area: Some(2.0 * half_width),
        contact_box: Some(ContactBox::along([-half_width, half_width])),
        peak_pressure,
        ..Answer::new(Method::Analytic, Model::HalfSpace, force)
    })
}
