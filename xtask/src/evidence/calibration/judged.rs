//! The bars of one scene beside its deviations.

use crate::random::Random;
use anyhow::{Result, anyhow};
use serde::Serialize;

use super::draw::{Scene, scene};
use super::reference::{Reference, judged, question, reference};
use super::ways::{Extent, Way, Ways, ways};
use crate::run::{choose, solve};
use crate::scene_file::{Accuracy, Method, Model};

/// One bar; all errors are absolute.
#[derive(Debug, Clone, Serialize)]
pub(super) struct Row {
    pub(super) scene: usize,
    pub(super) indenter: String,
    pub(super) material: String,
    pub(super) load: String,
    pub(super) method: String,
    /// What `asked` counts.
    pub(super) asked_kind: &'static str,
    pub(super) asked: f64,
    pub(super) value: f64,
    pub(super) error_bar: f64,
    pub(super) reference: f64,
    pub(super) reference_error: f64,
    pub(super) reference_source: String,
    pub(super) deviation: f64,
    /// Whether the deviation is within the bar and the error of the reference.
    pub(super) holds: bool,
    /// Whether it is within the bar alone.
    pub(super) holds_alone: bool,
    #[serde(skip)]
    pub(super) solver: Method,
}

impl Row {
    /// Whether the reference is much more exact than the bar says of the answer.
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

/// An answer or a reference that did not come.
#[derive(Debug, Clone, Serialize)]
pub(super) struct Refusal {
    pub(super) scene: usize,
    pub(super) indenter: String,
    pub(super) material: String,
    pub(super) load: String,
    pub(super) method: String,
    pub(super) reason: String,
}

/// What comes of one scene.
#[derive(Debug, Default)]
pub(super) struct Judged {
    pub(super) rows: Vec<Row>,
    pub(super) refusals: Vec<Refusal>,
    /// Reasons for what is not asked.
    pub(super) left_out: Vec<&'static str>,
}

/// A scene with all that is asked about it.
#[derive(Debug)]
pub(super) struct Examination {
    scene: Scene,
    ways: Ways,
}

const MODELS: [Model; 2] = [Model::Line, Model::HalfSpace];

impl Examination {
    /// The scene with this number, drawn after the one before.
    pub(super) fn new(random: &mut Random, number: usize, extent: &Extent) -> Result<Self> {
        let scene = scene(number, random)?;
        let ways = ways(random, &scene, extent);
        Ok(Self { scene, ways })
    }

    /// Asks every method that offers an answer.
    pub(super) fn judge(&self) -> Result<Judged> {
        let mut judged = Judged {
            left_out: self.ways.left_out.clone(),
            ..Judged::default()
        };
        // Closed forms are compared with no other closed form.
        for (model, closed) in MODELS.into_iter().flat_map(|m| [(m, true), (m, false)]) {
            let ways = self.offered((model, closed))?;
            if ways.is_empty() {
                continue;
            }
            let reference = reference(&self.scene, (model, closed), self.least_error(model));
            let Some(reference) = reference.transpose() else {
                continue;
            };
            for way in ways {
                let row = match &reference {
                    Ok(reference) => self.row(way, reference),
                    Err(error) => Err(anyhow!("no reference: {error:#}")),
                };
                match row {
                    Ok(row) => judged.rows.push(row),
                    Err(error) => judged.refusals.push(self.refusal(way, &error)),
                }
            }
        }
        Ok(judged)
    }

    fn offered(&self, (model, closed): (Model, bool)) -> Result<Vec<&Way>> {
        let mut offered = Vec::new();
        for way in &self.ways.asked {
            let is_meant = way.model == model && (way.method == Method::Analytic) == closed;
            if is_meant && choose(&question(&self.scene, way)?).is_ok() {
                offered.push(way);
            }
        }
        Ok(offered)
    }

    /// The smallest relative error that any method of the model is asked for.
    fn least_error(&self, model: Model) -> f64 {
        let asked = self.ways.asked.iter().filter(|way| way.model == model);
        let errors = asked.filter_map(|way| match way.accuracy {
            Accuracy::RelativeError(error) => Some(error),
            Accuracy::Elements(_) => None,
        });
        errors.fold(1e-2, f64::min)
    }

    fn row(&self, way: &Way, reference: &Reference) -> Result<Row> {
        let scene = &self.scene;
        let [value, error_bar] = judged(scene, &solve(&question(scene, way)?)?)?;
        let deviation = (value - reference.value).abs();
        let (asked_kind, asked) = match way.accuracy {
            Accuracy::RelativeError(error) => ("relative error", error),
            Accuracy::Elements(elements) => ("elements", elements as f64),
        };
        Ok(Row {
            scene: scene.number,
            indenter: scene.indenter.clone(),
            material: scene.material.clone(),
            load: scene.load.clone(),
            method: way.name(scene),
            asked_kind,
            asked,
            value,
            error_bar,
            reference: reference.value,
            reference_error: reference.error,
            reference_source: reference.source.clone(),
            deviation,
            holds: deviation <= error_bar + reference.error,
            holds_alone: deviation <= error_bar,
            solver: way.method,
        })
    }

    fn refusal(&self, way: &Way, error: &anyhow::Error) -> Refusal {
        let scene = &self.scene;
        Refusal {
            scene: scene.number,
            indenter: scene.indenter.clone(),
            material: scene.material.clone(),
            load: scene.load.clone(),
            method: way.name(scene),
            reason: format!("{error:#}"),
        }
    }
}
