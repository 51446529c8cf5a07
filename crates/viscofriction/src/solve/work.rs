//! What a method does for a problem, or why it does not answer it.

use friction_analytic::scaling_factor;
use indenters::{Cylinder, PowerProfile, PressingLoad, SlidingLoad, Surface};
use rheology::{KelvinVoigt, Maxwell, Viscous};

use super::body::{Body, Revolution};
use super::half_space::Simple;
use super::problem::{Motion, Problem};
use crate::scene::{Accuracy, Control, Method, Model};

/// What one method computes, with all that it needs.
pub(crate) enum Work<'a> {
    Closed(ClosedForm<'a>),
    LinePressed(&'a Revolution, PressingLoad),
    LineSteady(&'a Revolution, SlidingLoad, f64),
    LineTransient(&'a Revolution, SlidingLoad),
    HalfSpacePressed(&'a dyn Surface, PressingLoad),
    HalfSpaceSteady(&'a dyn Surface, SlidingLoad),
    HalfSpaceTransient(&'a dyn Surface, SlidingLoad),
    CylinderSteady(&'a Cylinder, SlidingLoad),
}

/// A closed form or a quadrature.
pub(crate) enum ClosedForm<'a> {
    Pressed(&'a Revolution, PressingLoad),
    /// Pressed under a force for a time, in plane strain.
    CylinderPressed(&'a Cylinder, f64, f64),
    /// Sliding on springs.
    Elastic(&'a Revolution, SlidingLoad),
    /// Sliding on springs under a force, in plane strain.
    ElasticCylinder(&'a Cylinder, f64),
    /// A power profile on a viscous half space, from the table of s(p).
    HalfSpacePower(&'a PowerProfile, Viscous, SlidingLoad),
    ViscousLine(&'a Revolution, Viscous, SlidingLoad),
    ViscousTransient(&'a PowerProfile, Viscous, SlidingLoad, f64),
    KelvinVoigtLine(&'a PowerProfile, KelvinVoigt, SlidingLoad),
    MaxwellLine(&'a PowerProfile, Maxwell, SlidingLoad),
}

/// Why a method does not answer.
pub(crate) type Refusal = &'static str;

const NO_ELEMENTS: Refusal = "closed forms have no elements; give relative_error instead";
const UNDER_FORCE: Refusal = "it slides under a force, not at a depth";
const STATIONARY: Refusal =
    "it answers the stationary state, without duration and sliding_distance";
const NOTHING_SLIDES: Refusal =
    "nothing slides, and without sliding there is no stationary state to solve for";
const ANOTHER_BODY: Refusal = "there is no closed form for this body on this material";
const VISCOUS_ONLY: Refusal =
    "the state before the stationary one has a closed form on a viscous material only";

/// The work of a method, whichever method and model the problem names.
pub(crate) fn work(
    problem: &Problem,
    method: Method,
    accuracy: Accuracy,
) -> Result<Work<'_>, Refusal> {
    match (&problem.body, method) {
        (Body::Cylinder(cylinder), _) => line_contact(problem, cylinder, method, accuracy),
        (Body::Revolution(body), Method::Analytic) => {
            closed(problem, body, accuracy).map(Work::Closed)
        }
        (Body::Revolution(body), Method::MdrSteady) => line_steady(problem, body, accuracy),
        (Body::Revolution(body), Method::MdrTransient) => line_transient(problem, body),
        (Body::Revolution(body), _) => boundary_elements(problem, body, method),
        (Body::HeightMap(map), Method::BemSteady | Method::BemTransient) => {
            boundary_elements(problem, map, method)
        }
        (Body::HeightMap(_), _) => Err(
            "it needs a body of revolution, and a height map is none; boundary elements take it",
        ),
    }
}

fn require(holds: bool, refusal: Refusal) -> Result<(), Refusal> {
    if holds { Ok(()) } else { Err(refusal) }
}

fn flows(problem: &Problem) -> bool {
    problem.material.creep().fluidity() > 0.0
}

fn has_force(problem: &Problem) -> bool {
    matches!(problem.motion.control(), Control::NormalForce(_))
}

fn line_contact<'a>(
    problem: &Problem,
    cylinder: &'a Cylinder,
    method: Method,
    accuracy: Accuracy,
) -> Result<Work<'a>, Refusal> {
    let Control::NormalForce(force) = problem.motion.control() else {
        return Err(
            "a line contact has no depth, which grows with the logarithm of the length; give load.normal_force",
        );
    };
    let is_line = matches!(method, Method::MdrSteady | Method::MdrTransient);
    require(
        !is_line,
        "it needs a body of revolution, and a cylinder is none",
    )?;
    require(
        problem.model == Model::HalfSpace,
        "the one-dimensional model is for bodies of revolution; a cylinder is on the half space",
    )?;
    match (method, problem.motion) {
        (Method::Analytic, motion) => {
            require(matches!(accuracy, Accuracy::RelativeError(_)), NO_ELEMENTS)?;
            Ok(Work::Closed(match (motion, &problem.simple) {
                (Motion::Pressing(load), _) => {
                    ClosedForm::CylinderPressed(cylinder, force, load.duration())
                }
                (_, Some(Simple::Elastic)) => ClosedForm::ElasticCylinder(cylinder, force),
                _ => {
                    return Err(
                        "there is no closed form for a cylinder that slides on this material",
                    );
                }
            }))
        }
        (Method::BemSteady, Motion::Sliding(load)) => {
            require(
                !flows(problem),
                "under a line contact a half space that flows sinks the faster the longer it is, without limit",
            )?;
            require(load.sliding_distance().is_none(), STATIONARY)?;
            Ok(Work::CylinderSteady(cylinder, load))
        }
        (Method::BemSteady, _) => Err(NOTHING_SLIDES),
        _ => Err(
            "its elements end, and a cylinder does not; analytic presses it, and bem-steady slides it",
        ),
    }
}

fn boundary_elements<'a>(
    problem: &Problem,
    surface: &'a dyn Surface,
    method: Method,
) -> Result<Work<'a>, Refusal> {
    let is_stationary = method == Method::BemSteady;
    let load = match problem.motion {
        Motion::Pressing(_) if is_stationary => return Err(NOTHING_SLIDES),
        Motion::Pressing(load) => return Ok(Work::HalfSpacePressed(surface, load)),
        Motion::Sliding(load) => load,
    };
    if !has_force(problem) && load.sliding_distance().is_none() {
        require(
            is_stationary,
            "at a depth it marches over a distance; give solve.sliding_distance",
        )?;
        require(
            !flows(problem),
            "a half space that flows sinks for ever, so that a depth belongs to a distance; give solve.sliding_distance",
        )?;
    }
    Ok(match is_stationary {
        true => Work::HalfSpaceSteady(surface, load),
        false => Work::HalfSpaceTransient(surface, load),
    })
}

fn line_steady<'a>(
    problem: &Problem,
    body: &'a Revolution,
    accuracy: Accuracy,
) -> Result<Work<'a>, Refusal> {
    let Motion::Sliding(load) = problem.motion else {
        return Err(NOTHING_SLIDES);
    };
    require(load.sliding_distance().is_none(), STATIONARY)?;
    match accuracy {
        Accuracy::Elements(_) => {
            Err("it chooses its polynomials itself; give relative_error instead of elements")
        }
        Accuracy::RelativeError(error) => Ok(Work::LineSteady(body, load, error)),
    }
}

fn line_transient<'a>(problem: &Problem, body: &'a Revolution) -> Result<Work<'a>, Refusal> {
    match problem.motion {
        Motion::Sliding(load) => {
            require(has_force(problem), UNDER_FORCE)?;
            Ok(Work::LineTransient(body, load))
        }
        Motion::Pressing(load) => {
            require(
                has_force(problem),
                "it presses with a force; analytic holds a depth",
            )?;
            Ok(Work::LinePressed(body, load))
        }
    }
}

fn closed<'a>(
    problem: &Problem,
    body: &'a Revolution,
    accuracy: Accuracy,
) -> Result<ClosedForm<'a>, Refusal> {
    let Accuracy::RelativeError(asked) = accuracy else {
        return Err(NO_ELEMENTS);
    };
    match (problem.motion, &problem.simple, problem.model) {
        (Motion::Pressing(load), _, _) => Ok(ClosedForm::Pressed(body, load)),
        (Motion::Sliding(load), Some(Simple::Elastic), _) => Ok(ClosedForm::Elastic(body, load)),
        (Motion::Sliding(load), _, Model::HalfSpace) => {
            closed_half_space(problem, body, load, asked)
        }
        (Motion::Sliding(load), _, Model::Line) => closed_line(problem, body, load),
    }
}

fn closed_line<'a>(
    problem: &Problem,
    body: &'a Revolution,
    load: SlidingLoad,
) -> Result<ClosedForm<'a>, Refusal> {
    let cone_or_paraboloid = match body {
        Revolution::Power(profile) if [1.0, 2.0].contains(&profile.exponent()) => Some(profile),
        _ => None,
    };
    match (&problem.simple, load.sliding_distance()) {
        (Some(Simple::Viscous(material)), None) => {
            Ok(ClosedForm::ViscousLine(body, *material, load))
        }
        (Some(Simple::Viscous(material)), Some(distance)) => {
            let profile = cone_or_paraboloid.ok_or(
                "only of cone and paraboloid the state before the stationary one has a closed form",
            )?;
            require(
                has_force(problem),
                "the state before the stationary one has a closed form under a force only",
            )?;
            Ok(ClosedForm::ViscousTransient(
                profile, *material, load, distance,
            ))
        }
        (_, Some(_)) => Err(VISCOUS_ONLY),
        (Some(Simple::KelvinVoigt(material)), None) => {
            let profile = cone_or_paraboloid.ok_or(ANOTHER_BODY)?;
            Ok(ClosedForm::KelvinVoigtLine(profile, *material, load))
        }
        (Some(Simple::Maxwell(material)), None) => {
            let profile = cone_or_paraboloid.ok_or(ANOTHER_BODY)?;
            Ok(ClosedForm::MaxwellLine(profile, *material, load))
        }
        _ => Err(ANOTHER_BODY),
    }
}

fn closed_half_space<'a>(
    problem: &Problem,
    body: &'a Revolution,
    load: SlidingLoad,
    asked: f64,
) -> Result<ClosedForm<'a>, Refusal> {
    let (Revolution::Power(profile), Some(Simple::Viscous(material))) = (body, &problem.simple)
    else {
        return Err("on the half space the friction of powers on a viscous material is tabulated");
    };
    let tabulated = scaling_factor(profile.exponent()).map(|s| s.error / s.value);
    require(
        tabulated.is_ok_and(|error| error <= asked),
        "the table of s(p) does not know this exponent to the relative error",
    )?;
    require(load.sliding_distance().is_none(), STATIONARY)?;
    require(has_force(problem), UNDER_FORCE)?;
    Ok(ClosedForm::HalfSpacePower(profile, *material, load))
}
