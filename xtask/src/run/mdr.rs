//! Sliding on the one-dimensional model.

use anyhow::Result;
use indenters::{Axisymmetric, EquivalentLine, SlidingLoad};
use mdr_core::{
    MdrError, SlideOptions, SlideRow, SlidingDepth, SteadyOptions, slide, steady, steady_at_depth,
};
use rheology::Material;

use super::answer::{Answer, ContactBox, HistoryRow};
use super::body::Revolution;
use super::resolution::{Goal, Quantity, Resolved, order_of_apex, resolve};
use crate::scene_file::{Accuracy, Control, Method, Model};

/// Elements along the contact after which a march in time gives up.
const LARGEST_CHAIN: usize = 4096;
/// Relative rounding of the stationary state; on a sphere of 46 times the contact 5e-12 was measured.
const STEADY_ROUNDING: f64 = 1e-11;
/// Rounding of forces times slopes, relative to the mean slope.
const ROUNDING: f64 = 1e-12;
/// Measured on paraboloids is 2.4.
const LAYER: f64 = 4.0;

/// The stationary state.
pub(super) fn stationary(
    body: &Revolution,
    material: &dyn Material,
    (control, velocity): (Control, f64),
    relative_error: f64,
) -> Result<Answer> {
    let options = SteadyOptions { relative_error };
    let line = EquivalentLine(body);
    let state = match control {
        Control::NormalForce(force) => steady(
            &line,
            material,
            &SlidingLoad::new(force, velocity)?,
            &options,
        ),
        Control::IndentationDepth(indentation_depth) => {
            let motion = SlidingDepth {
                indentation_depth,
                velocity,
            };
            steady_at_depth(&line, material, &motion, &options)
        }
    }?;
    let ends = state.contacts.first().zip(state.contacts.last());
    Ok(Answer {
        indentation_depth: Some(state.indentation_depth),
        contact_box: ends.map(|(first, last)| ContactBox::along([first[0], last[1]])),
        unknowns: state.n_pieces,
        left_out: vec!["elements", "time steps", "half space"],
        ..Answer::new(Method::MdrSteady, Model::Line, state.normal_force).with_friction(
            state.friction_coefficient,
            state.friction_coefficient_error + STEADY_ROUNDING * state.friction_coefficient.abs(),
        )
    })
}

/// A march to its end.
struct March {
    rows: Vec<SlideRow>,
    friction: Quantity,
}

/// From first touch to the stationary state, or over a distance.
pub(super) fn transient(
    body: &Revolution,
    material: &dyn Material,
    (load, distance): (&SlidingLoad, Option<f64>),
    accuracy: Accuracy,
) -> Result<Answer> {
    let solve = |elements: usize| march(body, material, (load, distance), elements);
    let goal = Goal {
        accuracy,
        largest: LARGEST_CHAIN,
        order: order_of_apex(body.apex_exponent()),
    };
    let Resolved {
        value: March { rows, friction },
        error: [error],
        ..
    } = resolve(&goal, solve, |march| [march.friction])?;
    let last = last(&rows)?;
    let mut answer = Answer {
        indentation_depth: Some(last.indentation_depth),
        contact_box: Some(ContactBox::along(last.contact)),
        unknowns: last.n_contact,
        iterations: rows.len(),
        left_out: vec!["half space"],
        ..Answer::new(Method::MdrTransient, Model::Line, load.normal_force())
            .with_friction(friction.value, error)
    };
    answer.fields.history = rows.iter().map(history).collect();
    Ok(answer)
}

fn march(
    body: &Revolution,
    material: &dyn Material,
    (load, distance): (&SlidingLoad, Option<f64>),
    elements: usize,
) -> Result<March> {
    let mut options = SlideOptions::with_elements(elements, body, material, load)?;
    if let Some(distance) = distance {
        let steps = (distance / options.spacing).ceil().max(1.0);
        options.spacing = distance / steps;
        // Half a step more than the last step, so that rounding does not lose it.
        options.max_sliding_distance = distance + 0.5 * options.spacing;
    }
    let rows = match slide(&EquivalentLine(body), material, load, &options) {
        Ok(transient) => transient.rows,
        Err(MdrError::NotStationary { rows, .. }) if distance.is_some() => rows,
        Err(error) => return Err(error.into()),
    };
    let last = last(&rows)?;
    let value = friction_at_end(&rows, distance.is_some());
    let layers = unresolved_layers(body, material, load.velocity(), (last, options.spacing))?;
    let friction = Quantity {
        value,
        rounding: ROUNDING * (last.indentation_depth / last.contact_length),
        hidden: layers * value.abs(),
    };
    Ok(March { rows, friction })
}

fn last(rows: &[SlideRow]) -> Result<&SlideRow> {
    rows.last()
        .ok_or_else(|| anyhow::anyhow!("the march made no step"))
}

/// Relative error of the friction that comes from relaxation within the first element of the contact.
///
/// At the front the load of a branch rises over the distance v τ_k. A chain with longer elements takes the branch for a
/// dashpot, whose load is there at once, whatever their number: three resolutions agree and all are wrong. The layer has
/// the share of the branch in the dissipation, times its length over that of the contact, times the square of the slope
/// at the front over its mean.
fn unresolved_layers(
    body: &Revolution,
    material: &dyn Material,
    velocity: f64,
    (last, spacing): (&SlideRow, f64),
) -> Result<f64> {
    let frequency = velocity / last.contact_length;
    let whole = material.loss_modulus(frequency)?;
    let relaxation = material.relaxation();
    let unresolved = relaxation.branches().iter().filter(|branch| {
        let layer = velocity * branch.relaxation_time;
        layer < spacing
    });
    let layers = unresolved.map(|branch| {
        let turned = frequency * branch.relaxation_time;
        let loss = branch.modulus * turned / (1.0 + turned * turned);
        loss / whole * turned
    });
    let front = last.contact[1];
    // p of a power that is as steep at the front.
    let exponent = front * body.line_slope(front) / body.line_height(front);
    let steepness = (2.0 * exponent - 1.0).max(1.0);
    Ok(LAYER * steepness * layers.sum::<f64>())
}

/// The friction of a step belongs to its middle; on the way to the stationary state the end is half a step further.
fn friction_at_end(rows: &[SlideRow], on_the_way: bool) -> f64 {
    match rows {
        [.., before, last] if on_the_way => {
            1.5 * last.friction_coefficient - 0.5 * before.friction_coefficient
        }
        [.., last] => last.friction_coefficient,
        [] => 0.0,
    }
}

fn history(row: &SlideRow) -> HistoryRow {
    HistoryRow {
        sliding_distance_m: row.sliding_distance,
        time_s: row.time,
        indentation_depth_m: row.indentation_depth,
        friction_coefficient: row.friction_coefficient,
    }
}
