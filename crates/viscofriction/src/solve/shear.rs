//! Shear of the real contact: the part of the friction that does not come from the bulk of the elastomer.
//!
//! A shear strength τ_f that is the same everywhere in the contact area A adds F_τ = τ_f A to the tangential force. On an
//! incompressible half space tangential tractions do not move the surface vertically, so that the sum μ = μ_hysteresis + τ_f A/F_N
//! is exact (Johnson 1985, Contact Mechanics, § 3.2). The error of the area is then an error of the friction.
//!
//! Theory: docs/theory/shear.md.

use indenters::{FrictionParts, Moved, Shape};
use numerics::{ErrorParts, Estimate, Progress};
use rheology::RheologyError;

use super::answer::Answer;
use super::body::Body;
use super::error::{Result, SolveError};
use super::half_space::Simple;
use super::period_grids::PeriodGrids;
use super::plan::{Plan, plan};
use super::problem::{Motion, Problem};
use super::solved::Solved;
use super::work::work_of_method;
use crate::scene::{Accuracy, Method, Model, SceneError, ShearLaw};

/// Largest relative error that is requested of the friction from hysteresis. Chosen: the first solution only has to show which part
/// of the friction is hysteresis.
const MAX_HYSTERESIS_ERROR: f64 = 0.1;
/// Fraction of the allowed error that the next request aims at, because errors on successive grids scatter about their trend. Chosen.
const AIMED_SHARE: f64 = 0.7;
/// Range of the ratio of successive requests. Chosen: a single coarse solution may mislead by less than a factor of 100, and each
/// solution shall be appreciably finer than the one before.
const REQUEST_RATIOS: [f64; 2] = [0.01, 0.7];
/// First and largest number of elements along an elastic contact that moves. Derived: those of the refinement of a motion on any other
/// material.
const ELASTIC_MOTION_ELEMENTS: [usize; 2] = [8, 64];
/// Largest number of solutions with smaller and smaller requested errors. Derived: with the largest of [`REQUEST_RATIOS`] the request
/// falls by a factor of 0.7⁹ = 1/25, and with the smallest far below rounding.
const MAX_SOLUTIONS: usize = 10;

/// Refusal of a shear strength in the one-dimensional model.
pub(crate) const NO_AREA_ON_LINE: &str = "the scene asks for the one-dimensional model, which does not know the contact area that shear acts on; boundary \
     elements do";
/// Refusal of a shear strength that depends on the temperature without one.
pub(crate) const NO_TEMPERATURE: &str = "it depends on the temperature, which is that of the material, and the material has none: give one with a shift law, as \
     fit-material writes it";

/// Shear strength of the contact at the temperature of the elastomer.
#[derive(Debug, Clone)]
pub(crate) struct Shear {
    /// The law over velocity and temperature.
    pub(crate) law: ShearLaw,
    /// Temperature of the contact, \[°C]; `None` if the scene gives none.
    pub(crate) temperature: Option<f64>,
    /// Factor on the strength of the law.
    pub(crate) factor: f64,
}

impl Shear {
    /// Shear strength at a velocity \[m/s], \[Pa]; the error names the table of the scene.
    pub(crate) fn strength(&self, velocity: f64) -> Result<f64, SceneError> {
        let strength = self.law.strength.at(velocity, self.temperature);
        let refused = |error: RheologyError| SceneError::at("interface", error.to_string());
        Ok(self.factor * strength.map_err(refused)?)
    }
}

impl Problem {
    /// Shear strength of the contact, \[Pa]; `None` unless the scene has one and the body slides at a constant velocity.
    ///
    /// # Errors
    /// [`SceneError`] for a velocity or a temperature outside the table of the interface.
    pub fn shear_strength(&self) -> Result<Option<f64>, SceneError> {
        match (self.shear(), self.motion()) {
            (Some(shear), Motion::Sliding(load)) => shear.strength(load.velocity()).map(Some),
            _ => Ok(None),
        }
    }

    /// Relative standard uncertainty of the shear strength, from the errors of a table; 0 without errors, and unless the scene has a
    /// shear strength and the body slides at a constant velocity.
    pub(super) fn shear_strength_uncertainty(&self) -> Result<f64, SceneError> {
        match (self.shear(), self.motion()) {
            (Some(shear), Motion::Sliding(load)) => shear
                .law
                .relative_uncertainty(load.velocity(), shear.temperature)
                .map_err(|error| SceneError::at("interface", error.to_string())),
            _ => Ok(0.0),
        }
    }

    /// Rejects a shear strength where nothing slides, in the one-dimensional model, without the temperature that it needs, and at a
    /// velocity outside its table.
    pub(super) fn check_interface(&self) -> Result<(), SceneError> {
        let Some(shear) = self.shear() else {
            return Ok(());
        };
        let refused = |problem: &str| Err(SceneError::at("interface", problem));
        if self.model() == Model::Line {
            return refused(NO_AREA_ON_LINE);
        }
        if shear.law.strength.depends_on_temperature() && shear.temperature.is_none() {
            return refused(NO_TEMPERATURE);
        }
        match self.motion() {
            Motion::Sliding(_) => self.shear_strength().map(drop),
            Motion::Moving(load) => load.stages().iter().try_for_each(|stage| {
                let fastest = stage.fastest();
                if stage.shape() == Shape::Sinusoidal && shear.strength(f64::MIN_POSITIVE).is_err() {
                    return refused(&format!(
                        "a sinusoidal motion passes all speeds from 0 to {fastest} m/s, and a table does not begin at 0; load.shape = \
                         \"triangular\" has one speed"
                    ));
                }
                // A body that dwells has no shear.
                if fastest > 0.0 { shear.strength(fastest).map(drop) } else { Ok(()) }
            }),
            Motion::Pressing(_) | Motion::History { .. } => {
                refused("nothing slides here, and without sliding there is no shear; leave it out")
            }
        }
    }

    /// Adds the shear of the contact area to a motion; `None` if the scene has no interface or the method no area.
    pub(super) fn add_shear_to_motion(&self, found: &mut Moved) -> Result<Option<FrictionParts>> {
        let (Some(shear), Motion::Moving(load)) = (self.shear(), self.motion()) else {
            return Ok(None);
        };
        Ok(found.add_shear(load, |speed| shear.strength(speed))?)
    }

    /// Adds the shear of the contact area to the friction of an answer to sliding at a constant velocity.
    pub(super) fn with_shear(&self, answer: Answer) -> Result<Answer> {
        let Some(strength) = self.shear_strength()? else {
            let lacks_shear = self.shear().is_some() && answer.friction_from_shear.is_none();
            return if lacks_shear {
                no_area(&answer)
            } else {
                Ok(answer)
            };
        };
        let (Some(hysteresis), Some(area)) = (answer.friction_coefficient, answer.contact_area)
        else {
            return no_area(&answer);
        };
        let shear = over_force(area * strength, answer.normal_force);
        let mut answer = Answer {
            friction_coefficient: Some(hysteresis + shear),
            friction_from_hysteresis: Some(hysteresis),
            friction_from_shear: Some(shear),
            error_parts: (answer.error_parts).plus(ErrorParts::discretisation_only(shear.error)),
            ..answer
        };
        // Without the shortest octave, the smaller area has its own shear.
        if let (Some(without), Some(pressure)) =
            (&mut answer.without_shortest_octave, answer.mean_pressure)
        {
            let shear = over_force(without.area_fraction * strength, pressure);
            without.friction_coefficient =
                (without.friction_coefficient).map(|hysteresis| hysteresis + shear);
        }
        // The steps before the end have the shear of their own areas.
        for row in &mut answer.fields.history {
            row.friction_coefficient += strength * row.area_over_force.unwrap_or_default();
        }
        Ok(answer)
    }
}

/// The error of a method that does not compute the contact area.
const fn no_area<T>(answer: &Answer) -> Result<T> {
    let method = answer.method;
    Err(SolveError::NoAreaForShear { method })
}

/// Quotient of a tangential and a normal force \[N], or of a mean stress and a mean pressure \[Pa]. The error is infinite if the normal
/// one may vanish within its error.
fn over_force(tangential: Estimate, normal: Estimate) -> Estimate {
    let ratio = tangential.value / normal.value;
    let smallest = normal.value - normal.error;
    let error = if smallest > 0.0 {
        (tangential.error + ratio * normal.error) / smallest
    } else {
        f64::INFINITY
    };
    Estimate::new(ratio, error)
}

/// Solves for the sum of hysteresis and shear to the requested relative error, without shear like [`Plan::solve_once`].
///
/// The methods control the relative error of the friction from hysteresis. It is requested coarsely at first, and then as finely as the
/// sum needs: a small hysteresis beside a large shear need not be known well, and the error of the contact area adds to both. A periodic
/// surface begins with its coarsest grids, which suffice for a friction that is mostly shear.
pub(super) fn solve(first: Plan, watch: &dyn Progress) -> Result<Answer> {
    let (problem, method) = (first.problem, first.method);
    let (Accuracy::RelativeError(asked), Some(_)) = (problem.accuracy(), problem.shear()) else {
        return first.solve_once(watch);
    };
    let mut request = asked.max(MAX_HYSTERESIS_ERROR);
    let mut grids = PeriodGrids::of(problem);
    // An elastic body that moves has no friction but shear, on any grid, so that no request refines its area.
    let is_elastic = problem.simple() == Some(&Simple::Elastic);
    let is_elastic_motion = is_elastic && matches!(problem.motion(), Motion::Moving(_));
    let is_body = !matches!(problem.body(), Body::Periodic(_));
    let [mut elements, most_elements] = ELASTIC_MOTION_ELEMENTS;
    let mut solutions = 0;
    loop {
        let accuracy = if is_elastic_motion && is_body {
            Accuracy::Elements(elements)
        } else {
            grids.take().unwrap_or(Accuracy::RelativeError(request))
        };
        let near = problem.clone().with_accuracy(accuracy);
        let Solved { answer, missed } = Solved::of(plan_again(&near, method)?.solve_once(watch))?;
        solutions += 1;
        let Some(friction) = answer.friction_coefficient else {
            return Ok(answer);
        };
        let allowed = asked * friction.value.abs();
        // Bars of the hysteresis do not hold as often on grids that are coarser than those of a request.
        let is_trusted = matches!(accuracy, Accuracy::RelativeError(_)) || answer.is_mostly_shear();
        if friction.error <= allowed && is_trusted {
            return Ok(Answer {
                not_reached: None,
                ..answer
            });
        }
        let is_stuck = is_elastic_motion && (!is_body || elements >= most_elements);
        elements *= 2;
        if missed.is_some() || is_stuck || solutions == MAX_SOLUTIONS {
            let why = SolveError::ShearNotReached {
                asked,
                friction,
                shear: answer.friction_from_shear.unwrap_or(friction),
                hysteresis: missed,
            };
            let missed = Some(Box::new(why));
            return Solved { answer, missed }.into_result();
        }
        let [smallest, largest] = REQUEST_RATIOS;
        let needed = AIMED_SHARE * allowed / friction.error;
        // The error that was reached may be far smaller than the request, which the same grid would then meet again.
        let reached = answer.hysteresis().map_or(request, |h| h.relative_error());
        request = match problem.motion() {
            // A grid without a request tells nothing about the error that a request reaches.
            _ if !is_trusted => request * needed.clamp(smallest, 1.0),
            // The next grid of a motion has eight times the work, so that none is left out.
            Motion::Moving(_) => AIMED_SHARE * request.min(reached),
            _ => request.min(reached) * needed.clamp(smallest, largest),
        };
        if is_trusted {
            grids.leave_out_if_too_coarse(friction, allowed);
        } else {
            grids.leave_out();
        }
    }
}

/// The plan of a method for a problem with another accuracy. A closed form may refuse a finer request, for which another method is
/// chosen unless the scene names one.
pub(super) fn plan_again(problem: &Problem, method: Method) -> Result<Plan<'_>> {
    match work_of_method(problem, method) {
        Ok(work) => Ok(Plan {
            problem,
            method,
            work,
        }),
        Err(_) if problem.method().is_none() => Ok(plan(problem)?),
        Err(why) => Err(SolveError::Refused { method, why }),
    }
}
