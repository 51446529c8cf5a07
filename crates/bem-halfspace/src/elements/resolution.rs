//! Grid options of transient simulations, and the layout of the elements under the indenter.

use crate::elements::bounds::Bounds;
use crate::elements::mirror::Mirror;
use crate::{BemError, ContactOptions, Footprint};
use numerics::positive;

/// Grid and contact tolerance of a simulation of pressing or sliding in time.
#[derive(Debug, Clone, Copy, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize))]
pub struct GridOptions {
    /// Edges of an element [Δx, Δy], \[m].
    pub spacing: [f64; 2],
    /// Rectangle in which contact may occur, in the frame of the indenter.
    pub footprint: Footprint,
    /// Stopping criteria of the contact of each step.
    pub contact: ContactOptions,
}

/// Arrangement of the elements under the indenter: their number, the one under the lowest point, and the mirrors.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) struct Layout {
    /// Numbers of elements [n_x, n_y] of the footprint.
    pub(crate) shape: [usize; 2],
    /// The element [row, column] under the lowest point.
    pub(crate) apex: [usize; 2],
    /// Mirrors about the centre of that element; only elements of the symmetry-reduced domain are computed.
    pub(crate) mirrors: [Mirror; 2],
}

impl GridOptions {
    /// Options for a grid with element edges `spacing` \[m] in a footprint, with contacts solved to the default tolerance.
    pub fn new(spacing: [f64; 2], footprint: Footprint) -> Self {
        Self {
            spacing,
            footprint,
            contact: ContactOptions::default(),
        }
    }

    /// The layout under an indenter that is its own mirror image about x = 0 if `even[0]`, and about y = 0 if `even[1]`. A mirror also
    /// needs a symmetric footprint.
    pub(crate) fn layout(&self, even: [bool; 2]) -> Result<Layout, BemError> {
        positive("spacing along x", self.spacing[0])?;
        positive("spacing along y", self.spacing[1])?;
        self.contact.validate()?;
        // The lowest point lies over the centre of one more element between the two sides.
        let counts = self.footprint.elements(self.spacing)?;
        Ok(Layout {
            shape: counts.map(|[before, after]| before + after + 1),
            apex: counts.map(|[before, _]| before),
            mirrors: [0, 1].map(|axis| {
                let [before, after] = counts[axis];
                if even[axis] && before == after {
                    Mirror::Centre
                } else {
                    Mirror::None
                }
            }),
        })
    }
}

impl Layout {
    /// Number of elements [n_x, n_y] of the symmetry-reduced domain.
    pub(crate) fn folded_shape(&self) -> [usize; 2] {
        [0, 1].map(|axis| self.mirrors[axis].folded_len(self.shape[axis]))
    }

    /// The first element [row, column] of the footprint in the symmetry-reduced domain.
    pub(crate) fn first(&self) -> [usize; 2] {
        let folded = self.folded_shape();
        [0, 1].map(|axis| self.shape[axis] - folded[axis])
    }

    /// An element [row, column] of the footprint and its images; an element on a mirror appears once for each half.
    pub(crate) fn images_of(&self, element: [usize; 2]) -> impl Iterator<Item = [usize; 2]> {
        let [rows, columns] = [0, 1].map(|axis| {
            let index = element[axis];
            let image = self.shape[axis] - 1 - index;
            std::iter::once(index).chain((!self.mirrors[axis].is_none()).then_some(image))
        });
        rows.flat_map(move |row| columns.clone().map(move |column| [row, column]))
    }

    /// The element of the symmetry-reduced domain, counted from its first one, that has an element [row, column] of the footprint as its
    /// image.
    pub(crate) fn folded_element(&self, element: [usize; 2]) -> [usize; 2] {
        let first = self.first();
        [0, 1].map(|axis| match element[axis] {
            index if index < first[axis] => self.shape[axis] - 1 - index - first[axis],
            index => index - first[axis],
        })
    }

    /// Number of different elements of the footprint that are images of an element of the symmetry-reduced domain, itself included.
    pub(crate) fn n_images_of(&self, element: [usize; 2]) -> usize {
        let along = |axis: usize| {
            let has_image = !self.mirrors[axis].is_none() && element[axis] != self.apex[axis];
            1 + usize::from(has_image)
        };
        along(0) * along(1)
    }

    /// The smallest box of the footprint that holds a box of the symmetry-reduced domain and its images; `folded` counts rows and
    /// columns from the first element of that domain.
    pub(crate) fn unfolded(&self, folded: &Bounds) -> Bounds {
        let first = self.first();
        let upper = [0, 1].map(|axis| first[axis] + folded.upper[axis]);
        let lower = [0, 1].map(|axis| {
            if self.mirrors[axis].is_none() {
                folded.lower[axis]
            } else {
                self.shape[axis] - upper[axis]
            }
        });
        Bounds { lower, upper }
    }
}
