//! What boundary elements say, as answers.

use bem_halfspace::indent::{self, PressEstimate};
use bem_halfspace::slide::{SlideRow, slide};
use bem_halfspace::steady::{steady, steady_line};
use indenters::{Cylinder, PressingLoad, SlidingLoad, Surface};
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
    let finest = estimate.finest;
    let mut answer = Answer {
        friction_coefficient: Some(estimate.friction_coefficient),
        indentation_depth: estimate.indentation_depth,
        error_parts: estimate.error_parts,
        contact_area: Some(estimate.contact_area),
        peak_pressure: estimate.peak_pressure,
        contact_box: Some(ContactBox::around(
            finest.contact_x,
            finest.contact_y,
            estimate.contact_box_error,
        )),
        unknowns: finest.unknowns,
        iterations: finest.iterations,
        grid: Some(Grid::Stationary {
            options: estimate.options,
            factorised: finest.is_factorised(),
        }),
        ..Answer::new(Method::BemSteady, Model::HalfSpace, estimate.normal_force)
    };
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
    let finest = estimate.finest;
    let force = load.require_normal_force()?;
    let mut answer = Answer {
        is_per_length: true,
        friction_coefficient: Some(estimate.friction_coefficient),
        error_parts: estimate.error_parts,
        contact_area: Some(estimate.contact_width),
        peak_pressure: estimate.peak_pressure,
        contact_box: Some(ContactBox::along(finest.contact, estimate.contact_error)),
        unknowns: finest.unknowns,
        iterations: finest.iterations,
        ..Answer::new(Method::BemSteady, Model::HalfSpace, Estimate::exact(force))
    };
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
    let finest = estimate.finest;
    let last = finest.last();
    let mut answer = Answer {
        friction_coefficient: Some(estimate.friction_coefficient),
        indentation_depth: estimate.indentation_depth,
        error_parts: estimate.error_parts,
        contact_area: Some(estimate.contact_area),
        peak_pressure: estimate.peak_pressure,
        contact_box: Some(ContactBox::around(
            last.contact_x,
            last.contact_y,
            estimate.contact_box_error,
        )),
        unknowns: last.n_contact,
        iterations: finest.rows.len(),
        grid: Some(Grid::March(estimate.options)),
        ..Answer::new(
            Method::BemTransient,
            Model::HalfSpace,
            estimate.normal_force,
        )
    };
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
        indentation_depth,
        normal_force,
        error_parts,
        contact_area,
        peak_pressure,
        contact_box_error,
        finest,
        options,
    } = indent::indent(surface, material, load, accuracy)?;
    let mut answer = Answer {
        indentation_depth: Some(indentation_depth),
        error_parts,
        contact_area: Some(contact_area),
        peak_pressure,
        contact_box: Some(ContactBox::around(
            finest.contact_x,
            finest.contact_y,
            contact_box_error,
        )),
        unknowns: finest.n_contact,
        iterations: 1,
        grid: Some(Grid::March(options)),
        ..Answer::new(Method::BemTransient, Model::HalfSpace, normal_force)
    };
    answer.fields.pressure = finest.pressure;
    Ok(answer)
}

fn history_row(row: &SlideRow) -> HistoryRow {
    HistoryRow {
        sliding_distance_m: row.sliding_distance,
        time_s: row.time,
        indentation_depth_m: row.indentation_depth,
        friction_coefficient: row.friction_coefficient,
    }
}
