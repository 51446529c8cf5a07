//! Solutions of the one-dimensional model (method of dimensionality reduction) as answers.

use indenters::{
    Axisymmetric, EquivalentLine, EquivalentProfile, HistoryPoint, Moved, MovedPoint, SlidingLoad,
};
use mdr_core::{
    CurvePoint, HistoryOptions, MdrError, Sliding, SlidingStep, SteadySliding, indent_along, steady,
};
use numerics::{ErrorParts, Estimate};
use rheology::Material;

use super::answer::{Answer, ContactBox, HistoryRow};
use super::curve::{AREA, Curve, CurveColumn, DEPTH, FORCE, OfPoint, POSITION, RADIUS, TANGENTIAL};
use super::error::Result;
use super::problem::Problem;
use crate::scene::{Method, Model};

/// Stationary sliding in the one-dimensional model, to a relative error of the friction.
pub(crate) fn stationary(
    body: &dyn Axisymmetric,
    material: &dyn Material,
    load: &SlidingLoad,
    relative_error: f64,
) -> Result<Answer> {
    let line = EquivalentLine(body);
    Ok(answer_from_steady(steady(
        &line,
        material,
        load,
        relative_error,
    )?))
}

/// Converts a stationary solution, with its load per length as a field. The error is that of the discretisation only.
pub(crate) fn answer_from_steady(state: SteadySliding) -> Answer {
    let mut answer = Answer {
        friction_coefficient: Some(state.friction_coefficient),
        indentation_depth: Some(state.indentation_depth),
        error_parts: ErrorParts::discretisation_only(state.friction_coefficient.error),
        contact_box: Some(contact_box(state.ends)),
        unknowns: state.n_pieces,
        ..Answer::new(Method::MdrSteady, Model::Line, state.normal_force)
    };
    answer.fields.line_load = state.load;
    answer
}

/// Converts a time march: quantities of its end, and its steps as a history.
pub(crate) fn answer_from_march(state: Sliding) -> Answer {
    let mut answer = Answer {
        friction_coefficient: Some(state.friction_coefficient),
        indentation_depth: Some(state.indentation_depth),
        error_parts: state.error_parts,
        contact_box: Some(contact_box(state.ends)),
        unknowns: state.steps.last().map_or(0, |step| step.n_contact),
        iterations: state.steps.len(),
        ..Answer::new(Method::MdrTransient, Model::Line, state.normal_force)
    };
    let row = |step: &SlidingStep| HistoryRow {
        sliding_distance_m: step.sliding_distance,
        time_s: step.time,
        indentation_depth_m: step.indentation_depth,
        friction_coefficient: step.friction_coefficient,
        area_over_force: None,
    };
    answer.fields.history = state.steps.iter().map(row).collect();
    answer.fields.line_load = state.load;
    answer
}

/// The answer of a motion: friction over all of it; force, depth and area at its last point.
pub(crate) fn answer_from_motion(method: Method, model: Model, found: Moved) -> Answer {
    let last = found.points.last();
    let force = last.map_or(Estimate::exact(0.0), |point| point.normal_force);
    let mut answer = Answer {
        friction_coefficient: Some(found.friction_coefficient),
        peak_friction: Some(found.peak_friction),
        dissipated_energy: found.dissipated_energy,
        indentation_depth: last.map(|point| point.indentation_depth),
        contact_area: last.and_then(|point| point.contact_area),
        error_parts: found.error_parts,
        contact_box: found.ends.map(contact_box),
        unknowns: found.steps.last().map_or(0, |step| step.n_contact),
        iterations: found.steps.len() * found.n_cycles.max(1),
        ..Answer::new(method, model, force)
    };
    let columns: [OfPoint<MovedPoint>; 4] = [
        (POSITION, |point| Estimate::exact(point.position)),
        (TANGENTIAL, |point| point.tangential_force),
        (FORCE, |point| point.normal_force),
        (DEPTH, |point| point.indentation_depth),
    ];
    answer.fields.curve = Curve::of(&found.points, |point| point.time, columns);
    let areas: Option<Vec<Estimate>> =
        (found.points.iter().map(|point| point.contact_area)).collect();
    let area = |values| CurveColumn { name: AREA, values };
    answer.fields.curve.columns.extend(areas.map(area));
    answer.fields.motion_steps = found
        .steps
        .iter()
        .map(|step| [step.time, step.position, step.tangential_force])
        .collect();
    answer
}

/// The answer of an indentation without sliding.
pub(crate) fn answer_from_press(state: &SteadySliding) -> Answer {
    let error = state.indentation_depth.error.max(state.normal_force.error);
    Answer {
        indentation_depth: Some(state.indentation_depth),
        error_parts: ErrorParts::discretisation_only(error),
        contact_box: Some(contact_box(state.ends)),
        unknowns: state.n_pieces,
        ..Answer::new(Method::MdrTransient, Model::Line, state.normal_force)
    }
}

/// Indentation along a history of loading and unloading; the answer is its last point.
pub(crate) fn followed(
    problem: &Problem,
    body: &dyn EquivalentProfile,
    points: &[HistoryPoint],
    method: Method,
    relative_error: f64,
) -> Result<Answer> {
    let options = history_options(problem, relative_error);
    let curve = indent_along(body, problem.material(), points, &options)?;
    let found = answer_from_curve(problem, method, &curve);
    Ok(found.ok_or(MdrError::Empty { list: "history" })?)
}

/// The answer of a history; `None` if it has no points.
pub(crate) fn answer_from_curve(
    problem: &Problem,
    method: Method,
    curve: &[CurvePoint],
) -> Option<Answer> {
    let last = curve.last()?;
    let radius = last.contact_radius;
    let ends = Estimate::new(-radius.value, radius.error);
    let touches = radius.value > 0.0;
    let mut answer = Answer {
        indentation_depth: Some(last.indentation_depth),
        contact_box: touches.then(|| contact_box([ends, radius])),
        iterations: curve.len(),
        ..Answer::new(method, problem.model(), last.normal_force)
    };
    answer.fields.curve = curve_of(curve);
    Some(answer)
}

/// Force, depth and contact radius at the points of a history.
pub(super) fn curve_of(points: &[CurvePoint]) -> Curve {
    let columns: [OfPoint<CurvePoint>; 3] = [
        (FORCE, |point| point.normal_force),
        (DEPTH, |point| point.indentation_depth),
        (RADIUS, |point| point.contact_radius),
    ];
    Curve::of(points, |point| point.time, columns)
}

/// Options of an indentation history: the relative error requested, and the error of the moduli of the problem.
pub(super) fn history_options(problem: &Problem, relative_error: f64) -> HistoryOptions {
    HistoryOptions {
        relative_error,
        modulus_error: problem.modulus_error(),
    }
}

/// The contact interval between two ends; its error is the larger one.
fn contact_box([rear, front]: [Estimate; 2]) -> ContactBox {
    ContactBox::along([rear.value, front.value], rear.error.max(front.error))
}
