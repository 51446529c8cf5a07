//! Validation of an indentation history, given in the scene or in a file.

use indenters::HistoryPoint;

use super::SceneError;
use super::files::history;
use super::load::{Load, LoadPoint};
use super::place::Place;
use crate::files::Files;

impl Load {
    /// Validated points of the history, read from its file if it is in one; `None` if the load has no history. Rejects a force,
    /// depth, pressure or velocity beside it.
    pub(crate) fn checked_history(
        &self,
        files: &Files<'_>,
    ) -> Result<Option<Vec<HistoryPoint>>, SceneError> {
        let (points, key) = match (&self.history, &self.history_file) {
            (None, None) => return Ok(None),
            (Some(points), None) => (points.clone(), "load.history"),
            (None, Some(file)) => {
                let key = "load.history_file";
                (files.read_table(key, file, history)?, key)
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
        let problem = "a history says how the body moves, and nothing slides; leave this out";
        SceneError::none_given(&others, problem)?;
        checked_points(&points, key).map(Some)
    }
}

/// Validated points: at least two, time does not decrease, and all have a force or all have a depth. `key` is the path of the points
/// for errors.
fn checked_points(points: &[LoadPoint], key: &str) -> Result<Vec<HistoryPoint>, SceneError> {
    if points.len() < 2 {
        return Err(SceneError::at(key, "at least two points are needed"));
    }
    let mut before = 0.0;
    let checked = |(index, point): (usize, &LoadPoint)| {
        let place = Place { key, index };
        let allowed = "finite, at least 0, and not before the time of the point before";
        before = place.number("time", point.time, point.time >= before, allowed)?;
        let needed = "either normal_force or indentation_depth is needed, and not both";
        Ok(HistoryPoint {
            time: point.time,
            control: place.control(*point, points[0], needed)?,
        })
    };
    points.iter().enumerate().map(checked).collect()
}
