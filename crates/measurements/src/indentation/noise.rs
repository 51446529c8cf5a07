//! Correlated noise: a white part and a part with an exponential correlation in time.
//!
//! ```text
//! noise = u + e,   cov(u_i, u_j) = s² λ e^(−|t_i − t_j|/T),   var e_i = s² (1 − λ)/m_i
//! ```
//! Points are means of m_i measured ones. A Kalman filter (1960, DOI 10.1115/1.3662552) whitens the noise. T and λ follow from
//! the restricted likelihood (Harville 1977, DOI 10.1080/01621459.1977.10480998), which accounts for the parameters of a fit.

use std::ops::Range;

/// Parameters of the noise.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Noise {
    /// Correlation time T, \[s].
    pub(super) time: f64,
    /// Fraction λ of the variance that is correlated.
    pub(super) part: f64,
}

/// A linear model of points: one column of derivatives per parameter, and the explained values as the last column.
pub(super) struct Linear<'a> {
    /// Times of the points, \[s].
    pub(super) time: &'a [f64],
    /// Numbers m of measured points in each mean.
    pub(super) counts: &'a [f64],
    /// Columns of derivatives, and last the explained values.
    pub(super) columns: Vec<Vec<f64>>,
}

/// Restricted likelihood of a noise for the residuals of a linear model.
#[derive(Debug, Clone, Copy)]
pub(super) struct Likelihood {
    /// Logarithm of the determinants of the covariance of the noise and of the normal matrix.
    logarithm: f64,
    /// Sum of squares of the whitened residuals.
    squares: f64,
    /// Number of points less number of parameters.
    degrees_of_freedom: f64,
}

impl Likelihood {
    /// Joint likelihood of two sets of points with a common s².
    pub(super) fn combine(self, other: Self) -> Self {
        Self {
            logarithm: self.logarithm + other.logarithm,
            squares: self.squares + other.squares,
            degrees_of_freedom: self.degrees_of_freedom + other.degrees_of_freedom,
        }
    }

    /// Estimate of s² by the restricted likelihood.
    pub(super) fn variance(self) -> f64 {
        self.squares / self.degrees_of_freedom
    }

    /// Deviance, minus twice the logarithm of the likelihood, at the estimated s².
    pub(super) fn deviance(self) -> f64 {
        self.deviance_at(self.variance())
    }

    /// Deviance at another variance s², \[N²].
    pub(super) fn deviance_at(self, variance: f64) -> f64 {
        self.logarithm + self.degrees_of_freedom * variance.ln() + self.squares / variance
    }
}

/// Ratio of neighbouring candidates of the correlation time T of the noise. Chosen.
const TIME_RATIO: f64 = 2.5;
/// Candidates of the fraction λ of the variance of the noise that is correlated; the rest is white. Chosen.
const CORRELATED_FRACTIONS: [f64; 7] = [0.01, 0.05, 0.2, 0.5, 0.8, 0.95, 1.0];
/// Prior probability of white noise. Chosen; all other candidates share the rest equally.
const WHITE: f64 = 0.5;
/// Smallest ratio of the posterior probability of a noise to the largest one, with which the noise is kept. Chosen.
const MIN_RELATIVE_PROBABILITY: f64 = 1e-3;
/// Factor on the diagonal of a normal matrix. Chosen: it keeps parameters finite that the points do not determine.
pub(super) const DIAGONAL_FACTOR: f64 = 1.0 + 1e-12;

impl Noise {
    /// Noise without correlation.
    pub(super) const WHITE: Self = Self {
        time: 1.0,
        part: 0.0,
    };

    /// Candidates: white noise, then correlation times from half a step of the points to their whole duration.
    pub(super) fn candidates(time: &[f64]) -> Vec<Self> {
        let length = time[time.len() - 1] - time[0];
        let shortest = 0.5 * length / time.len() as f64;
        let times = (0..)
            .map(|k| shortest * TIME_RATIO.powi(k))
            .take_while(|time| *time <= length);
        let lasting = times.flat_map(|time| CORRELATED_FRACTIONS.map(|part| Self { time, part }));
        [Self::WHITE].into_iter().chain(lasting).collect()
    }

    /// The candidates around this noise, with T and λ/(1 − λ) divided by `ratio`, unchanged, or multiplied by it.
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

    /// Noises for the residuals of a linear model with their posterior probabilities, in decreasing order; those with less than
    /// [`MIN_RELATIVE_PROBABILITY`] of the largest are left out.
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
        // Refine around the best candidate; each new one has the prior of its smaller area in the plane of ln T and λ.
        for halvings in [1, 2] {
            let best = all[0].0;
            let finer = TIME_RATIO.powf(0.5_f64.powi(halvings));
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
        let likely: Vec<_> = weights
            .filter(|(_, weight)| *weight > MIN_RELATIVE_PROBABILITY)
            .collect();
        let sum: f64 = likely.iter().map(|(_, weight)| weight).sum();
        likely
            .into_iter()
            .map(|(noise, weight)| (noise, weight / sum))
            .collect()
    }

    /// Transforms every column in place so that this noise becomes white with the variance s², by a Kalman filter. Returns ln
    /// det of the covariance over s².
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
        // Filter all columns row by row, because in a column every number depends on the previous one.
        let mut states = vec![0.0; columns.len()];
        for (i, [kept, gain, scale]) in steps.into_iter().enumerate() {
            for (column, state) in columns.iter_mut().zip(&mut states) {
                let expected = kept * *state;
                let innovation = column[i] - expected;
                *state = expected + gain * innovation;
                column[i] = scale * innovation;
            }
        }
        logarithm
    }

    /// Product of the covariance over s² with a column.
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

    /// Restricted likelihood of this noise for the residuals of a linear model.
    pub(super) fn likelihood(self, linear: &Linear) -> Likelihood {
        let mut columns = linear.columns.clone();
        let noise = self.whiten(linear.time, linear.counts, &mut columns);
        let n = columns.len();
        let mut matrix = normal_matrix(&columns);
        let mut determinant = 0.0;
        // Eliminate the parameters by Cholesky steps. The pivots give the determinant, and the last one is the residual sum of
        // squares.
        for k in 0..n - 1 {
            let pivot = matrix[k * (n + 1)] * DIAGONAL_FACTOR;
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
            degrees_of_freedom: (columns[0].len() + 1 - n) as f64,
        }
    }
}

impl Linear<'_> {
    /// The model of a range of points, with only the parameters whose derivatives do not all vanish there.
    pub(super) fn part(&self, range: Range<usize>) -> Linear<'_> {
        let (last, rows) = self
            .columns
            .split_last()
            .map_or((&[][..], &[][..]), |(l, r)| (&l[..], r));
        let concerned = rows
            .iter()
            .map(|row| row[range.clone()].to_vec())
            .filter(|row| row.iter().any(|slope| *slope != 0.0));
        Linear {
            time: &self.time[range.clone()],
            counts: &self.counts[range.clone()],
            columns: concerned.chain([last[range.clone()].to_vec()]).collect(),
        }
    }
}

/// Matrix of the products of columns, row by row.
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

/// Scalar product in four independent sums, for instruction-level parallelism.
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

/// Number of correlated points per independent point, the integrated autocorrelation time 1 + 2 Σ ρ(lag), at least 1.
///
/// The sum extends to the lag of five times itself (Sokal 1997, Sect. 3).
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
