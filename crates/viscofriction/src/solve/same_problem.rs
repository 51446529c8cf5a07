//! The grid behind an answer, solved again, with all omissions or all but one.
//!
//! Both are the same discrete problem, and are solved far more tightly than the answer needs, so that what the
//! omission changes is not hidden.

use bem_halfspace::indent::{IndentRow, IndentStep, indent_history_on_grid};
use bem_halfspace::slide::{March, Motion as Step, MotionRow, SlideOmission, follow};
use bem_halfspace::steady::{SteadyOmission, SteadyOptions, SteadySliding, steady_on_grid};
use bem_halfspace::{BemError, ContactOptions, GridOptions};
use indenters::{PressingLoad, SlidingLoad, Surface, Unmirrored};

use super::answer::{Answer, Grid};
use super::body::Body;
use super::error::{Result, SolveError};
use super::omission::Omission;
use super::pressing;
use super::problem::{Motion, Problem};
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
    grid: Grid,
    method: Method,
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
            grid: answer.grid.ok_or(SolveError::NoGrid)?,
            method: answer.method,
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
            Body::Cylinder(_) => Err(SolveError::NoGrid),
        }
    }

    const fn not_left_out(&self, omission: Omission) -> SolveError {
        SolveError::NotLeftOut {
            method: self.method,
            omission,
        }
    }

    fn with_or_without_mirrors(
        &self,
        surface: &dyn Surface,
        kept: Option<Omission>,
    ) -> Result<Vec<Number>> {
        match kept {
            Some(Omission::MirrorHalf) => self.solve_for(&Unmirrored(surface), None),
            _ => self.solve_for(surface, kept),
        }
    }

    fn solve_for(&self, surface: &dyn Surface, kept: Option<Omission>) -> Result<Vec<Number>> {
        match (self.problem.motion, self.grid) {
            (Motion::Pressing(load), Grid::March(grid)) => self.press(surface, &load, &grid, kept),
            (Motion::Sliding(load), Grid::March(grid)) => self.march(surface, &load, &grid, kept),
            (Motion::Sliding(load), Grid::Stationary { options, .. }) => {
                self.stationary(surface, &load, &options, kept)
            }
            (Motion::Pressing(_), Grid::Stationary { .. }) => Err(SolveError::NoGrid),
        }
    }

    fn stationary(
        &self,
        surface: &dyn Surface,
        load: &SlidingLoad,
        grid: &SteadyOptions,
        kept: Option<Omission>,
    ) -> Result<Vec<Number>> {
        let options = SteadyOptions {
            tolerance: STATIONARY_TOLERANCE,
            redundant_work: match kept {
                None => None,
                Some(Omission::OutsideContact) => Some(SteadyOmission::OutsideContact),
                Some(Omission::Transforms) => Some(SteadyOmission::Transforms),
                Some(other) => return Err(self.not_left_out(other)),
            },
            ..*grid
        };
        let state = steady_on_grid(surface, &*self.problem.material, load, &options)?;
        Ok(of_state(&state))
    }

    fn march(
        &self,
        surface: &dyn Surface,
        load: &SlidingLoad,
        grid: &GridOptions,
        kept: Option<Omission>,
    ) -> Result<Vec<Number>> {
        let distance = load.sliding_distance().or(self.marched);
        let load = load.after(distance.ok_or(SolveError::NoGrid)?)?;
        let options = GridOptions {
            contact: CONTACT,
            redundant_work: match kept {
                None => None,
                Some(Omission::OutsideContact) => Some(SlideOmission::OutsideContact),
                Some(Omission::RowsBehind) => Some(SlideOmission::RowsBehind),
                Some(other) => return Err(self.not_left_out(other)),
            },
            ..*grid
        };
        let mut march = March::sliding(surface, &*self.problem.material, &load, &options)?;
        let mut last = None;
        while let Some(row) = march.step()? {
            last = Some(row);
        }
        of_motion(&last.ok_or(SolveError::NoGrid)?)
    }

    fn press(
        &self,
        surface: &dyn Surface,
        load: &PressingLoad,
        grid: &GridOptions,
        kept: Option<Omission>,
    ) -> Result<Vec<Number>> {
        let (control, material) = (load.control(), &*self.problem.material);
        let pressed = pressing::on_unit_dashpot(material, (control, load.duration()))?;
        let options = GridOptions {
            contact: CONTACT,
            ..*grid
        };
        let dashpot = pressing::unit_dashpot()?;
        let in_steps = |n_steps: usize| {
            let steps = pressing::in_steps(pressed, n_steps);
            indent_history_on_grid(surface, &dashpot, &steps, &options)
        };
        let rows = match (kept, control) {
            (None, _) => in_steps(1),
            (Some(Omission::TimeSteps), _) => in_steps(STEPS),
            (Some(Omission::Gradients), _) => press_with_slopes(surface, pressed, &options),
            (Some(Omission::HistoryFields), Control::NormalForce(_)) => {
                let steps = IndentStep::constant(control, &[load.duration()]);
                indent_history_on_grid(surface, material, &steps, &options)
            }
            (Some(other), _) => return Err(self.not_left_out(other)),
        }?;
        of_press(control, &rows)
    }
}

/// The step made as a motion over no distance, with its slopes.
fn press_with_slopes(
    surface: &dyn Surface,
    pressed: Control,
    options: &GridOptions,
) -> Result<Vec<IndentRow>, BemError> {
    let steps = pressing::in_steps(pressed, 1);
    let motion = |step: &IndentStep| Step {
        time: step.time,
        position: 0.0,
        control: step.control,
    };
    let motions: Vec<Step> = steps.iter().map(motion).collect();
    let rows = follow(surface, &pressing::unit_dashpot()?, &motions, options)?;
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
    let [rear, front] = row.contact_x.ok_or(SolveError::NoGrid)?;
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
    let last = rows.last().ok_or(SolveError::NoGrid)?;
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
