//! What the tests of scenes share.

use std::fs;
use std::path::{Path, PathBuf};
use std::process::{Command, Output};

use serde_json::Value;

/// An empty folder of this name.
pub(crate) fn folder(name: &str) -> PathBuf {
    let folder = Path::new(env!("CARGO_TARGET_TMPDIR")).join(name);
    fs::remove_dir_all(&folder).ok();
    fs::create_dir_all(&folder).expect("the folder can be made");
    folder
}

/// The command, ready to run.
pub(crate) fn command(arguments: &[&str]) -> Command {
    let mut command = Command::new(env!("CARGO_BIN_EXE_viscofriction"));
    command.args(arguments);
    command
}

/// The command, run.
pub(crate) fn viscofriction(arguments: &[&str]) -> Output {
    command(arguments).output().expect("the command runs")
}

/// What is wrong with a refusal that should end with status 2 and one line that begins with `error: ` and the place,
/// and says what is needed; nothing if it does.
pub(crate) fn complaint(arguments: &[&str], place: &str, needed: &str) -> Option<String> {
    let output = viscofriction(arguments);
    let message = text(&output.stderr);
    let helpful = message.starts_with(&format!("error: {place}: ")) && message.contains(needed);
    let brief = message.trim_end().lines().count() == 1 && output.stdout.is_empty();
    let right = output.status.code() == Some(2) && helpful && brief;
    (!right).then(|| {
        let status = output.status;
        format!("needs status 2, {place:?} and {needed:?}, but {status} says: {message}")
    })
}

pub(crate) fn text(bytes: &[u8]) -> String {
    String::from_utf8_lossy(bytes).into_owned()
}

/// A path as an argument.
pub(crate) fn argument(path: &Path) -> &str {
    path.to_str().expect("a path in Unicode")
}

/// A committed scene.
pub(crate) fn example(name: &str) -> PathBuf {
    let root = Path::new(env!("CARGO_MANIFEST_DIR"));
    root.join("../../examples/scenes").join(name)
}

/// A committed table of measured moduli.
pub(crate) fn measured(name: &str) -> PathBuf {
    let root = Path::new(env!("CARGO_MANIFEST_DIR"));
    root.join("../rheology/tests/data").join(name)
}

/// A quantity of a result.
pub(crate) fn number(result: &Value, field: &str) -> f64 {
    let value = result[field].as_f64();
    value.unwrap_or_else(|| panic!("{field} is missing in {result}"))
}

/// A quantity with its error.
pub(crate) fn bar(result: &Value, field: &str) -> [f64; 2] {
    [field.to_owned(), format!("{field}_error")].map(|field| number(result, &field))
}

/// The result of a scene as JSON.
pub(crate) fn run_json(arguments: &[&str]) -> Value {
    let output = viscofriction(&[&["run", "--format", "json"], arguments].concat());
    let message = text(&output.stderr);
    assert_eq!(output.status.code(), Some(0), "{arguments:?}: {message}");
    serde_json::from_slice(&output.stdout).expect("JSON")
}

/// A file of NumPy in the format 1.0, of a header and numbers.
pub(crate) fn npy(header: &str, numbers: &[u8]) -> Vec<u8> {
    // Up to a line feed in front of a multiple of 64 bytes.
    let length = (10 + header.len() + 1).next_multiple_of(64) - 10;
    let counted = u16::try_from(length).expect("a short header");
    let line = format!("{header:<padded$}\n", padded = length - 1);
    let start = b"\x93NUMPY\x01\x00";
    [start, &counted.to_le_bytes()[..], line.as_bytes(), numbers].concat()
}
