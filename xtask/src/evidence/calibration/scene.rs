//! Random scenes of which a reference is known, and what is asked of them.

use std::path::Path;

use anyhow::Result;
use serde::{Deserialize, Serialize};
use toml::Value;
use viscofriction::scene::{self, Accuracy, Indenter, Method, Model};
use viscofriction::solve::Problem;

use crate::evidence::extent;
use crate::evidence::request::{Request, presses};
use crate::evidence::sample::{Source, sample};
use crate::random::Random;

pub(super) struct Scene {
    pub(super) label: Label,
    pub(super) file: scene::Scene,
}

/// Its number and its parts, which are inline tables of a scene file.
#[derive(Debug, Clone, Default, Serialize)]
pub(super) struct Label {
    scene: usize,
    indenter: String,
    material: String,
    load: String,
    solve: String,
}

/// One scene in so many slides from first touch.
const SCENES_PER_FIRST_TOUCH: usize = 6;
/// Bodies that end in a flat.
pub(super) const FLAT: &str = "flat-cone truncated-paraboloid";

impl Scene {
    /// The scene with this number, from the next numbers of the generator.
    pub(super) fn new(number: usize, random: &mut Random, memory: &str) -> Result<Self> {
        let mut source = Source::new(match number % SCENES_PER_FIRST_TOUCH {
            0 => "from-first-touch",
            _ => "calibration",
        })?;
        memory.clone_into(&mut source.range.memory);
        let mut file = sample(random, &source, Path::new(""))?.scene;
        // Both models and several errors are asked of it.
        (file.solve.model, file.solve.relative_error) = (None, None);
        let label = Label {
            scene: number,
            indenter: inline(&file.indenter)?,
            material: inline(&file.material)?,
            load: inline(&file.load)?,
            solve: inline(&file.solve)?,
        };
        Ok(Self { label, file })
    }

    /// Whether its body or its material is one of those between blanks.
    pub(super) fn is(&self, kinds: &str) -> bool {
        let own = [self.file.indenter.key(), self.file.material.key()];
        let is_own = |kind: &str| own.iter().any(|key| key.split('.').nth(1) == Some(kind));
        kinds.split(' ').any(is_own)
    }

    pub(super) const fn is_at_depth(&self) -> bool {
        self.file.load.indentation_depth.is_some()
    }

    pub(super) fn is_stationary(&self) -> bool {
        !presses(&self.file) && self.file.solve.sliding_distance.is_none()
    }

    /// Whether a dashpot carries a part of the load.
    fn has_dashpot(&self) -> bool {
        let problem = Problem::try_from(&self.file);
        problem.is_ok_and(|problem| problem.material().relaxation().viscosity() > 0.0)
    }

    /// Whether the equivalent line is infinitely steep somewhere.
    fn is_sharp(&self) -> bool {
        let has_cusp = match &self.file.indenter {
            Indenter::Power { exponent, .. } => *exponent < 1.0,
            Indenter::Superposition { terms } => terms.iter().any(|term| term.exponent < 1.0),
            _ => false,
        };
        has_cusp || self.is(FLAT)
    }
}

fn inline(part: &impl Serialize) -> Result<String> {
    Ok(Value::try_from(part)?.to_string())
}

/// How much is computed.
#[derive(Deserialize)]
pub(super) struct Extent {
    pub(super) scenes: usize,
    /// Memory of one solution.
    pub(super) memory: String,
    half_space_every: f64,
    pressed: Vec<Asked>,
    line: Vec<Asked>,
    half_space: Vec<Asked>,
    cylinder: Vec<Asked>,
    rough: Vec<Asked>,
}

/// A method, and between what its accuracy is drawn.
#[derive(Deserialize)]
struct Asked {
    method: Method,
    errors: Option<[f64; 2]>,
    errors_of_flat_ends: Option<[f64; 2]>,
    elements: Option<Vec<usize>>,
    elements_on_dashpot: Option<Vec<usize>>,
}

/// Relative error requested of closed forms, with which the table of s(p) takes part.
const CLOSED_FORM_ERROR: f64 = 1e-2;

impl Extent {
    pub(super) fn new(quick: bool) -> Result<Self> {
        extent(include_str!("requests.toml"), quick)
    }

    /// What is asked of a scene, by model.
    pub(super) fn requests(&self, random: &mut Random, scene: &Scene) -> Vec<Request> {
        let mut draw = |model, asked: &[Asked]| -> Vec<Request> {
            let asked = asked.iter().map(|asked| asked.draw(model, random, scene));
            asked.collect()
        };
        // Both models are the same where nothing slides.
        if presses(&scene.file) {
            let mut requests = draw(Model::HalfSpace, &self.pressed);
            requests.retain(|_| !scene.is("self-affine"));
            return requests;
        }
        if scene.is("self-affine") {
            return draw(Model::HalfSpace, &self.rough);
        }
        if scene.is("cylinder") {
            return draw(Model::HalfSpace, &self.cylinder);
        }
        let mut requests = draw(Model::Line, &self.line);
        let on_half_space = draw(Model::HalfSpace, &self.half_space);
        // At an edge on a dashpot the friction is infinite, and errors of a chain fall too slowly at a cusp or an edge.
        let is_infinite = scene.is(FLAT) && scene.has_dashpot();
        requests.retain(|request| {
            let is_march = request.method == Method::MdrTransient && !request.is_by_elements();
            !(is_infinite || is_march && scene.is_sharp())
        });
        let is_turn = random.uniform() * self.half_space_every < 1.0;
        if scene.is_stationary() && is_turn {
            requests.extend(on_half_space);
        }
        requests
    }
}

impl Asked {
    fn draw(&self, model: Model, random: &mut Random, scene: &Scene) -> Request {
        let of_flat_end = self.errors_of_flat_ends.filter(|_| scene.is(FLAT));
        let on_dashpot = self.elements_on_dashpot.as_ref();
        let on_dashpot = on_dashpot.filter(|_| scene.is("viscous"));
        let accuracy = match (
            of_flat_end.or(self.errors),
            on_dashpot.or(self.elements.as_ref()),
        ) {
            (Some(errors), _) => Accuracy::RelativeError(10_f64.powf(random.between(errors))),
            (None, Some(counts)) => Accuracy::Elements(random.choice(counts)),
            (None, None) => Accuracy::RelativeError(CLOSED_FORM_ERROR),
        };
        Request::new(model, self.method, accuracy)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn scenes_follow_from_the_seed() {
        let scene = |seed| {
            let scene = Scene::new(1, &mut Random::new(seed), "48 MiB").expect("a scene");
            inline(&scene.file).expect("a scene as text")
        };
        assert_eq!(scene(3), scene(3), "the same seed");
        assert_ne!(scene(3), scene(6), "another seed");
    }
}
