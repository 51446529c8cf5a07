//! Logarithmic derivatives of an answer by the numbers of its scene.

mod adjoint;
mod budget;
mod caused;
mod differences;
mod parameters;
mod sampling;
mod spectral;

use std::path::Path;

use numerics::{Estimate, Progress, WorkProgress};
use serde::Serialize;

use super::answer::Answer;
use super::error::{Result, SolveError};
use super::modulus_error::MODULUS_ERROR_AMPLIFICATION;
use super::plan::Plan;
use super::problem::{Motion, Problem};
use super::work::work_of_method;
use crate::files::ReadFile;
use crate::quantity::{ByQuantity, Quantity};
use crate::scene::{Method, Model, Scene, SceneError};
use adjoint::log_derivatives;
pub(crate) use adjoint::{AnswerChange, relative_change};
use budget::budget;
pub use budget::{Budget, Source};
use differences::Values;
pub(crate) use parameters::check_uncertainties;
pub(crate) use parameters::{Number, Numbers};
pub use sampling::sampled;
use spectral::check_spectral_sensitivity;
pub use spectral::{ByFrequency, SpectralSensitivity, spectral_sensitivity};

/// Largest relative error of an answer that finite differences still differentiate. Chosen: closed forms and the stationary
/// one-dimensional model reach it.
pub(super) const MAX_DIFFERENCED_ERROR: f64 = 1e-9;

/// Derivatives of the quantities of an answer by one number of its scene: d ln(quantity)/d ln(number).
///
/// Quantities that are given, or without derivatives in this method, are missing.
#[derive(Debug, Clone, PartialEq, Serialize)]
#[non_exhaustive]
pub struct Sensitivity {
    /// The path of the number in the scene, such as `material.prony.branches[0].modulus`.
    pub parameter: String,
    /// Derivatives of the quantities.
    #[serde(flatten)]
    pub derivatives: ByQuantity<Estimate>,
}

/// Adds the derivatives by all numbers of the scene that are moduli, times, ratios, loads, speeds or lengths. If the scene states
/// uncertainties or its material has a covariance, the uncertainty budget is added too. `watch` receives the progress.
///
/// If the scene names no method and the cheapest one has no derivatives, the answer is replaced by that of boundary elements.
///
/// # Errors
/// [`SolveError::NoSensitivity`] for methods and motions without derivatives, and the errors of [`Plan::solve`].
pub fn with_sensitivity(
    scene: &Scene,
    (folder, read): (&Path, ReadFile),
    problem: &Problem,
    answer: Answer,
    watch: &dyn Progress,
) -> Result<Answer> {
    // Differentiate the answer by all numbers of the scene. If the method cannot, solve the problem again by boundary elements.
    let numbers = Numbers::new(scene, folder, read)?;
    let all = numbers.all().into_iter();
    let all: Vec<Number> = all.chain(numbers.uncertain_temperature()).collect();
    let known = (&numbers, &all[..]);
    let (answer, mut found) = match derivatives(known, problem, &answer, watch) {
        Err(none @ SolveError::NoSensitivity { .. }) => {
            let answer = answer_with_derivatives(problem, answer.method, watch).ok_or(none)??;
            let found = derivatives(known, problem, &answer, watch)?;
            (answer, found)
        }
        found => (answer, found?),
    };
    // The derivatives of a Prony series differ from those of the law it approximates by its ripple, so their errors are widened
    // by its error.
    let series = MODULUS_ERROR_AMPLIFICATION * problem.modulus_error();
    found
        .by_numbers
        .iter_mut()
        .for_each(|one| one.widen(series));
    let material = numbers.scene()?.material;
    let of_shear = problem.shear_strength_uncertainty()?;
    let budget = budget(&material, scene, &all, &found, &answer, of_shear);
    // Remove the derivative by the temperature, because a temperature in °C has no logarithmic one.
    let temperature = numbers.uncertain_temperature().map(|number| number.path);
    let mut sensitivity = found.by_numbers;
    sensitivity.retain(|one| Some(&one.parameter) != temperature.as_ref());
    Ok(Answer {
        sensitivity,
        budget,
        ..answer
    })
}

/// Derivatives of an answer.
struct Derivatives {
    /// By the numbers of the scene that can change.
    by_numbers: Vec<Sensitivity>,
    /// By the shear strength as a whole.
    by_shear_strength: Option<Sensitivity>,
}

/// The derivatives by all numbers, by the technique that suits the method of the answer.
fn derivatives(
    (numbers, all): (&Numbers, &[Number]),
    problem: &Problem,
    answer: &Answer,
    watch: &dyn Progress,
) -> Result<Derivatives> {
    let progress = WorkProgress::new(watch, all.len() as f64);
    if problem.heating().is_some() || problem.strain_dependence().is_some() {
        return caused::derivatives((numbers, all), problem, answer, progress);
    }
    let method = answer.method;
    let asked = answer.requested_quantity();
    let is_exact = asked.error <= MAX_DIFFERENCED_ERROR * asked.value.abs();
    // For slow sliding over a half space with an equilibrium modulus the closed form is the first term of a series; its omitted
    // terms add an error.
    let is_series =
        answer.model == Model::HalfSpace && problem.material().creep().fluidity() <= 0.0;
    let by_numbers = match (method, problem.motion()) {
        (Method::BemSteady, Motion::Sliding(load)) => {
            adjoint::sensitivities((numbers, all), problem, (load, answer), progress)
        }
        (method, Motion::History { .. }) => Err(SolveError::NoSensitivity { method }),
        (Method::Analytic | Method::MdrSteady, _) if is_exact => {
            let values = Values::Exact;
            differences::sensitivities((numbers, all), problem, values, answer, progress)
        }
        (Method::Analytic, Motion::Sliding(_)) if is_series => {
            let values = Values::TruncatedSeries;
            differences::sensitivities((numbers, all), problem, values, answer, progress)
        }
        (method, _) => Err(SolveError::NoSensitivity { method }),
    };
    let of_strength = AnswerChange::of_shear_strength();
    let name = Source::ShearTable.name().to_owned();
    Ok(Derivatives {
        by_numbers: by_numbers?,
        by_shear_strength: Some(log_derivatives(name, answer, of_strength, 1.0)),
    })
}

/// The boundary-element answer to stationary sliding, in place of that of a cheaper method. `None` if the scene names its method
/// or boundary elements do not answer it.
fn answer_with_derivatives(
    problem: &Problem,
    cheaper: Method,
    watch: &dyn Progress,
) -> Option<Result<Answer>> {
    let method = Method::BemSteady;
    let is_free = problem.method().is_none() && cheaper != method;
    if !is_free || method.model() != Some(problem.model()) {
        return None;
    }
    let work = work_of_method(problem, method).ok()?;
    let plan = Plan {
        problem,
        method,
        work,
    };
    Some(plan.solve(watch))
}

/// Rejects a problem whose answer by a method has no derivatives of a kind that is requested, before it is solved.
///
/// `by_numbers` and `by_moduli` are the names of the options that request the derivatives of [`with_sensitivity`] and of
/// [`spectral_sensitivity`], for the message; `None` if they are not requested.
///
/// # Errors
/// [`SceneError`] at the key to change; it says that the option may be left out.
pub fn check_derivatives(
    problem: &Problem,
    method: Method,
    by_numbers: Option<&str>,
    by_moduli: Option<&str>,
) -> std::result::Result<(), SceneError> {
    if let Some(option) = by_numbers {
        check_sensitivity(problem, method).map_err(|error| error.or_without(option))?;
    }
    if let Some(option) = by_moduli {
        check_spectral_sensitivity(problem, method).map_err(|error| error.or_without(option))?;
    }
    Ok(())
}

/// Rejects a problem whose answer by a method has no derivatives by the numbers of its scene.
fn check_sensitivity(problem: &Problem, method: Method) -> std::result::Result<(), SceneError> {
    let none = || {
        SceneError::at(
            "solve.method",
            SolveError::NoSensitivity { method }.to_string(),
        )
    };
    match (method, problem.motion()) {
        (Method::BemSteady, Motion::Sliding(_)) => adjoint::check_surfaces(problem),
        (Method::Analytic | Method::MdrSteady, motion)
            if !matches!(motion, Motion::History { .. }) =>
        {
            Ok(())
        }
        _ => Err(none()),
    }
}

impl Sensitivity {
    /// Adds `error` to the errors of the derivatives, and removes derivatives that are not finite.
    fn widen(&mut self, error: f64) {
        let derivatives = &self.derivatives;
        let widened = |of: &Quantity| Some(derivatives.of(of.key)?.widened(error));
        let is_finite = |known: &Estimate| known.value.is_finite() && known.error.is_finite();
        self.derivatives = ByQuantity::new(|quantity| widened(quantity).filter(is_finite));
    }
}
