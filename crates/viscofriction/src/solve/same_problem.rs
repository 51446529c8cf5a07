//! The grid behind an answer, solved again, with all omissions or all but one.
//!
//! Both are the same discrete problem, and are solved far more tightly than the answer needs, so that what the
//! omission changes is not hidden.

use bem_halfspace::indent::{IndentStep, indent_history_on_grid};
use bem_halfspace::slide::{March, Motion as Step, SlideOmission, follow};
use bem_halfspace::steady::{SteadyOmission, SteadyOptions, steady_on_grid};
use bem_halfspace::{ContactOptions, GridOptions};
use indenters::{PressingLoad, SlidingLoad, Surface, Unmirrored};
use rheology::{Material, Viscous};

use super::analytic::impulse;
use super::answer::{Answer, Grid};
use super::error::{Result, SolveError};
use super::omission::Omission;
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

/// What the grid on which the answer was found last answers when the work of an omission is done too: quantities, each with
/// the scale by which its changes are judged.
///
/// # Errors
/// [`SolveError`] for an answer without a grid, for work that the method does not have, and of the solver.
pub fn solve_again(
    problem: &Problem,
    answer: &Answer,
    kept: Option<Omission>,
) -> Result<Vec<Number>> {
    let surface = problem.body.surface().ok_or(SolveError::NoGrid)?;
    let unmirrored = Unmirrored(surface);
    let (surface, kept): (&dyn Surface, _) = match kept {
        Some(Omission::MirrorHalf) => (&unmirrored, None),
        _ => (surface, kept),
    };
    let material = &*problem.material;
    match (problem.motion, answer.grid.ok_or(SolveError::NoGrid)?) {
        (Motion::Pressing(load), Grid::March(grid)) => press(surface, material, &load, grid, kept),
        (Motion::Sliding(load), Grid::March(grid)) => {
            let marched = answer.fields.history.last();
            let marched = marched.map(|row| row.sliding_distance_m);
            let distance = load.sliding_distance().or(marched);
            let load = load.after(distance.ok_or(SolveError::NoGrid)?)?;
            march(surface, material, &load, grid, kept)
        }
        (Motion::Sliding(load), Grid::Stationary { options, .. }) => {
            stationary(surface, material, &load, options, kept)
        }
        (Motion::Pressing(_), Grid::Stationary { .. }) | (Motion::History(_), _) => {
            Err(SolveError::NoGrid)
        }
    }
}

/// Friction is a difference of slopes of both signs, and compared relative to their mean modulus.
fn stationary(
    surface: &dyn Surface,
    material: &dyn Material,
    load: &SlidingLoad,
    grid: SteadyOptions,
    kept: Option<Omission>,
) -> Result<Vec<Number>> {
    let method = Method::BemSteady;
    let options = SteadyOptions {
        tolerance: STATIONARY_TOLERANCE,
        redundant_work: match kept {
            None => None,
            Some(Omission::OutsideContact) => Some(SteadyOmission::OutsideContact),
            Some(Omission::Transforms) => Some(SteadyOmission::Transforms),
            Some(omission) => return Err(SolveError::NotLeftOut { method, omission }),
        },
        ..grid
    };
    let state = steady_on_grid(surface, material, load, &options)?;
    Ok(vec![
        [state.friction_coefficient, state.mean_slope],
        own(state.contact_area),
        own(state.normal_force),
    ])
}

/// Friction relative to the slope of a body that rises by the depth over the length of the contact.
fn march(
    surface: &dyn Surface,
    material: &dyn Material,
    load: &SlidingLoad,
    grid: GridOptions,
    kept: Option<Omission>,
) -> Result<Vec<Number>> {
    let method = Method::BemTransient;
    let options = GridOptions {
        contact: CONTACT,
        redundant_work: match kept {
            None => None,
            Some(Omission::OutsideContact) => Some(SlideOmission::OutsideContact),
            Some(Omission::RowsBehind) => Some(SlideOmission::RowsBehind),
            Some(omission) => return Err(SolveError::NotLeftOut { method, omission }),
        },
        ..grid
    };
    let mut march = March::sliding(surface, material, load, &options)?;
    let mut last = None;
    while let Some(row) = march.step()? {
        last = Some(row);
    }
    let row = last.ok_or(SolveError::NoContact)?;
    let [rear, front] = row.contact_x.ok_or(SolveError::NoContact)?;
    let slope = row.indentation_depth.abs() / (front - rear);
    Ok(vec![
        [row.tangential_force / row.normal_force, slope],
        own(row.indentation_depth),
        own(row.contact_area),
        own(row.normal_force),
    ])
}

/// Of depth and force, as ∫F dt in however many steps, the one that is not given.
fn press(
    surface: &dyn Surface,
    material: &dyn Material,
    load: &PressingLoad,
    grid: GridOptions,
    kept: Option<Omission>,
) -> Result<Vec<Number>> {
    let (control, duration) = (load.control(), load.duration());
    let options = GridOptions {
        contact: CONTACT,
        ..grid
    };
    // What does in a second on the dashpot of unit viscosity what the control does to the material.
    let dashpot = Viscous::new(1.0)?;
    let pressed = match control {
        Control::NormalForce(force) => Control::NormalForce(impulse(material, force, duration)?),
        Control::IndentationDepth(_) => control,
    };
    let in_steps = |n_steps: usize| {
        let steps = in_steps(pressed, n_steps);
        indent_history_on_grid(surface, &dashpot, &steps, &options)
    };
    let method = Method::BemTransient;
    let rows = match (kept, control) {
        (None, _) => in_steps(1),
        (Some(Omission::TimeSteps), _) => in_steps(STEPS),
        (Some(Omission::HistoryFields), Control::NormalForce(_)) => {
            let steps = IndentStep::constant(control, &[duration]);
            indent_history_on_grid(surface, material, &steps, &options)
        }
        (Some(Omission::Gradients), _) => {
            // A motion over no distance, with its slopes.
            let step = Step {
                time: 1.0,
                position: 0.0,
                control: pressed,
            };
            let rows = follow(surface, &dashpot, &[step], &options)?;
            let row = rows.last().ok_or(SolveError::NoContact)?;
            let found = [row.indentation_depth, row.normal_force];
            return Ok(of_press(control, found, row.contact_area));
        }
        (Some(omission), _) => return Err(SolveError::NotLeftOut { method, omission }),
    }?;
    let begins = std::iter::once(0.0).chain(rows.iter().map(|row| row.time));
    let impulses = rows.iter().zip(begins);
    let impulses = impulses.map(|(row, begin)| row.normal_force * (row.time - begin));
    let last = rows.last().ok_or(SolveError::NoContact)?;
    let found = [last.indentation_depth, impulses.sum()];
    Ok(of_press(control, found, last.contact_area))
}

/// A second of a constant force, or of a depth that grows in proportion to time.
fn in_steps(control: Control, n_steps: usize) -> Vec<IndentStep> {
    let step = |step: usize| {
        let time = step as f64 / n_steps as f64;
        let control = match control {
            Control::NormalForce(_) => control,
            Control::IndentationDepth(depth) => Control::IndentationDepth(time * depth),
        };
        IndentStep { time, control }
    };
    (1..=n_steps).map(step).collect()
}

fn of_press(control: Control, [depth, impulse]: [f64; 2], area: f64) -> Vec<Number> {
    let found = match control {
        Control::NormalForce(_) => depth,
        Control::IndentationDepth(_) => impulse,
    };
    vec![own(found), own(area)]
}

const fn own(value: f64) -> Number {
    [value, value]
}
