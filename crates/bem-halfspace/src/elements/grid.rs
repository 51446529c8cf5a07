//! Regular grids of rectangular elements.

use crate::BemError;
use crate::elements::mirror::Mirror;
use numerics::{positive, whole_part};

/// Largest number of elements of a grid, 2^28. Larger grids are refused with [`BemError::GridTooLarge`], to limit the memory.
/// Chosen: with 150 bytes for an element the largest grid takes 37.5 GiB.
pub(crate) const MAX_ELEMENTS: f64 = (1_u64 << 28) as f64;
/// Smallest number of elements along an edge of the coarsest grid: of a nested iteration, and of a refinement along an edge of a period
/// with waves.
///
/// Chosen; from 8 to 32 no answer of `evidence tuning` changes by more than 1e-9 of its bar.
pub(crate) const MIN_COARSEST_EDGE: usize = 32;

/// A regular grid of rectangular elements, stored row-major with y fastest.
#[derive(Debug, Clone, Copy, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize))]
pub struct Grid {
    /// Numbers of elements n_x and n_y.
    shape: [usize; 2],
    /// Edges Δx and Δy of an element, \[m].
    spacing: [f64; 2],
}

impl Grid {
    /// `shape` = (n_x, n_y) elements with edges of length `spacing` = (Δx, Δy), \[m].
    ///
    /// # Errors
    /// [`BemError::InvalidParameter`] for an empty grid or a spacing that is not finite and greater than zero;
    /// [`BemError::GridTooLarge`] above 2^28 elements.
    pub fn new(shape: [usize; 2], spacing: [f64; 2]) -> Result<Self, BemError> {
        positive("spacing along x", spacing[0])?;
        positive("spacing along y", spacing[1])?;
        positive("number of elements along x", shape[0] as f64)?;
        positive("number of elements along y", shape[1] as f64)?;
        let elements = shape[0] as f64 * shape[1] as f64;
        if elements > MAX_ELEMENTS {
            return Err(BemError::GridTooLarge {
                elements,
                limit: MAX_ELEMENTS,
            });
        }
        Ok(Self { shape, spacing })
    }

    /// The grid of blocks of two by two elements that covers this one.
    pub(crate) fn blocks(&self) -> Self {
        Self {
            shape: self.shape.map(|n| n.div_ceil(2)),
            spacing: self.spacing.map(|edge| 2.0 * edge),
        }
    }

    /// The symmetry-reduced domain of this grid, for mirrors through its middle.
    pub(crate) fn folded(&self, mirrors: [Mirror; 2]) -> Self {
        Self {
            shape: [0, 1].map(|axis| mirrors[axis].folded_len(self.shape[axis])),
            ..*self
        }
    }

    /// The whole grid of which this one is the symmetry-reduced domain.
    pub(crate) fn unfolded(&self, mirrors: [Mirror; 2]) -> Self {
        Self {
            shape: [0, 1].map(|axis| mirrors[axis].unfolded_len(self.shape[axis])),
            ..*self
        }
    }

    /// Number of elements [n_x, n_y].
    pub const fn shape(&self) -> [usize; 2] {
        self.shape
    }

    /// Edges of an element [Δx, Δy], \[m].
    pub const fn spacing(&self) -> [f64; 2] {
        self.spacing
    }

    /// Number of elements.
    pub const fn n_elements(&self) -> usize {
        self.shape[0] * self.shape[1]
    }

    /// Area of an element, \[m²].
    pub fn element_area(&self) -> f64 {
        self.spacing[0] * self.spacing[1]
    }
}

/// Number of elements of the edge `spacing` that cover a length, both in \[m]. Fails with [`BemError::GridTooLarge`] for more than a
/// grid may have.
pub(crate) fn elements_along(length: f64, spacing: f64) -> Result<usize, BemError> {
    // An integer ratio must not gain an element by rounding, or results would depend on the unit of length.
    whole_elements((length / spacing * (1.0 - 4.0 * f64::EPSILON)).ceil())
}

/// Converts an integral number of elements to an integer, a negative one to 0. Fails with [`BemError::GridTooLarge`] for NaN and for
/// more than a grid may have.
pub(crate) fn whole_elements(elements: f64) -> Result<usize, BemError> {
    if elements > MAX_ELEMENTS || elements.is_nan() {
        return Err(BemError::GridTooLarge {
            elements,
            limit: MAX_ELEMENTS,
        });
    }
    Ok(whole_part(elements))
}
