//! A curve of as many points as its force and depth need.
//!
//! Neighbours become their mean where force and depth are straight within their noise, so that a curve of 10⁵ points takes no
//! longer than one of a few thousand; where the body turns around, all points stay.

use super::IndentationCurve;
use super::depth::{self, Path, STRUCTURE, ends};

/// A curve as it is fitted.
pub(super) struct Measured {
    pub(super) curve: IndentationCurve,
    /// How many measured points each point is the mean of.
    pub(super) counts: Vec<f64>,
    /// What is known of the depth where it was measured with noise.
    pub(super) path: Option<Path>,
}

/// Curves of at most so many points are fitted as they are; others in about so many means.
const MOST: usize = 4000;
/// A bend of the depth within this part of its range is none.
const STRAIGHT: f64 = 1e-6;

impl Measured {
    pub(super) fn new(curve: &IndentationCurve) -> Self {
        let n = curve.time.len();
        let ones = vec![1.0; n];
        let [low, high] = ends(&curve.depth);
        let columns = [&curve.depth, &curve.force];
        let [depth, force] = columns.map(|values| depth::noise(&curve.time, values, &ones));
        let bends = [depth.max(STRAIGHT * (high - low)), force];
        let mut blocks = Vec::from_iter(std::iter::once(0..n));
        let mut starts = Vec::new();
        while let Some(block) = blocks.pop() {
            let pairs = columns.into_iter().zip(bends);
            let is_short = block.len() <= n.div_ceil(MOST);
            // With a point on each side, so that a turn is not between two blocks.
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

/// Whether quarters of some values are on one line but for their noise.
fn is_straight(values: &[f64], noise: f64) -> bool {
    let quarter = values.len() / 4;
    if quarter == 0 {
        let bend = values
            .windows(3)
            .map(|three| (three[0] - 2.0 * three[1] + three[2]).abs());
        return bend.fold(0.0, f64::max) <= STRUCTURE * noise;
    }
    let parts = values.chunks_exact(quarter).take(4);
    let signs = [1.0, -1.0, -1.0, 1.0];
    let sums = parts
        .zip(signs)
        .map(|(part, sign)| sign * part.iter().sum::<f64>());
    sums.sum::<f64>().abs() <= STRUCTURE * noise * (4.0 * quarter as f64).sqrt()
}
