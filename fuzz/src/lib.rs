//! What is asked of every reader: a file is accepted, or refused with one line that names it and the place in it.

use std::path::Path;

use viscofriction_cli::{InputKind, check_input};

/// Formats of heights that have no lines.
const WITHOUT_LINES: [&str; 4] = ["gsf", "npy", "sur", "x3p"];

/// Checks the contents of a file; whether they are accepted.
///
/// # Errors
/// The message of a refusal that does not say where the file is wrong.
pub fn check(kind: InputKind, file: &Path, contents: &[u8]) -> Result<bool, String> {
    let Err(error) = check_input(kind, file, contents) else {
        return Ok(true);
    };
    let message = error.to_string();
    if names_place(&message, file, contents) {
        Ok(false)
    } else {
        Err(message)
    }
}

/// Whether a refusal begins with the file and a line that it has, or the one behind its end; of a format without lines the file
/// is enough.
fn names_place(message: &str, file: &Path, contents: &[u8]) -> bool {
    let lines = 1 + contents.split(|byte| *byte == b'\n').count();
    let names_line = |rest: &str| {
        let rest = rest.strip_prefix(':').or(rest.strip_prefix(", line "))?;
        let (line, why) = rest.split_once([':', ',', ' '])?;
        let line: usize = line.parse().ok()?;
        ((1..=lines).contains(&line) && !why.trim_matches([':', ',', ' ']).is_empty()).then_some(())
    };
    let extension = file.extension().unwrap_or_default().to_string_lossy();
    let has_no_lines = WITHOUT_LINES.contains(&extension.as_ref());
    let rest = message.strip_prefix(&file.display().to_string());
    let is_named =
        |rest: &str| has_no_lines && rest.starts_with(": ") || names_line(rest).is_some();
    rest.is_some_and(is_named) && !message.contains(['\n', '\r'])
}
