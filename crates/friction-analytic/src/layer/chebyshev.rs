//! Chebyshev interpolation of a pair of functions, with as many nodes as they need.
//!
//! ```text
//! f(x) ≈ Σ c_k T_k(x) through the zeros x_j = cos(π (2j + 1)/(2n)) of T_n
//! ```

use std::f64::consts::PI;

/// Number of nodes of the first interpolation. Chosen; it changes the number of evaluations only: nodes are added until the tail
/// is within the tolerance.
const INITIAL_NODES: usize = 9;
/// Factor on the number of nodes per refinement. Derived: 3 is the smallest with which the zeros of T_n are among those of the
/// next polynomial, T_3n, so that no value is computed twice.
const NODE_GROWTH: usize = 3;
/// Largest number of nodes. Chosen to limit the computing time: three refinements from [`INITIAL_NODES`]. The series is then
/// returned with the tail that it has, which the caller judges.
const MAX_NODES: usize = 243;
/// Number of last coefficients whose largest absolute value estimates the truncation error: two may vanish by the symmetry of a
/// function, three do not. Chosen (case of `evidence tuning`).
const TAIL_TERMS: usize = 3;

/// Chebyshev series of two functions of x from −1 to 1.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct ChebyshevPair {
    /// Coefficients c_k of both functions.
    coefficients: Vec<[f64; 2]>,
    /// Largest absolute value of the last coefficients before any was dropped, which estimates the truncation error.
    pub(super) tail: f64,
}

impl ChebyshevPair {
    /// Interpolates with the fewest nodes for which the tail is within the tolerance, or with the largest number of nodes.
    pub(super) fn interpolate<E>(
        function: impl Fn(f64) -> Result<[f64; 2], E>,
        tolerance: f64,
    ) -> Result<Self, E> {
        let mut values: Vec<[f64; 2]> = Vec::new();
        let mut n = INITIAL_NODES;
        loop {
            // Every third node is known from the interpolation before.
            let node = |k: usize| (0.5 * PI * (2 * k + 1) as f64 / n as f64).cos();
            let value = |k: usize| match values.get(k / NODE_GROWTH) {
                Some(known) if k % NODE_GROWTH == NODE_GROWTH / 2 => Ok(*known),
                _ => function(node(k)),
            };
            values = (0..n).map(value).collect::<Result<_, E>>()?;
            let series = Self::through_values(&values);
            if series.tail <= tolerance || n >= MAX_NODES {
                // All of the dropped coefficients together are within the tolerance.
                return Ok(series.without_small_terms(tolerance / n as f64));
            }
            n *= NODE_GROWTH;
        }
    }

    /// The series through n values at the zeros of T_n.
    fn through_values(values: &[[f64; 2]]) -> Self {
        let n = values.len();
        // Discrete orthogonality of the Chebyshev polynomials gives the coefficients.
        let coefficient = |order: usize| {
            let scale = if order == 0 { 1.0 } else { 2.0 } / n as f64;
            let cosine = |k: usize| (0.5 * PI * (order * (2 * k + 1)) as f64 / n as f64).cos();
            let terms = values.iter().enumerate();
            terms.fold([0.0; 2], |sum, (k, value)| {
                [0, 1].map(|i| sum[i] + scale * cosine(k) * value[i])
            })
        };
        let coefficients: Vec<[f64; 2]> = (0..n).map(coefficient).collect();
        let last = coefficients[n - TAIL_TERMS..].iter().flatten();
        Self {
            tail: last.fold(0.0, |tail, term| tail.max(term.abs())),
            coefficients,
        }
    }

    /// Drops the last coefficients that do not exceed a tolerance.
    fn without_small_terms(mut self, tolerance: f64) -> Self {
        let counts = |terms: &[f64; 2]| terms.iter().any(|term| term.abs() > tolerance);
        let last = self.coefficients.iter().rposition(counts);
        self.coefficients.truncate(last.unwrap_or(0) + 1);
        self
    }

    /// Values of both functions at −1 ≤ x ≤ 1, by Clenshaw's recurrence.
    pub(super) fn evaluate(&self, x: f64) -> [f64; 2] {
        let [mut current, mut next] = [[0.0; 2]; 2];
        for terms in self.coefficients[1..].iter().rev() {
            let sum = [0, 1].map(|i| terms[i] + 2.0 * x * current[i] - next[i]);
            (current, next) = (sum, current);
        }
        [0, 1].map(|i| self.coefficients[0][i] + x * current[i] - next[i])
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_series_has_as_many_terms_as_it_needs() {
        let function = |x: f64| Ok::<_, ()>([(2.0 * x).exp(), (3.0 - x).recip()]);
        let series = ChebyshevPair::interpolate(function, 1e-10).expect("no function fails");
        assert!(series.tail <= 1e-10, "{}", series.tail);
        assert!((12..27).contains(&series.coefficients.len()), "{series:?}");
        for step in -10..=10 {
            let x = 0.1 * f64::from(step);
            let pairs = series
                .evaluate(x)
                .into_iter()
                .zip([(2.0 * x).exp(), (3.0 - x).recip()]);
            for (found, expected) in pairs {
                assert!((found - expected).abs() < 1e-11, "{found} at {x}");
            }
        }
    }
}
