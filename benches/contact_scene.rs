//! The contacts of one instant that are timed.

use bem_halfspace::{
    BemError, Contact, ContactOptions, ContactProblem, ContactState, Control, Convolution, Grid,
    solve_contact,
};

/// Rigid bodies on E* = 1, which for the incompressible half space is a compliance of 4.
const COMPLIANCE: f64 = 4.0;
const MAX_ITERATIONS: usize = 500;
/// Contact radius and depth of the Hertz contact on the unit square.
const RADIUS: f64 = 0.3;

/// A contact at a given force.
#[derive(Debug)]
pub struct ContactScene {
    /// The grid and its influence coefficients.
    pub convolution: Convolution,
    /// Heights of the rigid body, row-major, \[m].
    pub heights: Vec<f64>,
    /// Normal force, \[N].
    pub force: f64,
}

impl ContactScene {
    /// Depth of the Hertz contact in closed form, \[m].
    pub const HERTZ_DEPTH: f64 = RADIUS * RADIUS;

    /// Hertz contact with the radius 0.3 on the unit square of `n` × `n` elements, free boundary, apex between the four
    /// middle elements.
    ///
    /// # Errors
    /// [`BemError`] for a number of elements that no grid has.
    pub fn hertz(n: usize) -> Result<Self, BemError> {
        Self::hertz_aside(n, 0.0)
    }

    /// The same with the apex so many elements aside along x and y; there is no mirror unless it is zero.
    ///
    /// # Errors
    /// [`BemError`] for a number of elements that no grid has.
    pub fn hertz_aside(n: usize, offset: f64) -> Result<Self, BemError> {
        let edge = 1.0 / n as f64;
        let middle = 0.5 * n as f64 + offset;
        let centre = |index: usize| (index as f64 + 0.5 - middle) * edge;
        let height = |index: usize| 0.5 * (centre(index / n).powi(2) + centre(index % n).powi(2));
        Ok(Self {
            convolution: Convolution::new(&Grid::new([n; 2], [edge; 2])?),
            heights: (0..n * n).map(height).collect(),
            force: 4.0 / 3.0 * RADIUS.powi(3),
        })
    }

    /// A periodic surface on the unit square, pressed with the mean pressure 0.05 on its summits.
    ///
    /// # Errors
    /// [`BemError`] for a number of elements that no grid has.
    pub fn rough(summits: Vec<f64>) -> Result<Self, BemError> {
        let n = summits.len().isqrt();
        Ok(Self {
            convolution: Convolution::periodic(&Grid::new([n; 2], [1.0 / n as f64; 2])?),
            heights: summits.into_iter().map(|summit| -summit).collect(),
            force: 0.05,
        })
    }

    /// Solves the contact from a cold start.
    ///
    /// # Errors
    /// Those of [`solve_contact`].
    pub fn solve(&self, tolerance: f64) -> Result<(Contact, ContactState), BemError> {
        let problem = ContactProblem {
            convolution: &self.convolution,
            separation: &self.heights,
            compliance: COMPLIANCE,
            control: Control::NormalForce(self.force),
        };
        let options = ContactOptions {
            tolerance,
            max_iterations: MAX_ITERATIONS,
        };
        let mut state = ContactState::new(&self.convolution);
        let contact = solve_contact(&problem, &mut state, &options)?;
        Ok((contact, state))
    }
}

/// Relative difference in the mean square.
#[must_use]
pub fn deviation(actual: &[f64], expected: &[f64]) -> f64 {
    let pairs = actual.iter().zip(expected);
    let difference: f64 = pairs.map(|(a, b)| (a - b).powi(2)).sum();
    (difference / expected.iter().map(|b| b.powi(2)).sum::<f64>()).sqrt()
}
