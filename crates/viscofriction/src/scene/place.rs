//! Validation of the numbers of one point of a history or a motion.

use indenters::Control;
use numerics::in_range;

use super::SceneError;
use super::load::LoadPoint;

/// Location of a point for error messages: the path of its list in the scene and its index, or only the key of its file, whose rows
/// were checked by line when it was read.
pub(super) struct Place<'a> {
    /// Path of the list or of the file.
    pub(super) key: &'a str,
    /// Index of the point.
    pub(super) index: usize,
}

impl Place<'_> {
    /// Path of a value of the point; an empty name stands for the point.
    fn key(&self, name: &str) -> String {
        let Self { key, index } = self;
        match name {
            _ if key.ends_with("_file") => (*key).to_owned(),
            "" => format!("{key}[{index}]"),
            _ => format!("{key}[{index}].{name}"),
        }
    }

    /// The number, unless it is not finite or `holds` is false; then an error with the range `allowed`.
    pub(super) fn number(
        &self,
        name: &'static str,
        value: f64,
        holds: bool,
        allowed: &'static str,
    ) -> Result<f64, SceneError> {
        let wrong = |refused| SceneError::value(self.key(name), refused);
        in_range(name, value, holds && value.is_finite(), allowed).map_err(wrong)
    }

    /// Force or depth of a point; it must be of the kind of the first point. `needed` is the message for both or neither.
    pub(super) fn control(
        &self,
        point: LoadPoint,
        first: LoadPoint,
        needed: &str,
    ) -> Result<Control, SceneError> {
        let control = match (point.normal_force, point.indentation_depth) {
            (Some(force), None) => {
                let allowed = "finite and at least 0";
                self.number("normal_force", force, force >= 0.0, allowed)
                    .map(Control::NormalForce)?
            }
            (None, Some(depth)) => {
                let depth = self.number("indentation_depth", depth, true, "finite");
                depth.map(Control::IndentationDepth)?
            }
            _ => return Err(SceneError::at(self.key(""), needed)),
        };
        if first.normal_force.is_some() != point.normal_force.is_some() {
            let problem = "all points have a force, or all a depth";
            return Err(SceneError::at(self.key(""), problem));
        }
        Ok(control)
    }
}
