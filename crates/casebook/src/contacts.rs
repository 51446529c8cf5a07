//! Contacts of one instant, over `n` × `n` elements of the unit square.

/// Contact radius of the Hertz contact, \[m].
const RADIUS: f64 = 0.3;
/// Normal force of the Hertz contact on a half space of E* = 1 Pa, \[N].
pub const HERTZ_FORCE: f64 = 4.0 / 3.0 * (RADIUS * RADIUS * RADIUS);
/// Depth of the Hertz contact in closed form, \[m].
pub const HERTZ_DEPTH: f64 = RADIUS * RADIUS;
/// Compliance of the incompressible half space of E* = 1 Pa, \[1/Pa].
pub const COMPLIANCE: f64 = 4.0;

/// Heights of the body of the Hertz contact, row-major, with the apex `offset` elements from the middle along x and y, \[m].
pub fn hertz_heights(n: usize, offset: f64) -> Vec<f64> {
    let edge = 1.0 / n as f64;
    let middle = 0.5 * n as f64 + offset;
    let centre = |index: usize| (index as f64 + 0.5 - middle) * edge;
    let height = |index: usize| 0.5 * (centre(index / n).powi(2) + centre(index % n).powi(2));
    (0..n * n).map(height).collect()
}

/// Relative difference of two fields in the mean square.
pub fn deviation(actual: &[f64], expected: &[f64]) -> f64 {
    let pairs = actual.iter().zip(expected);
    let difference: f64 = pairs.map(|(a, b)| (a - b).powi(2)).sum();
    (difference / expected.iter().map(|b| b.powi(2)).sum::<f64>()).sqrt()
}
