//! The bars of one scene beside its deviations.

use anyhow::{Result, anyhow};
use serde::Serialize;
use viscofriction::scene::{Method, Model};

use super::reference::reference;
use super::scenes::{Label, Scene};
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

/// Errors of references are at most this part of the bars that they judge sharply.
const SHARP: f64 = 1.0 / 3.0;

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
        let errors = of_model.iter().filter(|request| !request.is_by_elements());
        let least = errors.map(Request::number).fold(1e-2, f64::min);
        let mut offered = Vec::new();
        for request in of_model {
            if request.is_offered(&scene.file)? {
                offered.push(request);
            }
        }
        let is_closed = |request: &Request| request.method == Method::Analytic;
        for alike in offered.chunk_by(|one, other| is_closed(one) == is_closed(other)) {
            if let Some(reference) = reference(scene, alike[0], least).transpose() {
                let verdict = |request: &&_| {
                    let bar = judged(scene, request, &reference);
                    (scene.label.clone(), bar)
                };
                verdicts.extend(alike.iter().map(verdict));
            }
        }
    }
    Ok(verdicts)
}

fn judged(scene: &Scene, request: &Request, reference: &Result<Reference>) -> Result<Bar, Reason> {
    let bar = match reference {
        Ok(reference) => bar(scene, request, reference),
        Err(error) => Err(anyhow!("no reference: {error:#}")),
    };
    bar.map_err(|error| Reason {
        method: name(request, scene),
        reason: format!("{error:#}"),
    })
}

fn bar(scene: &Scene, request: &Request, reference: &Reference) -> Result<Bar> {
    let (got, expected) = (request.solve(&scene.file)?.asked(), reference.known);
    let deviation = (got.value - expected.value).abs();
    Ok(Bar {
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
    })
}

/// What the table of the results calls a method.
fn name(request: &Request, scene: &Scene) -> String {
    let motion = match (request.method, request.model) {
        _ if presses(&scene.file) => ", pressed",
        (Method::Analytic, Model::HalfSpace) => ", half space",
        _ => "",
    };
    let resolution = if request.is_by_elements() {
        ", elements"
    } else {
        ""
    };
    format!("{}{motion}{resolution}", request.method.name())
}
