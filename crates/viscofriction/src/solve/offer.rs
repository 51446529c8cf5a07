//! Which methods answer which scenes.

use friction_analytic::scaling_factor;
use rheology::RheologyError;
use thiserror::Error;

use super::body::{Body, Revolution};
use super::half_space::{Simple, simple};
use super::problem::{Motion, Problem};
use crate::scene::{Accuracy, Control, Method, Model};

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
        why: &'static str,
        /// Methods that do.
        offered: Vec<Method>,
    },
    /// No method does.
    #[error("no method answers this scene yet: {}", reasons(refusals))]
    AnyMethod {
        /// Why each of them does not.
        refusals: Vec<(Method, &'static str)>,
    },
    /// The material cannot be reduced to the incompressible one with the same surface.
    #[error(transparent)]
    Material(#[from] RheologyError),
}

fn others(offered: &[Method]) -> String {
    if offered.is_empty() {
        return "no other method does either".to_owned();
    }
    let names: Vec<&str> = offered.iter().map(|method| method.name()).collect();
    format!("these do: {}", names.join(", "))
}

fn reasons(refusals: &[(Method, &'static str)]) -> String {
    let reason = |(method, why): &(Method, &'static str)| format!("{}: {why}", method.name());
    let reasons: Vec<String> = refusals.iter().map(reason).collect();
    reasons.join("; ")
}

/// The method of the scene, or the cheapest that answers it.
///
/// # Errors
/// [`NotOffered`], with what is offered instead.
pub fn choose(problem: &Problem) -> Result<Method, NotOffered> {
    let simple = simple(&*problem.material)?;
    let why = |method| {
        other_model(method, problem.model).or_else(|| refusal(method, problem, simple.as_ref()))
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
fn other_model(method: Method, asked: Model) -> Option<&'static str> {
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
    simple(&*problem.material)
        .is_ok_and(|simple| refusal(method, problem, simple.as_ref()).is_none())
}

/// Why a method does not answer, if it does not.
fn refusal(method: Method, problem: &Problem, simple: Option<&Simple>) -> Option<&'static str> {
    match (method, &problem.body) {
        (_, Body::Cylinder(_)) => line_contact(method, problem),
        (Method::BemSteady | Method::BemTransient, _) => boundary_elements(method, problem),
        (_, Body::HeightMap(_)) => Some(
            "it needs a body of revolution, and a height map is none; boundary elements take it",
        ),
        (Method::Analytic, Body::Revolution(body)) => closed(problem, body, simple),
        (_, Body::Revolution(_)) => line(method, problem),
    }
}

const NO_ELEMENTS: &str = "closed forms have no elements; give relative_error instead";
const UNDER_FORCE: &str = "it slides under a force, not at a depth";
const STATIONARY: &str = "it answers the stationary state, without duration and sliding_distance";
const NOTHING_SLIDES: &str =
    "nothing slides, and without sliding there is no stationary state to solve for";

fn at_depth(problem: &Problem) -> bool {
    matches!(problem.motion.control(), Control::IndentationDepth(_))
}

fn line_contact(method: Method, problem: &Problem) -> Option<&'static str> {
    if at_depth(problem) {
        return Some(
            "a line contact has no depth, which grows with the logarithm of the length; give load.normal_force",
        );
    }
    match (method, problem.motion) {
        (Method::MdrSteady | Method::MdrTransient, _) => {
            Some("it needs a body of revolution, and a cylinder is none")
        }
        _ if problem.model == Model::Line => Some(
            "the one-dimensional model is for bodies of revolution; a cylinder is on the half space",
        ),
        (Method::Analytic, Motion::Sliding(_)) => {
            Some("there is no closed form for a cylinder that slides")
        }
        (Method::Analytic, Motion::Pressing(_)) => {
            matches!(problem.accuracy, Accuracy::Elements(_)).then_some(NO_ELEMENTS)
        }
        (Method::BemTransient, _) => Some(
            "its elements end, and a cylinder does not; analytic presses it, and bem-steady slides it",
        ),
        (Method::BemSteady, Motion::Pressing(_)) => Some(NOTHING_SLIDES),
        (Method::BemSteady, Motion::Sliding(load)) => {
            if problem.material.creep().fluidity() > 0.0 {
                return Some(
                    "under a line contact a half space that flows sinks the faster the longer it is, without limit",
                );
            }
            load.sliding_distance().is_some().then_some(STATIONARY)
        }
    }
}

fn boundary_elements(method: Method, problem: &Problem) -> Option<&'static str> {
    let Motion::Sliding(load) = problem.motion else {
        return (method == Method::BemSteady).then_some(NOTHING_SLIDES);
    };
    if !at_depth(problem) || load.sliding_distance().is_some() {
        return None;
    }
    if method == Method::BemTransient {
        return Some("at a depth it marches over a distance; give solve.sliding_distance");
    }
    let flows = problem.material.creep().fluidity() > 0.0;
    flows.then_some(
        "a half space that flows sinks for ever, so that a depth belongs to a distance; give solve.sliding_distance",
    )
}

fn line(method: Method, problem: &Problem) -> Option<&'static str> {
    let Motion::Sliding(load) = problem.motion else {
        return match method {
            Method::MdrSteady => Some(NOTHING_SLIDES),
            _ => at_depth(problem).then_some("it presses with a force; analytic holds a depth"),
        };
    };
    if method == Method::MdrTransient {
        return at_depth(problem).then_some(UNDER_FORCE);
    }
    match problem.accuracy {
        _ if load.sliding_distance().is_some() => Some(STATIONARY),
        Accuracy::Elements(_) => {
            Some("it chooses its polynomials itself; give relative_error instead of elements")
        }
        Accuracy::RelativeError(_) => None,
    }
}

fn closed(problem: &Problem, body: &Revolution, simple: Option<&Simple>) -> Option<&'static str> {
    if matches!(problem.accuracy, Accuracy::Elements(_)) {
        return Some(NO_ELEMENTS);
    }
    let Motion::Sliding(load) = problem.motion else {
        return None;
    };
    match problem.model {
        _ if matches!(simple, Some(Simple::Elastic)) => None,
        Model::HalfSpace => closed_half_space(problem, body, simple, load.sliding_distance()),
        Model::Line => closed_line(problem, body, simple, load.sliding_distance()),
    }
}

fn closed_line(
    problem: &Problem,
    body: &Revolution,
    simple: Option<&Simple>,
    distance: Option<f64>,
) -> Option<&'static str> {
    let cone_or_paraboloid = match body {
        Revolution::Power(profile) => [1.0, 2.0].contains(&profile.exponent()),
        _ => false,
    };
    match (simple, distance) {
        (Some(Simple::Viscous(_)), None) => None,
        (Some(Simple::Viscous(_)), Some(_)) if cone_or_paraboloid => {
            at_depth(problem).then_some("the way to the stationary state is known under a force")
        }
        (Some(Simple::Viscous(_)), Some(_)) => {
            Some("only of cone and paraboloid the way to the stationary state has a closed form")
        }
        (Some(Simple::KelvinVoigt(_) | Simple::Maxwell(_)), None) if cone_or_paraboloid => None,
        (_, Some(_)) => Some("the way to the stationary state is known on a viscous material only"),
        _ => Some("there is no closed form for this body on this material"),
    }
}

fn closed_half_space(
    problem: &Problem,
    body: &Revolution,
    simple: Option<&Simple>,
    distance: Option<f64>,
) -> Option<&'static str> {
    let (Revolution::Power(profile), Some(Simple::Viscous(_))) = (body, simple) else {
        return Some("on the half space the friction of powers on a viscous material is tabulated");
    };
    let tabulated = scaling_factor(profile.exponent()).map(|s| s.error / s.value);
    let known = |asked| tabulated.is_ok_and(|error| error <= asked);
    if !matches!(problem.accuracy, Accuracy::RelativeError(asked) if known(asked)) {
        return Some("the table of s(p) does not know this exponent to the relative error");
    }
    if distance.is_some() {
        return Some(STATIONARY);
    }
    at_depth(problem).then_some(UNDER_FORCE)
}
