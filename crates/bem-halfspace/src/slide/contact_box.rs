//! The part of the footprint on which the contact of a step is solved.

use std::f64::consts::{FRAC_1_PI, PI};

use crate::fast_length::fast_length;
use crate::{
    BemError, Contact, ContactOptions, ContactProblem, ContactState, Control, Convolution, Grid,
    solve_contact,
};

/// Half-open ranges of rows and columns of the footprint.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) struct Bounds {
    pub(super) lower: [usize; 2],
    pub(super) upper: [usize; 2],
}

impl Bounds {
    pub(super) const fn around(element: [usize; 2]) -> Self {
        Self {
            lower: element,
            upper: [element[0] + 1, element[1] + 1],
        }
    }

    pub(super) fn include(&mut self, element: [usize; 2]) {
        for (axis, &index) in element.iter().enumerate() {
            self.lower[axis] = self.lower[axis].min(index);
            self.upper[axis] = self.upper[axis].max(index + 1);
        }
    }

    pub(super) fn contains(&self, [row, column]: [usize; 2]) -> bool {
        (self.lower[0]..self.upper[0]).contains(&row)
            && (self.lower[1]..self.upper[1]).contains(&column)
    }

    pub(super) const fn shape(&self) -> [usize; 2] {
        [self.upper[0] - self.lower[0], self.upper[1] - self.lower[1]]
    }

    /// With room for a growing contact, inside a field of the given shape, of a size that transforms fast.
    pub(super) fn with_margin(&self, field: [usize; 2]) -> Self {
        let mut grown = *self;
        for (axis, &available) in field.iter().enumerate() {
            let needed = self.shape()[axis];
            let wanted = needed + (needed / 8).max(2) * 2;
            let length = (fast_length(2 * wanted) / 2).min(available);
            let behind = (length - needed) / 2;
            grown.lower[axis] = self.lower[axis]
                .saturating_sub(behind)
                .min(available - length);
            grown.upper[axis] = grown.lower[axis] + length;
        }
        grown
    }
}

/// Contact solver on a box that travels with the indenter.
#[derive(Debug)]
pub(super) struct ContactBox {
    pub(super) bounds: Bounds,
    convolution: Convolution,
    pub(super) state: ContactState,
    pub(super) separation: Vec<f64>,
}

impl ContactBox {
    /// A box for elements with the edge 1 along x and `aspect` along y.
    pub(super) fn new(bounds: Bounds, aspect: f64) -> Result<Self, BemError> {
        let convolution = Convolution::new(&Grid::new(bounds.shape(), [1.0, aspect])?);
        let state = ContactState::new(&convolution);
        let separation = vec![0.0; convolution.grid().n_elements()];
        Ok(Self {
            bounds,
            convolution,
            state,
            separation,
        })
    }

    /// A box of other bounds that starts from the pressure of this one.
    pub(super) fn moved_to(&self, bounds: Bounds) -> Result<Self, BemError> {
        let mut moved = Self::new(bounds, self.convolution.grid().spacing()[1])?;
        let columns = bounds.shape()[1];
        for (element, pressure) in self.loaded_elements() {
            if bounds.contains(element) {
                let [row, column] = [element[0] - bounds.lower[0], element[1] - bounds.lower[1]];
                moved.state.pressure_mut()[row * columns + column] = pressure;
            }
        }
        Ok(moved)
    }

    /// Solves the step for the separation set before. In the units of the march the force is 1/π and the compliance
    /// 4π, whatever the scene.
    pub(super) fn solve(&mut self, options: &ContactOptions) -> Result<Contact, BemError> {
        let problem = ContactProblem {
            convolution: &self.convolution,
            separation: &self.separation,
            compliance: 4.0 * PI,
            control: Control::NormalForce(FRAC_1_PI),
        };
        solve_contact(&problem, &mut self.state, options)
    }

    /// Elements with pressure, as [row, column] of the footprint, and their pressure.
    pub(super) fn loaded_elements(&self) -> impl Iterator<Item = ([usize; 2], f64)> {
        let columns = self.bounds.shape()[1];
        let lower = self.bounds.lower;
        self.state
            .pressure()
            .iter()
            .enumerate()
            .filter(|(_, pressure)| **pressure > 0.0)
            .map(move |(index, &pressure)| {
                (
                    [lower[0] + index / columns, lower[1] + index % columns],
                    pressure,
                )
            })
    }
}
