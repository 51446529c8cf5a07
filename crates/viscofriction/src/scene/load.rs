//! `[load]`: how the body is pressed and moved.

use std::path::{Path, PathBuf};

use indenters::Control;
use mdr_core::HistoryPoint;
use numerics::{in_range, not_negative, positive};
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use super::SceneError;
use super::files::history;
use crate::text::{ReadFile, WrongInput};

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
    /// Mean pressure > 0 over the period of a periodic surface, \[Pa], which takes nothing else.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub mean_pressure: Option<f64>,
    /// Sliding speed ≥ 0 towards positive x, \[m/s]; 0 with `solve.duration` is pure indentation.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub velocity: Option<f64>,
    /// Instead of force or depth and speed: depth or force over time, straight from point to point; two points of the same
    /// time are a jump.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub history: Option<Vec<LoadPoint>>,
    /// The same as a CSV file beside the scene file, with the columns time_s and indentation_depth_m or normal_force_n.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub history_file: Option<PathBuf>,
}

/// A point of a history.
#[derive(Debug, Clone, Copy, PartialEq, Deserialize, Serialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct LoadPoint {
    /// Time ≥ 0, \[s]; not before that of the point before.
    pub time: f64,
    /// Normal force ≥ 0, \[N]; or `indentation_depth`.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub normal_force: Option<f64>,
    /// Depth of the lowest point below the undeformed surface, \[m], of either sign; or `normal_force`.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub indentation_depth: Option<f64>,
}

impl Load {
    /// What is held constant on a body of which one `period` has that area \[m²], or that has none: the mean pressure of a
    /// period is a force on it.
    ///
    /// # Errors
    /// [`SceneError`] unless there is exactly one of force and depth, or of a period the mean pressure, and it is positive.
    pub fn control(&self, period: Option<f64>) -> Result<Control, SceneError> {
        let at = |key: &str, problem: &str| Err(SceneError::at(format!("load.{key}"), problem));
        let Self {
            normal_force,
            indentation_depth,
            mean_pressure,
            ..
        } = *self;
        match (period, mean_pressure, normal_force, indentation_depth) {
            (Some(area), Some(pressure), None, None) => {
                let pressure = positive("load.mean_pressure", pressure)?;
                let key = "load.mean_pressure times the period";
                Ok(Control::NormalForce(positive(key, pressure * area)?))
            }
            (Some(_), ..) => {
                let problem = "a periodic surface takes a mean_pressure, and neither normal_force nor indentation_depth";
                at("mean_pressure", problem)
            }
            (None, Some(_), ..) => {
                let problem = "only a periodic surface has a mean pressure; give normal_force or indentation_depth";
                at("mean_pressure", problem)
            }
            (None, None, Some(force), None) => {
                Ok(Control::NormalForce(positive("load.normal_force", force)?))
            }
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

    /// The sliding speed, \[m/s].
    ///
    /// # Errors
    /// [`SceneError::Value`] for a speed that is negative or not finite; [`SceneError::At`] for none.
    pub fn checked_velocity(&self) -> Result<f64, SceneError> {
        let missing = || SceneError::at("load.velocity", "missing field `velocity`");
        let velocity = self.velocity.ok_or_else(missing)?;
        Ok(not_negative("load.velocity", velocity)?)
    }

    /// The points of the history; none where the load is constant. A file is in `folder` and read by `read`.
    ///
    /// # Errors
    /// [`SceneError`] for the first point that is out of order or range, and for a history beside anything else.
    pub fn checked_history(
        &self,
        folder: &Path,
        read: ReadFile,
    ) -> Result<Option<Vec<HistoryPoint>>, SceneError> {
        let (points, of_file) = match (&self.history, &self.history_file) {
            (None, None) => return Ok(None),
            (Some(points), None) => (points.clone(), false),
            (None, Some(file)) => {
                let file = folder.join(file);
                let points =
                    read(&file).and_then(|table| history(&file, &table).map_err(WrongInput));
                let wrong = |WrongInput(problem)| SceneError::at("load.history_file", problem);
                (points.map_err(wrong)?, true)
            }
            (Some(_), Some(_)) => {
                let problem = "either history or history_file is given, not both";
                return Err(SceneError::at("load.history_file", problem));
            }
        };
        let others = [
            ("load.normal_force", self.normal_force),
            ("load.indentation_depth", self.indentation_depth),
            ("load.mean_pressure", self.mean_pressure),
            ("load.velocity", self.velocity),
        ];
        if let Some((key, _)) = others.into_iter().find(|(_, value)| value.is_some()) {
            let problem = "a history says how the body moves, and nothing slides; leave this out";
            return Err(SceneError::at(key, problem));
        }
        // Whoever wrote a file reads the number of its row, counted from 0 like an index.
        let key = |index: usize, name: &str| match (of_file, name) {
            (true, _) => "load.history_file".to_owned(),
            (false, "") => format!("load.history[{index}]"),
            (false, _) => format!("load.history[{index}].{name}"),
        };
        checked(&points, key).map(Some)
    }
}

/// The points, where time does not go back, and all have a force or all a depth.
fn checked(
    points: &[LoadPoint],
    key: impl Fn(usize, &str) -> String,
) -> Result<Vec<HistoryPoint>, SceneError> {
    if points.len() < 2 {
        let key = key(0, "").replace("[0]", "");
        return Err(SceneError::at(key, "at least two points are needed"));
    }
    let mut before = 0.0;
    let mut checked = Vec::with_capacity(points.len());
    for (index, point) in points.iter().enumerate() {
        let number = |name: &'static str, value: f64, holds: bool, allowed: &'static str| {
            let holds = holds && value.is_finite();
            in_range(name, value, holds, allowed).map_err(|_| SceneError::Value {
                key: key(index, name),
                value,
                allowed,
            })
        };
        let allowed = "finite, at least 0, and not before the time of the point before";
        before = number("time", point.time, point.time >= before, allowed)?;
        let control = match (point.normal_force, point.indentation_depth) {
            (Some(force), None) => {
                let allowed = "finite and at least 0";
                number("normal_force", force, force >= 0.0, allowed).map(Control::NormalForce)?
            }
            (None, Some(depth)) => {
                let depth = number("indentation_depth", depth, true, "finite");
                depth.map(Control::IndentationDepth)?
            }
            _ => {
                let problem = "either normal_force or indentation_depth is needed";
                return Err(SceneError::at(key(index, ""), problem));
            }
        };
        if points[0].normal_force.is_some() != point.normal_force.is_some() {
            let problem = "all points have a force, or all a depth";
            return Err(SceneError::at(key(index, ""), problem));
        }
        checked.push(HistoryPoint {
            time: point.time,
            control,
        });
    }
    Ok(checked)
}
