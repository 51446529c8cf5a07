//! Detection of adhesion on the approach: a force below its baseline.
//!
//! Without adhesion the force of a contact is never below the baseline, for any body and material. A fall is therefore
//! searched in the force itself, before the fit, whose baseline and tilt would absorb it. The baseline is the regression line
//! through the first points, for several numbers of them. Means of later points are compared with it.

use std::collections::BTreeMap;
use std::ops::Range;

use numerics::least_squares::{inverse, student_quantile};

use super::IndentationCurve;
use super::depth::{self, median, min_max};
use super::flag::Flag;
use super::judgement::{MAX_FORCE_DEFECT, MIN_FORCE_DEFECT};
use super::means::Measured;
use super::noise::{DIAGONAL_FACTOR, Linear, Noise, normal_matrix};
use super::start::approach_end;

/// Smallest number of points of a baseline, the line through the points before a fall of the force. Chosen: a line through
/// fewer points is too uncertain where it is extrapolated to the fall.
const MIN_BASELINE_POINTS: usize = 10;
/// Inverse of the relative growth of the baselines that are tried: each has a fifth more points than the one before. Chosen:
/// the uncertainty of a line changes little over a fifth, and only some tens of baselines have to be tried.
const BASELINE_GROWTH: usize = 5;
/// Smallest number of points of a fall of the force by attraction; fewer count as outliers. Chosen: one or two low points
/// are more probably disturbances.
const MIN_FALL_POINTS: usize = 3;
/// Probability that noise stays below a deviation that counts as a fall: that of five standard errors of a normal
/// distribution. Chosen: about a thousand means of a curve are compared, so that noise exceeds it in one of 2000 curves.
const COVERAGE: f64 = 1.0 - 5.7e-7;
/// Smallest distance of an outlier from the median of five points, in standard deviations of the noise. Chosen: normal noise
/// exceeds it in one of 2·10⁶ points, which no curve has.
const OUTLIER_DEVIATIONS: f64 = 5.0;

/// Adhesion on the approach.
struct PullIn {
    /// Fall of the force below the baseline, \[N].
    fall: f64,
    /// Largest force above the baseline, \[N].
    peak: f64,
}

/// Flag for a relevant fall of the force.
///
/// # Errors
/// The flag if the fall is too large for a fit without adhesion.
pub(super) fn flag(measured: &Measured) -> Result<Option<Flag>, Flag> {
    let Some(PullIn { fall, peak }) = find(measured) else {
        return Ok(None);
    };
    let part = fall / peak;
    let flag = Flag::JumpToContact { fall, part };
    if part > MAX_FORCE_DEFECT {
        return Err(flag);
    }
    Ok((part > MIN_FORCE_DEFECT).then_some(flag))
}

/// A mean of points below the baseline.
#[derive(Debug, Clone, Copy)]
struct Fall {
    /// Number of points.
    width: usize,
    /// Distance below the baseline, \[N].
    size: f64,
    /// Distance below the baseline in standard errors.
    significance: f64,
}

/// Largest fall that is significant both for white noise and for the correlated noise of the baseline.
fn find(measured: &Measured) -> Option<PullIn> {
    let IndentationCurve { time, depth, force } = &measured.curve;
    let counts = &measured.counts;
    let n = approach_end(depth) + 1;
    let noise = depth::noise(&time[..n], &force[..n], &counts[..n]);
    let force = without_outliers(force, counts, noise);
    let approach = Approach::new(&time[..n], &depth[..n], &force[..n], &counts[..n]);
    let falls = baselines(n).flat_map(|baseline| approach.falls(baseline, noise));
    // Keep the most significant fall of each width: a baseline that ends within the fall is steep and noisy.
    let mut clearest: BTreeMap<usize, Fall> = BTreeMap::new();
    for fall in falls {
        let best = clearest.entry(fall.width).or_insert(fall);
        if fall.significance > best.significance {
            *best = fall;
        }
    }
    let sizes = clearest.values().map(|fall| fall.size);
    let fall = sizes.max_by(f64::total_cmp)?;
    let peak = min_max(&force)[1] - median(force[..=n / 20].to_vec());
    // A fall as large as the peak belongs to a force that only decreases, hence has the wrong sign, and is no attraction.
    (fall < peak).then_some(PullIn { fall, peak })
}

/// The forces \[N] with outliers replaced by the median of five points; `noise` \[N] is the standard deviation of a measured
/// force.
fn without_outliers(force: &[f64], counts: &[f64], noise: f64) -> Vec<f64> {
    let last = force.len() - 1;
    let value = |i: usize| {
        let middle = median(force[i.saturating_sub(2)..=(i + 2).min(last)].to_vec());
        let is_outlier = (force[i] - middle).abs() * counts[i].sqrt() > OUTLIER_DEVIATIONS * noise;
        if is_outlier { middle } else { force[i] }
    };
    (0..=last).map(value).collect()
}

/// The approach, with depths scaled to −1 to 1.
struct Approach<'a> {
    time: &'a [f64],
    depth: Vec<f64>,
    force: &'a [f64],
    counts: &'a [f64],
    /// Cumulative sums of w, w d, w d², w f and w d f, with the number w of measured points in each mean.
    sums: Vec<[f64; 5]>,
}

impl<'a> Approach<'a> {
    /// Scales the depths and sums the moments for regression lines, with forces relative to the first.
    fn new(time: &'a [f64], depth: &[f64], force: &'a [f64], counts: &'a [f64]) -> Self {
        let [low, high] = min_max(depth);
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

    /// Significant falls of the force \[N] below the regression line through the first `baseline` points, one for each width of
    /// a window. `noise` \[N] is the standard deviation of a measured force.
    fn falls(&self, baseline: usize, noise: f64) -> Vec<Fall> {
        let Some(least) = student_quantile(COVERAGE, baseline - 2) else {
            return Vec::new();
        };
        let n = self.depth.len();
        let line = Line::through(&self.sums[baseline]);
        let widths = (0..)
            .map(|k| MIN_FALL_POINTS << k)
            .take_while(|width| 4 * width <= n);
        // Select windows that are significant for white noise; the test for correlated noise follows.
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
                // The maximum of several falls is biased by about its error.
                size: fall - error,
                significance: fall / error,
            })
        });
        falls.collect()
    }

    /// Linear model of the force as a line over the depth.
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

    /// Distance \[N] of the points of a window below the line through the first `baseline` points, by the most likely noise,
    /// and its standard error, averaged over the noises.
    ///
    /// `likely` has noises with the products of their probabilities and variances.
    fn fall(&self, baseline: usize, window: Range<usize>, likely: &[(Noise, f64)]) -> [f64; 2] {
        let both = |values: &[f64]| [&values[..baseline], &values[window.clone()]].concat();
        let [time, counts, depth, force] =
            [self.time, self.counts, &self.depth, self.force].map(both);
        let is_after = [vec![0.0; baseline], vec![1.0; window.len()]].concat();
        let columns = [vec![1.0; time.len()], depth, is_after, force];
        let of_noise = likely.iter().map(|(noise, variance)| {
            let mut whitened = columns.clone();
            noise.whiten(&time, &counts, &mut whitened);
            let [rise, error] = last_coefficient(&whitened);
            [-rise, variance * error]
        });
        let of_noise: Vec<[f64; 2]> = of_noise.collect();
        let variance: f64 = of_noise.iter().map(|[_, variance]| variance).sum();
        [of_noise[0][0], variance.sqrt()]
    }
}

/// Numbers of points of the baselines that are tried: from [`MIN_BASELINE_POINTS`] on, each a fifth larger, below `n`.
fn baselines(n: usize) -> impl Iterator<Item = usize> {
    let next = |last: &usize| Some(last + last.div_ceil(BASELINE_GROWTH));
    std::iter::successors(Some(MIN_BASELINE_POINTS), next).take_while(move |one| *one < n)
}

/// A weighted regression line of force over scaled depth.
struct Line {
    /// Sum of the weights.
    weight: f64,
    /// Mean depth.
    depth: f64,
    /// Mean force relative to the first, \[N].
    value: f64,
    /// Weighted sum of squares of the depths about their mean; infinite for a level line.
    square: f64,
    /// Slope, \[N].
    slope: f64,
}

impl Line {
    /// The line from the sums of w, w d, w d², w f and w d f.
    fn through(&[weight, by_depth, square, value, product]: &[f64; 5]) -> Self {
        let [depth, value] = [by_depth, value].map(|sum| sum / weight);
        let square = (square - weight * depth * depth).max(0.0);
        // If all depths are equal, the slope is not determined, and the line is taken to be level.
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

    /// Distance of a mean below the line in standard errors for a unit standard deviation, from the sums of w, w d and w f.
    fn fall_of(&self, [weight, by_depth, value]: [f64; 3]) -> f64 {
        let side = by_depth / weight - self.depth;
        let fall = self.value + self.slope * side - value / weight;
        let variance = weight.recip() + self.weight.recip() + side * side / self.square;
        fall / variance.sqrt()
    }
}

/// Last coefficient of the regression of the last column on the others, and its variance for a unit standard deviation.
fn last_coefficient(columns: &[Vec<f64>]) -> [f64; 2] {
    let n = columns.len() - 1;
    let all = normal_matrix(columns);
    let mut matrix: Vec<f64> = (0..n)
        .flat_map(|row| all[row * (n + 1)..][..n].to_vec())
        .collect();
    (0..n).for_each(|k| matrix[k * (n + 1)] *= DIAGONAL_FACTOR);
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
