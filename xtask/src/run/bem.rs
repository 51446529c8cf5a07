//! Stationary sliding on the half space, under a force or at a depth.

use anyhow::{Context, Result};
use bem_halfspace::Footprint;
use bem_halfspace::steady::{
    DepthControl, FrictionOptions, Ladder, SinkingDepth, SteadyOmission, SteadyOptions,
    SteadySliding, steady, steady_at_depth, steady_at_depth_without_omission,
    steady_friction_at_depth, steady_friction_of_surface, steady_without_omission,
};
use indenters::SlidingLoad;
use rheology::Material;

use super::answer::{Answer, ContactBox, Grid};
use super::resolution::{Resolved, resolve};
use super::shape::{COARSEST_ELEMENTS, Drive, Shape};
use crate::scene_file::{Accuracy, Control, Method, Model};

const TOLERANCE: f64 = 1e-9;
const MAX_ITERATIONS: usize = 500;
/// Lengths of the footprint that a solid has slid over, on which they have no effect.
const FAR: f64 = 100.0;

/// The stationary state, to an error or on a grid.
pub(super) fn stationary(
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
pub(super) struct Scene<'a, S> {
    body: &'a S,
    material: &'a dyn Material,
    drive: &'a Drive,
    ladder: Ladder,
}

impl<'a, S: Shape> Scene<'a, S> {
    pub(super) fn new(
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
            .with_friction(estimate.friction_coefficient, estimate.error);
        self.with_state(
            self.with_force_error(answer, estimate.normal_force_error),
            self.on_grid(spacing)?,
        )
    }

    fn on_elements(&self, accuracy: Accuracy) -> Result<Answer> {
        let length = COARSEST_ELEMENTS * self.ladder.coarsest_spacing;
        let solve = |elements: usize| self.on_grid(length / elements as f64);
        let Resolved {
            value,
            error: [friction_error, force_error],
            ..
        } = resolve(accuracy, usize::MAX, solve, |state| {
            [state.friction_coefficient, state.normal_force]
        })?;
        let answer = Answer::new(Method::BemSteady, Model::HalfSpace, value.normal_force)
            .with_friction(value.friction_coefficient, friction_error);
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
    pub(super) fn grid(&self, spacing: f64) -> SteadyOptions {
        SteadyOptions {
            spacing: [spacing, 0.5 * spacing],
            phase: [0.0, 0.0],
            footprint: widened(&self.ladder.footprint, spacing),
            tolerance: TOLERANCE,
            max_iterations: MAX_ITERATIONS,
        }
    }

    /// The state on one grid, where the work of an omission may be done too.
    pub(super) fn solve(
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

/// With room for elements at the boundary, where a steep body leaves none.
pub(super) fn widened(footprint: &Footprint, spacing: f64) -> Footprint {
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
