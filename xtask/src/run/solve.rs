//! From a question to its answer.

use anyhow::{Result, bail};
use indenters::SlidingLoad;

use super::answer::Answer;
use super::body::{Body, Revolution};
use super::half_space::{Simple, simple};
use super::offer::choose;
use super::omission::plan;
use super::question::{Motion, Question};
use super::shape::{Drive, Shape};
use super::{analytic, bem, line_contact, march, mdr, pressing};
use crate::scene_file::{Accuracy, Control, Method, Model};

/// Asks the method of the scene, or the cheapest that answers it.
pub(crate) fn solve(question: &Question) -> Result<Answer> {
    solve_by(question, choose(question)?, question.accuracy)
}

/// Asks a method that answers the scene.
pub(super) fn solve_by(question: &Question, method: Method, accuracy: Accuracy) -> Result<Answer> {
    let started = std::time::Instant::now();
    let way = (method, accuracy);
    let answer = match (&question.body, method) {
        (Body::Revolution(body), Method::BemSteady | Method::BemTransient) => {
            by_elements(question, body, way)
        }
        (Body::Revolution(body), _) => of_revolution(question, body, way),
        (Body::HeightMap(map), _) => by_elements(question, map, way),
        (Body::Cylinder(cylinder), _) => line_contact::answer(question, cylinder, accuracy),
    }?;
    let left_out = plan(question, &answer);
    let answer = Answer { left_out, ..answer };
    answer.after(started.elapsed()).finite()
}

fn by_elements(
    question: &Question,
    body: &impl Shape,
    (method, accuracy): (Method, Accuracy),
) -> Result<Answer> {
    let (material, control) = (&*question.material, question.control);
    let (velocity, distance) = match question.motion {
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

fn of_revolution(
    question: &Question,
    body: &Revolution,
    way: (Method, Accuracy),
) -> Result<Answer> {
    match question.motion {
        Motion::Pressing { duration } => pressed(question, body, way, duration),
        Motion::Sliding { velocity, distance } => slid(question, body, way, (velocity, distance)),
    }
}

fn pressed(
    question: &Question,
    body: &Revolution,
    (method, accuracy): (Method, Accuracy),
    duration: f64,
) -> Result<Answer> {
    let material = &*question.material;
    match (method, question.control) {
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
    question: &Question,
    body: &Revolution,
    (method, accuracy): (Method, Accuracy),
    (velocity, distance): (f64, Option<f64>),
) -> Result<Answer> {
    let material = &*question.material;
    let motion = (question.control, velocity);
    match method {
        Method::MdrSteady => mdr::stationary(body, material, motion, relative_error(accuracy)?),
        Method::MdrTransient => {
            let load = load(motion)?;
            mdr::transient(body, material, (&load, distance), accuracy)
        }
        _ => closed(question, body, (velocity, distance)),
    }
}

fn closed(
    question: &Question,
    body: &Revolution,
    (velocity, distance): (f64, Option<f64>),
) -> Result<Answer> {
    let motion = (question.control, velocity);
    let half_space = question.model == Some(Model::HalfSpace);
    match (simple(&*question.material)?, body) {
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

pub(super) fn load((control, velocity): (Control, f64)) -> Result<SlidingLoad> {
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
