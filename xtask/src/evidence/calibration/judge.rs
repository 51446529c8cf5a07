//! The bars of one scene beside its deviations.

use std::cell::LazyCell;

use anyhow::{Result, anyhow};
use serde::Serialize;
use viscofriction::Estimate;
use viscofriction::scene::{Method, Model};

use super::reference::{SHARP, closed_form, is_numerical, numerical};
use super::scene::{Label, Scene};
use crate::evidence::request::{Reference, Request, presses};

/// A scene, and one bar.
pub(super) type Row = (Label, Bar);

/// One bar; all errors are absolute.
#[derive(Debug, Clone, Serialize)]
pub(super) struct Bar {
    /// What the table calls the method.
    pub(super) method: String,
    /// Unit of `asked`.
    asked_kind: &'static str,
    asked: f64,
    value: f64,
    pub(super) error_bar: f64,
    pub(super) reference: f64,
    reference_error: f64,
    reference_source: String,
    pub(super) deviation: f64,
    /// Whether the deviation is within the bar and the error of the reference.
    pub(super) holds: bool,
    /// Whether it is within the bar alone.
    pub(super) holds_alone: bool,
    #[serde(skip)]
    pub(super) solver: Method,
}

impl Bar {
    /// Whether the reference is much more exact than the bar says of the result.
    pub(super) fn is_sharply_judged(&self) -> bool {
        self.reference_error <= SHARP * self.error_bar
    }

    /// Deviation over bar; a bar of zero holds for a deviation of zero only.
    pub(super) fn part_of_bar(&self) -> f64 {
        if self.deviation > 0.0 {
            self.deviation / self.error_bar
        } else {
            0.0
        }
    }
}

/// A result or a reference that could not be computed.
pub(super) type Refusal = (Label, Reason);

/// By what method, and why it could not.
#[derive(Debug, Clone, Default, Serialize)]
pub(super) struct Reason {
    pub(super) method: String,
    reason: String,
}

/// What comes of a request.
pub(super) type Verdict = (Label, Result<Bar, Reason>);

/// Solves a scene by every method that can.
pub(super) fn judge(scene: &Scene, requests: &[Request]) -> Result<Vec<Verdict>> {
    let mut verdicts = Vec::new();
    for of_model in requests.chunk_by(|one, other| one.model == other.model) {
        let mut solved = Vec::new();
        for request in of_model {
            // A model may also find that it cannot take what is given.
            if request.is_offered(&scene.file).unwrap_or(false) {
                let answer = request.solve(&scene.file);
                solved.push((request, answer.map(|answer| answer.requested_quantity())));
            }
        }
        let known = solved
            .iter()
            .filter(|(request, _)| request.method != Method::Analytic);
        let bars = known.filter_map(|(_, known)| Some(relative(known.as_ref().ok()?)));
        let least = bars.fold(f64::INFINITY, f64::min);
        let shared = LazyCell::new(|| numerical(scene, of_model[0].model, least));
        for (request, known) in solved {
            let bar = known.and_then(|known| bar(scene, request, known, &shared));
            let bar = bar.map_err(|error| Reason {
                method: name(request, scene),
                reason: format!("{error:#}"),
            });
            verdicts.extend(bar.transpose().map(|bar| (scene.label.clone(), bar)));
        }
    }
    Ok(verdicts)
}

fn relative(known: &Estimate) -> f64 {
    known.error / known.value.abs()
}

/// One bar, if there is anything to compare it with.
fn bar(
    scene: &Scene,
    request: &Request,
    got: Estimate,
    shared: &Result<Reference>,
) -> Result<Option<Bar>> {
    let own = closed_form(scene, request, relative(&got))?;
    let reference = match (&own, shared) {
        (Some(own), _) => own,
        (None, _) if !is_numerical(scene, request) => return Ok(None),
        (None, Ok(shared)) => shared,
        (None, Err(error)) => return Err(anyhow!("no reference: {error:#}")),
    };
    let expected = reference.known;
    let deviation = (got.value - expected.value).abs();
    Ok(Some(Bar {
        method: name(request, scene),
        asked_kind: request.kind(),
        asked: request.number(),
        value: got.value,
        error_bar: got.error,
        reference: expected.value,
        reference_error: expected.error,
        reference_source: reference.source.clone(),
        deviation,
        holds: deviation <= got.error + expected.error,
        holds_alone: deviation <= got.error,
        solver: request.method,
    }))
}

/// What the table of the results calls a method.
fn name(request: &Request, scene: &Scene) -> String {
    let is_on_half_space = request.model == Model::HalfSpace;
    let group = match request.method {
        _ if presses(&scene.file) && scene.is_at_depth() => ", pressed to a depth",
        _ if presses(&scene.file) => ", pressed",
        _ if !is_on_half_space => "",
        _ if scene.is_rough() => ", rough",
        _ if scene.is_cylinder() => ", cylinder",
        _ if scene.is_flat() => ", flat end",
        _ if scene.is_at_depth() => ", depth",
        Method::Analytic => ", half space",
        _ => "",
    };
    let resolution = if request.is_by_elements() {
        ", elements"
    } else {
        ""
    };
    format!("{}{group}{resolution}", request.method.name())
}
