//! Smoothing of a noisy measured depth.
//!
//! A noisy path would load and unload the contact at every point. It is replaced by a linear spline, fitted by least squares
//! with few knots.
//! 1. A piece is divided if the mean residual of a quarter of it exceeds 3.5 standard errors.
//! 2. Knots move to minimise the sum of squares, as to a turning point.
//! 3. Knots without a significant effect are removed.

/// Smallest mean residual of a part of a piece that counts as structure, in standard errors of that mean. Chosen: noise
/// alone reaches it in one of 2000 parts.
pub(super) const STRUCTURE_STANDARD_ERRORS: f64 = 3.5;
/// Ratio of the noise to the range of depths up to which the path is not smoothed, because the noise is the rounding of the
/// file. Chosen: numbers with seven digits are rounded by as much.
const MIN_RELATIVE_NOISE: f64 = 1e-7;
/// Largest number of rounds in which the knots of the smoothed path are moved and removed; a round without a change is the
/// last one. Chosen, as a bound of the time.
const MAX_KNOT_ROUNDS: usize = 4;

/// A smoothed path with the covariance of its depths.
pub(super) struct SmoothedPath {
    /// Times of the knots, \[s].
    knots: Vec<f64>,
    /// Standard deviation of one measured depth, \[m].
    noise: f64,
    /// Diagonal of the normal matrix of the depths at the knots, after elimination.
    diagonal: Vec<f64>,
    /// Off-diagonal of this tridiagonal matrix.
    off_diagonal: Vec<f64>,
}

impl SmoothedPath {
    /// Number of knots of the smoothed path.
    pub(super) const fn len(&self) -> usize {
        self.knots.len()
    }

    /// Hat function of a knot: derivative of the depth at a time by the depth at the knot.
    pub(super) fn hat_function(&self, knot: usize, time: f64) -> f64 {
        let k = self
            .knots
            .partition_point(|one| *one <= time)
            .clamp(1, self.knots.len() - 1);
        let part = (time - self.knots[k - 1]) / (self.knots[k] - self.knots[k - 1]);
        match knot {
            _ if knot == k => part,
            _ if knot + 1 == k => 1.0 - part,
            _ => 0.0,
        }
    }

    /// Product of the covariance matrix \[m²] of the depths at the knots with a vector that has one entry per knot.
    pub(super) fn covariance(&self, mut values: Vec<f64>) -> Vec<f64> {
        solve(&self.diagonal, &self.off_diagonal, &mut values);
        let variance = self.noise * self.noise;
        values.into_iter().map(|value| variance * value).collect()
    }
}

/// Standard deviation of one measured value, in the unit of `values`, which are means of `counts` measured ones. It follows
/// from the median distance of each from the line over time through its neighbours, so that outliers have no effect.
pub(super) fn noise(time: &[f64], values: &[f64], counts: &[f64]) -> f64 {
    let second_difference = |i: usize| {
        let part = (time[i] - time[i - 1]) / (time[i + 1] - time[i - 1]);
        let between = (1.0 - part) * values[i - 1] + part * values[i + 1];
        let variance = part * part / counts[i + 1] + (1.0 - part).powi(2) / counts[i - 1];
        (values[i] - between).abs() / (1.0 / counts[i] + variance).sqrt()
    };
    DEVIATION_PER_MEDIAN
        * median(
            (1..values.len().max(2) - 1)
                .map(second_difference)
                .collect(),
        )
}

/// Ratio of the standard deviation of a normal distribution to its median absolute deviation.
pub(super) const DEVIATION_PER_MEDIAN: f64 = 1.4826;

/// Upper median; 0 without values.
pub(super) fn median(mut values: Vec<f64>) -> f64 {
    values.sort_by(f64::total_cmp);
    values.get(values.len() / 2).copied().unwrap_or_default()
}

/// Smallest and largest value.
pub(super) fn min_max(values: &[f64]) -> [f64; 2] {
    let start = [f64::INFINITY, f64::NEG_INFINITY];
    let wider = |[low, high]: [f64; 2], value: &f64| [value.min(low), value.max(high)];
    values.iter().fold(start, wider)
}

/// Replaces the depths \[m] of a path by a linear spline over time \[s], fitted to means of `counts` measured values. `None`,
/// and an unchanged path, if it has no noise.
pub(super) fn smooth(time: &[f64], depth: &mut [f64], counts: &[f64]) -> Option<SmoothedPath> {
    let noise = noise(time, depth, counts);
    let [low, high] = min_max(depth);
    if noise <= MIN_RELATIVE_NOISE * (high - low) {
        return None;
    }
    let points = Points {
        time,
        depth,
        counts,
    };
    // Divide the pieces of the smoothed path at new knots until the means of residuals over parts of each piece are within their
    // noise.
    let mut knots = vec![0, depth.len() - 1];
    loop {
        let path = points.path(&knots);
        let is_rough = |&[from, to]: &[usize; 2]| {
            let quarter = (to - from).div_ceil(4);
            let starts = (from..to).step_by(quarter);
            let mut sums = starts.map(|start| {
                let points = start..(start + quarter).min(to);
                let weight: f64 = counts[points.clone()].iter().sum();
                let sum: f64 = points.map(|i| counts[i] * (depth[i] - path[i])).sum();
                sum.abs() / weight.sqrt()
            });
            to - from > 1 && sums.any(|sum| sum > STRUCTURE_STANDARD_ERRORS * noise)
        };
        let intervals = knots.windows(2).map(|pair| [pair[0], pair[1]]);
        let middles = intervals.filter(is_rough);
        let middles: Vec<usize> = middles.map(|[a, b]| usize::midpoint(a, b)).collect();
        if middles.is_empty() {
            break;
        }
        knots.extend(middles);
        knots.sort_unstable();
    }
    points.optimise_knots(&mut knots, noise);
    let path = points.path(&knots);
    let mut system = points.system(&knots);
    reduce(&mut system.diagonal, &system.off_diagonal);
    depth.copy_from_slice(&path);
    Some(SmoothedPath {
        knots: knots.iter().map(|&knot| time[knot]).collect(),
        noise,
        diagonal: system.diagonal,
        off_diagonal: system.off_diagonal,
    })
}

/// A noisy path: times \[s], depths \[m], and the number of measured values in each depth.
struct Points<'a> {
    time: &'a [f64],
    depth: &'a [f64],
    counts: &'a [f64],
}

/// Normal equations for the depths at the knots, with a symmetric tridiagonal matrix and the right-hand side `right`.
#[derive(Clone)]
struct System {
    diagonal: Vec<f64>,
    off_diagonal: Vec<f64>,
    right: Vec<f64>,
}

impl Points<'_> {
    /// Weighted normal equations of the spline with knots at points of these indices, which increase from the first to the last
    /// point of a part.
    fn system(&self, knots: &[usize]) -> System {
        let n = knots.len();
        let [diagonal, off_diagonal, right] = [0; 3].map(|_| vec![0.0; n]);
        let mut system = System {
            diagonal,
            off_diagonal,
            right,
        };
        for k in 0..n - 1 {
            let last = if k + 2 == n {
                knots[k + 1] + 1
            } else {
                knots[k + 1]
            };
            let [from, to] = [self.time[knots[k]], self.time[knots[k + 1]]];
            for i in knots[k]..last {
                let part = (self.time[i] - from) / (to - from);
                for (knot, hat) in [(k, 1.0 - part), (k + 1, part)] {
                    system.diagonal[knot] += self.counts[i] * hat * hat;
                    system.right[knot] += self.counts[i] * hat * self.depth[i];
                }
                system.off_diagonal[k] += self.counts[i] * part * (1.0 - part);
            }
        }
        system
    }

    /// Depths of the least-squares linear spline, \[m], at all points from the first to the last knot.
    fn path(&self, knots: &[usize]) -> Vec<f64> {
        let mut system = self.system(knots);
        reduce(&mut system.diagonal, &system.off_diagonal);
        solve(&system.diagonal, &system.off_diagonal, &mut system.right);
        let places = knots.windows(2).enumerate();
        let inner = places.flat_map(|(k, pair)| {
            let [from, to] = [self.time[pair[0]], self.time[pair[1]]];
            let rise = system.right[k + 1] - system.right[k];
            let start = system.right[k];
            (pair[0]..pair[1]).map(move |i| start + (self.time[i] - from) / (to - from) * rise)
        });
        let inner: Vec<f64> = inner.collect();
        [&inner[..], &system.right[knots.len() - 1..]].concat()
    }

    /// Sum of squares between the first and the last of the given knots.
    fn squares(&self, knots: &[usize]) -> f64 {
        let [depth, counts] = [self.depth, self.counts].map(|values| &values[knots[0]..]);
        let points = self.path(knots).into_iter().zip(depth).zip(counts);
        points
            .map(|((path, depth), count)| count * (depth - path).powi(2))
            .sum()
    }

    /// Moves knots to minimise the sum of squares, and removes those whose removal raises it by less than 2 ln n σ², for n points
    /// and the noise σ \[m]. That is the penalty of two parameters, time and depth of the knot, in Schwarz's criterion.
    fn optimise_knots(&self, knots: &mut Vec<usize>, noise: f64) {
        let chance = 2.0 * (self.time.len() as f64).ln() * noise * noise;
        // When a knot is moved, the path is fitted again on three neighbours at each side only, because the effect reaches no
        // farther.
        let near = |knots: &[usize], k: usize| k.saturating_sub(3)..(k + 4).min(knots.len());
        for _ in 0..MAX_KNOT_ROUNDS {
            let before = knots.clone();
            for k in 1..knots.len() - 1 {
                let near = near(knots, k);
                self.move_knot(&mut knots[near.clone()], k - near.start);
            }
            for k in (1..knots.len() - 1).rev() {
                let near = near(knots, k);
                let mut fewer = knots[near.clone()].to_vec();
                fewer.remove(k - near.start);
                if self.squares(&fewer) < self.squares(&knots[near]) + chance {
                    knots.remove(k);
                }
            }
            if *knots == before {
                break;
            }
        }
    }

    /// Moves knot `k` between its neighbours to the point with the smallest sum of squares, by a search whose step is halved
    /// until it is one point.
    fn move_knot(&self, knots: &mut [usize], k: usize) {
        let mut least = self.squares(knots);
        let mut step = (knots[k + 1] - knots[k - 1]) / 2;
        while step > 0 {
            let start = knots[k];
            let mut best = start;
            for place in [start.saturating_sub(step), start + step] {
                if knots[k - 1] < place && place < knots[k + 1] {
                    knots[k] = place;
                    let squares = self.squares(knots);
                    if squares < least {
                        (least, best) = (squares, place);
                    }
                }
            }
            knots[k] = best;
            if best == start {
                step /= 2;
            }
        }
    }
}

/// Replaces the diagonal of a symmetric tridiagonal matrix by that after Gaussian elimination of the lower off-diagonal.
fn reduce(diagonal: &mut [f64], off_diagonal: &[f64]) {
    for k in 1..diagonal.len() {
        diagonal[k] -= off_diagonal[k - 1] * off_diagonal[k - 1] / diagonal[k - 1];
    }
}

/// Solves the symmetric tridiagonal system for the right-hand side `right`, in place; `diagonal` is that from [`reduce`].
fn solve(diagonal: &[f64], off_diagonal: &[f64], right: &mut [f64]) {
    let n = diagonal.len();
    for k in 1..n {
        right[k] -= off_diagonal[k - 1] / diagonal[k - 1] * right[k - 1];
    }
    right[n - 1] /= diagonal[n - 1];
    for k in (0..n - 1).rev() {
        right[k] = (right[k] - off_diagonal[k] * right[k + 1]) / diagonal[k];
    }
}
