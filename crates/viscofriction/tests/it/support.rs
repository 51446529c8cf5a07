//! Scenes in a folder, solved as the program solves them, but in this process.

use std::fmt::Display;
use std::fs;
use std::path::Path;

use serde_json::Value;
use viscofriction::numerics::SilentProgress;
use viscofriction::scene::{Method, Source};
use viscofriction::{Answer, Estimate, Problem, WrongInput, plan_of, problem_of, with_fields};

pub(crate) use crate::shared::*;

/// What a scene asks, and the answer with its fields.
pub(crate) struct Solved {
    pub(crate) problem: Problem,
    pub(crate) answer: Answer,
}

/// More is not needed by any scene of the tests, \[bytes].
const MEMORY: u64 = 4 << 30;

fn read(file: &Path, _: u64) -> Result<Vec<u8>, WrongInput> {
    fs::read(file).map_err(|error| WrongInput(format!("{}: {error}", file.display())))
}

/// Solves the scene of a file, by its method or by the one after `--method`; an error has the status with which the program
/// ends.
fn solve(line: &str, folder: &Path) -> Result<Solved, (u8, String)> {
    let wrong = |error: WrongInput| (2, error.to_string());
    let (scene, method) = line.split_once(" --method ").unzip();
    let method = method.map(|name| serde_json::from_value::<Method>(name.into()));
    let path = folder.join(argument(scene.unwrap_or(line)));
    let source = Source::new(&path, fs::read(&path).expect("a scene")).map_err(wrong)?;
    let method = method.transpose().expect("a method");
    let problem = problem_of(&source, method, read).map_err(wrong)?;
    let problem = problem.or_max_memory(Some(MEMORY)).with_gap();
    let plan = plan_of(&source, &problem).map_err(wrong)?;
    let answer = plan
        .solve(&SilentProgress)
        .map_err(|error| (1, error.to_string()))?;
    let answer = with_fields(&problem, answer);
    Ok(Solved { problem, answer })
}

impl Folder {
    /// The solution of a scene in this folder.
    #[track_caller]
    pub(crate) fn solved(&self, line: &str) -> Solved {
        solve(line, &self.0).unwrap_or_else(|refused| panic!("{line}: {refused:?}"))
    }

    /// The answer as the program prints it.
    #[track_caller]
    pub(crate) fn json(&self, line: &str) -> Value {
        serde_json::to_value(&self.solved(line).answer).expect("JSON")
    }

    /// The answer of the text of a scene.
    #[track_caller]
    pub(crate) fn answer(&self, text: impl AsRef<[u8]>) -> Value {
        self.write("scene.toml", text);
        self.json("scene.toml")
    }

    /// Requires that a scene ends with a status and one line that says this; the line, without the path of this folder.
    #[track_caller]
    pub(crate) fn ends(&self, line: &str, status: u8, needed: &str) -> String {
        let ended = solve(line, &self.0).map(|solved| solved.answer);
        let Err((found, message)) = ended else {
            panic!("{line} is answered: {ended:?}");
        };
        let message = message.replace(&format!("{}/", self.0.display()), "");
        let is_right = found == status && message.contains(needed) && !message.contains('\n');
        assert!(
            is_right,
            "{line}: needs {status} and {needed:?}, but {found} and {message:?}"
        );
        message
    }
}

/// A quantity with its error.
#[track_caller]
pub(crate) fn estimate(result: &Value, field: &str) -> Estimate {
    Estimate::new(
        number(result, field),
        number(result, &format!("{field}_error")),
    )
}

/// Requires that two values differ by their errors at most, which together are less than a part of the second one, or of
/// one where that is zero, and zero only of a part of zero.
#[track_caller]
pub(crate) fn assert_agree(what: impl Display, one: Estimate, other: Estimate, part: f64) {
    let error = one.error + other.error;
    let is_zero = other.value == 0.0;
    let scale = if is_zero { 1.0 } else { other.value.abs() };
    let is_small = (error > 0.0 && error < part * scale) || (error == 0.0 && part == 0.0);
    let agree = (one.value - other.value).abs() <= error;
    assert!(agree && is_small, "{what}: {one:?} and {other:?}");
}
