//! A scene, asked by one method after the other, each against a reference of its model.

use std::path::Path;
use std::sync::Arc;

use anyhow::{Context, Result};

use super::scenes::{Scene, when_pressed, when_slid};
use super::series::{Attempt, Outcome, Plan, Reference, Refusal, Resolution, Series, Solver};
use crate::run::{Answer, Question, choose, solve};
use crate::scene_file::{Accuracy, Method, Model, SceneFile, scene_file};

/// What is compared where something slides, and where nothing does.
pub(super) const FRICTION: &str = "friction coefficient";
pub(super) const DEPTH: &str = "indentation depth";
/// Relative errors of references without closed form; the first that is reached is taken.
const LINE_REFERENCE: [f64; 2] = [1e-12, 1e-11];
const HALF_SPACE_REFERENCE: [f64; 3] = [2e-5, 5e-5, 1e-4];
/// Closed forms are asked for this, so that the table of s(p) answers too.
const CLOSED: f64 = 1e-2;
/// Rounding of closed forms.
const ROUNDING: f64 = 1e-15;

/// The series of a scene, each with at most `runs` runs; a model whose reference is not reached is refused.
pub(super) fn plan(scene: &Scene, runs: usize) -> Result<Plan> {
    let asked = Asked::new(scene)?;
    let models = if asked.presses() {
        when_pressed()
    } else {
        when_slid()
    };
    let mut plan = Plan::default();
    for (model, ways) in models {
        let reference = match asked.reference(model) {
            Ok(reference) => Arc::new(reference),
            Err(error) => {
                plan.refusals.push(Refusal {
                    scene: asked.name,
                    what: format!("reference of the {}", model.name()),
                    reason: format!("{error:#}"),
                });
                continue;
            }
        };
        for (method, mut resolutions) in ways {
            resolutions.truncate(runs);
            if asked.is_offered(model, method, &resolutions)? {
                let way = (model, method);
                plan.series.push(asked.series(way, resolutions, &reference));
            }
        }
    }
    Ok(plan)
}

/// A scene, ready to be asked.
struct Asked {
    name: &'static str,
    scene: Arc<SceneFile>,
}

impl Asked {
    fn new(scene: &Scene) -> Result<Self> {
        let mut file = scene_file(scene.text.parse()?)?;
        file.load.velocity = scene.velocity.unwrap_or(file.load.velocity);
        Ok(Self {
            name: scene.name,
            scene: Arc::new(file),
        })
    }

    fn presses(&self) -> bool {
        self.scene.load.velocity <= 0.0
    }

    /// The model is named only where the methods differ in it.
    fn question(&self, (model, method): (Model, Method), accuracy: Accuracy) -> Result<Question> {
        let question = Question::new(&self.scene, Path::new(""), crate::run::no_files)?;
        Ok(Question {
            method: Some(method),
            model,
            accuracy,
            ..question
        })
    }

    fn is_offered(&self, model: Model, method: Method, asked: &[Resolution]) -> Result<bool> {
        let Some(coarsest) = asked.first() else {
            return Ok(false);
        };
        Ok(choose(&self.question((model, method), coarsest.accuracy())?).is_ok())
    }

    fn series(
        &self,
        way: (Model, Method),
        resolutions: Vec<Resolution>,
        reference: &Arc<Reference>,
    ) -> Series {
        let attempt = |resolution: Resolution| {
            let asked = Self {
                name: self.name,
                scene: Arc::clone(&self.scene),
            };
            Attempt {
                resolution,
                solve: Box::new(move || asked.outcome(way, resolution.accuracy())),
            }
        };
        Series {
            scene: self.name,
            model: way.0,
            quantity: self.quantity(),
            solver: Solver::Of(way.1),
            reference: Arc::clone(reference),
            attempts: resolutions.into_iter().map(attempt).collect(),
        }
    }

    fn quantity(&self) -> &'static str {
        if self.presses() { DEPTH } else { FRICTION }
    }

    fn outcome(&self, way: (Model, Method), accuracy: Accuracy) -> Result<Outcome> {
        let answer = solve(&self.question(way, accuracy)?)?;
        let (value, error) = self.value(&answer)?;
        Ok(Outcome {
            values: vec![value],
            error_bar: Some(error / value.abs()),
            unknowns: answer.unknowns,
        })
    }

    fn value(&self, answer: &Answer) -> Result<(f64, f64)> {
        let pair = if self.presses() {
            answer.indentation_depth.zip(answer.indentation_depth_error)
        } else {
            let error = answer.friction_coefficient_error;
            answer.friction_coefficient.zip(error)
        };
        pair.with_context(|| format!("{}: no {}", self.name, self.quantity()))
    }

    /// The closed form; without one the stationary solver of the model with a far smaller error.
    ///
    /// On the half space the table of s(p) is no closed form: it is measured too.
    fn reference(&self, model: Model) -> Result<Reference> {
        let may_be_closed = model == Model::Line || self.presses();
        if may_be_closed && self.is_offered(model, Method::Analytic, &[Resolution::ClosedForm])? {
            return self.closed_form(model);
        }
        let (method, errors) = match model {
            Model::Line => (Method::MdrSteady, &LINE_REFERENCE[..]),
            Model::HalfSpace => (Method::BemSteady, &HALF_SPACE_REFERENCE[..]),
        };
        let mut last = None;
        for &error in errors {
            match self.outcome((model, method), Accuracy::RelativeError(error)) {
                Ok(outcome) => return Ok(finer(method, error, outcome)),
                Err(failure) => last = Some(failure),
            }
        }
        Err(last.context("no error was asked for")?)
    }

    fn closed_form(&self, model: Model) -> Result<Reference> {
        let closed = (model, Method::Analytic);
        let outcome = self.outcome(closed, Accuracy::RelativeError(CLOSED))?;
        Ok(Reference {
            values: outcome.values,
            error: outcome.error_bar.map_or(ROUNDING, |bar| bar.max(ROUNDING)),
            source: "closed form".to_owned(),
        })
    }
}

fn finer(method: Method, asked: f64, outcome: Outcome) -> Reference {
    Reference {
        values: outcome.values,
        error: outcome.error_bar.unwrap_or(asked),
        source: format!("{} to {asked:e}", method.name()),
    }
}

impl Resolution {
    /// As a scene asks for it.
    fn accuracy(self) -> Accuracy {
        match self {
            Self::Elements(elements) => Accuracy::Elements(elements),
            Self::RelativeError(error) | Self::Tolerance(error) => Accuracy::RelativeError(error),
            Self::ClosedForm => Accuracy::RelativeError(CLOSED),
        }
    }
}
