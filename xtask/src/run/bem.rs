//! Sliding on the half space: stationary on any material, from first touch on a viscous one.

use anyhow::Result;
use bem_halfspace::slide::{SlideOptions, SlideRow, Transient, slide};
use bem_halfspace::steady::{
    FrictionOptions, Ladder, SinkingDepth, SteadyOptions, SteadySliding, steady, steady_friction,
};
use bem_halfspace::{ContactOptions, Footprint};
use friction_analytic::stationary_depth;
use indenters::{Axisymmetric, SlidingLoad, contact_radius};
use rheology::{Material, Viscous};

use super::answer::{Answer, ContactBox, HistoryRow};
use super::body::Revolution;
use super::resolution::{Goal, Quantity, Resolved, order_of_apex, resolve};
use crate::scene_file::{Accuracy, Method, Model};

/// Elements of the coarsest grids of a ladder along the contact length of the one-dimensional model.
const COARSEST_ELEMENTS: f64 = 5.0;
/// Elements along the contact after which a march in time gives up; it takes about a minute.
const LARGEST_GRID: usize = 32;
/// Contact lengths of the one-dimensional model until the state counts as stationary.
const LENGTHS: f64 = 24.0;
const DRIFT: f64 = 0.05;
const TOLERANCE: f64 = 1e-9;
const MAX_ITERATIONS: usize = 500;

/// The stationary state, to an error or on a grid.
pub(super) fn stationary(
    body: &Revolution,
    (material, load): (&dyn Material, &SlidingLoad),
    accuracy: Accuracy,
    distance: Option<f64>,
) -> Result<Answer> {
    let (friction, error, state) = match accuracy {
        Accuracy::RelativeError(relative_error) => {
            let options = FrictionOptions {
                relative_error,
                ..FrictionOptions::default()
            };
            let estimate = steady_friction(body, material, load, &options)?;
            let spacing = estimate.refinements.last().map(|last| last.spacing);
            let spacing = spacing.ok_or_else(|| anyhow::anyhow!("no grid was refined"))?;
            let state = on_grid(body, (material, load), spacing)?;
            (estimate.friction_coefficient, estimate.error, state)
        }
        Accuracy::Elements(_) => {
            let ladder = Ladder::of_body(body, material, load)?;
            let length = COARSEST_ELEMENTS * ladder.coarsest_spacing;
            let solve = |elements: usize| on_grid(body, (material, load), length / elements as f64);
            let goal = Goal {
                accuracy,
                largest: usize::MAX,
                order: order_of_apex(body.apex_exponent()),
            };
            let Resolved { value, error, .. } = resolve(&goal, solve, friction_on_grid)?;
            (value.friction_coefficient, error, value)
        }
    };
    let depth = depth_after(&state.depth, distance).transpose();
    let answer = Answer::new(Method::BemSteady, Model::HalfSpace, load.normal_force())
        .with_friction(friction, error);
    Ok(with_state(answer, state, depth?))
}

/// The gaps that the solver leaves change it like rounding.
fn friction_on_grid(state: &SteadySliding) -> Quantity {
    Quantity {
        value: state.friction_coefficient,
        rounding: state.residual * state.mean_slope,
        hidden: 0.0,
    }
}

fn with_state(answer: Answer, state: SteadySliding, depth: Option<f64>) -> Answer {
    let mut answer = Answer {
        indentation_depth: depth,
        contact_area: Some(state.contact_area),
        contact_box: Some(ContactBox::around(state.contact_x, state.contact_y)),
        unknowns: state.unknowns,
        iterations: state.iterations,
        left_out: vec!["time steps", "free surface", "mirror half"],
        ..answer
    };
    answer.fields.pressure = Some(state.pressure);
    answer
}

/// A solid has a depth of its own; one that flows has a depth after a distance only.
fn depth_after(depth: &SinkingDepth, distance: Option<f64>) -> Option<Result<f64>> {
    if depth.depth_per_e_fold == 0.0 {
        return Some(Ok(depth.reference_depth));
    }
    distance.map(|distance| Ok(depth.after(distance)?))
}

fn line_length(body: &Revolution, material: &Viscous, load: &SlidingLoad) -> Result<f64> {
    Ok(contact_radius(body, stationary_depth(material, load))?)
}

/// Elements half as wide as long.
fn on_grid(
    body: &Revolution,
    (material, load): (&dyn Material, &SlidingLoad),
    spacing: f64,
) -> Result<SteadySliding> {
    let Footprint { x, y } = Ladder::of_body(body, material, load)?.footprint;
    let widened = |[first, last]: [f64; 2]| [first - 2.0 * spacing, last + 2.0 * spacing];
    let options = SteadyOptions {
        spacing: [spacing, 0.5 * spacing],
        phase: [0.0, 0.0],
        footprint: Footprint {
            x: widened(x),
            y: widened(y),
        },
        tolerance: TOLERANCE,
        max_iterations: MAX_ITERATIONS,
    };
    Ok(steady(body, material, load, &options)?)
}

/// From first touch to the stationary state, or over a distance.
pub(super) fn transient(
    body: &Revolution,
    (material, load): (&Viscous, &SlidingLoad),
    accuracy: Accuracy,
    distance: Option<f64>,
) -> Result<Answer> {
    let length = line_length(body, material, load)?;
    let solve = |elements: usize| {
        let options = SlideOptions {
            spacing: [length / elements as f64; 2],
            footprint: Footprint::of_body(body, material, load)?,
            sliding_distance: distance.unwrap_or(LENGTHS * length),
            contact: ContactOptions::default(),
        };
        let transient = slide(body, material, load, &options)?;
        let friction = friction(&transient, distance)?;
        Ok((friction, transient))
    };
    let goal = Goal {
        accuracy,
        largest: LARGEST_GRID,
        order: order_of_apex(body.apex_exponent()),
    };
    let Resolved { value, error, .. } = resolve(&goal, solve, |(friction, _)| *friction)?;
    let (friction, transient) = value;
    let answer = Answer::new(Method::BemTransient, Model::HalfSpace, load.normal_force())
        .with_friction(friction.value, error);
    // Without a distance the depth has no meaning: it never stops to grow.
    let depth = distance.map(|_| transient.last().indentation_depth);
    Ok(with_transient(answer, transient, depth))
}

/// The friction coefficient after a distance, or that of the stationary state and what the finite distance leaves open.
fn friction(transient: &Transient, distance: Option<f64>) -> Result<Quantity> {
    let (value, hidden) = if distance.is_some() {
        (transient.last().friction_coefficient, 0.0)
    } else {
        let state = transient.stationary(DRIFT)?;
        (state.friction_coefficient, state.distance_error)
    };
    Ok(Quantity {
        value,
        rounding: 0.0,
        hidden,
    })
}

fn with_transient(answer: Answer, transient: Transient, depth: Option<f64>) -> Answer {
    let last = transient.last();
    let mut answer = Answer {
        indentation_depth: depth,
        contact_area: Some(last.contact_area),
        contact_box: Some(ContactBox::around(last.contact_x, last.contact_y)),
        unknowns: last.n_contact,
        iterations: transient.rows.len(),
        left_out: vec!["history outside the contact box"],
        ..answer
    };
    answer.fields.history = transient.rows.iter().map(history).collect();
    answer.fields.pressure = Some(transient.pressure);
    answer
}

fn history(row: &SlideRow) -> HistoryRow {
    HistoryRow {
        sliding_distance_m: row.sliding_distance,
        time_s: row.time,
        indentation_depth_m: row.indentation_depth,
        friction_coefficient: row.friction_coefficient,
    }
}
