//! What an answer is compared with: a closed form, or the stationary solver of the model with a far smaller error.

use std::path::Path;

use anyhow::{Context, Result, bail};
use bem_halfspace::BemError;
use friction_analytic::power_indentation_after_impulse;
use rheology::Viscous;

use super::draw::Scene;
use super::ways::Way;
use crate::run::{Answer, Body, Question, Revolution, choose, solve};
use crate::scene_file::{Accuracy, Control, Method, Model};

/// A number, its absolute error, and where it comes from.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct Reference {
    pub(super) value: f64,
    pub(super) error: f64,
    pub(super) source: String,
}

/// Relative errors of the line; the first that is reached is taken.
const LINE_ERRORS: [f64; 3] = [1e-12, 1e-11, 1e-10];
/// How much smaller the error of the half space is than that asked for.
const FINER: f64 = 0.1;
/// Rounding of closed forms.
const ROUNDING: f64 = 1e-13;

/// The question of a scene to one method.
pub(super) fn question(scene: &Scene, way: &Way) -> Result<Question> {
    let question = Question::new(&scene.file, Path::new(""), crate::run::no_files)?;
    Ok(Question {
        method: Some(way.method),
        // Without sliding both models are the same.
        model: way.model,
        accuracy: way.accuracy,
        ..question
    })
}

/// The number that is judged, and its bar.
pub(super) fn judged(scene: &Scene, answer: &Answer) -> Result<[f64; 2]> {
    let pair = if scene.presses() {
        answer.indentation_depth.zip(answer.indentation_depth_error)
    } else {
        let bar = answer.friction_coefficient_error;
        answer.friction_coefficient.zip(bar)
    };
    let (value, bar) = pair.context("the answer has no number with an error bar")?;
    Ok([value, bar])
}

/// The reference of the answers of a model, or of its closed form; of some closed forms there is none.
pub(super) fn reference(
    scene: &Scene,
    (model, closed): (Model, bool),
    asked: f64,
) -> Result<Option<Reference>> {
    if closed && scene.presses() {
        return power_pressed(scene);
    }
    if closed && scene.file.solve.sliding_distance.is_some() {
        return Ok(None);
    }
    let closed_form = Way {
        model,
        method: Method::Analytic,
        accuracy: Accuracy::RelativeError(FINER * asked),
    };
    if !closed && choose(&question(scene, &closed_form)?).is_ok() {
        return ask(scene, &closed_form).map(Some);
    }
    if scene.is_elastic() && !scene.presses() {
        return Ok(Some(Reference {
            value: 0.0,
            error: 0.0,
            source: "no friction on an elastic material".to_owned(),
        }));
    }
    let reference = match model {
        Model::HalfSpace => half_space(scene, FINER * asked),
        Model::Line => line(scene),
    };
    reference.map(Some)
}

fn line(scene: &Scene) -> Result<Reference> {
    let mut last = None;
    for error in LINE_ERRORS {
        let way = Way {
            model: Model::Line,
            method: Method::MdrSteady,
            accuracy: Accuracy::RelativeError(error),
        };
        match ask(scene, &way) {
            Ok(reference) => return Ok(reference),
            Err(error) => last = Some(error),
        }
    }
    Err(last.context("no error was asked for")?)
}

/// Where the error is not reached, what was reached is the reference, with the error that it has.
fn half_space(scene: &Scene, error: f64) -> Result<Reference> {
    let way = Way {
        model: Model::HalfSpace,
        method: Method::BemSteady,
        accuracy: Accuracy::RelativeError(error),
    };
    ask(scene, &way).or_else(|failure| match failure.downcast_ref() {
        Some(&BemError::FrictionNotReached {
            friction_coefficient,
            error,
            ..
        }) => Ok(Reference {
            value: friction_coefficient,
            error,
            source: "bem-steady, as far as it came".to_owned(),
        }),
        _ => Err(failure),
    })
}

fn ask(scene: &Scene, way: &Way) -> Result<Reference> {
    let [value, error] = judged(scene, &solve(&question(scene, way)?)?)?;
    let Accuracy::RelativeError(asked) = way.accuracy else {
        bail!("a reference is asked for an error");
    };
    let source = match way.method {
        Method::Analytic => "closed form".to_owned(),
        method => format!("{} to {asked:.1e}", method.name()),
    };
    Ok(Reference {
        value,
        error: error.max(ROUNDING * value.abs()),
        source,
    })
}

/// The closed form of powers beside the quadrature that answers any body.
fn power_pressed(scene: &Scene) -> Result<Option<Reference>> {
    let question = Question::new(&scene.file, Path::new(""), crate::run::no_files)?;
    let (Body::Revolution(Revolution::Power(profile)), Control::NormalForce(force)) =
        (&question.body, question.motion.control())
    else {
        return Ok(None);
    };
    let time = scene.file.solve.indentation_time()?;
    let material = &*question.material;
    let compliance = material.half_space_factor() * material.creep_compliance(time)?;
    let contact =
        power_indentation_after_impulse(profile, &Viscous::new(1.0)?, force * compliance)?;
    let value = contact.indentation_depth;
    Ok(Some(Reference {
        value,
        error: ROUNDING * value,
        source: "closed form of powers".to_owned(),
    }))
}
