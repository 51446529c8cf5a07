//! From a question to its answer.

use anyhow::{Result, bail};
use indenters::SlidingLoad;
use rheology::Viscous;

use super::answer::Answer;
use super::body::{Body, Revolution};
use super::half_space::{Simple, simple};
use super::offer::choose;
use super::omission::plan;
use super::question::{Motion, Question};
use super::{analytic, bem, mdr, pressing};
use crate::scene_file::{Accuracy, Control, Method, Model};

/// Asks the method of the scene, or the cheapest that answers it.
pub(crate) fn solve(question: &Question) -> Result<Answer> {
    solve_by(question, choose(question)?, question.accuracy)
}

/// Asks a method that answers the scene.
pub(super) fn solve_by(question: &Question, method: Method, accuracy: Accuracy) -> Result<Answer> {
    let started = std::time::Instant::now();
    let Body::Revolution(body) = &question.body else {
        bail!("only bodies of revolution are answered");
    };
    let answer = match question.motion {
        Motion::Pressing { duration } => pressed(question, body, (method, accuracy), duration)?,
        Motion::Sliding { velocity, distance } => {
            slid(question, body, (method, accuracy), (velocity, distance))?
        }
    };
    let left_out = plan(question, &answer);
    let answer = Answer { left_out, ..answer };
    answer.after(started.elapsed()).finite()
}

fn pressed(
    question: &Question,
    body: &Revolution,
    (method, accuracy): (Method, Accuracy),
    duration: f64,
) -> Result<Answer> {
    let material = &*question.material;
    let simple = simple(material)?;
    match (method, question.control) {
        (Method::MdrTransient, Control::NormalForce(force)) => {
            pressing::chain(body, material, (force, duration), accuracy)
        }
        (Method::BemTransient, Control::NormalForce(force)) => {
            pressing::boundary_elements(body, material, (force, duration), accuracy)
        }
        (_, control) => pressing::analytic(body, material, (control, duration), simple.as_ref()),
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
        Method::Analytic => closed(question, body, (velocity, distance)),
        Method::MdrSteady => mdr::stationary(body, material, motion, relative_error(accuracy)?),
        Method::MdrTransient => {
            let load = load(motion)?;
            mdr::transient(body, material, (&load, distance), accuracy)
        }
        Method::BemSteady => {
            let load = load(motion)?;
            bem::stationary(body, (material, &load), accuracy, distance)
        }
        Method::BemTransient => {
            let load = load(motion)?;
            bem::transient(body, (&viscous(question)?, &load), accuracy, distance)
        }
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
    Ok(SlidingLoad::new(normal_force(control)?, velocity)?)
}

pub(super) fn normal_force(control: Control) -> Result<f64> {
    match control {
        Control::NormalForce(force) => Ok(force),
        Control::IndentationDepth(_) => bail!("the method needs a force, not a depth"),
    }
}

pub(super) fn viscous(question: &Question) -> Result<Viscous> {
    match simple(&*question.material)? {
        Some(Simple::Viscous(material)) => Ok(material),
        _ => bail!("the method slides on a viscous material only"),
    }
}

/// Where nothing has a fixed resolution.
fn relative_error(accuracy: Accuracy) -> Result<f64> {
    match accuracy {
        Accuracy::RelativeError(error) => Ok(error),
        Accuracy::Elements(elements) => bail!("the method has no {elements} elements"),
    }
}
