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

/// A random scene.
pub(super) struct Scene {
    /// What the tables say of it.
    pub(super) label: Label,
    /// The scene itself, without a model and an accuracy.
    pub(super) file: scene::Scene,
}

/// Number of a scene and its parts, as inline tables in TOML.
#[derive(Debug, Clone, Default, Serialize)]
pub(super) struct Label {
    scene: usize,
    indenter: String,
    material: String,
    interface: String,
    heat: String,
    strain: String,
    load: String,
    solve: String,
}

/// One of this number of scenes slides from first touch; the others are stationary or pressed. Chosen.
const SCENES_PER_FIRST_TOUCH: usize = 6;
/// Kinds of bodies that end in a flat, at whose edge the pressure has no bound.
pub(super) const FLAT: &str = "flat-cone truncated-paraboloid";

impl Scene {
    /// The scene with this number, from the next numbers of `random`; `memory` is the largest that a solution may take.
    pub(super) fn new(number: usize, random: &mut Random, memory: &str) -> Result<Self> {
        let mut source = Source::new(match number % SCENES_PER_FIRST_TOUCH {
            0 => "from-first-touch",
            _ => "calibration",
        })?;
        memory.clone_into(&mut source.range.memory);
        let mut file = sample(random, &source, Path::new(""))?.scene;
        // Leave model and error open, because both models and several errors are requested of the same scene.
        (file.solve.model, file.solve.relative_error) = (None, None);
        let (interface, heat, strain) = (&file.interface, &file.heat, &file.strain);
        let label = Label {
            scene: number,
            indenter: inline(&file.indenter)?,
            material: inline(&file.material)?,
            interface: interface.as_ref().map_or(Ok(String::new()), inline)?,
            heat: heat.as_ref().map_or(Ok(String::new()), inline)?,
            strain: strain.as_ref().map_or(Ok(String::new()), inline)?,
            load: inline(&file.load)?,
            solve: inline(&file.solve)?,
        };
        Ok(Self { label, file })
    }

    /// Whether its body or its material is of one of the kinds that `kinds` names, separated by blanks.
    pub(super) fn is(&self, kinds: &str) -> bool {
        let own = [self.file.indenter.key(), self.file.material.key()];
        let is_own = |kind: &str| own.iter().any(|key| key.split('.').nth(1) == Some(kind));
        kinds.split(' ').any(is_own)
    }

    /// Whether the depth is given instead of the force.
    pub(super) const fn is_at_depth(&self) -> bool {
        self.file.load.indentation_depth.is_some()
    }

    /// Whether it slides in a stationary state.
    pub(super) fn is_stationary(&self) -> bool {
        !presses(&self.file) && self.file.solve.sliding_distance.is_none()
    }

    /// Whether the material has a viscosity beside its springs, so that its stress follows the strain rate without a bound.
    fn has_dashpot(&self) -> bool {
        let problem = Problem::try_from(&self.file);
        problem.is_ok_and(|problem| problem.material().relaxation().viscosity() > 0.0)
    }

    /// Whether the profile of the one-dimensional model is infinitely steep somewhere.
    fn is_sharp(&self) -> bool {
        let has_cusp = match &self.file.indenter {
            Indenter::Power { exponent, .. } => *exponent < 1.0,
            Indenter::Superposition { terms } => terms.iter().any(|term| term.exponent < 1.0),
            _ => false,
        };
        has_cusp || self.is(FLAT)
    }
}

/// A part of a scene as an inline table in TOML.
fn inline(part: &impl Serialize) -> Result<String> {
    Ok(Value::try_from(part)?.to_string())
}

/// What is computed: a table of `requests.toml`.
#[derive(Deserialize)]
pub(super) struct Extent {
    /// Number of scenes.
    pub(super) scenes: usize,
    /// Largest memory of one solution, such as `16 MiB`.
    pub(super) memory: String,
    /// One of this number of scenes, on average, is also solved on the half space.
    half_space_every: f64,
    /// What is asked of scenes that are only pressed; then of those that slide: in the one-dimensional model, on the half
    /// space, of cylinders and of rough surfaces.
    pressed: Vec<Asked>,
    line: Vec<Asked>,
    half_space: Vec<Asked>,
    cylinder: Vec<Asked>,
    rough: Vec<Asked>,
}

/// A method, and the range from which its accuracy is drawn. Without errors and elements [`CLOSED_FORM_ERROR`] is requested.
#[derive(Deserialize)]
struct Asked {
    method: Method,
    /// Relative error: decimal logarithms of the ends of the range, as all errors of this table.
    errors: Option<[f64; 2]>,
    /// Instead of `errors` for bodies that end in a flat.
    errors_of_flat_ends: Option<[f64; 2]>,
    /// Numbers of elements.
    elements: Option<Vec<usize>>,
    /// Instead of `elements` on a viscous material.
    elements_on_dashpot: Option<Vec<usize>>,
}

/// Relative error requested of closed forms: so large that the tabulated factor s(p) of power profiles, whose error is not of
/// rounding only, is admitted.
const CLOSED_FORM_ERROR: f64 = 1e-2;

impl Extent {
    /// Extent of a quick run or of a full one.
    pub(super) fn new(quick: bool) -> Result<Self> {
        extent(include_str!("requests.toml"), quick)
    }

    /// What is asked of a scene, requests of one model next to each other. Cases in which friction is infinite or a method
    /// converges too slowly are left out.
    pub(super) fn requests(&self, random: &mut Random, scene: &Scene) -> Vec<Request> {
        let mut draw = |model, asked: &[Asked]| -> Vec<Request> {
            let requests = asked.iter().map(|asked| asked.draw(model, random, scene));
            requests.collect()
        };
        // Request answers of the half space only where nothing slides, because both models are the same there.
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
        // Leave out two cases. At an edge on a dashpot the friction is infinite; and the errors of a chain of elements fall too
        // slowly at a cusp or an edge.
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
    /// A request with a random accuracy: errors are uniformly distributed in their logarithm.
    fn draw(&self, model: Model, random: &mut Random, scene: &Scene) -> Request {
        let of_flat_end = self.errors_of_flat_ends.filter(|_| scene.is(FLAT));
        let on_dashpot = self
            .elements_on_dashpot
            .as_ref()
            .filter(|_| scene.is("viscous"));
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
