//! Places in the text of a file, and the error that names them.

use std::path::Path;

/// The input was wrong; one line that names the place.
#[derive(Debug, Clone, PartialEq, Eq, thiserror::Error)]
#[error("{}", _0.replace(char::is_control, " "))]
pub struct WrongInput(pub String);

/// Reads a file that a scene names; the sentence of a failure names it.
pub type ReadFile = fn(&Path) -> Result<Vec<u8>, WrongInput>;

/// The line at which a record of a CSV file begins, counted from 1; empty lines before it belong to its position.
pub fn line_of_record(contents: &[u8], position: Option<&csv::Position>) -> usize {
    let start = position.map_or(0, csv::Position::byte);
    let start = usize::try_from(start).unwrap_or(usize::MAX);
    let start = start.min(contents.len());
    let is_break = |byte: &&u8| b"\r\n".contains(byte);
    let breaks = contents[start..].iter().take_while(is_break);
    line_of(contents, start + breaks.count())
}

/// The line of an offset in a text, counted from 1.
pub fn line_of(text: &[u8], offset: usize) -> usize {
    let before = text.iter().take(offset);
    1 + before.filter(|byte| **byte == b'\n').count()
}
