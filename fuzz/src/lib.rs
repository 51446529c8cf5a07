//! What every fuzz target asks: a file is accepted, or refused with one line that begins with its name.

use std::path::Path;

use viscofriction_cli::{InputKind, check_input};

/// Checks the contents of a file; panics when a refusal does not help.
pub fn check(kind: InputKind, file: &str, contents: &[u8]) {
    let Err(error) = check_input(kind, Path::new(file), contents) else {
        return;
    };
    let message = error.to_string();
    assert!(
        message.starts_with(file) && !message.contains(['\n', '\r']),
        "no help: {message:?}"
    );
}
