//! Reduction of a curve to the points that its force and depth need.
//!
//! Neighbours are averaged where force and depth are linear within their noise. A curve of 10⁵ points then takes no longer
//! than one of a few thousand. At turning points of the body all points are kept.

use super::IndentationCurve;
use super::depth::{self, STRUCTURE_STANDARD_ERRORS, SmoothedPath, min_max};

/// A curve prepared for the fit.
pub(super) struct Measured {
    /// Means of neighbouring points, with the depth smoothed if it is noisy.
    pub(super) curve: IndentationCurve,
    /// Number of measured points in the mean of each point.
    pub(super) counts: Vec<f64>,
    /// Smoothed path of the depth; `None` if it has no noise.
    pub(super) path: Option<SmoothedPath>,
}

/// Largest number of points of a curve that is fitted without averaging. Chosen, as a bound of the time; longer curves are
/// averaged to about as many means.
const MAX_UNAVERAGED_POINTS: usize = 4000;
/// Ratio of the second difference of the depth to its range up to which the depth counts as linear even without noise.
/// Chosen: above the rounding of written depths, which bends a straight path by as much.
const BEND_TOLERANCE: f64 = 1e-6;

impl Measured {
    /// Averages neighbours in blocks in which depth and force are linear within their noise, found by bisection, and smooths
    /// the depth.
    pub(super) fn new(curve: &IndentationCurve) -> Self {
        let n = curve.time.len();
        let ones = vec![1.0; n];
        let [low, high] = min_max(&curve.depth);
        let columns = [&curve.depth, &curve.force];
        let [depth, force] = columns.map(|values| depth::noise(&curve.time, values, &ones));
        let bends = [depth.max(BEND_TOLERANCE * (high - low)), force];
        let mut blocks = Vec::from_iter(std::iter::once(0..n));
        let mut starts = Vec::new();
        while let Some(block) = blocks.pop() {
            let pairs = columns.into_iter().zip(bends);
            let is_short = block.len() <= n.div_ceil(MAX_UNAVERAGED_POINTS);
            // Extend the block by a point on each side, so that no turn lies between two blocks.
            let wider = block.start.saturating_sub(1)..(block.end + 1).min(n);
            let is_straight =
                |(values, noise): (&Vec<f64>, f64)| is_straight(&values[wider.clone()], noise);
            if block.len() == 1 || is_short && pairs.into_iter().all(is_straight) {
                starts.push(block.start);
            } else {
                let middle = block.start.midpoint(block.end);
                blocks.extend([middle..block.end, block.start..middle]);
            }
        }
        starts.push(n);
        let mean = |values: &[f64]| {
            let blocks = starts.windows(2).map(|pair| &values[pair[0]..pair[1]]);
            blocks
                .map(|block| block.iter().sum::<f64>() / block.len() as f64)
                .collect()
        };
        let mut curve = curve.map(mean);
        let counts: Vec<f64> = starts
            .windows(2)
            .map(|pair| (pair[1] - pair[0]) as f64)
            .collect();
        let path = depth::smooth(&curve.time, &mut curve.depth, &counts);
        Self {
            curve,
            counts,
            path,
        }
    }
}

/// Whether values at equal time steps are linear within a standard deviation `noise`. With the sums q of their quarters, q₁ −
/// q₂ − q₃ + q₄ vanishes; of fewer than four values every second difference does.
fn is_straight(values: &[f64], noise: f64) -> bool {
    let quarter = values.len() / 4;
    if quarter == 0 {
        let bend = values
            .windows(3)
            .map(|three| (three[0] - 2.0 * three[1] + three[2]).abs());
        return bend.fold(0.0, f64::max) <= STRUCTURE_STANDARD_ERRORS * noise;
    }
    let parts = values.chunks_exact(quarter).take(4);
    let signs = [1.0, -1.0, -1.0, 1.0];
    let sums = parts
        .zip(signs)
        .map(|(part, sign)| sign * part.iter().sum::<f64>());
    sums.sum::<f64>().abs() <= STRUCTURE_STANDARD_ERRORS * noise * (4.0 * quarter as f64).sqrt()
}
