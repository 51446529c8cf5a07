//! Sliding on the one-dimensional model.

use anyhow::Result;
use indenters::{EquivalentLine, SlidingLoad};
use mdr_core::{
    MdrError, SlideOptions, SlideRow, SlidingDepth, SteadyOptions, slide, steady, steady_at_depth,
};
use rheology::Material;

use super::answer::{Answer, ContactBox, HistoryRow};
use super::body::Revolution;
use super::resolution::{Resolved, resolve};
use crate::scene_file::{Accuracy, Control, Method, Model};

/// Elements along the contact after which a march in time gives up.
const LARGEST_CHAIN: usize = 4096;

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
        ..Answer::new(Method::MdrSteady, Model::Line, state.normal_force)
            .with_friction(state.friction_coefficient, state.friction_coefficient_error)
    })
}

/// From first touch to the stationary state, or over a distance.
pub(super) fn transient(
    body: &Revolution,
    material: &dyn Material,
    (load, distance): (&SlidingLoad, Option<f64>),
    accuracy: Accuracy,
) -> Result<Answer> {
    let solve = |elements: usize| {
        let mut options = SlideOptions::with_elements(elements, body, material, load)?;
        if let Some(distance) = distance {
            let steps = (distance / options.spacing).ceil().max(1.0);
            options.spacing = distance / steps;
            // Half a step more than the last step, so that rounding does not lose it.
            options.max_sliding_distance = distance + 0.5 * options.spacing;
        }
        match slide(&EquivalentLine(body), material, load, &options) {
            Ok(transient) => Ok(transient.rows),
            Err(MdrError::NotStationary { rows, .. }) if distance.is_some() => Ok(rows),
            Err(error) => Err(error.into()),
        }
    };
    let friction = |rows: &Vec<SlideRow>| friction_at_end(rows, distance.is_some());
    let Resolved {
        value: rows,
        error: [error],
        ..
    } = resolve(accuracy, LARGEST_CHAIN, solve, |rows| [friction(rows)])?;
    let last = rows
        .last()
        .ok_or_else(|| anyhow::anyhow!("the march made no step"))?;
    let mut answer = Answer {
        indentation_depth: Some(last.indentation_depth),
        contact_box: Some(ContactBox::along(last.contact)),
        unknowns: last.n_contact,
        iterations: rows.len(),
        ..Answer::new(Method::MdrTransient, Model::Line, load.normal_force())
            .with_friction(friction(&rows), error)
    };
    answer.fields.history = rows.iter().map(history).collect();
    Ok(answer)
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
