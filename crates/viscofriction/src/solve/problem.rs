//! A scene whose numbers are known to be right.

use std::path::Path;

use rheology::Material;

use super::body::{Body, body};
use super::half_space::half_space;
use super::offer::{NotOffered, choose};
use crate::scene::{Accuracy, Control, Method, Model, Scene, SceneError, Source, scene_file};
use crate::text::WrongInput;

/// Reads a file that a scene names; the sentence of a failure names it.
pub type ReadFile = fn(&Path) -> Result<Vec<u8>, WrongInput>;

/// What is asked of the methods.
#[derive(Debug)]
pub struct Problem {
    pub body: Body,
    pub material: Box<dyn Material>,
    pub control: Control,
    pub motion: Motion,
    pub accuracy: Accuracy,
    pub method: Option<Method>,
    pub model: Model,
    pub threads: Option<usize>,
}

/// How the body moves.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Motion {
    /// Slides with a velocity \[m/s], over a distance \[m] from first touch or for ever.
    Sliding {
        velocity: f64,
        distance: Option<f64>,
    },
    /// Is pressed without sliding, for a duration \[s].
    Pressing { duration: f64 },
}

impl Problem {
    /// The problem of a scene; files that it names are in `folder` and read by `read`.
    ///
    /// # Errors
    /// [`SceneError`] for the first number that is out of range.
    pub fn new(scene: &Scene, folder: &Path, read: ReadFile) -> Result<Self, SceneError> {
        let velocity = scene.load.checked_velocity()?;
        let motion = if velocity > 0.0 {
            Motion::Sliding {
                velocity,
                distance: scene.solve.distance(velocity)?,
            }
        } else {
            Motion::Pressing {
                duration: scene.solve.indentation_time()?,
            }
        };
        Ok(Self {
            body: body(&scene.indenter, folder, read)?,
            material: half_space(&scene.material)?,
            control: scene.load.control()?,
            motion,
            accuracy: scene.solve.accuracy()?,
            method: scene.solve.method,
            model: scene.solve.checked_model(),
            threads: scene.solve.checked_threads()?,
        })
    }
}

/// What a scene file asks, and the method that answers it: the one given, that of the scene, or the cheapest.
///
/// # Errors
/// [`WrongInput`] with the place where the scene is wrong.
pub fn problem_of(
    source: &Source,
    method: Option<Method>,
    read: ReadFile,
) -> Result<(Problem, Method), WrongInput> {
    let located = |error: SceneError| source.locate(&error);
    let mut scene = scene_file(source.table()?).map_err(located)?;
    scene.solve.method = method.or(scene.solve.method);
    let problem = Problem::new(&scene, source.folder(), read).map_err(located)?;
    let method = choose(&problem).map_err(|error| not_offered(source, &error))?;
    Ok((problem, method))
}

/// A combination that is not offered is wrong input, at the method or at the whole scene.
pub(crate) fn not_offered(source: &Source, error: &NotOffered) -> WrongInput {
    let key = match error {
        NotOffered::Method { .. } => "solve.method",
        NotOffered::AnyMethod { .. } => "indenter",
        NotOffered::Material(_) => "material",
    };
    source.locate(&SceneError::together(key, error.to_string()))
}
