//! The grid behind an answer, solved again, with all omissions or all but one.
//!
//! Both are the same discrete problem, and are solved far more tightly than the answer needs, so that what the
//! omission changes is not hidden.

use super::error::{Context as _, Result, bail};
use bem_halfspace::indent::{IndentOptions, IndentRow, IndentStep, indent, indent_history};
use bem_halfspace::slide::{Motion as Step, MotionRow, SlideOmission, follow};
use bem_halfspace::steady::{SteadyOmission, SteadyOptions, SteadySliding};
use bem_halfspace::{BemError, ContactOptions};
use indenters::Unmirrored;

use super::answer::{Answer, Grid};
use super::body::Body;
use super::omission::Omission;
use super::problem::{Motion, Problem};
use super::shape::{Drive, Shape};
use super::{bem, march, pressing};
use crate::scene::{Control, Method};

/// Far below the agreement that is demanded.
const STATIONARY_TOLERANCE: f64 = 1e-11;
const CONTACT: ContactOptions = ContactOptions {
    tolerance: 1e-12,
    max_iterations: 5000,
};
/// Steps to the end where one would do.
const STEPS: usize = 8;

/// A quantity and what it is compared relative to.
pub(crate) type Number = [f64; 2];

/// The grid behind an answer.
#[derive(Debug)]
pub struct SameProblem<'a> {
    problem: &'a Problem,
    method: Method,
    grid: Grid,
    /// Distance over which the answer marched, \[m].
    marched: Option<f64>,
}

impl<'a> SameProblem<'a> {
    /// The grid on which the answer was found last.
    ///
    /// # Errors
    /// [`super::SolveError`] for an answer without a grid.
    pub fn of(problem: &'a Problem, answer: &Answer) -> Result<Self> {
        let last = answer.fields.history.last();
        Ok(Self {
            problem,
            method: answer.method,
            grid: answer.grid.context("the answer has no grid")?,
            marched: last.map(|row| row.sliding_distance_m),
        })
    }

    /// What the grid answers when the work of an omission is done too: quantities, each with the scale by which its changes are
    /// judged.
    ///
    /// # Errors
    /// [`super::SolveError`] of the solver, and for work that the method does not have.
    pub fn solve(&self, kept: Option<Omission>) -> Result<Vec<Number>> {
        match &self.problem.body {
            Body::Revolution(body) => self.with_or_without_mirrors(body, kept),
            Body::HeightMap(map) => self.with_or_without_mirrors(map, kept),
            Body::Cylinder(_) => bail!("nothing of a line contact is measured"),
        }
    }

    fn with_or_without_mirrors(
        &self,
        body: &impl Shape,
        kept: Option<Omission>,
    ) -> Result<Vec<Number>> {
        match kept {
            Some(Omission::MirrorHalf) => self.solve_for(&Unmirrored(body), None),
            _ => self.solve_for(body, kept),
        }
    }

    fn solve_for(&self, body: &impl Shape, kept: Option<Omission>) -> Result<Vec<Number>> {
        let load = match self.problem.motion {
            Motion::Sliding(load) => load,
            Motion::Pressing(load) => return self.press(body, load.duration(), kept),
        };
        let drive = Drive {
            control: load.control(),
            velocity: load.velocity(),
            distance: load.sliding_distance(),
        };
        match self.method {
            Method::BemSteady => self.stationary(body, &drive, kept),
            Method::BemTransient => self.march(body, &drive, kept),
            other => bail!("{} has no grid", other.name()),
        }
    }

    fn stationary(
        &self,
        body: &impl Shape,
        drive: &Drive,
        kept: Option<Omission>,
    ) -> Result<Vec<Number>> {
        let scene = bem::Scene::new(body, (&*self.problem.material, drive))?;
        let options = SteadyOptions {
            tolerance: STATIONARY_TOLERANCE,
            ..scene.grid(self.grid.spacing)
        };
        let kept = match kept {
            None => None,
            Some(Omission::OutsideContact) => Some(SteadyOmission::OutsideContact),
            Some(Omission::Transforms) => Some(SteadyOmission::Transforms),
            Some(other) => bail!("the stationary solver does not leave out {}", other.name()),
        };
        Ok(of_state(&scene.solve(&options, kept)?))
    }

    fn march(
        &self,
        body: &impl Shape,
        drive: &Drive,
        kept: Option<Omission>,
    ) -> Result<Vec<Number>> {
        let material = &*self.problem.material;
        let scene = march::Scene::new(body, (material, drive), self.problem.accuracy)?;
        let distance = drive.distance.or(self.marched);
        let distance = distance.context("the answer has no distance")?;
        let march = scene.over([self.grid.spacing, distance], CONTACT)?;
        let mut march = match kept {
            None => march,
            Some(Omission::OutsideContact) => {
                march.without_omission(SlideOmission::OutsideContact)?
            }
            Some(Omission::RowsBehind) => march.without_omission(SlideOmission::RowsBehind)?,
            Some(other) => bail!("a march does not leave out {}", other.name()),
        };
        let mut last = None;
        while let Some(row) = march.step()? {
            last = Some(row);
        }
        of_motion(&last.context("the march made no step")?)
    }

    fn press(
        &self,
        body: &impl Shape,
        duration: f64,
        kept: Option<Omission>,
    ) -> Result<Vec<Number>> {
        let (control, material) = (self.problem.motion.control(), &*self.problem.material);
        let pressed = pressing::on_unit_dashpot(material, (control, duration))?;
        let options = IndentOptions {
            spacing: [self.grid.spacing; 2],
            footprint: body.patch(pressed)?.footprint,
            contact: CONTACT,
        };
        let dashpot = pressing::unit_dashpot()?;
        let rows = match (kept, control) {
            (None, _) => indent_history(body, &dashpot, &pressing::in_steps(pressed, 1), &options),
            (Some(Omission::TimeSteps), _) => {
                let steps = pressing::in_steps(pressed, STEPS);
                indent_history(body, &dashpot, &steps, &options)
            }
            (Some(Omission::Gradients), _) => press_with_slopes(body, pressed, &options),
            (Some(Omission::HistoryFields), Control::NormalForce(force)) => {
                indent(body, material, (force, &[duration]), &options)
            }
            (Some(other), _) => bail!("pressing does not leave out {}", other.name()),
        }?;
        of_press(control, &rows)
    }
}

/// The step made as a motion over no distance, with its slopes.
fn press_with_slopes(
    body: &impl Shape,
    pressed: Control,
    options: &IndentOptions,
) -> Result<Vec<IndentRow>, BemError> {
    let steps = pressing::in_steps(pressed, 1);
    let motion = |step: &IndentStep| Step {
        time: step.time,
        position: 0.0,
        control: step.control,
    };
    let motions: Vec<Step> = steps.iter().map(motion).collect();
    let rows = follow(body, &pressing::unit_dashpot()?, &motions, options)?;
    let without_slopes = |row: &MotionRow| IndentRow {
        time: row.time,
        indentation_depth: row.indentation_depth,
        normal_force: row.normal_force,
        contact_area: row.contact_area,
        n_contact: row.n_contact,
    };
    Ok(rows.iter().map(without_slopes).collect())
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

/// Friction relative to the slope of a body that rises by the depth over the length of the contact.
fn of_motion(row: &MotionRow) -> Result<Vec<Number>> {
    let [rear, front] = row.contact_x.context("the march ended without contact")?;
    let slope = row.indentation_depth.abs() / (front - rear);
    Ok(vec![
        [row.tangential_force / row.normal_force, slope],
        own(row.indentation_depth),
        own(row.contact_area),
        own(row.normal_force),
    ])
}

/// Of force and depth the one that is not given.
fn of_press(control: Control, rows: &[IndentRow]) -> Result<Vec<Number>> {
    let last = rows.last().context("the march made no step")?;
    let found = match control {
        Control::NormalForce(_) => last.indentation_depth,
        Control::IndentationDepth(_) => impulse(rows),
    };
    Ok(vec![own(found), own(last.contact_area)])
}

/// ∫F dt, which a depth on a dashpot needs, in however many steps, \[N s].
fn impulse(rows: &[IndentRow]) -> f64 {
    let begins = std::iter::once(0.0).chain(rows.iter().map(|row| row.time));
    let steps = rows.iter().zip(begins);
    steps
        .map(|(row, begin)| row.normal_force * (row.time - begin))
        .sum()
}
