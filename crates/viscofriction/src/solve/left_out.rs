//! What a scene does not need, decided here and nowhere else.

use indenters::Surface as _;
use rheology::CreepSpectrum;

use super::answer::{Answer, Grid};
use super::body::Body;
use super::offer::answers;
use super::omission::Omission;
use super::problem::{Motion, Problem};
use crate::scene::{Control, Method};

/// What the method of the answer left out; what only another method would do counts where that answers the scene too.
pub(crate) fn plan(problem: &Problem, answer: &Answer) -> Vec<Omission> {
    let mut left_out = candidates(problem, answer);
    left_out.retain(|omission| {
        let other = omission.done_by(answer.model, problem.motion);
        other.is_none_or(|method| answers(method, problem))
    });
    left_out
}

fn candidates(problem: &Problem, answer: &Answer) -> Vec<Omission> {
    if matches!(problem.body, Body::Cylinder(_)) {
        // No other method answers for it, and one element along y leaves nothing to leave out.
        return Vec::new();
    }
    match (answer.method, problem.motion) {
        (Method::Analytic, Motion::Sliding(_)) => {
            vec![Omission::NumericalSolution, Omission::TimeSteps]
        }
        (Method::Analytic, Motion::Pressing(_)) => {
            vec![Omission::NumericalSolution, Omission::HalfSpace]
        }
        (Method::MdrSteady, _) => vec![Omission::TimeSteps],
        (Method::MdrTransient, Motion::Pressing(_)) => vec![Omission::HalfSpace],
        (Method::MdrTransient, Motion::Sliding(_)) => Vec::new(),
        (Method::BemSteady, Motion::Sliding(load)) => {
            let mut left_out = Vec::new();
            left_out.extend(mirrors(&problem.body)[1].then_some(Omission::MirrorHalf));
            left_out.push(outside_or_transforms(answer));
            // After a distance the friction is not yet that of the stationary state.
            left_out.extend(
                load.sliding_distance()
                    .is_none()
                    .then_some(Omission::TimeSteps),
            );
            left_out
        }
        (Method::BemSteady, Motion::Pressing(_)) => Vec::new(),
        (Method::BemTransient, Motion::Sliding(_)) => {
            let mut left_out = Vec::new();
            left_out.extend(mirrors(&problem.body)[1].then_some(Omission::MirrorHalf));
            left_out.extend([Omission::OutsideContact, Omission::RowsBehind]);
            left_out
        }
        (Method::BemTransient, Motion::Pressing(_)) => {
            let mut left_out = vec![Omission::TimeSteps];
            let is_even = mirrors(&problem.body) != [false; 2];
            left_out.extend(is_even.then_some(Omission::MirrorHalf));
            left_out.push(Omission::Gradients);
            // A depth that is held needs another force at every time.
            let constant = matches!(problem.motion.control(), Control::NormalForce(_));
            let remembers = n_fields(&problem.material.creep()) > 1;
            left_out.extend((constant && remembers).then_some(Omission::HistoryFields));
            left_out
        }
    }
}

/// Whether a body is its own mirror image along x and y.
fn mirrors(body: &Body) -> [bool; 2] {
    match body {
        Body::Revolution(body) => body.mirrors(),
        Body::Cylinder(cylinder) => cylinder.mirrors(),
        Body::HeightMap(map) => map.mirrors(),
    }
}

/// A box is transformed unless its contact is factorised.
fn outside_or_transforms(answer: &Answer) -> Omission {
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
