//! Stationary sliding on the half space, under a force or at a depth.

use super::error::{Context as _, Result};
use bem_halfspace::Footprint;
use bem_halfspace::steady::{
    DepthControl, FrictionOptions, Ladder, SinkingDepth, SteadyOmission, SteadyOptions,
    SteadySliding, steady, steady_at_depth, steady_at_depth_without_omission,
    steady_friction_at_depth, steady_friction_of_surface, steady_without_omission,
};
use indenters::SlidingLoad;
use rheology::Material;

use super::answer::{Answer, ContactBox, Grid};
use super::order_of_apex;
use super::shape::{COARSEST_ELEMENTS, Drive, Shape};
use crate::scene::{Accuracy, Control, Method, Model};
use numerics::{ErrorParts, Goal, Quantity, Refined, refine};

const TOLERANCE: f64 = 1e-9;
const MAX_ITERATIONS: usize = 500;
/// Lengths of the footprint that a solid has slid over, on which they have no effect.
const FAR: f64 = 100.0;

/// The stationary state, to an error or on a grid.
pub(crate) fn stationary(
    body: &impl Shape,
    (material, drive): (&dyn Material, &Drive),
    accuracy: Accuracy,
) -> Result<Answer> {
    let scene = Scene::new(body, (material, drive))?;
    match accuracy {
        Accuracy::RelativeError(relative_error) => scene.to_an_error(relative_error),
        Accuracy::Elements(_) => scene.on_elements(accuracy),
    }
}

/// A body that slides in the stationary state.
pub(crate) struct Scene<'a, S> {
    body: &'a S,
    material: &'a dyn Material,
    drive: &'a Drive,
    ladder: Ladder,
}

impl<'a, S: Shape> Scene<'a, S> {
    pub(crate) fn new(
        body: &'a S,
        (material, drive): (&'a dyn Material, &'a Drive),
    ) -> Result<Self> {
        Ok(Self {
            body,
            material,
            drive,
            ladder: body.ladder(material, drive)?,
        })
    }

    fn to_an_error(&self, relative_error: f64) -> Result<Answer> {
        let Self { body, material, .. } = *self;
        let options = FrictionOptions {
            relative_error,
            ..FrictionOptions::default()
        };
        let estimate = match self.drive.control {
            Control::NormalForce(force) => {
                let load = SlidingLoad::new(force, self.drive.velocity)?;
                steady_friction_of_surface(body, (material, &load), &self.ladder, &options)
            }
            Control::IndentationDepth(depth) => {
                let control = self.depth_control(depth);
                steady_friction_at_depth(body, (material, &control), &self.ladder, &options)
            }
        }?;
        let last = estimate.refinements.last();
        let spacing = last.context("no grid was refined")?.spacing;
        let answer = Answer::new(Method::BemSteady, Model::HalfSpace, estimate.normal_force)
            .with_friction(estimate.friction_coefficient, estimate.error)
            .with_parts(ErrorParts {
                discretisation: Some(estimate.error - estimate.gap_error),
                iteration: Some(estimate.gap_error),
                ..ErrorParts::NONE
            });
        self.with_state(
            self.with_force_error(answer, estimate.normal_force_error),
            self.on_grid(spacing)?,
        )
    }

    fn on_elements(&self, accuracy: Accuracy) -> Result<Answer> {
        let length = COARSEST_ELEMENTS * self.ladder.coarsest_spacing;
        let solve = |elements: usize| self.on_grid(length / elements as f64);
        let goal = Goal {
            accuracy,
            largest: usize::MAX,
            order: order_of_apex(self.ladder.apex_exponent),
        };
        let Refined {
            value,
            error: [friction_error, force_error],
            parts: [parts, _],
            ..
        } = refine(&goal, solve, on_one_grid, |_, state| Ok(gaps(state)))?;
        let answer = Answer::new(Method::BemSteady, Model::HalfSpace, value.normal_force)
            .with_friction(value.friction_coefficient, friction_error)
            .with_parts(parts);
        self.with_state(self.with_force_error(answer, force_error), value)
    }

    /// A force that is given has no error.
    fn with_force_error(&self, answer: Answer, error: f64) -> Answer {
        match self.drive.control {
            Control::NormalForce(_) => answer,
            Control::IndentationDepth(_) => Answer {
                normal_force_error: Some(error),
                ..answer
            },
        }
    }

    fn with_state(&self, answer: Answer, state: SteadySliding) -> Result<Answer> {
        let indentation_depth = match self.drive.control {
            Control::NormalForce(_) => depth_after(&state.depth, self.drive.distance)?,
            Control::IndentationDepth(depth) => Some(depth),
        };
        let mut answer = Answer {
            indentation_depth,
            contact_area: Some(state.contact_area),
            contact_box: Some(ContactBox::around(state.contact_x, state.contact_y)),
            unknowns: state.unknowns,
            iterations: state.iterations,
            grid: Some(Grid {
                spacing: state.pressure.grid.spacing()[0],
                factorised: state.is_factorised(),
            }),
            ..answer
        };
        answer.fields.pressure = Some(state.pressure);
        Ok(answer)
    }

    fn on_grid(&self, spacing: f64) -> Result<SteadySliding> {
        self.solve(&self.grid(spacing), None)
    }

    /// Elements half as wide as long.
    pub(crate) fn grid(&self, spacing: f64) -> SteadyOptions {
        SteadyOptions {
            spacing: [spacing, 0.5 * spacing],
            phase: [0.0, 0.0],
            footprint: widened(&self.ladder.footprint, spacing),
            tolerance: TOLERANCE,
            max_iterations: MAX_ITERATIONS,
        }
    }

    /// The state on one grid, where the work of an omission may be done too.
    pub(crate) fn solve(
        &self,
        grid: &SteadyOptions,
        kept: Option<SteadyOmission>,
    ) -> Result<SteadySliding> {
        let Self { body, material, .. } = *self;
        Ok(match self.drive.control {
            Control::NormalForce(force) => {
                let load = SlidingLoad::new(force, self.drive.velocity)?;
                match kept {
                    None => steady(body, material, &load, grid),
                    Some(kept) => steady_without_omission(body, material, &load, grid, kept),
                }
            }
            Control::IndentationDepth(depth) => {
                let control = self.depth_control(depth);
                match kept {
                    None => steady_at_depth(body, material, &control, grid),
                    Some(kept) => {
                        steady_at_depth_without_omission(body, material, &control, grid, kept)
                    }
                }
            }
        }?)
    }

    fn depth_control(&self, depth: f64) -> DepthControl {
        let [rear, front] = self.ladder.footprint.x;
        DepthControl {
            depth,
            sliding_distance: self.drive.distance.unwrap_or(FAR * (front - rear)),
            velocity: self.drive.velocity,
        }
    }
}

fn on_one_grid(state: &SteadySliding) -> [Quantity; 2] {
    [state.friction_coefficient, state.normal_force].map(Quantity::from)
}

/// What the gaps that the solver leaves change of friction and force.
fn gaps(state: &SteadySliding) -> [ErrorParts; 2] {
    let friction = ErrorParts {
        iteration: Some(state.residual * state.mean_slope),
        ..ErrorParts::NONE
    };
    [friction, ErrorParts::NONE]
}

/// With room for elements at the boundary, where a steep body leaves none.
pub(crate) fn widened(footprint: &Footprint, spacing: f64) -> Footprint {
    let widened = |[first, last]: [f64; 2]| [first - 2.0 * spacing, last + 2.0 * spacing];
    Footprint {
        x: widened(footprint.x),
        y: widened(footprint.y),
    }
}

/// A solid has a depth of its own; one that flows has a depth after a distance only.
fn depth_after(depth: &SinkingDepth, distance: Option<f64>) -> Result<Option<f64>> {
    if depth.depth_per_e_fold == 0.0 {
        return Ok(Some(depth.reference_depth));
    }
    Ok(distance.map(|distance| depth.after(distance)).transpose()?)
}

#[cfg(test)]
mod tests {
    use indenters::PowerProfile;
    use rheology::{StandardSolid, StandardSolidParameters, Viscous};

    use super::*;
    use crate::solve::Revolution;

    /// Contacts that are large enough to be solved by iteration.
    #[test]
    fn smaller_gaps_change_the_friction_by_less_than_the_iteration() {
        let solid = StandardSolid::new(StandardSolidParameters {
            equilibrium_modulus: 1.0,
            maxwell_modulus: 3.0,
            viscosity: 1.0,
        })
        .expect("a material");
        let viscous = Viscous::new(1.0).expect("a material");
        let materials: [&dyn Material; 2] = [&viscous, &solid];
        for (exponent, material) in [1.0, 2.0].iter().flat_map(|p| materials.map(|m| (*p, m))) {
            let body = Revolution::Power(PowerProfile::new(0.3, exponent).expect("a body"));
            let drive = Drive {
                control: Control::NormalForce(1.0),
                velocity: 1.0,
                distance: None,
            };
            let scene = Scene::new(&body, (material, &drive)).expect("a scene");
            let spacing = COARSEST_ELEMENTS * scene.ladder.coarsest_spacing / 48.0;
            let [coarse, exact] = [1e-4, 1e-12].map(|tolerance| {
                let options = SteadyOptions {
                    tolerance,
                    ..scene.grid(spacing)
                };
                scene.solve(&options, None).expect("a state")
            });
            let change = (coarse.friction_coefficient - exact.friction_coefficient).abs();
            let [parts, _] = gaps(&coarse);
            let iteration = parts.iteration.expect("a part");
            assert!(
                change <= iteration && iteration > 0.0,
                "p = {exponent} on {material:?}, {} unknowns: {change:e}, and the part is {iteration:e}",
                coarse.unknowns
            );
        }
    }
}
