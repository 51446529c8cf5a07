//! Legendre polynomials, and Gauss–Lobatto rules.
//!
//! ```text
//! ∫ f dt over [−1, 1] = Σ w_j f(t_j)        t_j = −1, 1 and the zeros of P'_n,  w_j = 2/(n (n + 1) P_n(t_j)²)
//! ```
//! exactly for polynomials up to the degree 2n − 1 (NIST DLMF 3.5).

use std::cmp::Ordering;

/// Number of Newton steps per node. Derived: the first guess has two digits, each step doubles their number, and the fourth
/// changes a node by less than rounding.
const NEWTON_STEPS: usize = 4;
/// Number of nodes that are computed together, because the recursion over the degree of one node is sequential. Chosen as a
/// vector register of eight numbers; it changes the time only.
const NODES_PER_BATCH: usize = 8;

/// The values P_0(t), P_1(t), …, P_(N−1)(t).
pub fn legendre_values<const N: usize>(t: f64) -> [f64; N] {
    let (mut previous, mut current) = (0.0, 1.0);
    std::array::from_fn(|degree| {
        let value = current;
        (previous, current) = (current, next_legendre(degree, t, previous, current));
        value
    })
}

/// Polynomial P_(n+1)(t) from P_(n−1)(t) and P_n(t): (n + 1) P_(n+1) = (2n + 1) t P_n − n P_(n−1) (NIST DLMF 18.9.1).
fn next_legendre(degree: usize, t: f64, previous: f64, current: f64) -> f64 {
    let n = degree as f64;
    ((2.0 * n + 1.0) * t * current - n * previous) / (n + 1.0)
}

/// Nodes, increasing, and weights of a Gauss–Lobatto rule on [−1, 1].
#[derive(Debug, Clone, PartialEq)]
pub struct LobattoRule {
    /// Nodes t_j; both ends are among them.
    pub nodes: Vec<f64>,
    /// Weights w_j.
    pub weights: Vec<f64>,
}

/// The Gauss–Lobatto rule of `n_points` nodes, or of two if there are fewer.
pub fn lobatto_rule(n_points: usize) -> LobattoRule {
    let degree = n_points.max(2) - 1;
    let n = degree as f64;
    // `last_two` returns P_(n−1) and P_n at the nodes of one batch.
    let last_two = |t: [f64; NODES_PER_BATCH]| {
        (0..degree).fold(
            [[0.0; NODES_PER_BATCH], [1.0; NODES_PER_BATCH]],
            |[previous, current], degree| {
                let next = |k: usize| next_legendre(degree, t[k], previous[k], current[k]);
                [current, std::array::from_fn(next)]
            },
        )
    };
    // `batch` computes nodes and weights of one batch by Newton's method, which starts from the Chebyshev–Lobatto nodes.
    let batch = |first: usize| {
        let guess = |k: usize| -(std::f64::consts::PI * (first + k) as f64 / n).cos();
        let newton_step = |t: [f64; NODES_PER_BATCH], _| {
            let [previous, last] = last_two(t);
            std::array::from_fn(|k| t[k] - (t[k] * last[k] - previous[k]) / ((n + 1.0) * last[k]))
        };
        let nodes = (0..NEWTON_STEPS).fold(std::array::from_fn(guess), newton_step);
        let [_, last] = last_two(nodes);
        std::array::from_fn::<_, NODES_PER_BATCH, _>(|k| {
            [nodes[k], 2.0 / (n * (n + 1.0) * last[k] * last[k])]
        })
    };
    // The rule is symmetric: half of the nodes are computed, and mirrored.
    let half: Vec<[f64; 2]> = (0..=degree / 2)
        .step_by(NODES_PER_BATCH)
        .flat_map(batch)
        .collect();
    // The middle one of an odd number of nodes is exactly 0.
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

    /// No other rule of as many nodes with both ends among them has this degree of exactness.
    #[test]
    fn products_of_legendre_polynomials_are_integrated_exactly() {
        // The rule is exact for products up to the degree 2n − 1: ∫ P_i P_k dt = 2/(2k + 1) for i = k, else 0.
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
