//! Pressure on the elements of a grid.

use numerics::whole_part;

use crate::elements::area;
use crate::elements::bounds::Bounds;
use crate::elements::mirror::NO_MIRRORS;
use crate::{BemError, Grid};

/// Pressure in the contact, on a grid of elements.
#[derive(Debug, Clone, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize))]
pub struct PressureField {
    /// The grid of the field.
    pub grid: Grid,
    /// Centre of the first element relative to the lowest point of the indenter, \[m].
    pub origin: [f64; 2],
    /// Pressure P ≥ 0, \[Pa], row-major with y fastest. At the front edge it may be singular; its maximum then grows without
    /// limit on refinement.
    pub pressure: Vec<f64>,
}

impl PressureField {
    /// The field on the box `bounds`, whose first element has its centre at `origin` \[m].
    ///
    /// `loaded` gives elements [row, column] of the field in which the box lies, with their pressures \[Pa]; pressures given for the
    /// same element add up.
    pub(crate) fn from_elements(
        bounds: &Bounds,
        spacing: [f64; 2],
        origin: [f64; 2],
        loaded: impl Iterator<Item = ([usize; 2], f64)>,
    ) -> Result<Self, BemError> {
        let grid = Grid::new(bounds.shape(), spacing)?;
        let mut pressure = vec![0.0; grid.n_elements()];
        for (element, value) in loaded {
            pressure[bounds.index_of(element)] += value;
        }
        Ok(Self {
            grid,
            origin,
            pressure,
        })
    }

    /// Contact area, \[m²]: that of the elements with pressure, with the perimeter correction of Yastrebov, Anciaux & Molinari
    /// (2017).
    pub fn contact_area(&self) -> f64 {
        let bounds = Bounds {
            lower: [0; 2],
            upper: self.grid.shape(),
        };
        let elements = area::area_in_elements(&self.pressure, &bounds, NO_MIRRORS);
        elements * self.grid.element_area()
    }

    /// Centre \[m] and pressure \[Pa] of the elements along x, from rear to front, on the first line along x. In plane strain there is
    /// one line only.
    pub fn along_x(&self) -> Vec<[f64; 2]> {
        let ([_, columns], [dx, _]) = (self.grid.shape(), self.grid.spacing());
        let line = self.pressure.iter().step_by(columns).enumerate();
        line.map(|(row, pressure)| [self.origin[0] + row as f64 * dx, *pressure])
            .collect()
    }

    /// Largest pressure of an element, \[Pa].
    pub fn largest(&self) -> f64 {
        self.pressure.iter().copied().fold(0.0, f64::max)
    }

    /// Pressure of the element at a `position` \[m] relative to the lowest point, \[Pa]; zero outside the field.
    pub fn pressure_at(&self, position: [f64; 2]) -> f64 {
        // The element whose edges enclose the position.
        let [rows, columns] = self.grid.shape();
        let index =
            |axis: usize| (position[axis] - self.origin[axis]) / self.grid.spacing()[axis] + 0.5;
        let [row, column] = [index(0).floor(), index(1).floor()];
        if !(row >= 0.0 && row < rows as f64 && column >= 0.0 && column < columns as f64) {
            return 0.0;
        }
        self.pressure[whole_part(row) * columns + whole_part(column)]
    }
}
