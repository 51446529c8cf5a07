//! Computations that a method skipped, and what they save. All such decisions are made here.

use rheology::CreepSpectrum;

use super::answer::{Answer, Grid};
use super::omission::Omission;
use super::problem::{Motion, Problem};
use super::work::work_of_method;
use crate::scene::{Control, Method, Model};
use Method::{Analytic, BemSteady, BemTransient, MdrSteady, MdrTransient};
use Motion::{Pressing, Sliding};

impl Omission {
    /// The method that does the omitted work; `None` if no other method does.
    const fn done_by(self, model: Model, motion: &Motion) -> Option<Method> {
        match (self, model, motion) {
            (Self::NumericalSolution, Model::Line, Sliding(_)) => Some(MdrSteady),
            (Self::NumericalSolution, Model::HalfSpace, Sliding(_)) => Some(BemSteady),
            (Self::TimeSteps, Model::Line, _) => Some(MdrTransient),
            (Self::TimeSteps, Model::HalfSpace, Sliding(_)) => Some(BemTransient),
            (Self::HalfSpace, _, _) => Some(BemTransient),
            _ => None,
        }
    }

    /// What the omission saves in an answer to a problem: an exact count if there is one, else a phrase.
    pub fn saves(self, problem: &Problem, answer: &Answer) -> String {
        let (unknowns, iterations) = (answer.unknowns, answer.iterations);
        let n_footprint = |even| answer.grid.map_or(0, |grid| grid.n_elements(even));
        let all = n_footprint([false; 2]);
        match self {
            Self::MirrorHalf if answer.method == BemSteady => {
                let n_contact = n_contact(answer);
                format!("{unknowns} of {n_contact} elements in contact are unknowns")
            }
            Self::MirrorHalf => {
                let n_followed = n_footprint(mirrors(problem).unwrap_or_default());
                format!("{n_followed} of {all} elements of the footprint are followed")
            }
            Self::OutsideContact => {
                let n_contact = n_contact(answer);
                format!("{n_contact} of {all} elements of the footprint are in contact")
            }
            Self::Transforms => format!("the equations of {unknowns} unknowns are factorised"),
            Self::RowsBehind => {
                format!("each of {iterations} time steps leaves a row of elements behind")
            }
            Self::HistoryFields => {
                let n_fields = n_fields(&problem.material().creep());
                format!("0 values per element instead of {n_fields}")
            }
            Self::NumericalSolution => "no elements and no iteration".to_owned(),
            Self::TimeSteps => "one state instead of a march in time".to_owned(),
            Self::HalfSpace => "a line instead of a surface of elements".to_owned(),
            Self::Gradients => "no slope of an element is computed".to_owned(),
            Self::Files => "no field and no picture is written".to_owned(),
        }
    }
}

/// Number of elements in contact, mirror images included.
fn n_contact(answer: &Answer) -> usize {
    let field = answer.fields.pressure.iter();
    let pressures = field.flat_map(|field| &field.pressure);
    pressures.filter(|pressure| **pressure > 0.0).count()
}

impl Grid {
    /// Number of elements of the footprint; along an axis whose entry in `even` is true, and which has as many elements on both
    /// sides, without the mirror images.
    fn n_elements(&self, even: [bool; 2]) -> usize {
        let along = |axis: usize| {
            let [before, after] = self.footprint[axis];
            let is_half = even[axis] && before == after;
            1 + after + if is_half { 0 } else { before }
        };
        along(0) * along(1)
    }
}

/// Whether body and motion are mirror symmetric about x = 0 and about y = 0; a body that slides is not about x = 0. `None` for
/// a cylinder and a periodic surface, for which no omissions are listed.
fn mirrors(problem: &Problem) -> Option<[bool; 2]> {
    let [along, across] = problem.body().surface()?.mirrors();
    let is_pressed = matches!(problem.motion(), Pressing(_));
    Some([along && is_pressed, across])
}

/// The omissions of an answer. Work of another method is listed only if that method answers the scene too.
pub(crate) fn left_out(problem: &Problem, answer: &Answer) -> Vec<Omission> {
    let mut parts = candidates(problem, answer);
    parts.retain(|omission| {
        let other = omission.done_by(answer.model, problem.motion());
        other.is_none_or(|method| work_of_method(problem, method).is_ok())
    });
    parts
}

/// All omissions of a method for a kind of motion, whether or not another method answers the scene.
fn candidates(problem: &Problem, answer: &Answer) -> Vec<Omission> {
    let Some(even) = mirrors(problem) else {
        return Vec::new();
    };
    let mirror = even.contains(&true).then_some(Omission::MirrorHalf);
    let candidates = match (answer.method, problem.motion()) {
        (Analytic, Sliding(_)) => {
            vec![Some(Omission::NumericalSolution), Some(Omission::TimeSteps)]
        }
        // For a history or a motion the method leaves no part of the computation out.
        (_, Motion::History { .. } | Motion::Moving(_)) => Vec::new(),
        (MdrSteady, _) => vec![Some(Omission::TimeSteps)],
        (Analytic | MdrTransient, Pressing(_)) => vec![Some(Omission::HalfSpace)],
        (BemSteady, Sliding(load)) => {
            // The computation leaves out time steps only without a sliding distance: at a finite one the friction has not reached
            // its stationary value.
            let is_stationary = load.sliding_distance().is_none();
            // Fourier transforms are left out only with a factorisation; without one the bounding box of the contact is
            // transformed.
            let is_factorised = answer.grid.is_some_and(|grid| grid.factorised);
            let transforms = is_factorised.then_some(Omission::Transforms);
            vec![
                mirror,
                transforms.or(Some(Omission::OutsideContact)),
                is_stationary.then_some(Omission::TimeSteps),
            ]
        }
        (BemTransient, Sliding(_)) => vec![
            mirror,
            Some(Omission::OutsideContact),
            Some(Omission::RowsBehind),
        ],
        (BemTransient, Pressing(_)) => {
            // A constant depth needs a different force at each time, so the history matters.
            let constant = matches!(problem.motion().control(), Control::NormalForce(_));
            let remembers = constant && n_fields(&problem.material().creep()) > 1;
            vec![
                Some(Omission::TimeSteps),
                mirror,
                Some(Omission::Gradients),
                remembers.then_some(Omission::HistoryFields),
            ]
        }
        (MdrTransient, Sliding(_)) | (BemSteady, Pressing(_)) => Vec::new(),
    };
    candidates.into_iter().flatten().collect()
}

/// History variables per element of the half space in a time march.
fn n_fields(creep: &CreepSpectrum) -> usize {
    creep.elements().len() + usize::from(creep.fluidity() > 0.0)
}
