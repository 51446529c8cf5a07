//! Validation of a motion along the surface, given in the scene or in a file: reciprocating, or through given positions.

use indenters::{Control, IndenterError, MovingLoad, MovingPoint, Shape, Stroke};
use numerics::positive;

use super::SceneError;
use super::files::motion;
use super::load::{Load, MotionPoint, StrokeShape};
use super::place::Place;
use crate::files::Files;

/// Message if a scene has more than one of `motion`, `motion_file`, `stroke` and a history.
const ONE_OF: &str = "a body moves through the points of motion or motion_file, or over a stroke, or follows a history: give one of them";
/// Message for a velocity or a track beside a motion.
const MOVES: &str = "a motion says how the body moves; leave this out";
/// Message for a force or depth in the motion of a periodic surface.
const OWN_PRESSURE: &str = "a periodic surface is pressed by load.mean_pressure all the time; leave forces and depths of points out";

/// Message for a point with force and depth, or with neither where others have one.
const NEEDED: &str =
    "either normal_force or indentation_depth is needed, and not both, at all points or at none";

impl Load {
    /// Validated reciprocating motion, or motion through given positions; `None` if there is none. `period` is the area of one
    /// period \[m²] of a periodic surface.
    pub(crate) fn checked_motion(
        &self,
        period: Option<f64>,
        files: &Files<'_>,
    ) -> Result<Option<MovingLoad>, SceneError> {
        self.check_alone()?;
        let control = || self.control(period);
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
                let key = "load.motion_file";
                (files.read_table(key, file, motion)?, key)
            }
        };
        let points = self.pressed(&points, (key, period.is_some()), control)?;
        let load = MovingLoad::through_points(&points);
        load.map(Some).map_err(|error| refused(key, &error))
    }

    /// Rejects a scene with more than one of a stroke, a motion and a history.
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
            let others = [("load.velocity", self.velocity), ("load.track", self.track)];
            SceneError::none_given(&others, MOVES)?;
        }
        Ok(())
    }

    /// Validated points of a motion, with their own forces or depths, or else all with the constant one that `control` returns.
    /// `key` is the path of the points for errors.
    fn pressed(
        &self,
        points: &[MotionPoint],
        (key, is_periodic): (&str, bool),
        control: impl FnOnce() -> Result<Control, SceneError>,
    ) -> Result<Vec<MovingPoint>, SceneError> {
        if points.len() < 2 {
            return Err(SceneError::at(key, "at least two points are needed"));
        }
        let is_own =
            |point: &MotionPoint| point.normal_force.is_some() || point.indentation_depth.is_some();
        let held = if points.iter().any(is_own) {
            if is_periodic {
                return Err(SceneError::at(key, OWN_PRESSURE));
            }
            let others = [
                ("load.normal_force", self.normal_force),
                ("load.indentation_depth", self.indentation_depth),
                ("load.mean_pressure", self.mean_pressure),
            ];
            let problem =
                "the points of the motion have a force or a depth of their own; leave this out";
            SceneError::none_given(&others, problem)?;
            None
        } else {
            Some(control()?)
        };
        let mut before = f64::NEG_INFINITY;
        let moving = |(index, point): (usize, &MotionPoint)| {
            let place = Place { key, index };
            let later = point.time >= 0.0 && point.time > before;
            let allowed = "finite, at least 0, and after the time of the point before";
            before = place.number("time", point.time, later, allowed)?;
            let control = match held {
                Some(control) => control,
                None => place.control(point.load_point(), points[0].load_point(), NEEDED)?,
            };
            Ok(MovingPoint {
                time: point.time,
                position: place.number("position", point.position, true, "finite")?,
                control,
            })
        };
        points.iter().enumerate().map(moving).collect()
    }

    /// Validated length of the track, \[m]; `None` if there is none.
    pub(crate) fn checked_track(&self) -> Result<Option<f64>, SceneError> {
        let track = self.track.map(|track| positive("load.track", track));
        Ok(track.transpose()?)
    }
}

/// The error of the motion of `indenters` at the key of the scene that caused it, with advice for a motion of length 0.
fn refused(key: &str, error: &IndenterError) -> SceneError {
    let advice = match error {
        IndenterError::InvalidParameter(refused) if refused.value == 0.0 => {
            "; a body that does not slide follows load.history"
        }
        _ => "",
    };
    SceneError::at(key, format!("{error}{advice}"))
}
