//! Sliding on the half space: stationary on any material, from first touch on a viscous one.

use anyhow::Result;
use bem_halfspace::slide::{SlideOptions, SlideRow, Transient, slide};
use bem_halfspace::steady::{
    FrictionOptions, Ladder, SinkingDepth, SteadyOptions, SteadySliding, steady, steady_friction,
};
use bem_halfspace::{ContactOptions, Footprint};
use friction_analytic::stationary_depth;
use indenters::{SlidingLoad, contact_radius};
use rheology::{Material, Viscous};

use super::answer::{Answer, ContactBox, Grid, HistoryRow};
use super::body::Revolution;
use super::resolution::{Resolved, resolve};
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
            let Resolved { value, error, .. } = resolve(accuracy, usize::MAX, solve, |state| {
                state.friction_coefficient
            })?;
            (value.friction_coefficient, error, value)
        }
    };
    let depth = depth_after(&state.depth, distance).transpose();
    let answer = Answer::new(Method::BemSteady, Model::HalfSpace, load.normal_force())
        .with_friction(friction, error);
    Ok(with_state(answer, state, depth?))
}

fn with_state(answer: Answer, state: SteadySliding, depth: Option<f64>) -> Answer {
    let mut answer = Answer {
        indentation_depth: depth,
        contact_area: Some(state.contact_area),
        contact_box: Some(ContactBox::around(state.contact_x, state.contact_y)),
        unknowns: state.unknowns,
        iterations: state.iterations,
        grid: Some(Grid {
            spacing: state.pressure.grid.spacing()[0],
            factorised: state.is_factorised(),
        }),
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

fn on_grid(
    body: &Revolution,
    (material, load): (&dyn Material, &SlidingLoad),
    spacing: f64,
) -> Result<SteadySliding> {
    let options = grid_options(body, (material, load), spacing)?;
    Ok(steady(body, material, load, &options)?)
}

/// Elements half as wide as long.
pub(super) fn grid_options(
    body: &Revolution,
    (material, load): (&dyn Material, &SlidingLoad),
    spacing: f64,
) -> Result<SteadyOptions> {
    let Footprint { x, y } = Ladder::of_body(body, material, load)?.footprint;
    let widened = |[first, last]: [f64; 2]| [first - 2.0 * spacing, last + 2.0 * spacing];
    Ok(SteadyOptions {
        spacing: [spacing, 0.5 * spacing],
        phase: [0.0, 0.0],
        footprint: Footprint {
            x: widened(x),
            y: widened(y),
        },
        tolerance: TOLERANCE,
        max_iterations: MAX_ITERATIONS,
    })
}

/// Square elements, over a distance or so far that the state counts as stationary.
pub(super) fn march_options(
    body: &Revolution,
    (material, load): (&Viscous, &SlidingLoad),
    spacing: f64,
    distance: Option<f64>,
) -> Result<SlideOptions> {
    let length = line_length(body, material, load)?;
    Ok(SlideOptions {
        spacing: [spacing; 2],
        footprint: Footprint::of_body(body, material, load)?,
        sliding_distance: distance.unwrap_or(LENGTHS * length),
        contact: ContactOptions::default(),
    })
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
        let spacing = length / elements as f64;
        let options = march_options(body, (material, load), spacing, distance)?;
        let transient = slide(body, material, load, &options)?;
        let friction = friction(&transient, distance)?;
        Ok((friction, transient))
    };
    let Resolved { value, error, .. } =
        resolve(accuracy, LARGEST_GRID, solve, |([friction, _], _)| {
            *friction
        })?;
    let ([friction, distance_error], transient) = value;
    let answer = Answer::new(Method::BemTransient, Model::HalfSpace, load.normal_force())
        .with_friction(friction, error + distance_error);
    // Without a distance the depth has no meaning: it never stops to grow.
    let depth = distance.map(|_| transient.last().indentation_depth);
    Ok(with_transient(answer, transient, depth))
}

/// The friction coefficient after a distance, or that of the stationary state and what the finite distance leaves open.
fn friction(transient: &Transient, distance: Option<f64>) -> Result<[f64; 2]> {
    if distance.is_some() {
        return Ok([transient.last().friction_coefficient, 0.0]);
    }
    let state = transient.stationary(DRIFT)?;
    Ok([state.friction_coefficient, state.distance_error])
}

fn with_transient(answer: Answer, transient: Transient, depth: Option<f64>) -> Answer {
    let last = transient.last();
    let mut answer = Answer {
        indentation_depth: depth,
        contact_area: Some(last.contact_area),
        contact_box: Some(ContactBox::around(last.contact_x, last.contact_y)),
        unknowns: last.n_contact,
        iterations: transient.rows.len(),
        grid: Some(Grid {
            spacing: transient.pressure.grid.spacing()[0],
            factorised: false,
        }),
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
