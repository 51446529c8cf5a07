//! The path of a depth that was measured with noise.
//!
//! A noisy path would let the body shiver. It is replaced by the straight pieces of least squares on as few knots as leave
//! residuals without structure: a piece is divided where the mean of a quarter of it is more than 3.5 standard errors off.
//! Knots then move to where the squares are least, as to a turning point, and those that do not matter go.

/// Standard errors.
pub(super) const STRUCTURE: f64 = 3.5;
/// Noise below this part of the range is rounding, and the path is taken as it is.
const ROUNDING: f64 = 1e-7;
/// Rounds of moving and dropping knots.
const ROUNDS: usize = 4;

/// What is known of a path.
pub(super) struct Path {
    knots: Vec<f64>,
    /// Standard deviation of one measured depth, \[m].
    noise: f64,
    /// Of the normal matrix of the depths at the knots: reduced diagonal, and what is beside it.
    diagonal: Vec<f64>,
    beside: Vec<f64>,
}

impl Path {
    pub(super) const fn len(&self) -> usize {
        self.knots.len()
    }

    /// How much a point moves with a knot.
    pub(super) fn hat(&self, knot: usize, time: f64) -> f64 {
        let k = self.knots.partition_point(|one| *one <= time);
        let k = k.clamp(1, self.knots.len() - 1);
        let part = (time - self.knots[k - 1]) / (self.knots[k] - self.knots[k - 1]);
        match knot {
            _ if knot == k => part,
            _ if knot + 1 == k => 1.0 - part,
            _ => 0.0,
        }
    }

    /// The covariance of the depths at the knots, times a value for each of them.
    pub(super) fn covariance(&self, mut values: Vec<f64>) -> Vec<f64> {
        solve(&self.diagonal, &self.beside, &mut values);
        let variance = self.noise * self.noise;
        values.into_iter().map(|value| variance * value).collect()
    }
}

/// Standard deviation of one measured value, by the distances of means from the line through their neighbours.
pub(super) fn noise(time: &[f64], values: &[f64], counts: &[f64]) -> f64 {
    let bend = |i: usize| {
        let part = (time[i] - time[i - 1]) / (time[i + 1] - time[i - 1]);
        let between = (1.0 - part) * values[i - 1] + part * values[i + 1];
        let variance = part * part / counts[i + 1] + (1.0 - part).powi(2) / counts[i - 1];
        (values[i] - between).abs() / (1.0 / counts[i] + variance).sqrt()
    };
    BY_MEDIAN * median((1..values.len().max(2) - 1).map(bend).collect())
}

/// Standard deviation of a normal distribution over its median deviation.
pub(super) const BY_MEDIAN: f64 = 1.4826;

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

/// Takes the noise off a path, where there is some.
pub(super) fn smooth(time: &[f64], depth: &mut [f64], counts: &[f64]) -> Option<Path> {
    let noise = noise(time, depth, counts);
    let [low, high] = ends(depth);
    if noise <= ROUNDING * (high - low) {
        return None;
    }
    let points = Points {
        time,
        depth,
        counts,
    };
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
            to - from > 1 && sums.any(|sum| sum > STRUCTURE * noise)
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
    points.improve(&mut knots, noise);
    let path = points.path(&knots);
    let mut system = points.system(&knots);
    reduce(&mut system.diagonal, &system.beside);
    depth.copy_from_slice(&path);
    Some(Path {
        knots: knots.iter().map(|&knot| time[knot]).collect(),
        noise,
        diagonal: system.diagonal,
        beside: system.beside,
    })
}

struct Points<'a> {
    time: &'a [f64],
    depth: &'a [f64],
    counts: &'a [f64],
}

/// Normal matrix of hats on knots, which is tridiagonal, and right-hand side.
#[derive(Clone)]
struct System {
    diagonal: Vec<f64>,
    beside: Vec<f64>,
    right: Vec<f64>,
}

impl Points<'_> {
    fn system(&self, knots: &[usize]) -> System {
        let n = knots.len();
        let [diagonal, beside, right] = [0; 3].map(|_| vec![0.0; n]);
        let mut system = System {
            diagonal,
            beside,
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
                system.beside[k] += self.counts[i] * part * (1.0 - part);
            }
        }
        system
    }

    /// Straight from knot to knot, by least squares.
    fn path(&self, knots: &[usize]) -> Vec<f64> {
        let mut system = self.system(knots);
        reduce(&mut system.diagonal, &system.beside);
        solve(&system.diagonal, &system.beside, &mut system.right);
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

    /// Sum of squares between the first and the last of some knots.
    fn squares(&self, knots: &[usize]) -> f64 {
        let [depth, counts] = [self.depth, self.counts].map(|values| &values[knots[0]..]);
        let points = self.path(knots).into_iter().zip(depth).zip(counts);
        points
            .map(|((path, depth), count)| count * (depth - path).powi(2))
            .sum()
    }

    /// Moves knots to where the squares are least, and drops those that do not lower them by more than they may by chance.
    fn improve(&self, knots: &mut Vec<usize>, noise: f64) {
        let chance = 2.0 * (self.time.len() as f64).ln() * noise * noise;
        // The squares depend on a knot as far as its third neighbours.
        let near = |knots: &[usize], k: usize| k.saturating_sub(3)..(k + 4).min(knots.len());
        for _ in 0..ROUNDS {
            let before = knots.clone();
            for k in 1..knots.len() - 1 {
                let near = near(knots, k);
                self.shift(&mut knots[near.clone()], k - near.start);
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

    /// Moves one knot between its neighbours, by halves of what is left.
    fn shift(&self, knots: &mut [usize], k: usize) {
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

/// Eliminates what is below the diagonal.
fn reduce(diagonal: &mut [f64], beside: &[f64]) {
    for k in 1..diagonal.len() {
        diagonal[k] -= beside[k - 1] * beside[k - 1] / diagonal[k - 1];
    }
}

/// With the reduced diagonal.
fn solve(diagonal: &[f64], beside: &[f64], right: &mut [f64]) {
    let n = diagonal.len();
    for k in 1..n {
        right[k] -= beside[k - 1] / diagonal[k - 1] * right[k - 1];
    }
    right[n - 1] /= diagonal[n - 1];
    for k in (0..n - 1).rev() {
        right[k] = (right[k] - beside[k] * right[k + 1]) / diagonal[k];
    }
}
