//! The kind of a contact: single body, line or period.

use crate::{BemError, Grid, PressureField};

/// What a field on a grid is part of.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum ContactKind {
    /// The contact of a single body. Nothing outside the grid is heated.
    Body,
    /// A line contact, infinite along y; the field has one column of elements, of any length. At rest there is no stationary temperature:
    /// it grows like the logarithm of the time.
    Line,
    /// One period of a surface that has been sliding for a time ≥ 0 \[s], with whose root the mean temperature grows. All waves are
    /// stationary: they are after a multiple of L²/(4π²D), with the period L and the diffusivity D.
    Period {
        /// Time for which the surface has been sliding, \[s].
        duration: f64,
    },
}

impl ContactKind {
    /// Area of an element, \[m²]; of a line contact the edge along x, \[m].
    pub(super) fn area_of_element(self, grid: &Grid) -> f64 {
        match self {
            Self::Line => grid.spacing()[0],
            Self::Body | Self::Period { .. } => grid.element_area(),
        }
    }

    /// A grid of elements of `factor` times the edges along the axes with more than one element; a period stays the same.
    pub(super) fn coarse_grid(self, grid: &Grid, factor: usize) -> Result<Grid, BemError> {
        let (shape, spacing) = (grid.shape(), grid.spacing());
        let new_shape = shape.map(|n| n.div_ceil(factor));
        let new_spacing = [0, 1].map(|axis| match self {
            Self::Period { .. } => spacing[axis] * shape[axis] as f64 / new_shape[axis] as f64,
            _ if shape[axis] == 1 => spacing[axis],
            _ => spacing[axis] * factor as f64,
        });
        Grid::new(new_shape, new_spacing)
    }
}

/// The means of a field over the elements of a coarse grid that begins at the same place; elements outside of the field count as 0.
pub(super) fn coarsened(field: &PressureField, grid: &Grid) -> PressureField {
    let shift = [0, 1].map(|axis| 0.5 * (grid.spacing()[axis] - field.grid.spacing()[axis]));
    let origin = [0, 1].map(|axis| field.origin[axis] + shift[axis]);
    field.resampled(grid, origin)
}
