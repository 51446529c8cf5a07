//! Which methods answer which scenes.

use super::error::{NotOffered, Refusal};
use super::problem::Problem;
use super::work::work;
use crate::files::ReadFile;
use crate::scene::{Method, Model, SceneError, Source, scene_file};
use crate::text::WrongInput;

/// The methods from cheap to expensive.
const BY_COST: [Method; 5] = [
    Method::Analytic,
    Method::MdrSteady,
    Method::MdrTransient,
    Method::BemSteady,
    Method::BemTransient,
];

/// The method of the scene, or the cheapest that answers it.
///
/// # Errors
/// [`NotOffered`], with what is offered instead.
pub fn choose(problem: &Problem) -> Result<Method, NotOffered> {
    let why = |method| {
        let refused = || work(problem, method, problem.accuracy()).err();
        other_model(method, problem.model()).or_else(refused)
    };
    let offered = || BY_COST.into_iter().filter(|&m| why(m).is_none());
    match problem.method() {
        None => offered().next().ok_or_else(|| {
            let refusals = BY_COST.into_iter().filter_map(|m| Some((m, why(m)?)));
            let refusals = refusals.collect();
            NotOffered::AnyMethod { refusals }
        }),
        Some(method) => match why(method) {
            None => Ok(method),
            Some(why) => Err(NotOffered::Method {
                method,
                why,
                offered: offered().collect(),
            }),
        },
    }
}

/// An answer is of the model that was asked for.
fn other_model(method: Method, asked: Model) -> Option<Refusal> {
    let of_method = method.model()?;
    if of_method == asked {
        return None;
    }
    Some(match of_method {
        Model::Line => {
            "it is a method of the one-dimensional model, and the scene is on the half space; solve.model = \"line\" asks for the one-dimensional model"
        }
        Model::HalfSpace => {
            "it is a method of the half space, and the scene asks for the one-dimensional model"
        }
    })
}

/// What a scene file asks, and the method that answers it: the one given, that of the scene, or the cheapest.
///
/// # Errors
/// [`WrongInput`] with the place where the scene is wrong.
pub fn problem_of(
    source: &Source,
    method: Option<Method>,
    read: ReadFile,
) -> Result<(Problem, Method), WrongInput> {
    let located = |error: SceneError| source.locate(&error);
    let mut scene = scene_file(source.table()?).map_err(located)?;
    scene.solve.method = method.or(scene.solve.method);
    let problem = Problem::new(&scene, source.folder(), read).map_err(located)?;
    let method = choose(&problem).map_err(|error| not_offered(source, &error))?;
    Ok((problem, method))
}

/// A combination that is not offered is wrong input, at the method or at the whole scene.
pub(crate) fn not_offered(source: &Source, error: &NotOffered) -> WrongInput {
    let key = match error {
        NotOffered::Method { .. } => "solve.method",
        NotOffered::AnyMethod { .. } => "indenter",
    };
    source.locate(&SceneError::at(key, error.to_string()))
}
