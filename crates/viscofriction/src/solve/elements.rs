//! What boundary elements say, as answers.

use bem_halfspace::indent::{self, PressEstimate};
use bem_halfspace::slide::{SlideEstimate, SlideRow, slide};
use bem_halfspace::steady::{LineEstimate, SteadyEstimate, steady, steady_line};
use indenters::{Control, Cylinder, PressingLoad, SlidingLoad, Surface};
use numerics::Estimate;
use rheology::Material;

use super::answer::{Answer, ContactBox, Grid, HistoryRow};
use super::error::Result;
use crate::scene::{Accuracy, Method, Model};

/// The stationary state.
pub(crate) fn stationary(
    surface: &dyn Surface,
    material: &dyn Material,
    load: &SlidingLoad,
    accuracy: Accuracy,
) -> Result<Answer> {
    let estimate = steady(surface, material, load, accuracy)?;
    let SteadyEstimate {
        friction_coefficient: friction,
        finest,
        ..
    } = estimate;
    let mut answer = Answer {
        indentation_depth: estimate.indentation_depth.map(|depth| depth.value),
        indentation_depth_error: error_of_depth(load.control(), estimate.indentation_depth),
        contact_box: Some(ContactBox::around(finest.contact_x, finest.contact_y)),
        contact_box_error: Some(estimate.contact_box_error),
        unknowns: finest.unknowns,
        iterations: finest.iterations,
        grid: Some(Grid::Stationary {
            options: estimate.options,
            factorised: finest.is_factorised(),
        }),
        ..with_force(Method::BemSteady, load.control(), estimate.normal_force)
    }
    .with_friction(friction.value, friction.error)
    .with_parts(estimate.error_parts)
    .with_contact(estimate.contact_area, estimate.peak_pressure);
    answer.fields.pressure = Some(finest.pressure);
    Ok(answer)
}

/// The stationary state of a cylinder in plane strain.
pub(crate) fn line_contact(
    cylinder: &Cylinder,
    material: &dyn Material,
    load: &SlidingLoad,
    accuracy: Accuracy,
) -> Result<Answer> {
    let estimate = steady_line(cylinder, material, load, accuracy)?;
    let LineEstimate {
        friction_coefficient: friction,
        finest,
        ..
    } = estimate;
    let force = load.require_normal_force()?;
    let mut answer = Answer {
        is_per_length: true,
        contact_box: Some(ContactBox::along(finest.contact)),
        contact_box_error: Some(estimate.contact_error),
        unknowns: finest.unknowns,
        iterations: finest.iterations,
        ..Answer::new(Method::BemSteady, Model::HalfSpace, force)
    }
    .with_friction(friction.value, friction.error)
    .with_parts(estimate.error_parts)
    .with_contact(estimate.contact_width, estimate.peak_pressure);
    answer.fields.line_pressure = finest.pressure;
    Ok(answer)
}

/// From first touch to the stationary state, or over a distance.
pub(crate) fn transient(
    surface: &dyn Surface,
    material: &dyn Material,
    load: &SlidingLoad,
    accuracy: Accuracy,
) -> Result<Answer> {
    let estimate = slide(surface, material, load, accuracy)?;
    let SlideEstimate {
        friction_coefficient: friction,
        finest,
        ..
    } = estimate;
    let last = finest.last();
    let mut answer = Answer {
        indentation_depth: estimate.indentation_depth.map(|depth| depth.value),
        indentation_depth_error: error_of_depth(load.control(), estimate.indentation_depth),
        contact_box: Some(ContactBox::around(last.contact_x, last.contact_y)),
        contact_box_error: Some(estimate.contact_box_error),
        unknowns: last.n_contact,
        iterations: finest.rows.len(),
        grid: Some(Grid::March(estimate.options)),
        ..with_force(Method::BemTransient, load.control(), estimate.normal_force)
    }
    .with_friction(friction.value, friction.error)
    .with_parts(estimate.error_parts)
    .with_contact(estimate.contact_area, estimate.peak_pressure);
    answer.fields.history = finest.rows.iter().map(history_row).collect();
    answer.fields.pressure = Some(finest.pressure);
    Ok(answer)
}

/// Pressing without sliding.
pub(crate) fn pressed(
    surface: &dyn Surface,
    material: &dyn Material,
    load: &PressingLoad,
    accuracy: Accuracy,
) -> Result<Answer> {
    let PressEstimate {
        indentation_depth: depth,
        normal_force,
        error_parts,
        contact_area,
        peak_pressure,
        contact_box_error,
        finest,
        options,
    } = indent::indent(surface, material, load, accuracy)?;
    let mut answer = Answer {
        indentation_depth: Some(depth.value),
        indentation_depth_error: error_of_depth(load.control(), Some(depth)),
        contact_box: Some(ContactBox::around(finest.contact_x, finest.contact_y)),
        contact_box_error: Some(contact_box_error),
        unknowns: finest.n_contact,
        iterations: 1,
        grid: Some(Grid::March(options)),
        ..with_force(Method::BemTransient, load.control(), normal_force)
    }
    .with_parts(error_parts)
    .with_contact(contact_area, peak_pressure);
    answer.fields.pressure = finest.pressure;
    Ok(answer)
}

/// A force that is given has no error.
fn with_force(method: Method, control: Control, force: Estimate) -> Answer {
    let error = matches!(control, Control::IndentationDepth(_)).then_some(force.error);
    Answer {
        normal_force_error: error,
        ..Answer::new(method, Model::HalfSpace, force.value)
    }
}

/// A depth that is given has no error.
fn error_of_depth(control: Control, depth: Option<Estimate>) -> Option<f64> {
    match control {
        Control::NormalForce(_) => depth.map(|depth| depth.error),
        Control::IndentationDepth(_) => None,
    }
}

fn history_row(row: &SlideRow) -> HistoryRow {
    HistoryRow {
        sliding_distance_m: row.sliding_distance,
        time_s: row.time,
        indentation_depth_m: row.indentation_depth,
        friction_coefficient: row.friction_coefficient,
    }
}
