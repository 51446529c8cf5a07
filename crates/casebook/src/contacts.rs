//! Contacts of one instant, over `n` × `n` elements of the unit square.

/// Contact radius of the Hertz contact.
const RADIUS: f64 = 0.3;

/// A rigid body and the force that presses it on a half space of E* = 1 Pa.
#[derive(Debug, Clone, PartialEq)]
pub struct SquareContact {
    /// Heights of the body, row-major, \[m].
    pub heights: Vec<f64>,
    /// Normal force, \[N].
    pub force: f64,
}

impl SquareContact {
    /// Compliance of the incompressible half space, \[1/Pa].
    pub const COMPLIANCE: f64 = 4.0;
    /// Depth of the Hertz contact in closed form, \[m].
    pub const HERTZ_DEPTH: f64 = RADIUS * RADIUS;

    /// Hertz contact with the radius 0.3, with the apex so many elements from the middle along x and y.
    pub fn hertz(n: usize, offset: f64) -> Self {
        let edge = 1.0 / n as f64;
        let middle = 0.5 * n as f64 + offset;
        let centre = |index: usize| (index as f64 + 0.5 - middle) * edge;
        let height = |index: usize| 0.5 * (centre(index / n).powi(2) + centre(index % n).powi(2));
        Self {
            heights: (0..n * n).map(height).collect(),
            force: 4.0 / 3.0 * RADIUS.powi(3),
        }
    }

    /// A surface under the mean pressure 0.05 Pa.
    pub const fn rough(heights: Vec<f64>) -> Self {
        Self {
            heights,
            force: 0.05,
        }
    }
}

/// Relative difference of two fields in the mean square.
pub fn deviation(actual: &[f64], expected: &[f64]) -> f64 {
    let pairs = actual.iter().zip(expected);
    let difference: f64 = pairs.map(|(a, b)| (a - b).powi(2)).sum();
    (difference / expected.iter().map(|b| b.powi(2)).sum::<f64>()).sqrt()
}
