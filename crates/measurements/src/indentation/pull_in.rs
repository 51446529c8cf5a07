//! Whether the force falls below its baseline on the way in: the body is drawn to the surface, and held by it.
//!
//! Without adhesion the force of a contact is never below the baseline, whatever the body and the material. So a fall is sought in the
//! force itself, before a contact point or a material: a fit that knows no adhesion hides it in its baseline and tilt. The line through
//! the first points, for any number of them, is the baseline, and the means of some points behind them are compared with it.

use std::collections::BTreeMap;
use std::ops::Range;

use numerics::least_squares::{inverse, student_quantile};

use super::IndentationCurve;
use super::depth::{self, ends, median};
use super::flag::Flag;
use super::judgement::{DOUBTFUL, SPOILT};
use super::means::Measured;
use super::noise::{Linear, Noise, RIDGE, normal_matrix};
use super::start::approach_end;

/// Least number of points of a baseline; each that is tried next is longer by one in as many points.
const SHORTEST_BASELINE: usize = 10;
const BASELINE_SHARE: usize = 5;
/// Points of the narrowest fall: fewer are wild points.
const NARROWEST: usize = 3;
/// Part of the means within as many standard errors as are noise, five of a normal distribution: about a thousand means of a curve are
/// compared.
const COVERAGE: f64 = 1.0 - 5.7e-7;
/// Distance of a wild point from the median of five, in standard deviations.
const WILD: f64 = 5.0;

/// A fall of the force.
struct PullIn {
    /// Below the baseline, \[N].
    fall: f64,
    /// Largest force above the baseline, \[N].
    peak: f64,
}

/// What there is to say about a fall that is large enough to matter.
///
/// # Errors
/// The same, where it makes a fit without adhesion useless.
pub(super) fn flag(measured: &Measured) -> Result<Option<Flag>, Flag> {
    let Some(PullIn { fall, peak }) = find(measured) else {
        return Ok(None);
    };
    let part = fall / peak;
    let flag = Flag::JumpToContact { fall, part };
    if part > SPOILT {
        return Err(flag);
    }
    Ok((part > DOUBTFUL).then_some(flag))
}

/// The mean of some points that is below the line through the first ones.
#[derive(Debug, Clone, Copy)]
struct Fall {
    /// Number of points.
    width: usize,
    /// \[N].
    size: f64,
    /// In standard errors.
    significance: f64,
}

/// The largest fall that is no noise, neither independent nor lasting noise of the kind of the baseline.
fn find(measured: &Measured) -> Option<PullIn> {
    let IndentationCurve { time, depth, force } = &measured.curve;
    let counts = &measured.counts;
    let n = approach_end(depth) + 1;
    let noise = depth::noise(&time[..n], &force[..n], &counts[..n]);
    let force = without_wild_points(force, counts, noise);
    let approach = Approach::new(&time[..n], &depth[..n], &force[..n], &counts[..n]);
    let falls = baselines(n).flat_map(|baseline| approach.falls(baseline, noise));
    // A baseline that ends within the fall makes a steep line and much noise.
    let mut clearest: BTreeMap<usize, Fall> = BTreeMap::new();
    for fall in falls {
        let best = clearest.entry(fall.width).or_insert(fall);
        if fall.significance > best.significance {
            *best = fall;
        }
    }
    let sizes = clearest.values().map(|fall| fall.size);
    let fall = sizes.max_by(f64::total_cmp)?;
    let peak = ends(&force)[1] - median(force[..=n / 20].to_vec());
    // A force that only falls has the wrong sign.
    (fall < peak).then_some(PullIn { fall, peak })
}

/// Each point that is far from the median of itself and its two neighbours on each side is replaced by that.
fn without_wild_points(force: &[f64], counts: &[f64], noise: f64) -> Vec<f64> {
    let last = force.len() - 1;
    let value = |i: usize| {
        let middle = median(force[i.saturating_sub(2)..=(i + 2).min(last)].to_vec());
        let is_wild = (force[i] - middle).abs() * counts[i].sqrt() > WILD * noise;
        if is_wild { middle } else { force[i] }
    };
    (0..=last).map(value).collect()
}

/// The way in, with depths from −1 to 1.
struct Approach<'a> {
    time: &'a [f64],
    depth: Vec<f64>,
    force: &'a [f64],
    counts: &'a [f64],
    /// Sums over the first points of w, w d, w d², w f and w d f, with the number w of measured points of each.
    sums: Vec<[f64; 5]>,
}

impl<'a> Approach<'a> {
    fn new(time: &'a [f64], depth: &[f64], force: &'a [f64], counts: &'a [f64]) -> Self {
        let [low, high] = ends(depth);
        let scaled = depth
            .iter()
            .map(|one| 2.0 * (one - low) / (high - low) - 1.0);
        let depth: Vec<f64> = scaled.collect();
        let mut sums = vec![[0.0; 5]];
        for ((d, f), w) in depth.iter().zip(force).zip(counts) {
            let f = f - force[0];
            let [one, by_depth, square, value, product] = sums[sums.len() - 1];
            sums.push([
                one + w,
                by_depth + w * d,
                square + w * d * d,
                value + w * f,
                product + w * d * f,
            ]);
        }
        Self {
            time,
            depth,
            force,
            counts,
            sums,
        }
    }

    /// The falls behind a baseline, one for each width, that are no noise of the kind of the baseline.
    fn falls(&self, baseline: usize, noise: f64) -> Vec<Fall> {
        let Some(least) = student_quantile(COVERAGE, baseline - 2) else {
            return Vec::new();
        };
        let n = self.depth.len();
        let line = Line::through(&self.sums[baseline]);
        let widths = (0..).map(|k| NARROWEST << k);
        let widths = widths.take_while(|width| 4 * width <= n);
        // Where independent noise is exceeded, other noise is looked at.
        let windows = widths.filter_map(|width| {
            let firsts = (baseline..(n + 1).saturating_sub(width)).step_by(width / 3);
            let falls = firsts.map(|first| {
                let [from, to] = [self.sums[first], self.sums[first + width]];
                let sums = [0, 1, 3].map(|k| to[k] - from[k]);
                (first..first + width, line.fall_of(sums) / noise)
            });
            let deepest = falls.max_by(|one, other| one.1.total_cmp(&other.1))?;
            (deepest.1 > least).then_some(deepest.0)
        });
        let windows: Vec<Range<usize>> = windows.collect();
        if windows.is_empty() {
            return Vec::new();
        }
        let before = self.linear(0..baseline);
        let likely = Noise::likely(&before).into_iter().map(|(one, weight)| {
            let variance = one.likelihood(&before).variance();
            let is_white = one == Noise::WHITE;
            let variance = if is_white {
                variance.max(noise * noise)
            } else {
                variance
            };
            (one, weight * variance)
        });
        let likely: Vec<(Noise, f64)> = likely.collect();
        let falls = windows.into_iter().filter_map(|window| {
            let width = window.len();
            let [fall, error] = self.fall(baseline, window, &likely);
            (fall > least * error).then_some(Fall {
                width,
                // The largest of several is taken, which is too large by about its error.
                size: fall - error,
                significance: fall / error,
            })
        });
        falls.collect()
    }

    /// The parameters of a line, and the force that it is to explain.
    fn linear(&self, points: Range<usize>) -> Linear<'a> {
        Linear {
            time: &self.time[points.clone()],
            counts: &self.counts[points.clone()],
            columns: vec![
                vec![1.0; points.len()],
                self.depth[points.clone()].to_vec(),
                self.force[points].to_vec(),
            ],
        }
    }

    /// How far the points of a window are below the line through those of a baseline, and its standard error, in noises with the
    /// products of their probabilities and variances.
    fn fall(&self, baseline: usize, window: Range<usize>, likely: &[(Noise, f64)]) -> [f64; 2] {
        let both = |values: &[f64]| [&values[..baseline], &values[window.clone()]].concat();
        let [time, counts, depth, force] =
            [self.time, self.counts, &self.depth, self.force].map(both);
        let is_behind = [vec![0.0; baseline], vec![1.0; window.len()]].concat();
        let columns = [vec![1.0; time.len()], depth, is_behind, force];
        let of_noise = likely.iter().map(|(noise, variance)| {
            let mut columns = columns.clone();
            noise.whiten(&time, &counts, &mut columns);
            let [rise, error] = last_coefficient(&columns);
            [-rise, variance * error]
        });
        let of_noise: Vec<[f64; 2]> = of_noise.collect();
        let variance: f64 = of_noise.iter().map(|[_, variance]| variance).sum();
        [of_noise[0][0], variance.sqrt()]
    }
}

/// Numbers of points of the baselines that are tried.
fn baselines(n: usize) -> impl Iterator<Item = usize> {
    let next = |last: &usize| Some(last + last.div_ceil(BASELINE_SHARE));
    std::iter::successors(Some(SHORTEST_BASELINE), next).take_while(move |one| *one < n)
}

/// A line of least squares.
struct Line {
    weight: f64,
    depth: f64,
    value: f64,
    square: f64,
    slope: f64,
}

impl Line {
    fn through(&[weight, by_depth, square, value, product]: &[f64; 5]) -> Self {
        let [depth, value] = [by_depth, value].map(|sum| sum / weight);
        let square = (square - weight * depth * depth).max(0.0);
        // Where the depth is the same at all points, the line is level.
        let has_slope = square > f64::EPSILON * weight;
        let slope = if has_slope {
            (product - weight * depth * value) / square
        } else {
            0.0
        };
        Self {
            weight,
            depth,
            value,
            square: if has_slope { square } else { f64::INFINITY },
            slope,
        }
    }

    /// How far the mean of points with these sums of w, w d and w f is below, over its standard error for a standard deviation of 1.
    fn fall_of(&self, [weight, by_depth, value]: [f64; 3]) -> f64 {
        let side = by_depth / weight - self.depth;
        let fall = self.value + self.slope * side - value / weight;
        let variance = weight.recip() + self.weight.recip() + side * side / self.square;
        fall / variance.sqrt()
    }
}

/// The last coefficient of least squares, where the last column is to be explained, and its variance for a standard deviation of 1.
fn last_coefficient(columns: &[Vec<f64>]) -> [f64; 2] {
    let n = columns.len() - 1;
    let all = normal_matrix(columns);
    let mut matrix: Vec<f64> = (0..n)
        .flat_map(|row| all[row * (n + 1)..][..n].to_vec())
        .collect();
    (0..n).for_each(|k| matrix[k * (n + 1)] *= RIDGE);
    let Some(inverse) = inverse(&matrix, n) else {
        return [0.0, f64::INFINITY];
    };
    let row = &inverse[(n - 1) * n..];
    let products = row.iter().enumerate();
    let value = products
        .map(|(k, entry)| entry * all[n * (n + 1) + k])
        .sum();
    [value, row[n - 1]]
}
