//! Line numbers in text files, and the error that reports them.

/// Invalid input: a message that names file and line where it can. Line breaks and other control characters are printed as
/// blanks.
#[derive(Debug, Clone, PartialEq, Eq, thiserror::Error)]
#[error("{}", _0.replace(char::is_control, " "))]
pub struct WrongInput(pub String);

/// Line numbers of the records of a CSV file, queried in their order.
#[derive(Debug)]
pub(crate) struct RecordLines<'a> {
    contents: &'a [u8],
    /// Offset up to which lines were counted.
    counted: usize,
    /// Line at that offset, counted from 1.
    line: usize,
}

impl<'a> RecordLines<'a> {
    /// Starts at the first line of a file.
    pub(crate) const fn new(contents: &'a [u8]) -> Self {
        Self {
            contents,
            counted: 0,
            line: 1,
        }
    }

    /// Line of a record, counted from 1; the record must not precede the one queried before. `position` is where the reader
    /// began, which may be at empty lines before the record; they are skipped.
    pub(crate) fn of(&mut self, position: Option<&csv::Position>) -> usize {
        let given = position.map_or(0, csv::Position::byte);
        let began = usize::try_from(given)
            .unwrap_or(usize::MAX)
            .clamp(self.counted, self.contents.len());
        let is_break = |byte: &&u8| b"\r\n".contains(byte);
        let breaks = self.contents[began..].iter().take_while(is_break);
        let start = began + breaks.count();
        self.line += line_of(&self.contents[self.counted..], start - self.counted) - 1;
        self.counted = start;
        self.line
    }
}

/// Line of an offset in a text, counted from 1.
pub fn line_of(text: &[u8], offset: usize) -> usize {
    let before = text.iter().take(offset);
    1 + before.filter(|byte| **byte == b'\n').count()
}
