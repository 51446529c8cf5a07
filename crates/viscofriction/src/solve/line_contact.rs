//! A cylinder that is infinite along y, in plane strain: all forces and areas are per length.

use super::error::{Context as _, Result, bail};
use bem_halfspace::steady::{
    LineLadder, LineOptions, LineSliding, steady_line, steady_line_friction,
};
use friction_analytic::cylinder_half_width_after_impulse;
use indenters::{Cylinder, SlidingLoad};
use rheology::Material;

use super::answer::{Answer, ContactBox};
use super::half_space::{Simple, simple};
use super::order_of_apex;
use super::pressing;
use super::problem::{Motion, Problem};
use crate::scene::{Accuracy, Control, Method, Model};
use numerics::{ErrorParts, Goal, Quantity, Refined, refine};

/// Gaps relative to the depth scale that disturb a small friction little, and those that do not show in the width.
const FINE: f64 = 1e-9;
const COARSE: f64 = 1e-6;
const MAX_ITERATIONS: usize = 500;
/// Coarsest elements along the contact of a cylinder on an elastic half space.
const COARSEST_ELEMENTS: f64 = 8.0;

/// What a method answers that takes the cylinder.
pub(crate) fn answer(problem: &Problem, cylinder: &Cylinder, accuracy: Accuracy) -> Result<Answer> {
    let material = &*problem.material;
    match (problem.motion, problem.motion.control()) {
        (Motion::Sliding(ref load), _) => {
            let ladder = LineLadder::of_profile(cylinder, material, load)?;
            let sliding = Sliding {
                cylinder,
                material,
                load,
                ladder,
            };
            match accuracy {
                Accuracy::RelativeError(error) => sliding.to_an_error(error),
                Accuracy::Elements(_) => sliding.on_elements(accuracy),
            }
        }
        (Motion::Pressing(load), Control::NormalForce(force)) => {
            pressed(cylinder, material, (force, load.duration()))
        }
        (_, Control::IndentationDepth(_)) => bail!("a line contact has no depth"),
    }
}

/// A cylinder that slides in the stationary state.
struct Sliding<'a> {
    cylinder: &'a Cylinder,
    material: &'a dyn Material,
    load: &'a SlidingLoad,
    ladder: LineLadder,
}

impl Sliding<'_> {
    fn to_an_error(&self, relative_error: f64) -> Result<Answer> {
        let scene = (self.material, self.load);
        let estimate = steady_line_friction(self.cylinder, scene, &self.ladder, relative_error)?;
        let last = estimate.refinements.last();
        let spacing = last.context("no grid was refined")?.spacing;
        let friction = [estimate.friction_coefficient, estimate.error];
        let answer = self.answer(friction, self.on_grid(spacing, COARSE)?)?;
        Ok(answer.with_parts(ErrorParts {
            discretisation: Some(estimate.error - estimate.gap_error),
            iteration: Some(estimate.gap_error),
            ..ErrorParts::NONE
        }))
    }

    fn on_elements(&self, accuracy: Accuracy) -> Result<Answer> {
        let length = COARSEST_ELEMENTS * self.ladder.coarsest_spacing;
        let solve = |elements: usize| self.on_grid(length / elements as f64, FINE);
        let goal = Goal {
            accuracy,
            largest: usize::MAX,
            order: order_of_apex(self.ladder.apex_exponent),
        };
        let friction = |state: &LineSliding| [Quantity::from(state.friction_coefficient)];
        let Refined {
            value,
            error: [error],
            parts: [parts],
            ..
        } = refine(&goal, solve, friction, |_, state| Ok([gaps(state)]))?;
        let friction = [value.friction_coefficient, error];
        Ok(self.answer(friction, value)?.with_parts(parts))
    }

    fn on_grid(&self, spacing: f64, tolerance: f64) -> Result<LineSliding> {
        let options = LineOptions {
            spacing,
            phase: 0.0,
            footprint: self.ladder.footprint,
            tolerance,
            max_iterations: MAX_ITERATIONS,
        };
        Ok(steady_line(
            self.cylinder,
            self.material,
            self.load,
            &options,
        )?)
    }

    fn answer(&self, [friction, error]: [f64; 2], state: LineSliding) -> Result<Answer> {
        let [rear, front] = state.contact;
        let force = self.load.require_normal_force()?;
        let mut answer = Answer {
            is_per_length: true,
            contact_area: Some(front - rear),
            contact_box: Some(ContactBox::along(state.contact)),
            unknowns: state.unknowns,
            iterations: state.iterations,
            ..Answer::new(Method::BemSteady, Model::HalfSpace, force).with_friction(friction, error)
        };
        answer.fields.line_pressure = state.pressure;
        Ok(answer)
    }
}

/// What the gaps that the solver leaves change of the friction.
fn gaps(state: &LineSliding) -> ErrorParts {
    ErrorParts {
        iteration: Some(state.residual * state.mean_slope),
        ..ErrorParts::NONE
    }
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

#[cfg(test)]
mod tests {
    use rheology::{StandardSolid, StandardSolidParameters};

    use super::*;

    #[test]
    fn the_gaps_of_a_cylinder_are_iteration_and_the_rest_of_its_error_is_elements() {
        let material = StandardSolid::new(StandardSolidParameters {
            equilibrium_modulus: 1.0,
            maxwell_modulus: 1.0,
            viscosity: 1.0,
        })
        .expect("a material");
        let cylinder = &Cylinder::new(1.0).expect("a body");
        let load = &SlidingLoad::new(1.0, 0.01).expect("a load");
        let ladder = LineLadder::of_profile(cylinder, &material, load).expect("a ladder");
        let expected = steady_line_friction(cylinder, (&material, load), &ladder, 1e-3);
        let expected = expected.expect("a friction");
        let sliding = Sliding {
            cylinder,
            material: &material,
            load,
            ladder,
        };
        let parts = sliding.to_an_error(1e-3).expect("an answer").error_parts;
        assert_eq!(parts.iteration, Some(expected.gap_error), "{expected:?}");
        // The difference is rounded once, and so is its sum.
        let sum = parts.sum();
        assert!(
            expected.gap_error > 0.0 && (sum / expected.error - 1.0).abs() <= 2.0 * f64::EPSILON,
            "{parts:?} sum up to {sum:e} instead of {:e}",
            expected.error
        );
    }
}
