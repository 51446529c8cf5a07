//! What is measured: runs of one method on one scene that differ in their resolution only.

use anyhow::Result;
use casebook::deviation;
use serde::Serialize;
use viscofriction::scene::{Method, Model, Scene};

use crate::evidence::request::{Reference, Request, first_reached, presses};
use crate::meter::{measure, measure_median};

/// Name of the quantity that is compared in a scene that slides.
const FRICTION: &str = "friction coefficient";
/// Name of the quantity that is compared in a scene that is only pressed.
pub(super) const DEPTH: &str = "indentation depth";
/// Relative errors requested of references in the one-dimensional model that have no closed form; the first that is reached is
/// taken.
const LINE_REFERENCE: [f64; 2] = [1e-12, 1e-11];
/// Relative errors requested of references on the half space; the first that is reached is taken. Chosen.
const HALF_SPACE_REFERENCE: [f64; 3] = [2e-5, 5e-5, 1e-4];
/// Relative error assumed of closed forms. Chosen: a few roundings of f64.
const CLOSED_ROUNDING: f64 = 1e-15;
/// Relative error up to which no order of convergence is fitted, because smaller ones come from rounding in long sums and follow
/// no power law. Chosen.
const MIN_FITTED_ERROR: f64 = 1e-12;

/// The result of a run; errors are relative.
pub(super) struct Found {
    /// Deviation from the reference; of a field in the mean square.
    pub(super) error: f64,
    /// The error bar of the method, if it has one.
    pub(super) error_bar: Option<f64>,
    /// Unknown pressures, elements or polynomials; none in a closed form.
    pub(super) unknowns: usize,
}

/// One run; a row of `work_precision.csv`. Errors are relative.
#[derive(Debug, Clone, Default, Serialize)]
pub(super) struct Row {
    pub(super) scene: String,
    pub(super) model: &'static str,
    pub(super) quantity: &'static str,
    pub(super) method: String,
    /// What `resolution` is a number of.
    pub(super) resolution_kind: &'static str,
    pub(super) resolution: Option<f64>,
    pub(super) unknowns: usize,
    pub(super) error: f64,
    pub(super) error_bar: Option<f64>,
    pub(super) reference: String,
    /// Relative error of the reference; smaller errors are not resolved.
    pub(super) reference_error: f64,
    pub(super) seconds: f64,
    pub(super) processor_seconds: f64,
    /// `None` for the half space at one instant, on a given grid.
    #[serde(skip)]
    pub(super) solver: Option<Method>,
}

impl Row {
    /// The row of a contact at one instant on the half space, everything else empty.
    pub(super) fn of_one_instant() -> Self {
        let (model, method) = (Model::HalfSpace.name(), "bem contact".to_owned());
        Self {
            model,
            method,
            ..Self::default()
        }
    }

    /// The row of a request, without its results.
    fn of_request(request: &Request, name: &str, scene: &Scene, reference: &Reference) -> Self {
        let is_closed = request.method == Method::Analytic;
        // The stationary half space may be asked for an error or given its elements.
        let both = request.method == Method::BemSteady && request.is_by_elements();
        let kind = if both { ", elements" } else { "" };
        let (asked, number) = request.asked();
        Self {
            scene: name.to_owned(),
            model: request.model.name(),
            quantity: if presses(scene) { DEPTH } else { FRICTION },
            method: format!("{}{kind}", request.method.name()),
            resolution_kind: if is_closed { "closed form" } else { asked },
            resolution: (!is_closed).then_some(number),
            reference: reference.source.clone(),
            reference_error: reference.known.relative_error(),
            solver: Some(request.method),
            ..Self::default()
        }
    }

    /// Whether the error comes from the resolution, and not from rounding or from the reference.
    pub(super) fn is_resolved(&self) -> bool {
        self.error > self.reference_error.max(MIN_FITTED_ERROR)
    }

    /// The error, or that of the reference if that is larger.
    pub(super) fn visible_error(&self) -> f64 {
        self.error.max(self.reference_error)
    }

    /// Whether the scene slides, so that line and half space differ.
    pub(super) fn slides(&self) -> bool {
        self.quantity == FRICTION
    }

    /// Whether another run has the same scene, model and method, and differs in its resolution only.
    pub(super) fn is_of_series(&self, other: &Self) -> bool {
        let key = |row: &Self| (row.scene.clone(), row.model, row.method.clone());
        key(self) == key(other)
    }

    /// A measure h of the resolution, to which errors are related as h^q: 1/elements, or the tolerance.
    ///
    /// `None` where a relative error is requested, because the error that is reached may be far smaller.
    pub(super) fn fineness(&self) -> Option<f64> {
        match self.resolution_kind {
            "elements" => Some(1.0 / self.resolution?),
            "tolerance" => self.resolution,
            _ => None,
        }
    }
}

/// What was measured, one series after the other, from coarse to fine.
#[derive(Debug, Default)]
pub(super) struct Measured {
    /// Whether each run is timed once, which gives a rough time only, instead of by the median of several.
    pub(super) is_once: bool,
    pub(super) rows: Vec<Row>,
    /// One line for each run and each reference that could not be computed.
    pub(super) refused: String,
}

impl Measured {
    /// Times `solve` and adds `run`, a row without results, with what it gave; an error is added to [`Self::refused`].
    pub(super) fn add(&mut self, run: Row, solve: impl Fn() -> Result<Found>) {
        let timed = if self.is_once {
            let (found, cost) = measure(&solve);
            found.map(|found| (found, cost))
        } else {
            measure_median(&solve)
        };
        match timed {
            Ok((found, cost)) => self.rows.push(Row {
                unknowns: found.unknowns,
                error: found.error,
                error_bar: found.error_bar,
                seconds: cost.seconds,
                processor_seconds: cost.processor_seconds,
                ..run
            }),
            Err(error) => {
                let number = run.resolution.unwrap_or_default();
                let (scene, method, kind) = (run.scene, run.method, run.resolution_kind);
                self.refuse(&format!("{scene}, {method}, {kind} {number}"), &error);
            }
        }
    }

    /// Adds a line to [`Self::refused`].
    fn refuse(&mut self, what: &str, error: &anyhow::Error) {
        self.refused += &format!("\nrefused: {what}: {error:#}");
    }

    /// Times what is asked of a scene; a model whose reference is not reached is refused.
    pub(super) fn add_scene(&mut self, name: &str, scene: &Scene, asked: &[Request]) -> Result<()> {
        for of_model in asked.chunk_by(|one, other| one.model == other.model) {
            let reference = match reference(scene, &of_model[0]) {
                Ok(reference) => reference,
                Err(error) => {
                    let model = of_model[0].model.name();
                    self.refuse(&format!("{name}, reference of the {model}"), &error);
                    continue;
                }
            };
            for request in of_model {
                if request.is_offered(scene)? {
                    let run = Row::of_request(request, name, scene, &reference);
                    self.add(run, || found(request, scene, &reference));
                }
            }
        }
        Ok(())
    }
}

/// The closed form; without one the stationary solver of the model with a far smaller error.
///
/// On the half space the table of s(p) is no closed form: it is measured too.
fn reference(scene: &Scene, closed_form: &Request) -> Result<Reference> {
    let model = closed_form.model;
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

/// Solves a scene as requested: the deviation of the requested quantity from the reference, and its error bar, both relative.
fn found(request: &Request, scene: &Scene, reference: &Reference) -> Result<Found> {
    let answer = request.solve(scene)?;
    let known = answer.requested_quantity();
    Ok(Found {
        error: deviation(&[known.value], &[reference.known.value]),
        error_bar: Some(known.relative_error()),
        unknowns: answer.unknowns,
    })
}
