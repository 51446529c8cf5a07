//! Elements, where they are, and how exactly the contact on them is solved.

use crate::elements::bounds::Bounds;
use crate::elements::mirror::Mirror;
use crate::{BemError, ContactOptions, Footprint};
use numerics::positive;

/// One grid for pressing and sliding in time.
#[derive(Debug, Clone, Copy, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize))]
pub struct GridOptions {
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
    /// About the centre of that element; the elements behind them are not followed.
    pub(crate) mirrors: [Mirror; 2],
}

impl GridOptions {
    /// A grid with contacts solved to the default tolerance.
    pub fn new(spacing: [f64; 2], footprint: Footprint) -> Self {
        Self {
            spacing,
            footprint,
            contact: ContactOptions::default(),
        }
    }

    /// The elements under an indenter which is its own mirror image along the axes where `even` says so.
    pub(crate) fn layout(&self, even: [bool; 2]) -> Result<Layout, BemError> {
        positive("spacing along x", self.spacing[0])?;
        positive("spacing along y", self.spacing[1])?;
        self.contact.validate()?;
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
    /// Number of elements in front of the mirrors.
    pub(crate) fn folded_shape(&self) -> [usize; 2] {
        [0, 1].map(|axis| self.mirrors[axis].part_of(self.shape[axis]))
    }

    /// The first element in front of the mirrors.
    pub(crate) fn first(&self) -> [usize; 2] {
        let folded = self.folded_shape();
        [0, 1].map(|axis| self.shape[axis] - folded[axis])
    }

    /// An element of the footprint and its images; one through which a mirror passes appears once for either half.
    pub(crate) fn images_of(&self, element: [usize; 2]) -> impl Iterator<Item = [usize; 2]> {
        let [rows, columns] = [0, 1].map(|axis| {
            let index = element[axis];
            let image = self.shape[axis] - 1 - index;
            std::iter::once(index).chain((!self.mirrors[axis].is_none()).then_some(image))
        });
        rows.flat_map(move |row| columns.clone().map(move |column| [row, column]))
    }

    /// Number of elements of the footprint that an element in front of the mirrors stands for.
    pub(crate) fn n_images_of(&self, element: [usize; 2]) -> usize {
        let along = |axis: usize| {
            let has_image = !self.mirrors[axis].is_none() && element[axis] != self.apex[axis];
            1 + usize::from(has_image)
        };
        along(0) * along(1)
    }

    /// The box of the footprint around the elements of a box in front of the mirrors and their images.
    pub(crate) fn unfolded(&self, front: &Bounds) -> Bounds {
        let first = self.first();
        let upper = [0, 1].map(|axis| first[axis] + front.upper[axis]);
        let lower = [0, 1].map(|axis| {
            if self.mirrors[axis].is_none() {
                front.lower[axis]
            } else {
                self.shape[axis] - upper[axis]
            }
        });
        Bounds { lower, upper }
    }
}
