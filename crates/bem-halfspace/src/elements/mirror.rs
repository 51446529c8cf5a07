//! Mirror planes of symmetric fields. The *symmetry-reduced domain* is the half of a grid on one side of a mirror, towards larger indices,
//! or with two mirrors the quarter between them; only it is stored.
//!
//! Theory: docs/theory/contact.md, "Mirrors".

/// Mirror across one axis of a grid.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum Mirror {
    /// No symmetry, or none that the grid has.
    None,
    /// Symmetry about the centres of a row or column, the first one of the symmetry-reduced domain.
    Centre,
    /// Symmetry about the edge between two rows or columns.
    Edge,
}

/// No mirror along either axis.
pub(crate) const NO_MIRRORS: [Mirror; 2] = [Mirror::None; 2];

impl Mirror {
    /// Number of rows or columns of the symmetry-reduced domain of `whole`, which is odd for a mirror about a centre and even for one
    /// about an edge.
    pub(crate) const fn folded_len(self, whole: usize) -> usize {
        match self {
            Self::None => whole,
            Self::Centre => whole / 2 + 1,
            Self::Edge => whole / 2,
        }
    }

    /// Number of rows or columns of the whole grid, of which `part` are in the symmetry-reduced domain.
    pub(crate) const fn unfolded_len(self, part: usize) -> usize {
        match self {
            Self::None => part,
            Self::Centre => 2 * part - 1,
            Self::Edge => 2 * part,
        }
    }

    /// True without symmetry.
    pub(crate) const fn is_none(self) -> bool {
        matches!(self, Self::None)
    }

    /// The mirror of the grid of blocks of two by two elements over the same symmetry-reduced domain, whose blocks begin at the mirror.
    pub(crate) const fn of_blocks(self) -> Self {
        match self {
            Self::None => Self::None,
            Self::Centre | Self::Edge => Self::Edge,
        }
    }
}

/// Number of images of the symmetry-reduced domain that make up the whole: 1, 2 or 4.
pub(crate) fn n_images(mirrors: [Mirror; 2]) -> f64 {
    let count = |mirror: Mirror| if mirror.is_none() { 1.0 } else { 2.0 };
    mirrors.into_iter().map(count).product()
}
