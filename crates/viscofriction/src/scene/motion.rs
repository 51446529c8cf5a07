//! A motion along the surface, of a scene or of a file: to and fro, or through points.

use indenters::{Control, IndenterError, MovingLoad, MovingPoint, Shape, Stroke};
use numerics::{in_range, positive};

use super::SceneError;
use super::files::motion;
use super::load::{Load, MotionPoint, StrokeShape};
use crate::files::Files;
use crate::text::WrongInput;

const ONE_OF: &str = "a body moves through the points of motion or motion_file, or over a stroke, or follows a history: give one of them";
const MOVES: &str = "a motion says how the body moves; leave this out";

impl Load {
    /// To and fro, or through points, pressed as `control` says; none where the speed is constant.
    pub(crate) fn checked_motion(
        &self,
        control: impl FnOnce() -> Result<Control, SceneError>,
        files: &Files<'_>,
    ) -> Result<Option<MovingLoad>, SceneError> {
        self.check_alone()?;
        if let Some(length) = self.stroke {
            let missing = || {
                let problem = "a stroke needs a frequency [1/s], how many times it is passed forth and back in a second";
                SceneError::at("load.stroke", problem)
            };
            let stroke = Stroke {
                length: positive("load.stroke", length)?,
                frequency: positive("load.frequency", self.frequency.ok_or_else(missing)?)?,
                shape: match self.shape.unwrap_or_default() {
                    StrokeShape::Sinusoidal => Shape::Sinusoidal,
                    StrokeShape::Triangular => Shape::Triangular,
                },
            };
            let load = MovingLoad::reciprocating(control()?, stroke);
            return load
                .map(Some)
                .map_err(|error| refused("load.frequency", &error));
        }
        for (key, is_given) in [
            ("load.frequency", self.frequency.is_some()),
            ("load.shape", self.shape.is_some()),
        ] {
            if is_given {
                return Err(SceneError::at(
                    key,
                    "it belongs to a stroke; give load.stroke",
                ));
            }
        }
        let (points, key) = match (&self.motion, &self.motion_file) {
            (None, None) => return Ok(None),
            (Some(points), _) => (points.clone(), "load.motion"),
            (None, Some(file)) => {
                let table = files.table(file);
                let points =
                    table.and_then(|(file, table)| motion(&file, &table).map_err(WrongInput));
                let wrong = |WrongInput(problem)| SceneError::at("load.motion_file", problem);
                (points.map_err(wrong)?, "load.motion_file")
            }
        };
        let points = self.pressed(&points, key, control)?;
        let load = MovingLoad::through(&points);
        load.map(Some).map_err(|error| refused(key, &error))
    }

    /// Refuses what says something else about the motion.
    fn check_alone(&self) -> Result<(), SceneError> {
        let motions = [
            ("load.stroke", self.stroke.is_some()),
            ("load.motion", self.motion.is_some()),
            ("load.motion_file", self.motion_file.is_some()),
            ("load.history", self.history.is_some()),
            ("load.history_file", self.history_file.is_some()),
        ];
        let mut given = motions.iter().filter(|(_, is_given)| *is_given);
        let first = given.next();
        if let Some((key, _)) = given.next() {
            return Err(SceneError::at(*key, ONE_OF));
        }
        if first.is_some_and(|(key, _)| !key.contains("history")) {
            let others = [
                ("load.velocity", self.velocity),
                ("load.track", self.track),
                ("load.mean_pressure", self.mean_pressure),
            ];
            SceneError::none_given(&others, MOVES)?;
        }
        Ok(())
    }

    /// The points with their forces or depths, or with that of the load.
    fn pressed(
        &self,
        points: &[MotionPoint],
        key: &str,
        control: impl FnOnce() -> Result<Control, SceneError>,
    ) -> Result<Vec<MovingPoint>, SceneError> {
        if points.len() < 2 {
            return Err(SceneError::at(key, "at least two points are needed"));
        }
        let is_own =
            |point: &MotionPoint| point.normal_force.is_some() || point.indentation_depth.is_some();
        let held = if points.iter().any(is_own) {
            let others = [
                ("load.normal_force", self.normal_force),
                ("load.indentation_depth", self.indentation_depth),
            ];
            let problem =
                "the points of the motion have a force or a depth of their own; leave this out";
            SceneError::none_given(&others, problem)?;
            None
        } else {
            Some(control()?)
        };
        let key = |index: usize, name: &str| match (key, name) {
            ("load.motion_file", _) => key.to_owned(),
            (_, "") => format!("{key}[{index}]"),
            _ => format!("{key}[{index}].{name}"),
        };
        let mut before = f64::NEG_INFINITY;
        let moving = |(index, point): (usize, &MotionPoint)| {
            let number = |name: &'static str, value: f64, holds: bool, allowed: &'static str| {
                let wrong = |refused| SceneError::value(key(index, name), refused);
                in_range(name, value, holds && value.is_finite(), allowed).map_err(wrong)
            };
            let allowed = "finite, at least 0, and after the time of the point before";
            let time = number(
                "time",
                point.time,
                point.time >= 0.0 && point.time > before,
                allowed,
            )?;
            before = time;
            let position = number("position", point.position, true, "finite")?;
            let control = match (held, point.normal_force, point.indentation_depth) {
                (Some(control), ..) => control,
                (None, Some(force), None) => {
                    let allowed = "finite and at least 0";
                    Control::NormalForce(number("normal_force", force, force >= 0.0, allowed)?)
                }
                (None, None, Some(depth)) => {
                    Control::IndentationDepth(number("indentation_depth", depth, true, "finite")?)
                }
                _ => {
                    let problem = "either normal_force or indentation_depth is needed, at all points or at none";
                    return Err(SceneError::at(key(index, ""), problem));
                }
            };
            if points[0].normal_force.is_some() != point.normal_force.is_some() {
                let problem = "all points have a force, or all a depth";
                return Err(SceneError::at(key(index, ""), problem));
            }
            Ok(MovingPoint {
                time,
                position,
                control,
            })
        };
        points.iter().enumerate().map(moving).collect()
    }

    /// The length of a track, of a body that slides with a speed, \[m].
    pub(crate) fn checked_track(&self) -> Result<Option<f64>, SceneError> {
        let track = self.track.map(|track| positive("load.track", track));
        Ok(track.transpose()?)
    }
}

/// A number that follows from those of the scene.
fn refused(key: &str, error: &IndenterError) -> SceneError {
    SceneError::at(key, error.to_string())
}
