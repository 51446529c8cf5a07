//! The leading edge of a line of separate points.
//!
//! ```text
//! i ∈ A  ⇔  h_i < min_{j > i} h_j        (Kürschner 2014, Definition 1, for points)
//! ```

/// Minimum of each height and all that follow it, `m_i = min_{j ≥ i} h_j`, of the same unit and length.
///
/// Heights are finite, or `+∞` where there is no body. The increments of the result carry the force of stationary sliding
/// on independent dashpots.
#[must_use]
pub fn running_minimum(heights: &[f64]) -> Vec<f64> {
    let mut minima = heights.to_vec();
    for i in (1..minima.len()).rev() {
        minima[i - 1] = minima[i - 1].min(minima[i]);
    }
    minima
}

/// Indices, increasing, of the points that are lower than all points after them; the last point always is one.
///
/// Heights are finite, or `+∞` where there is no body. Of a plateau only the last point can belong.
#[must_use]
pub fn leading_indices(heights: &[f64]) -> Vec<usize> {
    let minima = running_minimum(heights);
    (0..heights.len())
        .filter(|&i| minima.get(i + 1).is_none_or(|later| heights[i] < *later))
        .collect()
}
