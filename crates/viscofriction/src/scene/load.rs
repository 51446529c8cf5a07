//! `[load]`: how the body is pressed and moved.

use indenters::Control;
use numerics::{not_negative, positive};
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use super::SceneError;

/// A force or a depth, and a speed.
#[derive(Debug, Clone, PartialEq, Deserialize, Serialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct Load {
    /// Normal force > 0, \[N]; or `indentation_depth`.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub normal_force: Option<f64>,
    /// Depth of the lowest point > 0, \[m]; or `normal_force`.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub indentation_depth: Option<f64>,
    /// Sliding speed ≥ 0 towards positive x, \[m/s]; 0 with `solve.duration` is pure indentation.
    pub velocity: f64,
}

impl Load {
    /// What is held constant.
    ///
    /// # Errors
    /// [`SceneError`] unless there is exactly one of force and depth, and it is positive.
    pub fn control(&self) -> Result<Control, SceneError> {
        Ok(match (self.normal_force, self.indentation_depth) {
            (Some(force), None) => Control::NormalForce(positive("load.normal_force", force)?),
            (None, Some(depth)) => {
                Control::IndentationDepth(positive("load.indentation_depth", depth)?)
            }
            (Some(_), Some(_)) => Err(SceneError::at(
                "load.indentation_depth",
                "either normal_force or indentation_depth is given, not both",
            ))?,
            (None, None) => Err(SceneError::at(
                "load.normal_force",
                "normal_force or indentation_depth is missing",
            ))?,
        })
    }

    /// The sliding speed, \[m/s].
    ///
    /// # Errors
    /// [`SceneError::Value`] for a speed that is negative or not finite.
    pub fn checked_velocity(&self) -> Result<f64, SceneError> {
        Ok(not_negative("load.velocity", self.velocity)?)
    }
}
