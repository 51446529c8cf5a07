//! From a problem to its answer.

mod analytic;
mod answer;
mod body;
mod elements;
mod error;
mod half_space;
mod line_contact;
mod mdr;
mod offer;
mod omission;
mod pressing;
mod problem;
mod same_problem;
mod validity;

pub use answer::{Answer, ContactBox, Fields, Grid, HistoryRow};
pub use body::{Body, Revolution};
pub use error::{Result, SolveError};
pub use numerics::ErrorParts;
pub use offer::{NotOffered, choose};
pub use omission::Omission;
pub(crate) use problem::not_offered;
pub use problem::{Motion, Problem, ReadFile, problem_of};
pub use same_problem::SameProblem;

use self::error::bail;
use indenters::{PressingLoad, SlidingLoad, Surface};

use self::omission::plan;
use self::validity::warnings;
use crate::scene::{Accuracy, Control, Method};

/// Asks the method of the scene, or the cheapest that answers it.
///
/// # Errors
/// [`SolveError`] where no method answers the scene, or what was asked for was not reached; it says what was.
pub fn solve(problem: &Problem) -> Result<Answer> {
    solve_by(problem, choose(problem)?, problem.accuracy)
}

/// Asks a method that answers the scene.
///
/// # Errors
/// [`SolveError`] where what was asked for was not reached.
pub fn solve_by(problem: &Problem, method: Method, accuracy: Accuracy) -> Result<Answer> {
    let answer = match (&problem.body, method) {
        (Body::Revolution(body), Method::BemSteady | Method::BemTransient) => {
            by_elements(problem, body, method, accuracy)
        }
        (Body::Revolution(body), _) => of_revolution(problem, body, (method, accuracy)),
        (Body::HeightMap(map), _) => by_elements(problem, map, method, accuracy),
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
        warnings: warnings(&problem.body, &answer),
        ..answer
    };
    answer.finite()
}

fn by_elements(
    problem: &Problem,
    surface: &dyn Surface,
    method: Method,
    accuracy: Accuracy,
) -> Result<Answer> {
    let material = &*problem.material;
    match (problem.motion, method) {
        (Motion::Pressing(load), _) => elements::pressed(surface, material, &load, accuracy),
        (Motion::Sliding(load), Method::BemSteady) => {
            elements::stationary(surface, material, &load, accuracy)
        }
        (Motion::Sliding(load), _) => elements::transient(surface, material, &load, accuracy),
    }
}

fn of_revolution(problem: &Problem, body: &Revolution, way: (Method, Accuracy)) -> Result<Answer> {
    match problem.motion {
        Motion::Pressing(load) => pressed(problem, body, way, &load),
        Motion::Sliding(load) => slid(problem, body, way, &load),
    }
}

fn pressed(
    problem: &Problem,
    body: &Revolution,
    (method, accuracy): (Method, Accuracy),
    load: &PressingLoad,
) -> Result<Answer> {
    let material = &*problem.material;
    match (method, load.control()) {
        (Method::MdrTransient, Control::NormalForce(_)) => {
            mdr::pressed(body, material, load, accuracy)
        }
        _ => analytic::pressed(body, material, load),
    }
}

fn slid(
    problem: &Problem,
    body: &Revolution,
    (method, accuracy): (Method, Accuracy),
    load: &SlidingLoad,
) -> Result<Answer> {
    let material = &*problem.material;
    match method {
        Method::MdrSteady => mdr::stationary(body, material, load, relative_error(accuracy)?),
        Method::MdrTransient => mdr::transient(body, material, load, accuracy),
        _ => analytic::slid(body, material, load, problem.model),
    }
}

/// Where nothing has a fixed resolution.
fn relative_error(accuracy: Accuracy) -> Result<f64> {
    match accuracy {
        Accuracy::RelativeError(error) => Ok(error),
        Accuracy::Elements(elements) => bail!("the method has no {elements} elements"),
    }
}
