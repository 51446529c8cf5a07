//! Memory limit of the readers, checked before allocation.

use super::TopographyError;

/// Memory per height while a surface is read, \[bytes]. Chosen: it covers five copies of 8 bytes and vectors that grow.
const BYTES_PER_HEIGHT: u64 = 64;

/// Memory that a reader may use in addition to the contents of the file, \[bytes].
#[derive(Clone, Copy)]
pub(super) struct Memory(pub(super) u64);

impl Memory {
    /// Refuses a number of heights that does not fit; `None` is an overflowed product.
    pub(super) fn require_heights(self, points: Option<usize>) -> Result<(), TopographyError> {
        self.require(points, 0)
    }

    /// Refuses a text whose numbers do not fit together with a copy of it, in which a byte may become two.
    pub(super) fn require_text(self, text: &[u8]) -> Result<(), TopographyError> {
        self.require(Some(max_numbers(text)), 2 * text.len() as u64)
    }

    /// Refuses a number of heights that does not fit together with `other` bytes.
    fn require(self, points: Option<usize>, other: u64) -> Result<(), TopographyError> {
        let points = points.map_or(u64::MAX, |points| points as u64);
        let needed = points
            .saturating_mul(BYTES_PER_HEIGHT)
            .saturating_add(other);
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

/// Upper bound on the number of numbers in a text, which separators or blanks delimit.
fn max_numbers(text: &[u8]) -> usize {
    let is_end = |pair: &&[u8]| {
        let is_blank = !pair[1].is_ascii_graphic() && pair[0].is_ascii_graphic();
        is_blank || b",;\t\n".contains(&pair[1])
    };
    1 + text.windows(2).filter(is_end).count()
}
