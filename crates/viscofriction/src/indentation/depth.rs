//! The path of a depth that was measured with noise.
//!
//! A noisy path would let the body shiver. It is replaced by the straight pieces of least squares on as few knots as leave
//! residuals without structure: a piece is divided where the mean of a quarter of it is more than 3.5 standard errors off.

/// Standard errors.
const STRUCTURE: f64 = 3.5;
/// Noise below this part of the range is rounding, and the path is taken as it is.
const ROUNDING: f64 = 1e-7;

/// Noise of values over time, by their distance from the line through their neighbours.
pub(super) fn noise(time: &[f64], values: &[f64]) -> f64 {
    let bend = |i: usize| {
        let part = (time[i] - time[i - 1]) / (time[i + 1] - time[i - 1]);
        let between = (1.0 - part) * values[i - 1] + part * values[i + 1];
        (values[i] - between).abs() / (1.0 + part * part + (1.0 - part).powi(2)).sqrt()
    };
    1.4826 * median((1..values.len().max(2) - 1).map(bend).collect())
}

/// The middle one; 0 of none.
pub(super) fn median(mut values: Vec<f64>) -> f64 {
    values.sort_by(f64::total_cmp);
    values.get(values.len() / 2).copied().unwrap_or_default()
}

/// The least and the largest.
pub(super) fn ends(values: &[f64]) -> [f64; 2] {
    let ends = [f64::INFINITY, f64::NEG_INFINITY];
    let wider = |[low, high]: [f64; 2], value: &f64| [value.min(low), value.max(high)];
    values.iter().fold(ends, wider)
}

/// The path without its noise.
pub(super) fn smoothed(time: &[f64], depth: &[f64]) -> Vec<f64> {
    let noise = noise(time, depth);
    let [low, high] = ends(depth);
    if noise <= ROUNDING * (high - low) {
        return depth.to_vec();
    }
    let mut knots = vec![0, depth.len() - 1];
    loop {
        let path = pieces(time, depth, &knots);
        let is_rough = |&[from, to]: &[usize; 2]| {
            let quarter = (to - from).div_ceil(4);
            let starts = (from..to).step_by(quarter);
            let mut sums = starts.map(|start| {
                let points = start..(start + quarter).min(to);
                let n = points.len() as f64;
                points.map(|i| depth[i] - path[i]).sum::<f64>().abs() / n.sqrt()
            });
            to - from > 1 && sums.any(|sum| sum > STRUCTURE * noise)
        };
        let intervals = knots.windows(2).map(|pair| [pair[0], pair[1]]);
        let middles = intervals.filter(is_rough);
        let middles: Vec<usize> = middles.map(|[a, b]| usize::midpoint(a, b)).collect();
        if middles.is_empty() {
            return path;
        }
        knots.extend(middles);
        knots.sort_unstable();
    }
}

/// Straight from knot to knot, by least squares; the matrix of its hats is tridiagonal.
fn pieces(time: &[f64], values: &[f64], knots: &[usize]) -> Vec<f64> {
    let n = knots.len();
    let [mut diagonal, mut beside, mut right] = [0; 3].map(|_| vec![0.0; n]);
    let interval = |i: usize| knots.partition_point(|&knot| knot <= i).clamp(1, n - 1) - 1;
    let part = |i: usize, k: usize| {
        let [from, to] = [time[knots[k]], time[knots[k + 1]]];
        (time[i] - from) / (to - from)
    };
    for (i, value) in values.iter().enumerate() {
        let k = interval(i);
        let part = part(i, k);
        diagonal[k] += (1.0 - part).powi(2);
        diagonal[k + 1] += part * part;
        beside[k] += part * (1.0 - part);
        right[k] += (1.0 - part) * value;
        right[k + 1] += part * value;
    }
    for k in 1..n {
        let factor = beside[k - 1] / diagonal[k - 1];
        diagonal[k] -= factor * beside[k - 1];
        right[k] -= factor * right[k - 1];
    }
    right[n - 1] /= diagonal[n - 1];
    for k in (0..n - 1).rev() {
        right[k] = (right[k] - beside[k] * right[k + 1]) / diagonal[k];
    }
    let at = |i: usize| {
        let k = interval(i);
        right[k] + part(i, k) * (right[k + 1] - right[k])
    };
    (0..values.len()).map(at).collect()
}
