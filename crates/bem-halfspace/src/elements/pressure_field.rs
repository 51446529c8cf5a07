//! Pressure on the elements of a grid.

use indenters::Surface;
use numerics::{positive, whole_part};

use crate::elements::area;
use crate::elements::bounds::Bounds;
use crate::elements::mirror::NO_MIRRORS;
use crate::error::check_length;
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

    /// Refuses a field without one pressure per element, and one without a positive pressure.
    pub(crate) fn check_contact(&self) -> Result<(), BemError> {
        check_length("pressure", self.pressure.len(), self.grid.n_elements())?;
        positive("largest pressure", self.largest())?;
        Ok(())
    }

    /// The field on another `grid` whose first element has its centre at `origin` relative to the lowest point, \[m].
    ///
    /// Each new element has the mean pressure over its area, so that the force is the same if the grid covers the contact;
    /// elements outside of the grid do not contribute.
    #[must_use]
    pub fn resampled(&self, grid: &Grid, origin: [f64; 2]) -> Self {
        let [along, across] = [0, 1].map(|axis| self.overlaps(axis, grid, origin[axis]));
        let [_, old_columns] = self.grid.shape();
        let [_, columns] = grid.shape();
        let mut pressure = vec![0.0; grid.n_elements()];
        for (new_row, old_row, part_of_row) in along {
            let old = &self.pressure[old_row * old_columns..][..old_columns];
            let new = &mut pressure[new_row * columns..][..columns];
            for &(new_column, old_column, part) in &across {
                new[new_column] += part_of_row * part * old[old_column];
            }
        }
        Self {
            grid: *grid,
            origin,
            pressure,
        }
    }

    /// Overlaps along an axis of the elements of a new `grid`, whose first element has its centre at `origin` \[m], with the old
    /// ones: index of the new element, index of the old one, and the part of the new element that the old one covers.
    fn overlaps(&self, axis: usize, grid: &Grid, origin: f64) -> Vec<(usize, usize, f64)> {
        let [old, new] = [&self.grid, grid].map(|grid| grid.spacing()[axis]);
        let n_old = self.grid.shape()[axis];
        // Find the old elements that each new element overlaps. Its ends are measured in edges of old elements, from the rear end
        // of the first one.
        let start = (origin - self.origin[axis] - 0.5 * new) / old + 0.5;
        let ratio = new / old;
        let pairs = (0..grid.shape()[axis]).flat_map(|index| {
            let rear = start + index as f64 * ratio;
            let front = start + (index + 1) as f64 * ratio;
            let first = whole_part(rear.max(0.0));
            let last = whole_part(front.max(0.0)).min(n_old.saturating_sub(1));
            (first..=last).filter_map(move |covered| {
                let overlap = front.min((covered + 1) as f64) - rear.max(covered as f64);
                (overlap > 0.0).then_some((index, covered, overlap / ratio))
            })
        });
        pairs.collect()
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

    /// Discretisation error of the friction coefficient by the position of the contact boundary: √(Σ S²) over the straight runs of the
    /// boundary at its extrema, with S = ½ Σ P (∂h/∂x − μ)/Σ P. The first sum runs over the outermost elements of the run, the second
    /// over the contact. 0 under bodies of revolution, whose boundary is nowhere straight.
    ///
    /// Along a run the true boundary lies within half an element of that of the elements. Up to half the force of the outermost
    /// elements therefore belongs to others, whose mean slope is μ. Where the boundary passes obliquely through the elements, errors
    /// cancel along a run.
    pub(crate) fn friction_uncertainty(&self, surface: &dyn Surface) -> f64 {
        if surface.as_axisymmetric().is_some() {
            return 0.0;
        }
        let slopes = self.slopes(surface);
        // Compute the mean slope under the load, which is the friction coefficient.
        let force: f64 = self.pressure.iter().sum();
        let weighted = self.pressure.iter().zip(&slopes);
        let mean_slope = weighted.map(|(p, slope)| p * slope).sum::<f64>() / force;
        // Add up the squared errors S of the runs at extrema, which are independent of each other.
        let bounds = Bounds {
            lower: [0; 2],
            upper: self.grid.shape(),
        };
        let weight =
            |element: usize| 0.5 * self.pressure[element] / force * (slopes[element] - mean_slope);
        let runs = area::boundary_runs(&self.pressure, &bounds, NO_MIRRORS, weight);
        let at_extrema = runs.iter().filter(|run| run.is_extremum);
        let squares = at_extrema.map(|run| run.weight * run.weight);
        squares.sum::<f64>().sqrt()
    }

    /// Mean of ∂h/∂x over each element with pressure, along its centre line, row-major; 0 for elements without pressure, and for those over
    /// which the surface ends.
    pub(crate) fn slopes(&self, surface: &dyn Surface) -> Vec<f64> {
        let (columns, [dx, dy]) = (self.grid.shape()[1], self.grid.spacing());
        let slope = |(element, pressure): (usize, &f64)| {
            let x = self.origin[0] + (element / columns) as f64 * dx;
            let y = self.origin[1] + (element % columns) as f64 * dy;
            let rise = || surface.height([x + 0.5 * dx, y]) - surface.height([x - 0.5 * dx, y]);
            let slope = (*pressure > 0.0).then(|| rise() / dx);
            slope.filter(|slope| slope.is_finite()).unwrap_or(0.0)
        };
        self.pressure.iter().enumerate().map(slope).collect()
    }

    /// Largest pressure of an element, \[Pa].
    pub fn largest(&self) -> f64 {
        self.pressure.iter().copied().fold(0.0, f64::max)
    }

    /// Pressure of the element at a `position` \[m] relative to the lowest point, \[Pa]; zero outside the field.
    pub fn pressure_at(&self, position: [f64; 2]) -> f64 {
        // Find the element whose edges enclose the position.
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

#[cfg(test)]
mod tests {
    use super::*;

    /// A field of 5 × 4 elements with an edge that has no pressure.
    fn field() -> PressureField {
        let grid = Grid::new([5, 4], [0.5, 0.25]).expect("a grid");
        let pressure = (0..20).map(|index| f64::from(index * index % 7));
        PressureField {
            grid,
            origin: [-0.75, -0.5],
            pressure: pressure.collect(),
        }
    }

    /// Normal force of a field, \[N].
    fn force(field: &PressureField) -> f64 {
        field.pressure.iter().sum::<f64>() * field.grid.element_area()
    }

    #[test]
    fn resampling_keeps_the_force() {
        let field = field();
        assert_eq!(field.resampled(&field.grid, field.origin), field, "itself");
        // Resample on grids that are finer, coarser and neither, all of which cover the field.
        for (shape, spacing, origin) in [
            ([23, 41], [0.13, 0.031], [-1.2, -0.66]),
            ([3, 2], [1.1, 0.9], [-0.6, -0.3]),
            ([1, 9], [3.0, 0.17], [0.3, -0.7]),
        ] {
            let grid = Grid::new(shape, spacing).expect("a grid");
            let (found, expected) = (force(&field.resampled(&grid, origin)), force(&field));
            let off = (found / expected - 1.0).abs();
            assert!(
                off < 1e-14,
                "{shape:?} of {spacing:?}: {found} N instead of {expected} N"
            );
        }
    }

    #[test]
    fn elements_have_the_mean_pressure_over_their_area() {
        let field = field();
        let halves = Grid::new([10, 8], [0.25, 0.125]).expect("a grid");
        let fine = field.resampled(&halves, [-0.875, -0.5625]);
        for (index, pressure) in fine.pressure.iter().enumerate() {
            let parent = index / 8 / 2 * 4 + index % 8 / 2;
            let expected = field.pressure[parent];
            let off = (pressure - expected).abs();
            assert!(
                off <= 1e-14 * expected,
                "half {index}: {pressure} Pa instead of {expected} Pa"
            );
        }
        let outside = field.resampled(&halves, [5.0, 5.0]);
        assert!(
            force(&outside).abs() < f64::MIN_POSITIVE,
            "of a grid elsewhere"
        );
    }
}
