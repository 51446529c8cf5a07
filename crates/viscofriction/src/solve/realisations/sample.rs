//! Two-level Monte Carlo estimate of the mean of a quantity over random surfaces.
//!
//! All N surfaces have a coarse value cᵢ, and the first n also a value fᵢ with an error estimate. The mean is
//!
//! ```text
//! ⟨f⟩ₙ + ⟨c⟩_N − ⟨c⟩ₙ,      (standard error)² = s²(f − c)/n + (s²(c) + 2 cov(c, f − c))/N,
//! ```
//!
//! unbiased by the coarse grid, whose error cancels in the difference. The variance of the difference is smaller the better both
//! are correlated (multilevel Monte Carlo with two levels: Giles 2008). Without a coarse grid c = f and N = n.

use numerics::vectors::mean;

pub(super) use crate::scene::FEWEST_REALISATIONS as FEWEST;

/// Scatter of a quantity over the surfaces.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Scatter {
    /// Standard deviation s of single surfaces.
    pub standard_deviation: f64,
    /// Standard error of the mean; s/√N for N surfaces without a coarse grid.
    pub standard_error: f64,
}

/// Numbers of surfaces, each set including the first surfaces.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Counts {
    /// Number of answers with error estimates.
    pub(super) fine: usize,
    /// Number of coarse solutions.
    pub(super) coarse: usize,
}

/// The values of one quantity on all surfaces.
#[derive(Debug, Clone, Copy)]
pub(super) struct Sample<'a> {
    /// Values fᵢ of the first surfaces.
    pub(super) fine: &'a [f64],
    /// Values cᵢ of all surfaces; the same as `fine` without a coarse grid.
    pub(super) coarse: &'a [f64],
}

/// Unbiased sample covariance of pairs of values.
fn covariance(pairs: impl ExactSizeIterator<Item = (f64, f64)> + Clone) -> f64 {
    let count = pairs.len() as f64;
    let (a, b) = pairs
        .clone()
        .fold((0.0, 0.0), |sums, pair| (sums.0 + pair.0, sums.1 + pair.1));
    let products = pairs.map(|pair| (pair.0 - a / count) * (pair.1 - b / count));
    products.sum::<f64>() / (count - 1.0)
}

impl Sample<'_> {
    /// Correction ⟨c⟩_N − ⟨c⟩ₙ of the mean of the answers: the mean c of all N coarse solutions less that of the n surfaces with
    /// an answer.
    pub(super) fn shift(&self) -> f64 {
        match self.fine.len() == self.coarse.len() {
            true => 0.0,
            false => mean(self.coarse) - mean(&self.coarse[..self.fine.len()]),
        }
    }

    /// Mean of the answers f, corrected by [`Self::shift`] with the coarse solutions c of more surfaces (control variate).
    pub(super) fn mean(&self) -> f64 {
        mean(self.fine) + self.shift()
    }

    /// The variances s²(f − c) and s²(c) + 2 cov(c, f − c), the latter at least 0, from the surfaces that have both values.
    fn variances(&self) -> [f64; 2] {
        let values = self.coarse.iter().map(|value| (*value, *value));
        let both = self.fine.iter().zip(self.coarse);
        let difference = both.clone().map(|(fine, coarse)| fine - coarse);
        let pairs = both.map(|(fine, coarse)| (*coarse, fine - coarse));
        let rest = covariance(values) + 2.0 * covariance(pairs);
        [
            covariance(difference.map(|value| (value, value))),
            rest.max(0.0),
        ]
    }

    /// Standard deviation of single surfaces and standard error of the mean; `None` for one answer.
    pub(super) fn scatter(&self) -> Option<Scatter> {
        let [difference, rest] = self.variances();
        let error = self.errors_squared([difference, rest]).iter().sum::<f64>();
        (self.fine.len() > 1).then(|| Scatter {
            standard_deviation: (difference + rest).sqrt(),
            standard_error: error.sqrt(),
        })
    }

    /// Contributions s²(f − c)/n and (s²(c) + 2 cov(c, f − c))/N to the square of the standard error, from the
    /// [`variances`](Self::variances).
    fn errors_squared(&self, [difference, rest]: [f64; 2]) -> [f64; 2] {
        let [fine, coarse] = [self.fine, self.coarse].map(|values| values.len() as f64);
        [difference / fine, rest / coarse]
    }

    /// Standard error relative to the mean, enlarged for small samples by Student's distribution to first order in 1/N. It is
    /// infinite for fewer than [`FEWEST`] answers.
    pub(super) fn relative_standard_error(&self) -> f64 {
        if self.fine.len() < FEWEST {
            return f64::INFINITY;
        }
        let [difference, rest] = self.errors_squared(self.variances());
        let difference = difference * student_factor(self.fine.len());
        let rest = rest * student_factor(self.coarse.len());
        match (difference + rest).sqrt() {
            0.0 => 0.0,
            error => error / self.mean().abs(),
        }
    }

    /// Numbers n of answers and N of coarse solutions that reach the relative standard error `asked` with the least work n +
    /// part N, each from 10 to `most`. `part` is the work for a coarse solution over that for an answer; 1 without a coarse
    /// grid.
    pub(super) fn wanted(&self, asked: f64, most: usize, part: f64) -> Counts {
        // Choose the number n of answers and N of coarse solutions of least work n + part N for the allowed variance (Lagrange
        // multiplier). Then bound both by the smallest and largest sample.
        let allowed = (asked * self.mean()).powi(2);
        let [difference, rest] = self.variances();
        let difference = difference * student_factor(self.fine.len());
        let rest = rest * student_factor(self.coarse.len());
        let optimal = (difference + (difference * rest * part).sqrt()) / allowed;
        let fine = optimal.max(FEWEST as f64).ceil();
        let coarse = rest / (allowed - difference / fine);
        let most = most as f64;
        let [fine, coarse] = if coarse.max(fine) <= most {
            [fine, coarse]
        } else {
            let left = allowed - rest / most;
            let enough = if left > 0.0 {
                difference / left
            } else {
                // Even the largest sample does not suffice: keep the optimal ratio of both numbers.
                most * (difference * part / rest).sqrt()
            };
            [enough.max(FEWEST as f64).min(most), most]
        };
        Counts {
            fine: rounded_up(fine),
            coarse: rounded_up(coarse.max(fine)),
        }
    }
}

/// Smallest number of leading values, at least `from`, with the requested relative standard error; `None` if all are too few.
pub(super) fn first_enough(values: &[f64], from: usize, asked: f64) -> Option<usize> {
    let error = |count: usize| {
        let [fine, coarse] = [&values[..count]; 2];
        Sample { fine, coarse }.relative_standard_error()
    };
    (from..=values.len()).find(|count| error(*count) <= asked)
}

/// A number of surfaces, rounded up.
#[expect(
    clippy::cast_possible_truncation,
    clippy::cast_sign_loss,
    reason = "a number of surfaces"
)]
fn rounded_up(count: f64) -> usize {
    count.ceil() as usize
}

/// Square of the factor on the standard error of a sample of `count` values (Student's distribution, first order).
fn student_factor(count: usize) -> f64 {
    (1.0 + 0.5 / (count as f64 - 1.0)).powi(2)
}

#[cfg(test)]
mod tests {
    use super::*;

    fn assert_close(found: f64, expected: f64, tolerance: f64) {
        let error = found / expected - 1.0;
        assert!(error.abs() < tolerance, "{found} for {expected}");
    }

    /// Pseudo-random numbers of mean 0 and variance 1.
    fn noise(seed: u64) -> impl Iterator<Item = f64> {
        let mut state = seed;
        std::iter::repeat_with(move || {
            state = state
                .wrapping_mul(6_364_136_223_846_793_005)
                .wrapping_add(1_442_695_040_888_963_407);
            let unit = (state >> 11) as f64 / (1u64 << 53) as f64;
            12.0_f64.sqrt() * (unit - 0.5)
        })
    }

    #[test]
    fn the_mean_of_surfaces_that_are_all_known_is_that_of_them() {
        let values: Vec<f64> = noise(1).take(20).map(|one| 3.0 + one).collect();
        let sample = Sample {
            fine: &values,
            coarse: &values,
        };
        let scatter = sample.scatter().expect("a scatter");
        assert_close(sample.mean(), mean(&values), 1e-15);
        let deviation = scatter.standard_deviation;
        assert_close(scatter.standard_error, deviation / 20.0_f64.sqrt(), 1e-12);
        let alone = Sample {
            fine: &values[..1],
            coarse: &values[..1],
        };
        assert_eq!(alone.scatter(), None);
    }

    #[test]
    fn surfaces_are_enough_as_soon_as_their_mean_is_known() {
        let values: Vec<f64> = noise(5).take(100).map(|one| 3.0 + one).collect();
        let count = first_enough(&values, 1, 0.05).expect("enough");
        let error = |count: usize| {
            let [fine, coarse] = [&values[..count]; 2];
            let sample = Sample { fine, coarse };
            let error = sample.scatter().expect("a scatter").standard_error;
            error / sample.mean() * (1.0 + 0.5 / (count as f64 - 1.0))
        };
        assert!(count > 20 && error(count) <= 0.05, "{count}");
        assert!((FEWEST..count).all(|fewer| error(fewer) > 0.05), "{count}");
        assert_eq!(first_enough(&values, count + 3, 0.05), Some(count + 3));
        assert_eq!(first_enough(&values, 1, 1e-3), None);
        assert_eq!(first_enough(&values[..9], 1, 0.9), None, "too few to tell");
    }

    /// Over many samples the standard error is the rms deviation of the means from the true mean, whatever the error of the coarse
    /// grid.
    #[test]
    fn the_standard_error_is_the_deviation_of_means() {
        let mut numbers = noise(2);
        let mut draw = |count: usize| -> Vec<f64> { numbers.by_ref().take(count).collect() };
        let [mut squares, mut said, mut ratio] = [0.0; 3];
        for _ in 0..2000 {
            let (common, own) = (draw(100), draw(100));
            let coarse: Vec<f64> = common.iter().map(|one| 7.0 + 0.8 * one).collect();
            let all = common.iter().zip(&own).take(15);
            let fine: Vec<f64> = all.map(|(a, b)| 5.0 + a + 0.3 * b).collect();
            let sample = Sample {
                fine: &fine,
                coarse: &coarse,
            };
            squares += (sample.mean() - 5.0).powi(2) / 2000.0;
            let scatter = sample.scatter().expect("a scatter");
            said += scatter.standard_error.powi(2) / 2000.0;
            ratio += scatter.standard_deviation.powi(2) / (1.09 * 2000.0);
        }
        assert_close(squares.sqrt(), said.sqrt(), 0.05);
        assert_close(ratio, 1.0, 0.05);
    }

    /// No other pair of counts reaches the requested error with less work.
    #[test]
    fn the_wanted_counts_take_the_least_work() {
        let coarse: Vec<f64> = noise(3).take(10).map(|one| 4.0 + one).collect();
        let own = noise(4).take(10);
        let fine = coarse.iter().zip(own).map(|(a, b)| 1.0 + a + 0.4 * b);
        let fine: Vec<f64> = fine.collect();
        let sample = Sample {
            fine: &fine,
            coarse: &coarse,
        };
        let (asked, part) = (5e-3, 0.05);
        let work = |counts: Counts| counts.fine as f64 + part * counts.coarse as f64;
        let found = sample.wanted(asked, usize::MAX, part);
        let [difference, rest] = sample.variances().map(|one| one * student_factor(10));
        let allowed = (asked * sample.mean()).powi(2);
        let left = |counts: Counts| {
            difference / counts.fine as f64 + rest / counts.coarse as f64 <= allowed
        };
        assert!(left(found), "{found:?}");
        for fine in (10..5 * found.fine).step_by(7) {
            let rest = rest / (allowed - difference / fine as f64);
            let coarse = if rest > 0.0 {
                rest.ceil()
            } else {
                f64::INFINITY
            };
            let other = fine as f64 + part * coarse;
            assert!(work(found) <= 1.01 * other, "{found:?} {fine} {coarse}");
        }
        let few = sample.wanted(asked, 30, part);
        assert!(few.coarse == 30 && few.fine < 30, "too few anyway: {few:?}");
    }
}
