//! Solution of a problem: choice of the method, its run, and the completed answer.

mod advice;
mod analytic;
mod answer;
pub(crate) mod body;
mod contact_strain;
mod contact_temperature;
mod curve;
mod cut_off;
mod dissipation;
mod elements;
mod error;
mod expansion;
mod fixed_point;
mod gap;
pub(crate) mod half_space;
mod heat;
mod heights;
mod layer;
mod left_out;
pub(crate) mod mdr;
mod memory;
mod modulus_error;
mod omission;
mod parts;
mod period_grids;
mod plan;
mod problem;
mod realisations;
mod road;
pub(crate) mod sensitivity;
mod shared_memory;
pub(crate) mod shear;
mod solved;
mod validity;
mod warning;
mod with_fields;
pub(crate) mod work;

pub use crate::scene::Revolution;
pub(crate) use answer::LINEAR_FRICTION;
pub use answer::{Answer, ContactBox, Fields, HistoryRow, Persson};
pub use body::{Body, BodyOfScene, body};
pub use curve::{Curve, CurveColumn};
pub use cut_off::WithoutShortestOctave;
pub use dissipation::Dissipation;
pub use elements::persson;
pub use error::{NotOffered, Result, SolveError};
pub use expansion::Expansion;
pub use half_space::{HalfSpace, half_space};
pub use heat::TemperatureField;
pub use heights::{Advice as AdviceOnHeights, body_of_heights, warnings as warnings_of_heights};
use memory::Limited;
pub use omission::Omission;
pub use parts::Parts;
pub use plan::{Plan, plan, plan_of, problem_of, scene_of};
pub use problem::{Motion, Problem};
pub(crate) use realisations::Coarse;
pub use realisations::{Ensemble, Realisation, Scatter};
pub use road::{CutOff, cut_offs};
pub(crate) use sensitivity::{AnswerChange, check_uncertainties, relative_change};
pub use sensitivity::{
    Budget, ByFrequency, Sensitivity, Source, SpectralSensitivity, check_derivatives, sampled,
    spectral_sensitivity, with_sensitivity,
};
pub use shared_memory::share_memory;
pub use warning::Warning;
pub use with_fields::with_fields;

use self::dissipation::dissipation;
use self::left_out::left_out;
use self::memory::check_first_grid;
use self::solved::Solved;
use self::validity::{not_modelled, warnings};
use self::work::rough;
use crate::scene::{Method, Model};
use bem_halfspace::BemError;
use mdr_core::MdrError;
use numerics::{Progress, SilentProgress};

/// Solves a problem with the method that the scene names, else with the cheapest that answers it.
///
/// # Errors
/// [`SolveError`] if no method answers the scene or the request was not met; it then holds the answer so far.
pub fn solve(problem: &Problem) -> Result<Answer> {
    plan(problem)?.solve(&SilentProgress)
}

impl Plan<'_> {
    /// Solves the problem; for random surfaces the answer is the ensemble mean. `watch` receives the progress and may stop a
    /// refinement before a grid.
    ///
    /// # Errors
    /// [`SolveError`] if the request was not met; it then holds the answer so far.
    pub fn solve(self, watch: &dyn Progress) -> Result<Answer> {
        let problem = self.problem;
        realisations::mean(problem, |watch| self.solve_one(watch), watch)
    }

    /// Solves for the body of the problem, of random surfaces the first, at temperature and strain of the contact and as finely as the sum
    /// of hysteresis and shear needs.
    fn solve_one(self, watch: &dyn Progress) -> Result<Answer> {
        contact_strain::beside_linear(self, watch)
    }

    /// Solves once for the body of the problem, of random surfaces the first. Refuses a first grid that exceeds the memory limit.
    fn solve_once(self, watch: &dyn Progress) -> Result<Answer> {
        let Self {
            problem,
            method,
            work,
        } = self;
        check_first_grid(problem, method)?;
        let limited = Limited::new(problem, method, watch);
        let solved = match work(&limited) {
            Ok(answer) => Solved {
                answer,
                missed: None,
            },
            Err(why) => {
                let answer = reached(problem, method, &why);
                let why = limited.or_memory(why);
                let Some(answer) = answer else {
                    return Err(why);
                };
                let missed = Some(Box::new(why));
                Solved { answer, missed }
            }
        };
        solved.complete(problem, method)
    }
}

impl Solved {
    /// Completes the answer with modulus error, omissions, dissipation and warnings; an error if it does not meet the request.
    fn complete(self, problem: &Problem, method: Method) -> Result<Answer> {
        // Add the error that the approximation of the moduli causes, and compare the sum with the requested error.
        let answer = problem.with_modulus_error(self.answer)?;
        let missed = self
            .missed
            .or_else(|| problem.missed(&answer).map(Box::new));
        // Closed forms of indentation belong to both models.
        let model = method.model().unwrap_or(problem.model());
        let answer = Answer {
            model,
            left_out: left_out(problem, &answer),
            dissipation: dissipation(problem, &answer),
            not_modelled: not_modelled(problem),
            ..answer
        };
        // Reject numbers that are not finite or not physical, and add the shear of the contact area to the friction and the
        // temperature to which both heat the contact.
        let checked = answer
            .finite()
            .and_then(|answer| answer.physical(problem))
            .and_then(|answer| problem.with_shear(answer))
            .and_then(|answer| problem.with_bulk(answer))
            .and_then(Answer::finite)
            .and_then(|answer| problem.add_gap(answer))
            .map(|answer| Answer {
                warnings: warnings(problem, &answer),
                ..answer
            });
        // If the requested error was missed, say so in the answer.
        match (checked, missed) {
            (Err(_), Some(why)) => Err(*why),
            (checked, missed) => Self {
                answer: checked?,
                missed,
            }
            .into_result(),
        }
    }
}

/// The answer of a solution that missed the request and is contained in the error of the method; `None` if it contains none.
fn reached(problem: &Problem, method: Method, why: &SolveError) -> Option<Answer> {
    match why {
        SolveError::HalfSpace(BemError::NotReached { reached, .. }) => {
            let rough = match problem.body() {
                Body::Periodic(surface) => Some(rough(problem, surface).ok()?),
                _ => None,
            };
            elements::reached(problem, rough, (**reached).clone())
        }
        SolveError::Line(MdrError::SlidingNotReached { reached, .. }) => {
            Some(mdr::answer_from_march((**reached).clone()))
        }
        SolveError::Line(MdrError::MotionNotReached { reached, .. }) => Some(
            mdr::answer_from_motion(method, Model::Line, (**reached).clone()),
        ),
        SolveError::Line(MdrError::NotConverged { reached, .. }) if method == Method::MdrSteady => {
            Some(mdr::answer_from_steady((**reached).clone()))
        }
        SolveError::Line(MdrError::HistoryNotReached { reached, .. }) => {
            mdr::answer_from_curve(problem, method, reached)
        }
        _ => None,
    }
}

#[cfg(test)]
mod tests {
    use mdr_core::{HistoryOptions, indent_along};
    use numerics::NotReached;

    use super::*;
    use crate::scene::Scene;

    #[test]
    fn a_history_that_was_not_reached_has_the_answer_of_its_curve() {
        let history = "history = [{ time = 0.0, indentation_depth = 0.0 }, { time = 1.0, indentation_depth = 1e-5 }]";
        let text = format!(
            "[indenter.sphere]\nradius = 5e-3\n[material.elastic]\nshear_modulus = 1e6\n[load]\n{history}"
        );
        let scene: Scene = text.parse().expect("a scene");
        let problem = Problem::try_from(&scene).expect("a problem");
        let (Body::Revolution(body), Motion::History { points, .. }) =
            (problem.body(), problem.motion())
        else {
            panic!("a body of revolution and a history");
        };
        let reached = indent_along(
            &&**body,
            problem.material(),
            points,
            &HistoryOptions::default(),
        );
        let missed = NotReached {
            quantity: 0,
            relative_error: 1e-12,
            value: 1e-5,
            scale: 1e-5,
            error: 1e-9,
            elements: 1,
        };
        let reached = reached.expect("a curve");
        let why = SolveError::Line(MdrError::HistoryNotReached { missed, reached });
        let found = super::reached(&problem, Method::MdrTransient, &why).expect("an answer");
        let answered = solve(&problem).expect("an answer");
        assert_eq!(found.fields.curve, answered.fields.curve, "the same points");
    }
}
