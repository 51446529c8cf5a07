//! Places in the text of a file, and the error that names them.

/// The input was wrong; one line that names the place.
#[derive(Debug, Clone, PartialEq, Eq, thiserror::Error)]
#[error("{}", _0.replace(char::is_control, " "))]
pub struct WrongInput(pub String);

/// The lines at which the records of a CSV file begin, in their order.
#[derive(Debug)]
pub(crate) struct RecordLines<'a> {
    contents: &'a [u8],
    /// Up to where lines were counted.
    counted: usize,
    /// The line there, counted from 1.
    line: usize,
}

impl<'a> RecordLines<'a> {
    pub(crate) const fn new(contents: &'a [u8]) -> Self {
        Self {
            contents,
            counted: 0,
            line: 1,
        }
    }

    /// The line of a record that is not before the one asked for last; empty lines before it belong to its position.
    pub(crate) fn of(&mut self, position: Option<&csv::Position>) -> usize {
        let start = position.map_or(0, csv::Position::byte);
        let start = usize::try_from(start).unwrap_or(usize::MAX);
        let start = start.clamp(self.counted, self.contents.len());
        let is_break = |byte: &&u8| b"\r\n".contains(byte);
        let breaks = self.contents[start..].iter().take_while(is_break);
        let start = start + breaks.count();
        self.line += line_of(&self.contents[self.counted..], start - self.counted) - 1;
        self.counted = start;
        self.line
    }
}

/// The line of an offset in a text, counted from 1.
pub fn line_of(text: &[u8], offset: usize) -> usize {
    let before = text.iter().take(offset);
    1 + before.filter(|byte| **byte == b'\n').count()
}
