//! Elements, where they are, and how exactly the contact on them is solved.

use crate::error::positive;
use crate::{BemError, ContactOptions, Footprint};

/// Resolution of a half space under an indenter.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Resolution {
    /// Edges of an element [Δx, Δy], \[m].
    pub spacing: [f64; 2],
    /// Where contact may occur, seen from the indenter.
    pub footprint: Footprint,
    /// How exactly each step is solved.
    pub contact: ContactOptions,
}

/// The elements under the indenter.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) struct Layout {
    /// Number of elements of the footprint.
    pub(crate) shape: [usize; 2],
    /// The element under the lowest point.
    pub(crate) apex: [usize; 2],
}

impl Resolution {
    pub(crate) fn layout(&self) -> Result<Layout, BemError> {
        positive("spacing along x", self.spacing[0])?;
        positive("spacing along y", self.spacing[1])?;
        self.contact.validate()?;
        let counts = self.footprint.elements(self.spacing)?;
        Ok(Layout {
            shape: counts.map(|[before, after]| before + after + 1),
            apex: counts.map(|[before, _]| before),
        })
    }
}
