//! A scene whose numbers are known to be right.

use std::path::Path;

use rheology::Material;

use super::body::{Body, body};
use super::half_space::half_space;
use crate::scene_file::{Accuracy, Control, Method, Model, SceneError, SceneFile};

/// What is asked of the methods.
#[derive(Debug)]
pub(crate) struct Question {
    pub(crate) body: Body,
    pub(crate) material: Box<dyn Material>,
    pub(crate) control: Control,
    pub(crate) motion: Motion,
    pub(crate) accuracy: Accuracy,
    pub(crate) method: Option<Method>,
    pub(crate) model: Option<Model>,
    pub(crate) threads: usize,
}

/// How the body moves.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) enum Motion {
    /// Slides with a velocity \[m/s], over a distance \[m] from first touch or for ever.
    Sliding {
        velocity: f64,
        distance: Option<f64>,
    },
    /// Is pressed without sliding, for a duration \[s].
    Pressing { duration: f64 },
}

impl Question {
    /// The question of a scene file; other files are beside it, in `folder`.
    ///
    /// # Errors
    /// [`SceneError`] for the first number that is out of range.
    pub(crate) fn new(scene: &SceneFile, folder: &Path) -> Result<Self, SceneError> {
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
            body: body(&scene.indenter, folder)?,
            material: half_space(&scene.material)?,
            control: scene.load.control()?,
            motion,
            accuracy: scene.solve.accuracy()?,
            method: scene.solve.method,
            model: scene.solve.model,
            threads: scene.solve.checked_threads()?,
        })
    }
}
