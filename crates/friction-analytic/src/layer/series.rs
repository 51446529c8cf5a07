//! Chebyshev series of pairs of functions, from as many points as they need.

use std::f64::consts::PI;

/// Points of the first series, and by how many times each next one has more; the points of one are among those of the next.
const FEWEST: usize = 9;
const TIMES: usize = 3;
const MOST: usize = 243;

/// Two functions of x from −1 to 1, and what their last terms are.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct Series {
    coefficients: Vec<[f64; 2]>,
    /// The largest of the last terms.
    pub(super) tail: f64,
}

impl Series {
    /// With last terms below a tolerance, or as many terms as there may be.
    pub(super) fn of<E>(
        function: impl Fn(f64) -> Result<[f64; 2], E>,
        tolerance: f64,
    ) -> Result<Self, E> {
        let mut values: Vec<[f64; 2]> = Vec::new();
        let mut n = FEWEST;
        loop {
            let node = |k: usize| (0.5 * PI * (2 * k + 1) as f64 / n as f64).cos();
            let value = |k: usize| match values.get(k / TIMES) {
                Some(known) if k % TIMES == TIMES / 2 => Ok(*known),
                _ => function(node(k)),
            };
            values = (0..n).map(value).collect::<Result<_, E>>()?;
            let series = Self::through(&values);
            if series.tail <= tolerance || n >= MOST {
                return Ok(series.shortened(0.01 * tolerance));
            }
            n *= TIMES;
        }
    }

    /// Through the values at the zeros of the polynomial of as many terms.
    fn through(values: &[[f64; 2]]) -> Self {
        let n = values.len();
        let coefficient = |order: usize| {
            let scale = if order == 0 { 1.0 } else { 2.0 } / n as f64;
            let cosine = |k: usize| (0.5 * PI * (order * (2 * k + 1)) as f64 / n as f64).cos();
            let terms = values.iter().enumerate();
            terms.fold([0.0; 2], |sum, (k, value)| {
                [0, 1].map(|i| sum[i] + scale * cosine(k) * value[i])
            })
        };
        let coefficients: Vec<[f64; 2]> = (0..n).map(coefficient).collect();
        let last = coefficients[n - 3..].iter().flatten();
        Self {
            tail: last.fold(0.0, |tail, term| tail.max(term.abs())),
            coefficients,
        }
    }

    /// Without last terms that are below a tolerance.
    fn shortened(mut self, tolerance: f64) -> Self {
        let counts = |terms: &[f64; 2]| terms.iter().any(|term| term.abs() > tolerance);
        let last = self.coefficients.iter().rposition(counts);
        self.coefficients.truncate(last.unwrap_or(0) + 1);
        self
    }

    /// Both functions, by Clenshaw's sum.
    pub(super) fn at(&self, x: f64) -> [f64; 2] {
        let [mut this, mut next] = [[0.0; 2]; 2];
        for terms in self.coefficients[1..].iter().rev() {
            let sum = [0, 1].map(|i| terms[i] + 2.0 * x * this[i] - next[i]);
            (this, next) = (sum, this);
        }
        [0, 1].map(|i| self.coefficients[0][i] + x * this[i] - next[i])
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_series_has_as_many_terms_as_it_needs() {
        let function = |x: f64| Ok::<_, ()>([(2.0 * x).exp(), (3.0 - x).recip()]);
        let series = Series::of(function, 1e-10).expect("no function fails");
        assert!(series.tail <= 1e-10, "{}", series.tail);
        assert!((12..27).contains(&series.coefficients.len()), "{series:?}");
        for step in -10..=10 {
            let x = 0.1 * f64::from(step);
            let pairs = series
                .at(x)
                .into_iter()
                .zip([(2.0 * x).exp(), (3.0 - x).recip()]);
            for (found, expected) in pairs {
                assert!((found - expected).abs() < 1e-11, "{found} at {x}");
            }
        }
    }
}
