//! `[load]`: how the body is pressed and moved.

use std::path::PathBuf;

use indenters::Control;
use numerics::{not_negative, positive};
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use super::SceneError;

/// A force or a depth, and a speed.
#[derive(Debug, Clone, Default, PartialEq, Deserialize, Serialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct Load {
    /// Normal force > 0, \[N]; or `indentation_depth`.
    pub normal_force: Option<f64>,
    /// Depth of the lowest point > 0, \[m]; or `normal_force`.
    pub indentation_depth: Option<f64>,
    /// Mean pressure > 0 over the period of a periodic surface, \[Pa], which takes nothing else.
    pub mean_pressure: Option<f64>,
    /// Sliding speed ≥ 0 towards positive x, \[m/s]; 0 with `solve.duration` is pure indentation.
    pub velocity: Option<f64>,
    /// Instead of force or depth and speed: depth or force over time, straight from point to point; two points of the same
    /// time are a jump.
    pub history: Option<Vec<LoadPoint>>,
    /// `history` as a CSV file in the folder of the scene, with the columns time_s and indentation_depth_m or normal_force_n.
    pub history_file: Option<PathBuf>,
    /// Length > 0 of the track after which the body returns to the same place, as a ball on a disc does, \[m]; without it the body
    /// never returns.
    pub track: Option<f64>,
    /// Instead of a speed: distance > 0 between the ends of a reciprocating motion, \[m].
    pub stroke: Option<f64>,
    /// Cycles of the stroke per second > 0, \[1/s].
    pub frequency: Option<f64>,
    /// How the body moves over the stroke; without it `sinusoidal`.
    pub shape: Option<StrokeShape>,
    /// Instead of a speed: positions over time, straight from point to point.
    pub motion: Option<Vec<MotionPoint>>,
    /// `motion` as a CSV file in the folder of the scene, with the columns time_s and position_m.
    pub motion_file: Option<PathBuf>,
}

/// How a body moves over its stroke.
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq, Deserialize, Serialize, JsonSchema)]
#[serde(rename_all = "kebab-case")]
pub enum StrokeShape {
    /// Like a crank: the position is a cosine of time.
    #[default]
    Sinusoidal,
    /// With constant speed between the ends.
    Triangular,
}

/// A point of a motion.
#[derive(Debug, Clone, Copy, PartialEq, Deserialize, Serialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct MotionPoint {
    /// Time ≥ 0, \[s]; after that of the point before.
    pub time: f64,
    /// Position of the lowest point along x, \[m].
    pub position: f64,
    /// Normal force ≥ 0, \[N], of a motion whose points have one each.
    pub normal_force: Option<f64>,
    /// Depth of the lowest point below the undeformed surface, \[m], of either sign, of a motion whose points have one each.
    pub indentation_depth: Option<f64>,
}

/// A point of a history.
#[derive(Debug, Clone, Copy, PartialEq, Deserialize, Serialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct LoadPoint {
    /// Time ≥ 0, \[s]; not before that of the point before.
    pub time: f64,
    /// Normal force ≥ 0, \[N]; or `indentation_depth`.
    pub normal_force: Option<f64>,
    /// Depth of the lowest point below the undeformed surface, \[m], of either sign; or `normal_force`.
    pub indentation_depth: Option<f64>,
}

impl MotionPoint {
    /// The point without its position.
    pub(super) const fn load_point(&self) -> LoadPoint {
        LoadPoint {
            time: self.time,
            normal_force: self.normal_force,
            indentation_depth: self.indentation_depth,
        }
    }
}

impl Load {
    /// Validated force \[N] or depth \[m], constant in time. `period` is the area of one period \[m²], by which a mean pressure
    /// is multiplied to a force; `None` for a body that is not periodic. Rejects a missing control, and several.
    pub(crate) fn control(&self, period: Option<f64>) -> Result<Control, SceneError> {
        let at = |key: &str, problem: &str| Err(SceneError::at(format!("load.{key}"), problem));
        let pressed = |key, force| Ok(Control::NormalForce(positive(key, force)?));
        let (force, depth) = (self.normal_force, self.indentation_depth);
        match (period, self.mean_pressure, force, depth) {
            (Some(area), Some(pressure), None, None) => {
                let pressure = positive("load.mean_pressure", pressure)?;
                pressed("load.mean_pressure times the period", pressure * area)
            }
            (Some(_), ..) => {
                let problem = "a periodic surface takes a mean_pressure, and neither normal_force nor indentation_depth";
                at("mean_pressure", problem)
            }
            (None, Some(_), ..) => {
                let problem = "only a periodic surface has a mean pressure; give normal_force or indentation_depth";
                at("mean_pressure", problem)
            }
            (None, None, Some(force), None) => pressed("load.normal_force", force),
            (None, None, None, Some(depth)) => {
                let depth = positive("load.indentation_depth", depth)?;
                Ok(Control::IndentationDepth(depth))
            }
            (None, None, Some(_), Some(_)) => {
                let problem = "either normal_force or indentation_depth is given, not both";
                at("indentation_depth", problem)
            }
            (None, None, None, None) => at(
                "normal_force",
                "normal_force or indentation_depth is missing",
            ),
        }
    }

    /// Validated sliding velocity, at least 0, \[m/s]; an error if it is missing.
    pub(crate) fn checked_velocity(&self) -> Result<f64, SceneError> {
        let missing = || {
            let problem = "missing field `velocity`: give a velocity [m/s], or a stroke, a motion or a history";
            SceneError::at("load.velocity", problem)
        };
        let velocity = self.velocity.ok_or_else(missing)?;
        Ok(not_negative("load.velocity", velocity)?)
    }
}
