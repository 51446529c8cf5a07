//! The computation of each method for a problem, or the reason why the method does not answer it.

use bem_halfspace::{
    PeriodicLoad, SteadyBody, indent, indent_along, move_along, periodic, slide, steady,
};
use friction_analytic::{kelvin_voigt_sliding, maxwell_sliding, scaling_factor};
use indenters::rough::PeriodicSurface;
use indenters::{
    Axisymmetric, Cylinder, EquivalentLine, HistoryPoint, MovingLoad, SlidingLoad, Surface,
};
use numerics::{Progress, Request};

use super::analytic::{cylinder_pressed, without_friction};
use super::answer::Answer;
use super::body::Body;
use super::elements::Rough;
use super::error::{Refusal, Result};
use super::half_space::Simple;
use super::problem::Motion::{History, Moving, Pressing, Sliding};
use super::problem::Problem;
use super::{analytic, elements, layer, mdr};
use crate::scene::Method::{self, Analytic, BemSteady, BemTransient, MdrSteady, MdrTransient};
use crate::scene::Revolution;
use crate::scene::{Accuracy, Control, Model};

/// The deferred computation of one method for a problem: a function that reports to a progress and returns the answer.
pub(crate) type Work<'a> = Box<dyn FnOnce(&dyn Progress) -> Result<Answer> + Send + 'a>;
/// The deferred computation of a method for a problem, or the reason why the method cannot answer it.
pub(crate) type WorkOrRefusal<'a> = Result<Work<'a>, Refusal>;

/// Refusal of a closed form for which the scene gives a number of elements.
const NO_ELEMENTS: Refusal = "closed forms have no elements; give relative_error instead";
/// Refusal of a method for the half space if the scene has a layer.
const NO_LAYER: Refusal = "it knows no layer; boundary elements do";
/// Refusal of a history on a layer.
const ONCE: Refusal = "on a layer it follows a contact that grows once and shrinks once, up to a hundred thicknesses wide and not to the \
     edge of the body; bem-transient follows any";
/// Refusal of a history of an unbounded body.
const HISTORY_WITHOUT_END: Refusal = "it follows a history of a body that ends, and a cylinder or a periodic surface does not; hold a force, or a mean \
     pressure, for solve.duration";
/// Refusal of a motion of a cylinder.
const MOTION_OF_CYLINDER: Refusal = "it follows the motion of a body that ends or of a periodic surface, and a cylinder is neither; bem-steady \
     slides a cylinder at a constant load.velocity";
/// Refusal of a cylinder by the time march on the half space.
const PRESSED_CYLINDER: Refusal = "it takes bodies that end, and a cylinder does not; bem-steady slides it, and analytic presses it";
/// Refusal of a shear strength by a closed form that gives friction alone.
const NO_AREA: Refusal =
    "the table of s(p) does not give the contact area, on which the shear of the interface acts";
/// Refusal of heat and strain by a closed form.
const NO_PRESSURE: Refusal = "it gives no pressure on elements, from which heat and strain of the contact follow; bem-steady does";
/// Refusal of sliding at a given depth.
const UNDER_FORCE: Refusal = "it slides under a force, not at a depth";
/// Refusal of a material with a range of valid frequencies.
const NO_SHARE: Refusal =
    "it does not say which part of the friction comes from outside of valid_frequencies";
/// Refusal of a duration or a sliding distance.
const STATIONARY: Refusal =
    "it answers the stationary state, without duration and sliding_distance";
/// Refusal of sliding with a flat punch.
const NO_FRONT: Refusal = "a flat punch does not rise in front of its contact: its slope is 0 in the contact and infinite at its \
     edge, so that its friction would be that of the edge alone; a flat-cone or a truncated-paraboloid has a flat end and a front";
/// Refusal of a motion that is not of constant speed.
const ONLY_STEADY: Refusal =
    "it knows no motion but that of constant speed; mdr-transient and bem-transient follow any";
/// Refusal of an approximating series in a motion or on a track.
const NO_BAR: Refusal = "the series that stands for the material has no error bar in a motion or on a track; give a material with finitely many branches";
/// Refusal of a reciprocating motion on a material that flows.
const NO_CYCLE: Refusal = "a material that flows gives way further in every cycle, and none is like the one before; give it an equilibrium modulus";
/// Refusal of an ensemble in a motion.
const ONE_SURFACE: Refusal =
    "realisations are for sliding and pressing; a motion has one surface, with a seed of its own";
/// Refusal of a method whose body never comes back to the same place, if the scene has a track.
const NO_TRACK: Refusal =
    "it knows no track on which the body comes back; mdr-steady and bem-steady do";
/// Refusal of a load without sliding at constant speed.
const NOTHING_SLIDES: Refusal =
    "nothing slides, and without sliding there is no stationary state to solve for";

/// The deferred computation of `method` for a problem, or the reason why the method cannot answer it. The method or model that the problem
/// names plays no part.
pub(super) fn work_of_method(problem: &Problem, method: Method) -> WorkOrRefusal<'_> {
    let accuracy = problem.solver_accuracy();
    let is_history = matches!(problem.motion(), History { .. });
    let has_layers =
        matches!(method, BemSteady | BemTransient) || (is_history && method == Analytic);
    require(has_layers || !problem.thickness().is_finite(), NO_LAYER)?;
    if let History { points, .. } = problem.motion() {
        return followed(problem, points, method, accuracy);
    }
    if problem.track().is_some() {
        require_track(problem, method)?;
    }
    let is_elastic = problem.simple() == Some(&Simple::Elastic);
    if let Moving(load) = problem.motion() {
        require(is_elastic || has_front(problem.body()), NO_FRONT)?;
        return moved(problem, load, method, accuracy);
    }
    require(
        method != Analytic
            || (problem.heating().is_none() && problem.strain_dependence().is_none()),
        NO_PRESSURE,
    )?;
    let rises = has_front(problem.body()) || (is_elastic && method == Analytic);
    require(rises || !matches!(problem.motion(), Sliding(_)), NO_FRONT)?;
    match (problem.body(), method) {
        (Body::Cylinder(cylinder), _) => line_contact(problem, cylinder, method, accuracy),
        (Body::Revolution(body), Analytic) => closed_form(problem, body, accuracy),
        (Body::Revolution(body), MdrSteady | MdrTransient) => {
            one_dimensional_model(problem, &**body, method, accuracy)
        }
        (Body::Revolution(body), _) => boundary_elements(problem, body.surface(), method, accuracy),
        (Body::HeightMap(map), BemSteady | BemTransient) => {
            boundary_elements(problem, map, method, accuracy)
        }
        (Body::Periodic(surface), BemSteady | BemTransient) => {
            periodic_surface(problem, surface, method, accuracy)
        }
        (Body::Periodic(_), _) => Err("it has no periodic surfaces; boundary elements slide them"),
        (Body::HeightMap(_), _) => Err(
            "it needs a body of revolution, and a height map is none; boundary elements take it",
        ),
    }
}

/// Refuses a track unless a stationary method solves it on a material without expanded series.
fn require_track(problem: &Problem, method: Method) -> Result<(), Refusal> {
    require(matches!(method, MdrSteady | BemSteady), NO_TRACK)?;
    require(problem.expansion().is_none(), NO_BAR)
}

/// True if the body is higher at its edge than at its lowest point; false for a flat punch, whose slope in the contact is 0.
fn has_front(body: &Body) -> bool {
    match body {
        Body::Revolution(body) => {
            let end = body.max_radius();
            end.is_infinite() || body.profile(end).height > 0.0
        }
        _ => true,
    }
}

/// The computation `answer`, for a method that can answer the problem.
#[expect(clippy::unnecessary_wraps, reason = "the other results are refusals")]
fn ready<'a>(
    answer: impl FnOnce(&dyn Progress) -> Result<Answer> + Send + 'a,
) -> WorkOrRefusal<'a> {
    Ok(Box::new(answer))
}

/// The computation `answer` on a sequence of grids, to an `accuracy`; the progress may stop it before each grid.
fn on_grids<'a>(
    accuracy: Accuracy,
    answer: impl FnOnce(Request<'_>) -> Result<Answer> + Send + 'a,
) -> WorkOrRefusal<'a> {
    ready(move |watch| answer(Request { accuracy, watch }))
}

/// Returns the refusal unless the condition holds.
fn require(holds: bool, refusal: Refusal) -> Result<(), Refusal> {
    if holds { Ok(()) } else { Err(refusal) }
}

/// True if a single body sinks without limit under a force: the material flows and is a half space.
fn sinks(problem: &Problem) -> bool {
    problem.material().creep().fluidity() > 0.0 && !problem.thickness().is_finite()
}

/// True if the scene gives the normal force, and not the depth.
fn has_force(problem: &Problem) -> bool {
    matches!(problem.motion().control(), Control::NormalForce(_))
}

/// The computation of a method for indentation along a history, or why it cannot answer it. For a body of revolution the
/// one-dimensional model is exact on the half space, and on a layer if the contact grows once and shrinks once.
fn followed<'a>(
    problem: &'a Problem,
    points: &'a [HistoryPoint],
    method: Method,
    accuracy: Accuracy,
) -> WorkOrRefusal<'a> {
    match (method, problem.body()) {
        (MdrSteady | BemSteady, _) => Err(NOTHING_SLIDES),
        (BemTransient, body) => {
            let surface = body.surface().ok_or(HISTORY_WITHOUT_END)?;
            on_grids(accuracy, move |request| {
                let elastomer = problem.elastomer()?;
                elements::answer_from_curve(&indent_along(surface, &elastomer, points, request)?)
            })
        }
        (_, Body::Revolution(body)) => {
            let Accuracy::RelativeError(asked) = accuracy else {
                return Err(NO_ELEMENTS);
            };
            if problem.thickness().is_finite() {
                let answer = layer::followed(problem, body, points, asked)
                    .ok()
                    .flatten()
                    .ok_or(ONCE)?;
                return ready(move |_| Ok(answer));
            }
            ready(move |_| mdr::followed(problem, &&**body, points, method, asked))
        }
        _ => Err("it needs a body of revolution; bem-transient follows a history with others"),
    }
}

/// The computation of a method for a reciprocating motion or a motion through given positions, or why it cannot answer it.
fn moved<'a>(
    problem: &'a Problem,
    load: &'a MovingLoad,
    method: Method,
    accuracy: Accuracy,
) -> WorkOrRefusal<'a> {
    require(problem.expansion().is_none(), NO_BAR)?;
    let flows = problem.material().creep().fluidity() > 0.0;
    require(!(load.is_cycle() && flows), NO_CYCLE)?;
    match (method, problem.body()) {
        (Analytic | MdrSteady | BemSteady, _) => Err(ONLY_STEADY),
        (MdrTransient, Body::Revolution(body)) => {
            let material = problem.material();
            on_grids(accuracy, move |request| {
                let line = EquivalentLine(&**body);
                let found = mdr_core::move_along(&line, material, load, request)?;
                Ok(mdr::answer_from_motion(method, Model::Line, found))
            })
        }
        (MdrTransient, _) => Err(
            "it needs a body of revolution; bem-transient takes height maps and periodic surfaces too",
        ),
        (BemTransient, Body::Periodic(surface)) => {
            require(problem.realisations() == 1, ONE_SURFACE)?;
            on_grids(accuracy, move |request| {
                let found = periodic::move_along(surface, &problem.elastomer()?, load, request)?;
                elements::answer_from_moved(problem, found)
            })
        }
        (BemTransient, body) => {
            let surface = body.surface().ok_or(MOTION_OF_CYLINDER)?;
            on_grids(accuracy, move |request| {
                let found = move_along(surface, &problem.elastomer()?, load, request)?;
                elements::answer_from_moved(problem, found)
            })
        }
    }
}

/// The computation of a method for a cylinder on the half space under a given force, or why it cannot answer it.
fn line_contact<'a>(
    problem: &'a Problem,
    cylinder: &'a Cylinder,
    method: Method,
    accuracy: Accuracy,
) -> WorkOrRefusal<'a> {
    let Control::NormalForce(force) = problem.motion().control() else {
        return Err(
            "a line contact has no depth, which grows with the logarithm of the length; give load.normal_force",
        );
    };
    let is_line = method.model() == Some(Model::Line);
    let of_revolution = "it needs a body of revolution, and a cylinder is none";
    require(!is_line, of_revolution)?;
    require(
        problem.model() == Model::HalfSpace,
        "the one-dimensional model is for bodies of revolution; a cylinder is on the half space",
    )?;
    let material = problem.material();
    match (method, problem.motion()) {
        (Analytic, motion) => {
            require(matches!(accuracy, Accuracy::RelativeError(_)), NO_ELEMENTS)?;
            let pressed = move |time| cylinder_pressed(cylinder, material, force, time);
            match (motion, problem.simple()) {
                (Pressing(load), _) => ready(move |_| pressed(load.duration())),
                (_, Some(Simple::Elastic)) => ready(move |_| pressed(1.0).map(without_friction)),
                _ => Err("there is no closed form for a cylinder that slides on this material"),
            }
        }
        (BemSteady, Sliding(load)) => {
            require(
                !sinks(problem),
                "a half space that flows sinks without limit under a line contact; give the material an equilibrium modulus",
            )?;
            require(load.sliding_distance().is_none(), STATIONARY)?;
            on_grids(accuracy, move |request| {
                let body = SteadyBody::Line(cylinder);
                let found = steady(body, &problem.elastomer()?, load, request)?;
                elements::answer_from_steady(problem, found)
            })
        }
        (BemSteady, _) => Err(NOTHING_SLIDES),
        _ => Err(PRESSED_CYLINDER),
    }
}

/// A periodic surface with its mean pressure, velocity and distance; a refusal at a given depth, and of sliding over a material
/// that flows.
pub(super) fn rough<'a>(
    problem: &Problem,
    surface: &'a PeriodicSurface,
) -> Result<Rough<'a>, Refusal> {
    let Control::NormalForce(force) = problem.motion().control() else {
        return Err("a periodic surface is pressed by a mean pressure");
    };
    let velocity = match problem.motion() {
        Sliding(load) => load.velocity(),
        _ => 0.0,
    };
    require(
        velocity == 0.0 || problem.material().creep().fluidity() <= 0.0,
        "a half space that flows creeps without limit under waves with crests along the motion; give the material an equilibrium modulus",
    )?;
    let area: f64 = surface.period().iter().product();
    let mean_pressure = force / area;
    let wrong = |_| "the mean pressure must be finite and greater than 0";
    let load = match problem.motion() {
        Pressing(load) => PeriodicLoad::pressed(mean_pressure, load.duration()),
        _ => PeriodicLoad::new(mean_pressure, velocity),
    };
    let mut load = load.map_err(wrong)?;
    if let Some(distance) = problem.motion().sliding_distance() {
        load = load.after(distance).map_err(wrong)?;
    }
    Ok(Rough {
        surface,
        load,
        mean_pressure,
    })
}

/// The computation for a periodic surface by boundary elements, stationary or in time, or a refusal of other methods.
fn periodic_surface<'a>(
    problem: &'a Problem,
    surface: &'a PeriodicSurface,
    method: Method,
    accuracy: Accuracy,
) -> WorkOrRefusal<'a> {
    let rough = rough(problem, surface)?;
    match (method, problem.motion()) {
        (BemTransient, Pressing(_)) => on_grids(accuracy, move |request| {
            elements::periodic(problem, rough, request)
        }),
        (_, Pressing(_) | History { .. } | Moving(_)) => Err(NOTHING_SLIDES),
        (BemSteady, Sliding(load)) => {
            require(load.sliding_distance().is_none(), STATIONARY)?;
            on_grids(accuracy, move |request| {
                elements::periodic(problem, rough, request)
            })
        }
        (_, Sliding(load)) => {
            let from_rest = "from rest it slides over a distance; give solve.sliding_distance";
            require(load.sliding_distance().is_some(), from_rest)?;
            on_grids(accuracy, move |request| {
                let elastomer = problem.elastomer()?;
                let found = periodic::slide(surface, &elastomer, &rough.load, request)?;
                Ok(elements::answer_from_periodic_transient(
                    problem, rough, found,
                ))
            })
        }
    }
}

/// The computation for a finite body in sliding or indentation by boundary elements, or why they cannot answer it.
fn boundary_elements<'a>(
    problem: &'a Problem,
    surface: &'a dyn Surface,
    method: Method,
    accuracy: Accuracy,
) -> WorkOrRefusal<'a> {
    let is_stationary = method == BemSteady;
    let load = match problem.motion() {
        Sliding(load) => load,
        Pressing(load) if !is_stationary => {
            return on_grids(accuracy, move |request| {
                elements::answer_from_press(indent(surface, &problem.elastomer()?, load, request)?)
            });
        }
        Pressing(_) | History { .. } | Moving(_) => return Err(NOTHING_SLIDES),
    };
    let has_distance = load.sliding_distance().is_some();
    require(!(is_stationary && has_distance), STATIONARY)?;
    if !has_force(problem) && !has_distance {
        require(
            is_stationary,
            "at a depth it marches over a distance; give solve.sliding_distance",
        )?;
        require(
            !sinks(problem),
            "a half space that flows sinks without limit, so that a depth needs a distance; give solve.sliding_distance for bem-transient",
        )?;
    }
    on_grids(accuracy, move |request| {
        let elastomer = problem.elastomer()?;
        if is_stationary {
            return elements::answer_from_steady(
                problem,
                steady(surface, &elastomer, load, request)?,
            );
        }
        elements::answer_from_slide(slide(surface, &elastomer, load, request)?)
    })
}

/// The computation for a body of revolution in the one-dimensional model: stationary sliding by polynomials, sliding in time by elements,
/// pressing in closed form; or why the method cannot answer it.
fn one_dimensional_model<'a>(
    problem: &'a Problem,
    body: &'a dyn Axisymmetric,
    method: Method,
    accuracy: Accuracy,
) -> WorkOrRefusal<'a> {
    let material = problem.material();
    match (method, problem.motion()) {
        (MdrSteady, Sliding(load)) => {
            require(load.sliding_distance().is_none(), STATIONARY)?;
            let Accuracy::RelativeError(error) = accuracy else {
                return Err(
                    "it chooses its polynomials itself; give relative_error instead of elements",
                );
            };
            ready(move |_| mdr::stationary(body, material, load, error))
        }
        (MdrSteady, Pressing(_)) | (_, History { .. } | Moving(_)) => Err(NOTHING_SLIDES),
        (_, Sliding(load)) => {
            require(has_force(problem), UNDER_FORCE)?;
            on_grids(accuracy, move |request| {
                let found = mdr_core::slide(&EquivalentLine(body), material, load, request)?;
                Ok(mdr::answer_from_march(found))
            })
        }
        (_, Pressing(load)) => {
            let Accuracy::RelativeError(error) = accuracy else {
                return Err("where nothing slides it has no elements; give relative_error instead");
            };
            ready(move |_| {
                let found = mdr_core::indent(&EquivalentLine(body), material, load, error)?;
                Ok(mdr::answer_from_press(&found))
            })
        }
    }
}

/// The computation for a body of revolution in closed form or by quadrature, or why there is none.
fn closed_form<'a>(
    problem: &'a Problem,
    body: &'a Revolution,
    accuracy: Accuracy,
) -> WorkOrRefusal<'a> {
    let Accuracy::RelativeError(asked) = accuracy else {
        return Err(NO_ELEMENTS);
    };
    let (control, material) = (problem.motion().control(), problem.material());
    let pressed = move |duration| analytic::pressed(body, material, control, duration);
    match (problem.motion(), problem.simple(), problem.model()) {
        (History { .. } | Moving(_), _, _) => Err(NOTHING_SLIDES),
        (Pressing(load), _, _) => ready(move |_| pressed(load.duration())),
        // An elastic material dissipates nothing: the pressure is even and the slope odd.
        (Sliding(_), Some(Simple::Elastic), _) => {
            ready(move |_| pressed(1.0).map(without_friction))
        }
        (Sliding(load), _, Model::HalfSpace) => closed_half_space(problem, body, load, asked),
        (Sliding(load), _, Model::Line) => {
            require(problem.window().is_none(), NO_SHARE)?;
            closed_line(problem.simple(), body, *load)
        }
    }
}

/// The closed form of stationary or transient sliding in the one-dimensional model, or a refusal. It has no field from which
/// the part of the friction outside the measured frequencies follows; the caller refuses a material with such frequencies.
pub(crate) fn closed_line<'a>(
    material: Option<&'a Simple>,
    body: &'a Revolution,
    load: SlidingLoad,
) -> WorkOrRefusal<'a> {
    let cone_or_paraboloid = match body {
        Revolution::Power(profile) if [1.0, 2.0].contains(&profile.exponent()) => Some(profile),
        _ => None,
    };
    match (material, load.sliding_distance(), cone_or_paraboloid) {
        (Some(Simple::Viscous(material)), None, _) => {
            ready(move |_| analytic::viscous_line(body, material, &load))
        }
        (Some(Simple::Viscous(material)), Some(distance), profile) => {
            let profile = profile.ok_or(
                "the state before the stationary one has a closed form for a cone and a paraboloid only",
            )?;
            require(
                matches!(load.control(), Control::NormalForce(_)),
                "the state before the stationary one has a closed form under a force only",
            )?;
            ready(move |_| analytic::viscous_transient(profile, material, &load, distance))
        }
        (_, Some(_), _) => {
            Err("the state before the stationary one has a closed form on a viscous material only")
        }
        (Some(Simple::KelvinVoigt(material)), None, Some(profile)) => ready(move |_| {
            let sliding = |contact| kelvin_voigt_sliding(profile, material, contact);
            analytic::viscoelastic_line(profile, &load, sliding)
        }),
        (Some(Simple::Maxwell(material)), None, Some(profile)) => ready(move |_| {
            let sliding = |contact| maxwell_sliding(profile, material, contact);
            analytic::viscoelastic_line(profile, &load, sliding)
        }),
        _ => Err("there is no closed form for this body on this material"),
    }
}

/// The closed form of sliding on the half space, or why there is none: powers on a viscous material, else the slow-sliding expansion.
fn closed_half_space<'a>(
    problem: &'a Problem,
    body: &'a Revolution,
    load: &'a SlidingLoad,
    asked: f64,
) -> WorkOrRefusal<'a> {
    let (Revolution::Power(profile), Some(Simple::Viscous(material))) = (body, problem.simple())
    else {
        require(load.sliding_distance().is_none(), STATIONARY)?;
        let slow = analytic::slow_half_space(body, problem.material(), load, asked).ok_or(
            "on the half space it knows the friction of powers on a viscous material, and that of smooth bodies that slide slowly over a solid; this scene is neither, or slides faster",
        )?;
        return ready(move |_| Ok(slow));
    };
    require(problem.window().is_none(), NO_SHARE)?;
    let tabulated = scaling_factor(profile.exponent()).map(|s| s.error / s.value);
    require(
        tabulated.is_ok_and(|error| error <= asked),
        "the table of s(p) does not know this exponent to the relative error",
    )?;
    require(load.sliding_distance().is_none(), STATIONARY)?;
    require(has_force(problem), UNDER_FORCE)?;
    require(problem.shear().is_none(), NO_AREA)?;
    ready(move |_| analytic::viscous_half_space(profile, material, load))
}
