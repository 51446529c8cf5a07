//! How much memory reading may take; it is asked before it is taken.

use super::TopographyError;

/// Of each height, \[bytes]: it is there as a part of its line, as it was read, with holes filled, turned, and in the body, and
/// lists are copied while they grow.
const PER_HEIGHT: u64 = 64;

/// Memory that reading may take beside the contents of the file, \[bytes].
#[derive(Clone, Copy)]
pub(super) struct Memory(pub(super) u64);

impl Memory {
    /// Refuses more heights than it holds; a product that overflows stands for more than any.
    pub(super) fn holds(self, points: Option<usize>) -> Result<(), TopographyError> {
        self.holds_beside(points, 0)
    }

    /// Refuses a text of more numbers than it holds, with a copy of the text in which a byte may become two.
    pub(super) fn holds_text(self, text: &[u8]) -> Result<(), TopographyError> {
        self.holds_beside(Some(cells(text)), 2 * text.len() as u64)
    }

    /// Refuses more heights than it holds beside so many bytes of something else.
    fn holds_beside(self, points: Option<usize>, other: u64) -> Result<(), TopographyError> {
        let points = points.map_or(u64::MAX, |points| points as u64);
        let needed = points.saturating_mul(PER_HEIGHT).saturating_add(other);
        let allowed = self.0;
        if needed <= allowed {
            return Ok(());
        }
        Err(TopographyError::Memory {
            points,
            needed,
            allowed,
        })
    }
}

/// As many numbers as a text has at most: between separators, or blanks of any kind.
fn cells(text: &[u8]) -> usize {
    let is_end = |pair: &&[u8]| {
        let is_blank = !pair[1].is_ascii_graphic() && pair[0].is_ascii_graphic();
        is_blank || b",;\t\n".contains(&pair[1])
    };
    1 + text.windows(2).filter(is_end).count()
}
