//! Polynomials on [−1, 1] as sums of Legendre polynomials, `p(t) = Σ c_k P_k(t)`.

use numerics::{legendre_values, lobatto_rule};

/// Degree of the polynomial that stands for one piece of a line. Chosen: pieces are halved until it is enough, so that it decides
/// on the time only.
pub(crate) const DEGREE: usize = 10;

/// Legendre coefficients c_0, c_1, … of one piece of a line.
pub(crate) type Polynomial = [f64; DEGREE + 1];

/// Interpolation at the Gauss–Lobatto nodes: −1, 1 and the zeros of P'_n.
pub(crate) struct Interpolation {
    /// Gauss–Lobatto nodes on [−1, 1].
    nodes: Polynomial,
    /// Row k holds the weights of the values at the nodes in the coefficient c_k.
    rows: [Polynomial; DEGREE + 1],
}

impl Interpolation {
    /// Nodes and coefficients of the interpolation of degree [`DEGREE`].
    pub(crate) fn new() -> Self {
        let rule = lobatto_rule(DEGREE + 1);
        let mut nodes = [0.0; DEGREE + 1];
        let mut rows = [[0.0; DEGREE + 1]; DEGREE + 1];
        for (j, (node, weight)) in rule.nodes.into_iter().zip(rule.weights).enumerate() {
            nodes[j] = node;
            let values: Polynomial = legendre_values(node);
            for (k, row) in rows.iter_mut().enumerate() {
                // At the nodes the sum of the weighted squares of the last polynomial, of degree n, is 2/n, and not its
                // integral 2/(2n + 1).
                let norm = if k == DEGREE {
                    2.0 / DEGREE as f64
                } else {
                    2.0 / (2 * k + 1) as f64
                };
                row[j] = values[k] * weight / norm;
            }
        }
        Self { nodes, rows }
    }

    /// The polynomial with the values of `function` at the nodes, which include both ends.
    pub(crate) fn interpolate(&self, function: impl Fn(f64) -> f64) -> Polynomial {
        let values = self.nodes.map(function);
        let coefficient = |row: Polynomial| row.iter().zip(&values).map(|(a, b)| a * b).sum();
        self.rows.map(coefficient)
    }
}

/// Value p(t) at −1 ≤ t ≤ 1, by Clenshaw's recurrence.
pub(crate) fn value(coefficients: &[f64], t: f64) -> f64 {
    let (mut next, mut second_next) = (0.0, 0.0);
    for (k, coefficient) in coefficients.iter().enumerate().rev() {
        let degree = k as f64;
        let factor = (2.0 * degree + 1.0) / (degree + 1.0) * t;
        let this = coefficient + factor * next - (degree + 1.0) / (degree + 2.0) * second_next;
        (next, second_next) = (this, next);
    }
    next
}

/// Coefficients of p'(t), as many as those of p; the last one is 0.
pub(crate) fn derivative<const N: usize>(coefficients: &[f64; N]) -> [f64; N] {
    let mut slopes = [0.0; N];
    // The coefficients c'_k of p' follow from those of p, from the highest one down: c'_k/(2k + 1) = c'_(k+2)/(2k + 5) +
    // c_(k+1).
    let mut sums = [0.0; 2];
    for k in (0..N - 1).rev() {
        sums[k % 2] += coefficients[k + 1];
        slopes[k] = (2 * k + 1) as f64 * sums[k % 2];
    }
    slopes
}

/// Integral ∫ p(t)² dt over [−1, 1].
pub(crate) fn square_integral(coefficients: &[f64]) -> f64 {
    let terms = coefficients.iter().enumerate();
    terms.map(|(k, c)| c * c / (k as f64 + 0.5)).sum()
}

/// Value p(−1).
pub(crate) fn start_value(coefficients: &[f64]) -> f64 {
    let terms = coefficients.iter().enumerate();
    let signed = terms.map(|(k, c)| if k % 2 == 0 { *c } else { -c });
    signed.sum()
}

/// Value p(1).
pub(crate) fn end_value(coefficients: &[f64]) -> f64 {
    coefficients.iter().sum()
}

#[cfg(test)]
mod tests {
    use super::*;

    fn assert_close(actual: f64, expected: f64, tolerance: f64) {
        let difference = (actual - expected).abs();
        assert!(difference < tolerance, "{actual} instead of {expected}");
    }

    #[test]
    fn a_polynomial_of_the_full_degree_is_reproduced_with_its_slope() {
        let power = DEGREE as f64;
        let coefficients = Interpolation::new().interpolate(|t| (t - 0.3).powf(power));
        let slopes = derivative(&coefficients);
        for t in [-1.0, -0.77, 0.1, 0.9, 1.0_f64] {
            assert_close(value(&coefficients, t), (t - 0.3).powf(power), 1e-13);
            let slope = power * (t - 0.3).powf(power - 1.0);
            assert_close(value(&slopes, t), slope, 1e-11);
        }
    }
}
