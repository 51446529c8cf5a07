//! What a method left out, decided here and nowhere else.

use indenters::Surface as _;
use rheology::CreepSpectrum;

use super::answer::{Answer, Grid};
use super::body::Body;
use super::omission::Omission;
use super::problem::{Motion, Problem};
use super::work::work;
use crate::scene::{Control, Method, Model};

impl Omission {
    /// The method that does the work of an omission too, where another method does.
    #[must_use]
    pub const fn done_by(self, model: Model, motion: Motion) -> Option<Method> {
        match (self, model, motion) {
            (Self::NumericalSolution, Model::Line, Motion::Sliding(_)) => Some(Method::MdrSteady),
            (Self::NumericalSolution, Model::HalfSpace, Motion::Sliding(_)) => {
                Some(Method::BemSteady)
            }
            (Self::TimeSteps, Model::Line, _) => Some(Method::MdrTransient),
            (Self::TimeSteps, Model::HalfSpace, Motion::Sliding(_)) | (Self::HalfSpace, _, _) => {
                Some(Method::BemTransient)
            }
            _ => None,
        }
    }
}

/// What the method of the answer left out. Work that only another method would do is named where that method answers the
/// scene too.
pub(crate) fn left_out(problem: &Problem, answer: &Answer) -> Vec<Omission> {
    let mut parts = candidates(problem, answer);
    parts.retain(|omission| {
        let other = omission.done_by(answer.model, problem.motion);
        other.is_none_or(|method| work(problem, method, problem.accuracy).is_ok())
    });
    parts
}

fn candidates(problem: &Problem, answer: &Answer) -> Vec<Omission> {
    let [even_along, even_across] = match &problem.body {
        // No other method answers for them, and one element along y leaves nothing to leave out.
        Body::Cylinder(_) | Body::Periodic(_) => return Vec::new(),
        Body::Revolution(body) => body.mirrors(),
        Body::HeightMap(map) => map.mirrors(),
    };
    let mirror = |is_even: bool| is_even.then_some(Omission::MirrorHalf);
    let candidates = match (answer.method, problem.motion) {
        (Method::Analytic, Motion::Sliding(_)) => {
            vec![Some(Omission::NumericalSolution), Some(Omission::TimeSteps)]
        }
        // No other method does it.
        (_, Motion::History(_)) => Vec::new(),
        (Method::MdrSteady, _) => vec![Some(Omission::TimeSteps)],
        (Method::Analytic | Method::MdrTransient, Motion::Pressing(_)) => {
            vec![Some(Omission::HalfSpace)]
        }
        (Method::BemSteady, Motion::Sliding(load)) => {
            // After a distance the friction is not yet that of the stationary state.
            let is_stationary = load.sliding_distance().is_none();
            vec![
                mirror(even_across),
                Some(outside_or_transforms(answer)),
                is_stationary.then_some(Omission::TimeSteps),
            ]
        }
        (Method::BemTransient, Motion::Sliding(_)) => vec![
            mirror(even_across),
            Some(Omission::OutsideContact),
            Some(Omission::RowsBehind),
        ],
        (Method::BemTransient, Motion::Pressing(_)) => {
            // A depth that is held needs another force at every time.
            let constant = matches!(problem.motion.control(), Control::NormalForce(_));
            let remembers = constant && n_fields(&problem.material.creep()) > 1;
            vec![
                Some(Omission::TimeSteps),
                mirror(even_along || even_across),
                Some(Omission::Gradients),
                remembers.then_some(Omission::HistoryFields),
            ]
        }
        (Method::MdrTransient, Motion::Sliding(_)) | (Method::BemSteady, Motion::Pressing(_)) => {
            Vec::new()
        }
    };
    candidates.into_iter().flatten().collect()
}

/// A box is transformed unless its contact is factorised.
const fn outside_or_transforms(answer: &Answer) -> Omission {
    match answer.grid {
        Some(Grid::Stationary {
            factorised: true, ..
        }) => Omission::Transforms,
        _ => Omission::OutsideContact,
    }
}

/// Values that an element of the half space remembers; the dashpot in its place remembers one.
fn n_fields(creep: &CreepSpectrum) -> usize {
    creep.elements().len() + usize::from(creep.fluidity() > 0.0)
}
