//! Choice of the method that answers a scene.

use std::fmt;

use super::error::{NotOffered, Refusal};
use super::memory::check_memory;
use super::problem::Problem;
use super::work::{Work, work_of_method};
use crate::files::ReadFile;
use crate::scene::{Method, Model, Scene, SceneError, Source, scene_file};
use crate::text::WrongInput;

/// The methods in order of increasing cost; the first that answers is chosen.
const BY_COST: [Method; 5] = [
    Method::Analytic,
    Method::MdrSteady,
    Method::MdrTransient,
    Method::BemSteady,
    Method::BemTransient,
];

/// A method that answers a problem, ready to run.
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

/// Plans the method that the scene names, else the cheapest that answers it.
///
/// Planning solves nothing, with two exceptions whose validity is known only from the result, which is kept: slow sliding, and a
/// contact on a layer that must grow once and shrink once.
///
/// # Errors
/// [`NotOffered`], with the methods that answer instead.
pub fn plan(problem: &Problem) -> Result<Plan<'_>, NotOffered> {
    let of = |method| match other_model(method, problem.model()) {
        Some(why) => Err(why),
        None => work_of_method(problem, method).map(|work| Plan {
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
    /// Method by which the problem is solved.
    pub const fn method(&self) -> Method {
        self.method
    }

    /// Rejects a method that needs more memory than [`Problem::max_memory`], and a periodic surface whose waves are too short for
    /// all grids. [`Self::solve`] makes the same checks.
    ///
    /// # Errors
    /// [`SceneError`] with the memory needed, the memory allowed, and the key to change.
    pub fn check_memory(&self) -> Result<(), SceneError> {
        check_memory(self.problem, self.method)
    }
}

/// Reason for refusal if the method belongs to another model than the requested one; `None` if it does not.
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

/// The problem of a scene file; `method` overrides that of the file.
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

/// The scene of a file; `method` overrides that of the file.
///
/// # Errors
/// [`WrongInput`] with the place where the scene is wrong.
pub fn scene_of(source: &Source, method: Option<Method>) -> Result<Scene, WrongInput> {
    let table = source.table()?;
    let mut scene = scene_file(table).map_err(|error| source.locate(&error))?;
    scene.solve.method = method.or(scene.solve.method);
    Ok(scene)
}

/// The plan of a problem from a file, checked against the memory limit.
///
/// # Errors
/// [`WrongInput`] with the place of the error: the method, or the indenter if no method answers.
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
