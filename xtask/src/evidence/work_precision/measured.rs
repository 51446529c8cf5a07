//! Error and time of every run.

use serde::Serialize;

use super::asked::FRICTION;
use super::series::{Attempt, Outcome, Refusal, Resolution, Series, Solver};
use crate::meter::{Cost, measure, measure_median};
use crate::scene_file::Method;

/// Errors up to this come from rounding in long sums, and follow no power.
const ROUNDING: f64 = 1e-12;

/// How often a run is timed.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Timing {
    /// Once, which is no more than a hint.
    Once,
    /// The median of several.
    Median,
}

/// One run.
#[derive(Debug, Clone, Serialize)]
pub(super) struct Row {
    pub(super) scene: &'static str,
    pub(super) model: &'static str,
    pub(super) quantity: &'static str,
    pub(super) method: String,
    /// What `resolution` counts.
    pub(super) resolution_kind: &'static str,
    pub(super) resolution: Option<f64>,
    pub(super) unknowns: usize,
    /// Relative; of a field in the mean square.
    pub(super) error: f64,
    /// Relative error that the method claims.
    pub(super) error_bar: Option<f64>,
    pub(super) reference: String,
    /// Relative; a smaller error cannot be told from it.
    pub(super) reference_error: f64,
    /// Time on the wall.
    pub(super) seconds: f64,
    pub(super) processor_seconds: f64,
    /// Falls with refinement.
    #[serde(skip)]
    pub(super) fineness: Option<f64>,
    #[serde(skip)]
    pub(super) solver: Solver,
}

impl Row {
    /// Whether the error comes from the resolution, and not from rounding or from the reference.
    pub(super) fn is_resolved(&self) -> bool {
        self.error > self.reference_error.max(ROUNDING)
    }

    /// The error, or that of the reference where it cannot be told from it.
    pub(super) fn visible_error(&self) -> f64 {
        self.error.max(self.reference_error)
    }

    /// Whether the scene slides, so that line and half space differ.
    pub(super) fn slides(&self) -> bool {
        self.quantity == FRICTION
    }
}

/// Times all runs of a series; the refused ones come second.
pub(super) fn rows(
    series: &Series,
    timing: Timing,
    advance: &dyn Fn(),
) -> (Vec<Row>, Vec<Refusal>) {
    let (mut rows, mut refusals) = (Vec::new(), Vec::new());
    for attempt in &series.attempts {
        let timed = match timing {
            Timing::Once => {
                let (outcome, cost) = measure(&attempt.solve);
                outcome.map(|outcome| (outcome, cost))
            }
            Timing::Median => measure_median(&attempt.solve),
        };
        match timed {
            Ok((outcome, cost)) => rows.push(row(series, attempt.resolution, (&outcome, cost))),
            Err(error) => refusals.push(refusal(series, attempt, &error)),
        }
        advance();
    }
    (rows, refusals)
}

fn refusal(series: &Series, attempt: &Attempt, error: &anyhow::Error) -> Refusal {
    let resolution = attempt.resolution;
    let number = resolution
        .number()
        .map_or_else(String::new, |number| format!(" {number}"));
    Refusal {
        scene: series.scene,
        what: format!("{}, {}{number}", name(series), resolution.kind()),
        reason: format!("{error:#}"),
    }
}

/// The stationary half space may be asked for an error or given its elements.
fn name(series: &Series) -> String {
    let coarsest = series.attempts.first().map(|attempt| attempt.resolution);
    match (series.solver, coarsest) {
        (Solver::Contact, _) => "bem contact".to_owned(),
        (Solver::Of(Method::BemSteady), Some(Resolution::Elements(_))) => {
            format!("{}, elements", Method::BemSteady.name())
        }
        (Solver::Of(method), _) => method.name().to_owned(),
    }
}

fn row(series: &Series, resolution: Resolution, (outcome, cost): (&Outcome, Cost)) -> Row {
    let reference = &series.reference;
    Row {
        scene: series.scene,
        model: series.model.name(),
        quantity: series.quantity,
        method: name(series),
        resolution_kind: resolution.kind(),
        resolution: resolution.number(),
        unknowns: outcome.unknowns,
        error: deviation(&outcome.values, &reference.values),
        error_bar: outcome.error_bar,
        reference: reference.source.clone(),
        reference_error: reference.error,
        seconds: cost.seconds,
        processor_seconds: cost.processor_seconds,
        fineness: resolution.fineness(),
        solver: series.solver,
    }
}

/// Relative difference in the mean square.
fn deviation(actual: &[f64], expected: &[f64]) -> f64 {
    let pairs = actual.iter().zip(expected);
    let difference: f64 = pairs.map(|(a, b)| (a - b).powi(2)).sum();
    (difference / expected.iter().map(|b| b.powi(2)).sum::<f64>()).sqrt()
}
