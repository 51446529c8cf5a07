//! What is measured: series of runs of one method on one scene that differ in their resolution only.

use std::sync::Arc;

use anyhow::Result;
use casebook::deviation;
use numerics::Estimate;
use serde::Serialize;
use viscofriction::scene::{self, Method, Model};

use super::scenes::{Scene, requests};
use crate::evidence::request::{Reference, Request, first_reached, presses};
use crate::meter::{Cost, measure, measure_median};

/// What is compared where something slides, and where nothing does.
pub(super) const FRICTION: &str = "friction coefficient";
pub(super) const DEPTH: &str = "indentation depth";
/// Relative errors of references without closed form; the first that is reached is taken.
const LINE_REFERENCE: [f64; 2] = [1e-12, 1e-11];
const HALF_SPACE_REFERENCE: [f64; 3] = [2e-5, 5e-5, 1e-4];
/// Rounding of closed forms.
const CLOSED_ROUNDING: f64 = 1e-15;
/// Errors up to this come from rounding in long sums, and follow no power.
const ROUNDING: f64 = 1e-12;

/// Runs of one method on one scene, from coarse to fine.
pub(super) struct Series {
    pub(super) scene: &'static str,
    pub(super) model: Model,
    pub(super) quantity: &'static str,
    /// None for the half space at one instant, on a given grid.
    pub(super) method: Option<Method>,
    pub(super) reference: String,
    /// Relative; a smaller error cannot be told from it.
    pub(super) reference_error: f64,
    pub(super) runs: Vec<Run>,
}

/// One run, to be timed.
pub(super) struct Run {
    /// What the resolution is a number of, and the number, if there is anything to choose.
    pub(super) kind: &'static str,
    pub(super) resolution: Option<f64>,
    pub(super) solve: Box<dyn Fn() -> Result<Found> + Send + Sync>,
}

/// What a run finds; errors are relative.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Found {
    /// Deviation from the reference; of a field in the mean square.
    pub(super) error: f64,
    /// What the method claims.
    pub(super) error_bar: Option<f64>,
    /// Unknown pressures, elements or polynomials; none in a closed form.
    pub(super) unknowns: usize,
}

/// One run in the table.
#[derive(Debug, Clone, Serialize)]
pub(super) struct Row {
    pub(super) scene: &'static str,
    pub(super) model: &'static str,
    pub(super) quantity: &'static str,
    pub(super) method: String,
    /// What `resolution` is a number of.
    pub(super) resolution_kind: &'static str,
    pub(super) resolution: Option<f64>,
    pub(super) unknowns: usize,
    pub(super) error: f64,
    error_bar: Option<f64>,
    reference: String,
    pub(super) reference_error: f64,
    seconds: f64,
    pub(super) processor_seconds: f64,
    #[serde(skip)]
    pub(super) solver: Option<Method>,
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

    /// A number that falls with refinement, and that errors follow like a power.
    ///
    /// The relative error that is asked for is none: what is reached may be far smaller.
    pub(super) fn fineness(&self) -> Option<f64> {
        match self.resolution_kind {
            "elements" => Some(1.0 / self.resolution?),
            "tolerance" => self.resolution,
            _ => None,
        }
    }
}

/// The series of a scene, each with at most `runs` runs; a model whose reference is not reached is refused.
pub(super) fn series_of(
    scene: &Scene,
    runs: usize,
    refused: &mut Vec<String>,
) -> Result<Vec<Series>> {
    let mut file: scene::Scene = scene.text.parse()?;
    file.load.velocity = scene.velocity.unwrap_or(file.load.velocity);
    let file = Arc::new(file);
    let mut planned = Vec::new();
    for (model, methods) in requests(presses(&file)) {
        let reference = match reference(&file, model, &methods[0][0]) {
            Ok(reference) => reference,
            Err(error) => {
                let (name, model) = (scene.name, model.name());
                refused.push(format!(
                    "\nrefused: {name}, reference of the {model}: {error:#}"
                ));
                continue;
            }
        };
        for mut requests in methods {
            requests.truncate(runs);
            if requests[0].is_offered(&file)? {
                planned.push(series(scene.name, &file, &requests, &reference));
            }
        }
    }
    Ok(planned)
}

/// The closed form; without one the stationary solver of the model with a far smaller error.
///
/// On the half space the table of s(p) is no closed form: it is measured too.
fn reference(scene: &scene::Scene, model: Model, closed_form: &Request) -> Result<Reference> {
    let may_be_closed = model == Model::Line || presses(scene);
    if may_be_closed && closed_form.is_offered(scene)? {
        return closed_form.reference(scene, CLOSED_ROUNDING);
    }
    let errors = match model {
        Model::Line => &LINE_REFERENCE[..],
        Model::HalfSpace => &HALF_SPACE_REFERENCE,
    };
    first_reached(scene, model, errors)
}

fn series(
    name: &'static str,
    scene: &Arc<scene::Scene>,
    requests: &[Request],
    reference: &Reference,
) -> Series {
    let expected = reference.known;
    let run = |request: &Request| {
        let (request, scene) = (*request, Arc::clone(scene));
        let kind = match request.method {
            Method::Analytic => "closed form",
            _ => request.kind(),
        };
        Run {
            kind,
            resolution: (request.method != Method::Analytic).then(|| request.number()),
            solve: Box::new(move || {
                let solved = request.solve(&scene)?;
                let Estimate { value, error } = solved.known;
                Ok(Found {
                    error: deviation(&[value], &[expected.value]),
                    error_bar: Some(error / value.abs()),
                    unknowns: solved.unknowns,
                })
            }),
        }
    };
    Series {
        scene: name,
        model: requests[0].model,
        quantity: if presses(scene) { DEPTH } else { FRICTION },
        method: Some(requests[0].method),
        reference: reference.source.clone(),
        reference_error: expected.error / expected.value.abs(),
        runs: requests.iter().map(run).collect(),
    }
}

impl Series {
    /// Times all runs, each by the median of several or, for no more than a hint, once.
    pub(super) fn measure(&self, once: bool, refused: &mut Vec<String>) -> Vec<Row> {
        let mut measured = Vec::new();
        for run in &self.runs {
            let timed = if once {
                let (found, cost) = measure(&run.solve);
                found.map(|found| (found, cost))
            } else {
                measure_median(&run.solve)
            };
            match timed {
                Ok((found, cost)) => measured.push(self.row(run, found, cost)),
                Err(error) => {
                    let number = run.resolution.unwrap_or_default();
                    let what = format!("{}, {}, {} {number}", self.scene, self.name(), run.kind);
                    refused.push(format!("\nrefused: {what}: {error:#}"));
                }
            }
        }
        measured
    }

    fn row(&self, run: &Run, found: Found, cost: Cost) -> Row {
        Row {
            scene: self.scene,
            model: self.model.name(),
            quantity: self.quantity,
            method: self.name(),
            resolution_kind: run.kind,
            resolution: run.resolution,
            unknowns: found.unknowns,
            error: found.error,
            error_bar: found.error_bar,
            reference: self.reference.clone(),
            reference_error: self.reference_error,
            seconds: cost.seconds,
            processor_seconds: cost.processor_seconds,
            solver: self.method,
        }
    }

    /// The stationary half space may be asked for an error or given its elements.
    fn name(&self) -> String {
        match self.method {
            None => "bem contact".to_owned(),
            Some(Method::BemSteady) if self.runs[0].kind == "elements" => {
                format!("{}, elements", Method::BemSteady.name())
            }
            Some(method) => method.name().to_owned(),
        }
    }
}
