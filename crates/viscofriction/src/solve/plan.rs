//! Which methods answer which scenes.

use std::fmt;

use super::error::{NotOffered, Refusal};
use super::memory::check_memory;
use super::problem::Problem;
use super::work::{Work, work};
use crate::files::ReadFile;
use crate::scene::{Method, Model, Scene, SceneError, Source, scene_file};
use crate::text::WrongInput;

/// The methods from cheap to expensive.
const BY_COST: [Method; 5] = [
    Method::Analytic,
    Method::MdrSteady,
    Method::MdrTransient,
    Method::BemSteady,
    Method::BemTransient,
];

/// A method that answers a problem, with all that it needs.
pub struct Plan<'a> {
    pub(super) problem: &'a Problem,
    pub(super) method: Method,
    pub(super) work: Work<'a>,
}

impl fmt::Debug for Plan<'_> {
    fn fmt(&self, formatter: &mut fmt::Formatter<'_>) -> fmt::Result {
        let mut plan = formatter.debug_struct("Plan");
        plan.field("method", &self.method).finish_non_exhaustive()
    }
}

/// The plan of the method that the scene names, or of the cheapest that answers it.
///
/// Nothing is solved for it; only slow sliding is known to be slow, and a contact on a layer to grow once and shrink once, when
/// they have been computed, and they are kept.
///
/// # Errors
/// [`NotOffered`], with what is offered instead.
pub fn plan(problem: &Problem) -> Result<Plan<'_>, NotOffered> {
    let of = |method| match other_model(method, problem.model()) {
        Some(why) => Err(why),
        None => work(problem, method).map(|work| Plan {
            problem,
            method,
            work,
        }),
    };
    let Some(method) = problem.method() else {
        let mut refusals = Vec::new();
        for method in BY_COST {
            match of(method) {
                Ok(plan) => return Ok(plan),
                Err(why) => refusals.push((method, why)),
            }
        }
        return Err(NotOffered::AnyMethod { refusals });
    };
    of(method).map_err(|why| NotOffered::Method {
        method,
        why,
        offered: BY_COST.into_iter().filter(|&m| of(m).is_ok()).collect(),
    })
}

impl Plan<'_> {
    /// The method.
    pub const fn method(&self) -> Method {
        self.method
    }

    /// Refuses a method that needs more memory than [`Problem::max_memory`], if there is one, and a periodic surface with waves
    /// that are too short for all grids; [`Self::solve`] does so too.
    ///
    /// # Errors
    /// [`SceneError`] with what is needed, what is allowed, and the key that is best changed.
    pub fn check_memory(&self) -> Result<(), SceneError> {
        check_memory(self.problem, self.method)
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

/// What a scene file asks, of the method given in the place of its own.
///
/// # Errors
/// [`WrongInput`] with the place where the scene is wrong.
pub fn problem_of(
    source: &Source,
    method: Option<Method>,
    read: ReadFile,
) -> Result<Problem, WrongInput> {
    let scene = scene_of(source, method)?;
    let problem = Problem::new(&scene, source.folder(), read);
    problem.map_err(|error| source.locate(&error))
}

/// The scene of a file, with the method given in the place of its own.
///
/// # Errors
/// [`WrongInput`] with the place where the scene is wrong.
pub fn scene_of(source: &Source, method: Option<Method>) -> Result<Scene, WrongInput> {
    let table = source.table()?;
    let mut scene = scene_file(table).map_err(|error| source.locate(&error))?;
    scene.solve.method = method.or(scene.solve.method);
    Ok(scene)
}

/// The plan of a problem from a file, which has the memory that it needs.
///
/// # Errors
/// [`WrongInput`] with the place where the scene is wrong: the method, or the whole scene where there is none.
pub fn plan_of<'a>(source: &Source, problem: &'a Problem) -> Result<Plan<'a>, WrongInput> {
    let plan = || {
        let plan = plan(problem).map_err(|error| {
            let key = match error {
                NotOffered::Method { .. } => "solve.method",
                NotOffered::AnyMethod { .. } => "indenter",
            };
            SceneError::at(key, error.to_string())
        })?;
        plan.check_memory()?;
        Ok(plan)
    };
    plan().map_err(|error| source.locate(&error))
}
