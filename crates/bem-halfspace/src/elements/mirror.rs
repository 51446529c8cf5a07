//! Planes about which the fields on a grid are their own mirror images.

/// A mirror across one axis of a grid, of which only the part in front of it is kept.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum Mirror {
    /// No symmetry, or none that the grid shares.
    None,
    /// About the centre of a row or column, the first of the part.
    Centre,
    /// About the edge between two rows or columns.
    Edge,
}

/// Along neither axis.
pub(crate) const NO_MIRRORS: [Mirror; 2] = [Mirror::None; 2];

impl Mirror {
    /// Number of rows or columns in front of a mirror in the middle of so many: an odd number with one about a centre, an
    /// even one with one about an edge.
    pub(crate) const fn part_of(self, whole: usize) -> usize {
        match self {
            Self::None => whole,
            Self::Centre => whole / 2 + 1,
            Self::Edge => whole / 2,
        }
    }

    /// Number of rows or columns of which so many are in front of the mirror.
    pub(crate) const fn whole_of(self, part: usize) -> usize {
        match self {
            Self::None => part,
            Self::Centre => 2 * part - 1,
            Self::Edge => 2 * part,
        }
    }

    pub(crate) const fn is_none(self) -> bool {
        matches!(self, Self::None)
    }

    /// The mirror of a coarser grid over the same part: elements of twice the edges have no centre there.
    pub(crate) const fn of_blocks(self) -> Self {
        match self {
            Self::None => Self::None,
            Self::Centre | Self::Edge => Self::Edge,
        }
    }
}

/// How often the loads in front of mirrors count.
pub(crate) fn n_images(mirrors: [Mirror; 2]) -> f64 {
    let count = |mirror: Mirror| if mirror.is_none() { 1.0 } else { 2.0 };
    mirrors.into_iter().map(count).product()
}
