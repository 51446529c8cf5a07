//! Which methods answer which scenes.

use thiserror::Error;

use super::problem::Problem;
use super::work::{Refusal, work};
use crate::scene::{Method, Model, SceneError, Source, scene_file};
use crate::text::{ReadFile, WrongInput};

/// The methods from cheap to expensive.
const BY_COST: [Method; 5] = [
    Method::Analytic,
    Method::MdrSteady,
    Method::MdrTransient,
    Method::BemSteady,
    Method::BemTransient,
];

/// Why no method is asked.
#[derive(Debug, Clone, PartialEq, Error)]
pub enum NotOffered {
    /// The method that the scene names does not answer it.
    #[error("{} does not answer this scene: {why}; {}", method.name(), others(offered))]
    Method {
        /// The method.
        method: Method,
        /// Why it does not.
        why: Refusal,
        /// Methods that do.
        offered: Vec<Method>,
    },
    /// No method does.
    #[error("no method answers this scene yet: {}", reasons(refusals))]
    AnyMethod {
        /// Why each of them does not.
        refusals: Vec<(Method, Refusal)>,
    },
}

fn others(offered: &[Method]) -> String {
    if offered.is_empty() {
        return "no other method does either".to_owned();
    }
    let names: Vec<&str> = offered.iter().map(|method| method.name()).collect();
    format!("these do: {}", names.join(", "))
}

fn reasons(refusals: &[(Method, Refusal)]) -> String {
    let reason = |(method, why): &(Method, Refusal)| format!("{}: {why}", method.name());
    let reasons: Vec<String> = refusals.iter().map(reason).collect();
    reasons.join("; ")
}

/// The method of the scene, or the cheapest that answers it.
///
/// # Errors
/// [`NotOffered`], with what is offered instead.
pub fn choose(problem: &Problem) -> Result<Method, NotOffered> {
    let why = |method| {
        let refused = || work(problem, method, problem.accuracy).err();
        other_model(method, problem.model).or_else(refused)
    };
    let offered = || BY_COST.into_iter().filter(|&m| why(m).is_none());
    match problem.method {
        None => offered().next().ok_or_else(|| NotOffered::AnyMethod {
            refusals: BY_COST
                .into_iter()
                .filter_map(|method| Some((method, why(method)?)))
                .collect(),
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

/// Whether a method answers a problem, whichever method and model that names.
pub(crate) fn answers(method: Method, problem: &Problem) -> bool {
    work(problem, method, problem.accuracy).is_ok()
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
