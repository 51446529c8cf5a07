//! A scene file, solved by one method after the other, and the reference that they are compared with.

use std::path::Path;

use anyhow::{Result, anyhow};
use numerics::SilentProgress;
use toml::Value;
use viscofriction::scene::{Accuracy, Method, Model, Scene};
use viscofriction::solve::{
    Answer, Problem, Sensitivity, SolveError, plan, solve, with_sensitivity,
};
use viscofriction::{Estimate, WrongInput};

/// A method of one model, and how accurate its result is to be.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Request {
    pub(super) model: Model,
    pub(super) method: Method,
    pub(super) accuracy: Accuracy,
}

/// A value that is more accurate than the results that are compared with it.
pub(super) struct Reference {
    /// Value and error bar, in the unit of the requested quantity of the scene.
    pub(super) known: Estimate,
    /// Which method computed it and how accurately, for people.
    pub(super) source: String,
}

impl Reference {
    /// Reference with an absolute error bar `error`; `source` says how it was computed.
    pub(super) fn new(value: f64, error: f64, source: &str) -> Self {
        Self {
            known: Estimate::new(value, error),
            source: source.to_owned(),
        }
    }
}

impl Request {
    /// Request of an answer by a method in a model, to a relative error or with a number of elements.
    pub(super) const fn new(model: Model, method: Method, accuracy: Accuracy) -> Self {
        Self {
            model,
            method,
            accuracy,
        }
    }

    /// A request for a relative error of the requested quantity.
    pub(super) const fn to_error(model: Model, method: Method, relative_error: f64) -> Self {
        Self::new(model, method, Accuracy::RelativeError(relative_error))
    }

    /// Whether a number of elements is given instead of an error.
    pub(super) fn is_by_elements(&self) -> bool {
        matches!(self.accuracy, Accuracy::Elements(_))
    }

    /// Kind of accuracy, for people, and its value: a relative error or a number of elements.
    pub(super) const fn asked(&self) -> (&'static str, f64) {
        match self.accuracy {
            Accuracy::RelativeError(error) => ("relative error", error),
            Accuracy::Elements(elements) => ("elements", elements as f64),
        }
    }

    /// The scene with this method, model and accuracy. Where nothing slides, both models give the same answer, so that the
    /// model that the method has is taken and not refused.
    fn problem(&self, scene: &Scene) -> Result<Problem> {
        let of_method = self.method.model().filter(|_| presses(scene));
        let mut scene = scene.clone();
        scene.solve.method = Some(self.method);
        scene.solve.model = Some(of_method.unwrap_or(self.model));
        if scene.solve.model == Some(Model::Line) {
            // The one-dimensional model knows no contact area, on which shear acts, and no pressure that heats and strains what is below.
            (scene.interface, scene.heat, scene.strain) = (None, None, None);
        }
        Ok(Problem::try_from(&scene)?.with_accuracy(self.accuracy))
    }

    /// True if the method solves scenes of this kind.
    pub(super) fn is_offered(&self, scene: &Scene) -> Result<bool> {
        Ok(plan(&self.problem(scene)?).is_ok())
    }

    /// The answer of this method; fails where it refuses the scene or does not reach the accuracy.
    pub(super) fn solve(&self, scene: &Scene) -> Result<Answer> {
        Ok(solve(&self.problem(scene)?)?)
    }

    /// The result as a reference. Its relative error is at least `rounding`, since a closed form states none.
    pub(super) fn reference(&self, scene: &Scene, rounding: f64) -> Result<Reference> {
        let known = self.solve(scene)?.requested_quantity();
        let source = match self.method {
            Method::Analytic => "closed form".to_owned(),
            method => format!("{} to {:.1e}", method.name(), self.asked().1),
        };
        let error = known.error.max(rounding * known.value.abs());
        Ok(Reference::new(known.value, error, &source))
    }
}

/// The answer of a scene, by the method that it names or that is chosen for it; fails if the scene refers to a file.
pub(super) fn answer(scene: &Scene) -> Result<Answer> {
    Ok(solve(&Problem::try_from(scene)?)?)
}

/// `answer`, which solves `problem` made from `scene`, with its derivatives with respect to the numbers of the scene, which
/// must not refer to a file.
pub(super) fn differentiated(
    scene: &Scene,
    problem: &Problem,
    answer: Answer,
) -> Result<Answer, SolveError> {
    let files = (Path::new(""), no_file as _);
    with_sensitivity(scene, files, problem, answer, &SilentProgress)
}

/// The derivatives of [`differentiated`]; empty where the method of the answer has none.
pub(super) fn derivatives(
    scene: &Scene,
    problem: &Problem,
    answer: Answer,
) -> Result<Vec<Sensitivity>, SolveError> {
    match differentiated(scene, problem, answer) {
        Ok(answer) => Ok(answer.sensitivity),
        Err(SolveError::NoSensitivity { .. }) => Ok(Vec::new()),
        Err(error) => Err(error),
    }
}

/// In place of a reader of files: fails for every path.
pub(super) fn no_file(path: &Path, _: u64) -> Result<Vec<u8>, WrongInput> {
    Err(WrongInput(format!("{}: no file", path.display())))
}

/// The number at a path such as `material.prony.branches[0].modulus` in the table of a scene; `None` where there is no
/// floating-point number.
pub(super) fn number_at<'a>(scene: &'a mut Value, path: &str) -> Option<&'a mut f64> {
    let mut steps = path.split(['.', '[', ']']).filter(|step| !step.is_empty());
    let place = steps.try_fold(scene, |place, step| match step.parse::<usize>() {
        Ok(index) => place.get_mut(index),
        Err(_) => place.get_mut(step),
    });
    match place? {
        Value::Float(number) => Some(number),
        _ => None,
    }
}

/// Whether the body is only pressed: no speed, no oscillation and no prescribed motion along the surface.
pub(super) fn presses(scene: &Scene) -> bool {
    let load = &scene.load;
    let moves = load.stroke.is_some() || load.motion.is_some() || load.motion_file.is_some();
    !moves && load.velocity.is_none_or(|velocity| velocity <= 0.0)
}

/// The stationary state of a model to the first of `errors`, relative and ascending, that the solver reaches; the error of
/// the last attempt where it reaches none.
pub(super) fn first_reached(scene: &Scene, model: Model, errors: &[f64]) -> Result<Reference> {
    let method = match model {
        Model::Line => Method::MdrSteady,
        Model::HalfSpace => Method::BemSteady,
    };
    let mut result = Err(anyhow!("no error was asked for"));
    for &error in errors {
        result = Request::to_error(model, method, error).reference(scene, CLOSED_FORM_ROUNDING);
        if result.is_ok() {
            break;
        }
    }
    result
}

/// Relative error that is assumed of closed forms, some hundred roundings of f64. Chosen: larger than any seen in tests, and far
/// below every error of a numerical method.
pub(super) const CLOSED_FORM_ROUNDING: f64 = 1e-13;
