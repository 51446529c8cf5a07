//! Legendre polynomials, and the points and weights of Gauss and Lobatto.
//!
//! ```text
//! ∫ f dt over [−1, 1] = Σ w_j f(t_j)        t_j = −1, 1 and the zeros of P'_n,  w_j = 2/(n (n + 1) P_n(t_j)²)
//! ```
//! exactly for polynomials up to the degree 2n − 1 (NIST DLMF 3.5).

use std::cmp::Ordering;

/// Every step of Newton's method doubles the two digits of the first guess; the fourth changes less than rounding.
const NEWTON_STEPS: usize = 4;
/// Points of a rule that are found together.
const AT_ONCE: usize = 8;

/// P_0(t), P_1(t), … of as many degrees as the array is long.
pub fn legendre_values<const N: usize>(t: f64) -> [f64; N] {
    let mut pair = [0.0, 1.0];
    std::array::from_fn(|degree| {
        let value = pair[1];
        pair = next(degree, t, pair);
        value
    })
}

/// From the polynomials of the degree before and of this one to those of this one and the next.
fn next(degree: usize, t: f64, [before, this]: [f64; 2]) -> [f64; 2] {
    let n = degree as f64;
    [this, ((2.0 * n + 1.0) * t * this - n * before) / (n + 1.0)]
}

/// Points, increasing, and weights of a Gauss–Lobatto rule on [−1, 1].
#[derive(Debug, Clone, PartialEq)]
pub struct LobattoRule {
    /// Points t_j; both ends are among them.
    pub nodes: Vec<f64>,
    /// Weights w_j.
    pub weights: Vec<f64>,
}

/// The Gauss–Lobatto rule of at least two points.
pub fn lobatto_rule(n_points: usize) -> LobattoRule {
    let degree = n_points.max(2) - 1;
    let n = degree as f64;
    // Several points at once, because each polynomial waits for the one before it.
    let last_two = |t: [f64; AT_ONCE]| {
        (0..degree).fold(
            [[0.0; AT_ONCE], [1.0; AT_ONCE]],
            |[before, this], degree| {
                let after = |k: usize| next(degree, t[k], [before[k], this[k]])[1];
                [this, std::array::from_fn(after)]
            },
        )
    };
    let rules = |first: usize| {
        let guess = |k: usize| -(std::f64::consts::PI * (first + k) as f64 / n).cos();
        let step = |t: [f64; AT_ONCE], _| {
            let [before, last] = last_two(t);
            std::array::from_fn(|k| t[k] - (t[k] * last[k] - before[k]) / ((n + 1.0) * last[k]))
        };
        let nodes = (0..NEWTON_STEPS).fold(std::array::from_fn(guess), step);
        let [_, last] = last_two(nodes);
        std::array::from_fn::<_, AT_ONCE, _>(|k| {
            [nodes[k], 2.0 / (n * (n + 1.0) * last[k] * last[k])]
        })
    };
    // The rule is symmetric.
    let half: Vec<[f64; 2]> = (0..=degree / 2).step_by(AT_ONCE).flat_map(rules).collect();
    let nodes = (0..=degree).map(|index| match (2 * index).cmp(&degree) {
        Ordering::Less => half[index][0],
        Ordering::Equal => 0.0,
        Ordering::Greater => -half[degree - index][0],
    });
    LobattoRule {
        nodes: nodes.collect(),
        weights: (0..=degree)
            .map(|index| half[index.min(degree - index)][1])
            .collect(),
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use approx::assert_abs_diff_eq;

    /// With both ends among its points, no other rule of so many does.
    #[test]
    fn a_rule_integrates_products_of_its_polynomials_exactly() {
        // Degrees up to 2n − 1: ∫ P_i P_k = 2/(2k + 1) for i = k, else 0.
        for n in [5, 12] {
            let LobattoRule { nodes, weights } = lobatto_rule(n);
            assert_abs_diff_eq!(nodes[0], -1.0, epsilon = 2e-16);
            assert_abs_diff_eq!(nodes[n - 1], 1.0, epsilon = 2e-16);
            let values: Vec<[f64; 12]> = nodes.iter().map(|t| legendre_values(*t)).collect();
            for i in 0..n {
                for k in 0..=i.min(n - 2) {
                    let products = values.iter().zip(&weights).map(|(p, w)| w * p[i] * p[k]);
                    let actual: f64 = products.sum();
                    let expected = if i == k { 1.0 / (k as f64 + 0.5) } else { 0.0 };
                    assert_abs_diff_eq!(actual, expected, epsilon = 1e-14);
                }
            }
        }
    }
}
