//! The grid behind an answer, solved again, with all omissions or all but one.
//!
//! Both are the same discrete problem, and are solved far more tightly than the answer needs, so that what the
//! omission changes is not hidden.

use anyhow::{Context, Result, bail};
use bem_halfspace::indent::{IndentOptions, indent};
use bem_halfspace::slide::{
    Motion as Step, SlideOmission, SlideOptions, Transient, follow, slide, slide_without_omission,
};
use bem_halfspace::steady::{
    SteadyOmission, SteadyOptions, SteadySliding, steady, steady_without_omission,
};
use bem_halfspace::{ContactOptions, Control as Held};
use indenters::SlidingLoad;
use rheology::Material;

use super::answer::{Answer, Grid};
use super::body::{Body, Revolution};
use super::omission::Omission;
use super::question::{Motion, Question};
use super::solve::{load, normal_force, viscous};
use super::{bem, pressing};
use crate::scene_file::Method;

/// Far below the agreement that is demanded.
const STATIONARY_TOLERANCE: f64 = 1e-11;
const CONTACT: ContactOptions = ContactOptions {
    tolerance: 1e-12,
    max_iterations: 5000,
};
/// Steps to the end of a constant force where one would do.
const STEPS: usize = 8;

/// A quantity and what it is compared relative to.
type Number = [f64; 2];

/// The grid behind an answer.
pub(super) struct SameProblem<'a> {
    question: &'a Question,
    body: &'a Revolution,
    method: Method,
    grid: Grid,
}

impl<'a> SameProblem<'a> {
    pub(super) fn of(question: &'a Question, answer: &Answer) -> Result<Self> {
        let Body::Revolution(body) = &question.body else {
            bail!("only bodies of revolution are answered");
        };
        Ok(Self {
            question,
            body,
            method: answer.method,
            grid: answer.grid.context("the answer has no grid")?,
        })
    }

    /// What the grid answers when the work of an omission is done too.
    pub(super) fn solve(&self, kept: Option<Omission>) -> Result<Vec<Number>> {
        let material = &*self.question.material;
        match (self.method, self.question.motion) {
            (Method::BemSteady, Motion::Sliding { velocity, .. }) => {
                let load = load((self.question.control, velocity))?;
                self.stationary((material, &load), kept)
            }
            (Method::BemTransient, Motion::Sliding { velocity, distance }) => {
                let load = load((self.question.control, velocity))?;
                self.march(&load, distance, kept)
            }
            (Method::BemTransient, Motion::Pressing { duration }) => {
                let force = normal_force(self.question.control)?;
                self.press(material, (force, duration), kept)
            }
            (method, _) => bail!("{} has no grid", method.name()),
        }
    }

    fn stationary(
        &self,
        (material, load): (&dyn Material, &SlidingLoad),
        kept: Option<Omission>,
    ) -> Result<Vec<Number>> {
        let options = SteadyOptions {
            tolerance: STATIONARY_TOLERANCE,
            ..bem::grid_options(self.body, (material, load), self.grid.spacing)?
        };
        let without =
            |omission| steady_without_omission(self.body, material, load, &options, omission);
        let state = match kept {
            None => steady(self.body, material, load, &options),
            Some(Omission::MirrorHalf) => without(SteadyOmission::MirrorHalf),
            Some(Omission::OutsideContact) => without(SteadyOmission::OutsideContact),
            Some(Omission::Transforms) => without(SteadyOmission::Transforms),
            Some(other) => bail!("the stationary solver does not leave out {}", other.name()),
        };
        Ok(of_state(&state?))
    }

    fn march(
        &self,
        load: &SlidingLoad,
        distance: Option<f64>,
        kept: Option<Omission>,
    ) -> Result<Vec<Number>> {
        let (body, material) = (self.body, viscous(self.question)?);
        let options = SlideOptions {
            contact: CONTACT,
            ..bem::march_options(body, (&material, load), self.grid.spacing, distance)?
        };
        let without = |omission| slide_without_omission(body, &material, load, &options, omission);
        let transient = match kept {
            None => slide(body, &material, load, &options),
            Some(Omission::OutsideContact) => without(SlideOmission::OutsideContact),
            Some(Omission::RowsBehind) => without(SlideOmission::RowsBehind),
            Some(other) => bail!("a march does not leave out {}", other.name()),
        };
        Ok(of_march(&transient?))
    }

    fn press(
        &self,
        material: &dyn Material,
        (force, duration): (f64, f64),
        kept: Option<Omission>,
    ) -> Result<Vec<Number>> {
        let body = self.body;
        let options = IndentOptions {
            contact: CONTACT,
            ..pressing::grid_options(body, material, (force, duration), self.grid.spacing)?
        };
        let (dashpot, time) = pressing::dashpot_and_time(material, duration)?;
        let rows = match kept {
            None => indent(body, &dashpot, (force, &[time]), &options),
            Some(Omission::TimeSteps) => {
                let part = |step: usize| time * (step as f64 / STEPS as f64);
                let times: Vec<f64> = (1..=STEPS).map(part).collect();
                indent(body, &dashpot, (force, &times), &options)
            }
            Some(Omission::HistoryFields) => indent(body, material, (force, &[duration]), &options),
            Some(Omission::Gradients) => {
                let step = Step {
                    time,
                    position: 0.0,
                    control: Held::NormalForce(force),
                };
                let rows = follow(body, &dashpot, &[step], &options)?;
                let row = rows.last().context("the march made no step")?;
                return Ok(pressed(row.indentation_depth, row.contact_area));
            }
            Some(other) => bail!("pressing does not leave out {}", other.name()),
        }?;
        let row = rows.last().context("the march made no step")?;
        Ok(pressed(row.indentation_depth, row.contact_area))
    }
}

fn own(value: f64) -> Number {
    [value, value]
}

/// Friction is a difference of slopes of both signs, and compared relative to their mean modulus.
fn of_state(state: &SteadySliding) -> Vec<Number> {
    vec![
        [state.friction_coefficient, state.mean_slope],
        own(state.contact_area),
        own(state.normal_force),
    ]
}

fn of_march(transient: &Transient) -> Vec<Number> {
    let last = transient.last();
    let numbers = [
        last.friction_coefficient,
        last.indentation_depth,
        last.contact_area,
    ];
    numbers.map(own).to_vec()
}

fn pressed(indentation_depth: f64, contact_area: f64) -> Vec<Number> {
    [indentation_depth, contact_area].map(own).to_vec()
}
