//! Validation of an indentation history, given in the scene or in a file.

use indenters::{Control, HistoryPoint};
use numerics::in_range;

use super::SceneError;
use super::files::history;
use super::load::{Load, LoadPoint};
use crate::files::Files;
use crate::text::WrongInput;

impl Load {
    /// Validated points of the history, read from its file if it is in one; `None` if the load has no history. Rejects a force,
    /// depth, pressure or velocity beside it.
    pub(crate) fn checked_history(
        &self,
        files: &Files<'_>,
    ) -> Result<Option<Vec<HistoryPoint>>, SceneError> {
        let (points, of_file) = match (&self.history, &self.history_file) {
            (None, None) => return Ok(None),
            (Some(points), None) => (points.clone(), false),
            (None, Some(file)) => {
                let table = files.table(file);
                let points =
                    table.and_then(|(file, table)| history(&file, &table).map_err(WrongInput));
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
        let problem = "a history says how the body moves, and nothing slides; leave this out";
        SceneError::none_given(&others, problem)?;
        // Rows of a file were checked by line when it was read, so its errors here name the file only.
        let key = |index: usize, name: &str| match (of_file, name) {
            (true, _) => "load.history_file".to_owned(),
            (false, "") => format!("load.history[{index}]"),
            (false, _) => format!("load.history[{index}].{name}"),
        };
        checked_points(&points, key).map(Some)
    }
}

/// Validated points: at least two, time does not decrease, and all have a force or all have a depth. `key` returns the path of
/// a value from the index of its point and its name; an empty name stands for the point.
fn checked_points(
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
            let wrong = |refused| SceneError::value(key(index, name), refused);
            in_range(name, value, holds, allowed).map_err(wrong)
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
                let problem = "either normal_force or indentation_depth is needed, and not both";
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
