//! Noise that lasts from point to point.
//!
//! ```text
//! noise = u + e,   cov(u_i, u_j) = s² λ e^(−|t_i − t_j|/T),   var e_i = s² (1 − λ)/m_i
//! ```
//! of points that are means of m_i measured ones. Kalman's filter (1960, DOI 10.1115/1.3662552) makes it independent; T and λ
//! are judged by the restricted likelihood (Harville 1977, DOI 10.1080/01621459.1977.10480998), which knows what the
//! parameters of a fit take out of the residuals.

use std::ops::Range;

/// What lasts, and for how long.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Noise {
    /// T, \[s].
    pub(super) time: f64,
    /// λ, the part of the variance that lasts.
    pub(super) part: f64,
}

/// A linear model of points: what its parameters do to each of them, and last what they are to explain.
pub(super) struct Linear<'a> {
    pub(super) time: &'a [f64],
    pub(super) counts: &'a [f64],
    pub(super) columns: Vec<Vec<f64>>,
}

/// How well a noise explains what a linear model leaves.
#[derive(Debug, Clone, Copy)]
pub(super) struct Likelihood {
    /// Logarithm of the determinants of the noise and of the normal matrix.
    logarithm: f64,
    /// Squares of independent residuals.
    squares: f64,
    freedom: f64,
}

impl Likelihood {
    /// Of two sets of points with the same s².
    pub(super) fn with(self, other: Self) -> Self {
        Self {
            logarithm: self.logarithm + other.logarithm,
            squares: self.squares + other.squares,
            freedom: self.freedom + other.freedom,
        }
    }

    /// The most likely s².
    pub(super) fn variance(self) -> f64 {
        self.squares / self.freedom
    }

    /// Minus twice the logarithm of the likelihood, with that s².
    pub(super) fn deviance(self) -> f64 {
        self.deviance_at(self.variance())
    }

    /// With another s².
    pub(super) fn deviance_at(self, variance: f64) -> f64 {
        self.logarithm + self.freedom * variance.ln() + self.squares / variance
    }
}

/// Ratio of neighbouring times that are tried, and parts.
const RATIO: f64 = 2.5;
const PARTS: [f64; 7] = [0.01, 0.05, 0.2, 0.5, 0.8, 0.95, 1.0];
/// Probability of white noise before anything was measured; all others share the rest.
const WHITE: f64 = 0.5;
/// Noises with a smaller part of the largest probability do not count.
const UNLIKELY: f64 = 1e-3;
/// A little more on the diagonal of a normal matrix keeps what is not determined finite.
pub(super) const RIDGE: f64 = 1.0 + 1e-12;

impl Noise {
    pub(super) const WHITE: Self = Self {
        time: 1.0,
        part: 0.0,
    };

    /// Noise that lasts for half a step of the points up to their whole time, after white noise.
    pub(super) fn candidates(time: &[f64]) -> Vec<Self> {
        let length = time[time.len() - 1] - time[0];
        let shortest = 0.5 * length / time.len() as f64;
        let times = (0..).map(|k| shortest * RATIO.powi(k));
        let times = times.take_while(|time| *time <= length);
        let lasting = times.flat_map(|time| PARTS.map(|part| Self { time, part }));
        [Self::WHITE].into_iter().chain(lasting).collect()
    }

    /// Around this one, by a ratio of times and of λ/(1 − λ).
    fn neighbours(self, ratio: f64) -> impl Iterator<Item = Self> {
        let odds = move |factor: f64| factor * self.part / (1.0 - self.part + factor * self.part);
        let factors = [ratio.recip(), 1.0, ratio];
        let parts = factors
            .map(odds)
            .into_iter()
            .filter(move |part| *part < 1.0);
        let parts: Vec<f64> = parts.chain([self.part]).collect();
        let noise = move |(one, part): (f64, f64)| Self {
            time: one * self.time,
            part,
        };
        let all = factors
            .into_iter()
            .flat_map(move |one| parts.clone().into_iter().map(move |part| (one, part)));
        all.map(noise).filter(move |one| *one != self)
    }

    /// What is likely, with probabilities, the most likely one first.
    pub(super) fn likely(linear: &Linear) -> Vec<(Self, f64)> {
        let candidates = Self::candidates(linear.time);
        let judged = |noise: Self, prior: f64| {
            let deviance = noise.likelihood(linear).deviance();
            (noise, 0.5 * deviance - prior.ln())
        };
        let share = (1.0 - WHITE) / candidates.len() as f64;
        let prior = |noise: &Self| if *noise == Self::WHITE { WHITE } else { share };
        let mut all: Vec<_> = candidates
            .into_iter()
            .map(|noise| judged(noise, prior(&noise)))
            .collect();
        let order = |one: &(Self, f64), other: &(Self, f64)| one.1.total_cmp(&other.1);
        all.sort_by(order);
        // Finer about the best one, where each stands for a smaller piece of the plane.
        for halvings in [1, 2] {
            let best = all[0].0;
            let finer = RATIO.powf(0.5_f64.powi(halvings));
            if best.part > 0.0 {
                let share = share * 0.25_f64.powi(halvings);
                all.extend(best.neighbours(finer).map(|noise| judged(noise, share)));
                all.sort_by(order);
            }
        }
        let least = all[0].1;
        let weights = all
            .into_iter()
            .map(|(noise, cost)| (noise, (least - cost).exp()));
        let likely: Vec<_> = weights.filter(|(_, weight)| *weight > UNLIKELY).collect();
        let sum: f64 = likely.iter().map(|(_, weight)| weight).sum();
        likely
            .into_iter()
            .map(|(noise, weight)| (noise, weight / sum))
            .collect()
    }

    /// Makes points independent, of the variance s², in every column; the logarithm of the determinant of the noise over s².
    pub(super) fn whiten(self, time: &[f64], counts: &[f64], columns: &mut [Vec<f64>]) -> f64 {
        let mut variance = self.part;
        let mut last = time[0];
        let mut logarithm = 0.0;
        let steps = time.iter().zip(counts).map(|(&time, count)| {
            let kept = ((last - time) / self.time).exp();
            last = time;
            variance = self.part + kept * kept * (variance - self.part);
            let total = variance + (1.0 - self.part) / count;
            let gain = variance / total;
            variance *= 1.0 - gain;
            logarithm += total.ln();
            [kept, gain, total.sqrt().recip()]
        });
        let steps: Vec<[f64; 3]> = steps.collect();
        // Column by column every number would wait for the one before it.
        let mut states = vec![0.0; columns.len()];
        for (i, [kept, gain, scale]) in steps.into_iter().enumerate() {
            for (column, state) in columns.iter_mut().zip(&mut states) {
                let expected = kept * *state;
                let news = column[i] - expected;
                *state = expected + gain * news;
                column[i] = scale * news;
            }
        }
        logarithm
    }

    /// The covariance over s², times a column.
    pub(super) fn covariance(self, time: &[f64], counts: &[f64], column: &[f64]) -> Vec<f64> {
        let n = column.len();
        let kept = |from: usize, to: usize| ((time[from] - time[to]) / self.time).exp();
        let mut sums = column.to_vec();
        let mut later = 0.0;
        for i in (0..n - 1).rev() {
            later = kept(i, i + 1) * (later + column[i + 1]);
            sums[i] += later;
        }
        let mut earlier = 0.0;
        for i in 1..n {
            earlier = kept(i - 1, i) * (earlier + column[i - 1]);
            sums[i] += earlier;
        }
        let white = column
            .iter()
            .zip(counts)
            .map(|(value, count)| (1.0 - self.part) * value / count);
        sums.iter()
            .zip(white)
            .map(|(sum, white)| self.part * sum + white)
            .collect()
    }

    pub(super) fn likelihood(self, linear: &Linear) -> Likelihood {
        let mut columns = linear.columns.clone();
        let noise = self.whiten(linear.time, linear.counts, &mut columns);
        let n = columns.len();
        let mut matrix = normal_matrix(&columns);
        let mut determinant = 0.0;
        // Columns are eliminated one after the other; the squares of what is left of the last one stay.
        for k in 0..n - 1 {
            let pivot = matrix[k * (n + 1)] * RIDGE;
            if pivot <= 0.0 {
                continue;
            }
            determinant += pivot.ln();
            for row in k + 1..n {
                let factor = matrix[row * n + k] / pivot;
                for column in k + 1..=row {
                    matrix[row * n + column] -= factor * matrix[column * n + k];
                }
            }
        }
        Likelihood {
            logarithm: noise + determinant,
            squares: matrix[n * n - 1].max(f64::MIN_POSITIVE),
            freedom: (columns[0].len() + 1 - n) as f64,
        }
    }
}

impl Linear<'_> {
    /// Some of the points, and the parameters that have to do with them.
    pub(super) fn part(&self, range: Range<usize>) -> Linear<'_> {
        let (last, rows) = self
            .columns
            .split_last()
            .map_or((&[][..], &[][..]), |(l, r)| (&l[..], r));
        let concerned = rows.iter().map(|row| row[range.clone()].to_vec());
        let concerned = concerned.filter(|row| row.iter().any(|slope| *slope != 0.0));
        Linear {
            time: &self.time[range.clone()],
            counts: &self.counts[range.clone()],
            columns: concerned.chain([last[range.clone()].to_vec()]).collect(),
        }
    }
}

/// Products of columns, row by row.
pub(super) fn normal_matrix(columns: &[Vec<f64>]) -> Vec<f64> {
    let n = columns.len();
    let mut matrix = vec![0.0; n * n];
    for (j, one) in columns.iter().enumerate() {
        for (k, other) in columns[..=j].iter().enumerate() {
            let product = dot(one, other);
            matrix[j * n + k] = product;
            matrix[k * n + j] = product;
        }
    }
    matrix
}

/// In four sums, so that no product waits for the one before it.
fn dot(one: &[f64], other: &[f64]) -> f64 {
    let mut sums = [0.0; 4];
    let [quads, others] = [one.chunks_exact(4), other.chunks_exact(4)];
    let rest = quads.remainder().iter().zip(others.remainder());
    let rest: f64 = rest.map(|(a, b)| a * b).sum();
    for (quad, other) in quads.zip(others) {
        for (sum, (a, b)) in sums.iter_mut().zip(quad.iter().zip(other)) {
            *sum += a * b;
        }
    }
    sums.iter().sum::<f64>() + rest
}

/// How many points one independent point stands for: 1 + 2 Σ of the correlations at the lags up to five times that sum (Sokal 1997, Sect. 3), at least 1.
pub(crate) fn correlated_points(values: &[f64]) -> f64 {
    let product = |lag: usize| {
        let pairs = values.iter().zip(&values[lag..]);
        pairs.map(|(one, other)| one * other).sum::<f64>()
    };
    let square = product(0);
    let mut sum = 1.0_f64;
    for lag in 1..values.len() {
        sum += 2.0 * product(lag) / square;
        if lag as f64 >= 5.0 * sum {
            break;
        }
    }
    if sum.is_finite() { sum.max(1.0) } else { 1.0 }
}
