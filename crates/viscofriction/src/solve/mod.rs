//! From a problem to its answer.

mod analytic;
mod answer;
mod bem;
mod body;
mod error;
mod error_parts;
mod half_space;
mod line_contact;
mod march;
mod mdr;
mod memory;
mod offer;
mod omission;
mod pressing;
mod problem;
mod resolution;
mod same_problem;
mod shape;

pub use answer::{Answer, ContactBox, Fields, Grid, HistoryRow};
pub use body::{Body, Revolution};
pub use error::{Result, SolveError};
pub use error_parts::ErrorParts;
pub use offer::{NotOffered, choose};
pub use omission::Omission;
pub(crate) use problem::not_offered;
pub use problem::{Motion, Problem, ReadFile, problem_of};
pub use same_problem::SameProblem;

use self::error::bail;
use indenters::SlidingLoad;

use self::half_space::{Simple, simple};
use self::omission::plan;
use self::shape::{Drive, Shape};
use crate::scene::{Accuracy, Control, Method, Model};

/// Asks the method of the scene, or the cheapest that answers it.
pub fn solve(problem: &Problem) -> Result<Answer> {
    solve_by(problem, choose(problem)?, problem.accuracy)
}

/// Asks a method that answers the scene.
pub fn solve_by(problem: &Problem, method: Method, accuracy: Accuracy) -> Result<Answer> {
    let way = (method, accuracy);
    let answer = match (&problem.body, method) {
        (Body::Revolution(body), Method::BemSteady | Method::BemTransient) => {
            by_elements(problem, body, way)
        }
        (Body::Revolution(body), _) => of_revolution(problem, body, way),
        (Body::HeightMap(map), _) => by_elements(problem, map, way),
        (Body::Cylinder(cylinder), _) => line_contact::answer(problem, cylinder, accuracy),
    }?;
    let left_out = plan(problem, &answer);
    // Closed forms of pressing are those of both models.
    let model = match method {
        Method::Analytic => problem.model,
        _ => answer.model,
    };
    let answer = Answer {
        model,
        left_out,
        ..answer
    };
    answer.finite()
}

fn by_elements(
    problem: &Problem,
    body: &impl Shape,
    (method, accuracy): (Method, Accuracy),
) -> Result<Answer> {
    let (material, control) = (&*problem.material, problem.control);
    let (velocity, distance) = match problem.motion {
        Motion::Sliding { velocity, distance } => (velocity, distance),
        Motion::Pressing { duration } => {
            return pressing::boundary_elements(body, material, (control, duration), accuracy);
        }
    };
    let drive = Drive {
        control,
        velocity,
        distance,
    };
    match method {
        Method::BemSteady => bem::stationary(body, (material, &drive), accuracy),
        _ => march::transient(body, (material, &drive), accuracy),
    }
}

fn of_revolution(problem: &Problem, body: &Revolution, way: (Method, Accuracy)) -> Result<Answer> {
    match problem.motion {
        Motion::Pressing { duration } => pressed(problem, body, way, duration),
        Motion::Sliding { velocity, distance } => slid(problem, body, way, (velocity, distance)),
    }
}

fn pressed(
    problem: &Problem,
    body: &Revolution,
    (method, accuracy): (Method, Accuracy),
    duration: f64,
) -> Result<Answer> {
    let material = &*problem.material;
    match (method, problem.control) {
        (Method::MdrTransient, Control::NormalForce(force)) => {
            pressing::chain(body, material, (force, duration), accuracy)
        }
        (_, control) => {
            let simple = simple(material)?;
            pressing::analytic(body, material, (control, duration), simple.as_ref())
        }
    }
}

fn slid(
    problem: &Problem,
    body: &Revolution,
    (method, accuracy): (Method, Accuracy),
    (velocity, distance): (f64, Option<f64>),
) -> Result<Answer> {
    let material = &*problem.material;
    let motion = (problem.control, velocity);
    match method {
        Method::MdrSteady => mdr::stationary(body, material, motion, relative_error(accuracy)?),
        Method::MdrTransient => {
            let load = load(motion)?;
            mdr::transient(body, material, (&load, distance), accuracy)
        }
        _ => closed(problem, body, (velocity, distance)),
    }
}

fn closed(
    problem: &Problem,
    body: &Revolution,
    (velocity, distance): (f64, Option<f64>),
) -> Result<Answer> {
    let motion = (problem.control, velocity);
    let half_space = problem.model == Model::HalfSpace;
    match (simple(&*problem.material)?, body) {
        (Some(elastic @ Simple::Elastic), body) => {
            let pressed = pressing::analytic(
                body,
                &*problem.material,
                (problem.control, 1.0),
                Some(&elastic),
            )?;
            Ok(pressed.with_friction(0.0, 0.0))
        }
        (Some(Simple::Viscous(material)), Revolution::Power(profile)) if half_space => {
            analytic::viscous_half_space(profile, &material, &load(motion)?)
        }
        (Some(Simple::Viscous(material)), body) => match (distance, body) {
            (Some(distance), Revolution::Power(profile)) => {
                analytic::viscous_transient(profile, &material, &load(motion)?, distance)
            }
            _ => analytic::viscous_line(body, &material, motion),
        },
        (Some(material), Revolution::Power(profile)) => {
            analytic::viscoelastic_line(profile, &material, motion)
        }
        _ => bail!("there is no closed form for this body on this material"),
    }
}

fn load((control, velocity): (Control, f64)) -> Result<SlidingLoad> {
    match control {
        Control::NormalForce(force) => Ok(SlidingLoad::new(force, velocity)?),
        Control::IndentationDepth(_) => bail!("the method slides under a force, not at a depth"),
    }
}

/// Where nothing has a fixed resolution.
fn relative_error(accuracy: Accuracy) -> Result<f64> {
    match accuracy {
        Accuracy::RelativeError(error) => Ok(error),
        Accuracy::Elements(elements) => bail!("the method has no {elements} elements"),
    }
}
