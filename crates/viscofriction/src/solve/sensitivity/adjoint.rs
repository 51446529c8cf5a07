//! Stationary contacts on the half space: one adjoint solution for each quantity, whatever the number of parameters.

use bem_halfspace::Elastomer;
use bem_halfspace::steady::sensitivity::{Change, SteadySensitivity};
use indenters::{SlidingLoad, Surface};
use numerics::Estimate;

use super::Sensitivity;
use super::parameters::{Number, Numbers};
use crate::scene::{Method, SceneError};
use crate::solve::answer::{Answer, StationaryGrid};
use crate::solve::body::Body;
use crate::solve::error::{Result, SolveError};
use crate::solve::problem::{Motion, Problem};

/// Relative step of the numbers; what it leaves out is far below the bars.
const STEP: f64 = 1e-5;

pub(super) fn sensitivities(
    (numbers, all): (&Numbers, &[Number]),
    problem: &Problem,
    load: &SlidingLoad,
    answer: &Answer,
) -> Result<Vec<Sensitivity>> {
    let contact = contact(problem, load, answer)?;
    let of = |number: &Number| {
        let ends = neighbours(numbers, number)?;
        let change = change(&contact, number, &ends)?;
        let width = (ends[1].1 / ends[0].1).ln();
        Ok(relative(number.path(), answer, change, width))
    };
    all.iter().map(of).collect()
}

/// The contact of an answer with its adjoint loads.
pub(super) fn contact(
    problem: &Problem,
    load: &SlidingLoad,
    answer: &Answer,
) -> Result<SteadySensitivity> {
    let method = Method::BemSteady;
    let elastomer = problem.elastomer()?;
    Ok(match (problem.body(), answer.stationary) {
        (Body::Cylinder(cylinder), Some(StationaryGrid::Line(options))) => {
            SteadySensitivity::of_line(cylinder, &elastomer, load, &options)
        }
        (body, Some(StationaryGrid::Contact(options))) => {
            let surface = body.surface().ok_or(SolveError::NoSensitivity { method })?;
            SteadySensitivity::new(surface, &elastomer, load, &options)
        }
        _ => return Err(SolveError::NoSensitivity { method }),
    }?)
}

/// The problems on both sides of a number, or from below where it is the largest allowed one, with its values.
fn neighbours(numbers: &Numbers, number: &Number) -> Result<[(Problem, f64); 2], SceneError> {
    let at = |factor: f64| {
        let value = factor * number.value;
        Ok::<_, SceneError>((numbers.problem(number, value)?, value))
    };
    Ok([at(1.0 - STEP)?, at(1.0 + STEP).or_else(|_| at(1.0))?])
}

fn change(
    contact: &SteadySensitivity,
    number: &Number,
    ends: &[(Problem, f64); 2],
) -> Result<Change<Estimate>> {
    let [from, to] = [&ends[0].0, &ends[1].0];
    let velocity = |problem: &Problem| match problem.motion() {
        Motion::Sliding(load) => load.velocity(),
        _ => f64::NAN,
    };
    let velocities = [from, to].map(velocity);
    let is_layer = to.thickness().is_finite();
    Ok(match number.ends() {
        ["load", "normal_force" | "indentation_depth"] => {
            scaled(contact.by_load(), ends[1].1 - ends[0].1)
        }
        ["indenter", _] => contact.between_bodies([surface(from)?, surface(to)?])?,
        ["load", "track"] => scaled(contact.by_track(), (ends[1].1 / ends[0].1).ln()),
        ["layer", _] => scaled(contact.by_thickness(), (ends[1].1 / ends[0].1).ln()),
        ["material", "poisson_ratio"] if is_layer => {
            let [from, to] = [from.elastomer()?, to.elastomer()?];
            contact.between_elastomers([&from as &dyn Elastomer, &to], velocities)?
        }
        _ => contact.between_materials([from.material(), to.material()], velocities)?,
    })
}

fn surface(problem: &Problem) -> Result<&dyn Surface> {
    let method = Method::BemSteady;
    match problem.body() {
        Body::Cylinder(cylinder) => Ok(cylinder),
        body => body.surface().ok_or(SolveError::NoSensitivity { method }),
    }
}

fn scaled(change: Change<Estimate>, factor: f64) -> Change<Estimate> {
    let times = |value: Estimate| value * factor;
    Change {
        friction_coefficient: times(change.friction_coefficient),
        indentation_depth: change.indentation_depth.map(times),
        normal_force: change.normal_force.map(times),
    }
}

/// The derivatives of the logarithms by that of a parameter, which changes by so much.
pub(super) fn relative(
    parameter: String,
    answer: &Answer,
    change: Change<Estimate>,
    width: f64,
) -> Sensitivity {
    let of = |change: Option<Estimate>, value: Option<Estimate>| {
        let (change, value) = change.zip(value.filter(|value| value.value != 0.0))?;
        let derivative = change.value / (width * value.value);
        // The answer differs from what these grids have.
        let of_value = derivative * value.error / value.value;
        let error = change.error / (width * value.value);
        Some(Estimate::new(derivative, error.abs() + of_value.abs()))
    };
    Sensitivity {
        parameter,
        friction_coefficient: of(
            Some(change.friction_coefficient),
            answer.friction_coefficient,
        ),
        normal_force: of(change.normal_force, Some(answer.normal_force)),
        indentation_depth: of(change.indentation_depth, answer.indentation_depth),
        contact_area: None,
    }
}
