//! Body and elastomer of a scene, which problems with other loads share.

use std::sync::Arc;

use super::body::{BodyOfScene, body};
use super::half_space::{HalfSpace, half_space};
use crate::files::Files;
use crate::scene::{Scene, SceneError};

/// The parts of a problem that depend neither on its load nor on the requested accuracy.
#[derive(Debug, Clone)]
pub struct Parts {
    /// The rigid body, with the warnings of its files.
    pub body: Arc<BodyOfScene>,
    /// The elastomer, without its thickness.
    pub half_space: Arc<HalfSpace>,
}

impl Parts {
    /// Builds the parts of a scene, and reads the files of its body and its material.
    ///
    /// # Errors
    /// [`SceneError`] for the first number of the body or the material that is out of range.
    pub fn new(scene: &Scene, files: &Files<'_>) -> Result<Self, SceneError> {
        Ok(Self {
            body: Arc::new(body(&scene.indenter, files)?),
            half_space: Arc::new(half_space(&scene.material, files)?),
        })
    }
}
