//! Integrals of a smooth function against an exponential of any steepness.
//!
//! ```text
//! rate · ∫_0^1 e^(−rate·s) f(s) ds = Σ W_j(rate) f(s_j)
//! ```
//!
//! The function is replaced by the polynomial through the Gauss–Lobatto points, or through integers. Integrals of Legendre polynomials
//! against the exponential are modified spherical Bessel functions (NIST DLMF 10.54.2). The error is at most that of the polynomial for
//! any rate, because the weight is positive with the sum 1 − e^(−rate).
//!
//! Theory: docs/theory/stationary-half-space.md, "Any linear viscoelastic material".

use numerics::{LobattoRule, legendre_values, lobatto_rule};

/// Largest number of points of a rule. Derived: that of the most accurate panels (`retarded_potential.rs`), whose error is of the
/// order 6⁻¹².
pub(super) const MAX_POINTS: usize = 12;

/// Points on [0, 1] or around it, and the projection of values at them onto Legendre polynomials.
pub(super) struct ExponentialRule {
    /// Points s_j of the rule.
    pub(super) nodes: Vec<f64>,
    /// Matrix `[degree][point]` from values at the points to Legendre coefficients.
    projection: Vec<[f64; MAX_POINTS]>,
}

impl ExponentialRule {
    /// Rule of `n_points` Gauss–Lobatto points on [0, 1], from 2 to [`MAX_POINTS`].
    pub(super) fn new(n_points: usize) -> Self {
        let degree = n_points - 1;
        let LobattoRule { nodes, weights } = lobatto_rule(n_points);
        let mut projection = vec![[0.0; MAX_POINTS]; n_points];
        for (index, (&x, weight)) in nodes.iter().zip(weights).enumerate() {
            // The coefficient of the Legendre polynomial P_n in a function f is (n + 1/2) ∫ f P_n, which the Gauss–Lobatto rule
            // integrates.
            let values: [f64; MAX_POINTS] = legendre_values(x);
            for (order, coefficients) in projection.iter_mut().enumerate() {
                // The Gauss–Lobatto rule integrates the square of the highest Legendre polynomial wrongly; its discrete norm is used.
                let norm = if order == degree {
                    0.5 * degree as f64
                } else {
                    order as f64 + 0.5
                };
                coefficients[index] = norm * weight * values[order];
            }
        }
        Self {
            nodes: nodes.iter().map(|x| 0.5 * (1.0 + x)).collect(),
            projection,
        }
    }

    /// The rule of 2 to [`MAX_POINTS`] integer points around [0, 1], as many on either side, for functions that are smooth over all
    /// of them.
    pub(super) fn on_integers(n_points: usize) -> Self {
        // Interpolate the values at the integers to the Gauss–Lobatto points (Lagrange), and project these onto Legendre polynomials.
        let lobatto = Self::new(n_points);
        let first = 1.0 - 0.5 * n_points as f64;
        let nodes: Vec<f64> = (0..n_points).map(|index| first + index as f64).collect();
        let mut projection = vec![[0.0; MAX_POINTS]; n_points];
        for (coefficients, lobatto_coefficients) in projection.iter_mut().zip(&lobatto.projection) {
            for (&x, from_lobatto) in lobatto.nodes.iter().zip(lobatto_coefficients) {
                for (index, coefficient) in coefficients[..n_points].iter_mut().enumerate() {
                    *coefficient += from_lobatto * lagrange(&nodes, index, x);
                }
            }
        }
        Self { nodes, projection }
    }

    /// Weights W_j of the rule for a `rate` ≥ 0, one for each of its points; 0 beyond them.
    pub(super) fn weights(&self, rate: f64) -> [f64; MAX_POINTS] {
        let moments = legendre_moments(rate, self.nodes.len());
        let mut weights = [0.0; MAX_POINTS];
        for (moment, coefficients) in moments.iter().zip(&self.projection) {
            for (weight, coefficient) in weights.iter_mut().zip(coefficients) {
                *weight += moment * coefficient;
            }
        }
        weights
    }
}

/// Value at x of the Lagrange polynomial that is 1 at the node of number `index` and 0 at the other nodes.
fn lagrange(nodes: &[f64], index: usize, x: f64) -> f64 {
    let other_nodes = nodes[..index].iter().chain(&nodes[index + 1..]);
    let factors = other_nodes.map(|node| (x - node) / (nodes[index] - node));
    factors.product()
}

/// Moments rate · ∫_0^1 e^(−rate·s) P_n(2s − 1) ds = (−1)ⁿ 2z e^(−z) i_n(z) for n = 0 … count − 1, with z = rate/2, the Legendre
/// polynomials P_n and the modified spherical Bessel functions i_n.
fn legendre_moments(rate: f64, count: usize) -> [f64; MAX_POINTS] {
    let z = 0.5 * rate;
    let first = -(-rate).exp_m1();
    let mut moments = [0.0; MAX_POINTS];
    moments[0] = first;
    // For arguments above the degree the recurrence of the moments is stable and runs upwards. Otherwise the ratios of Bessel
    // functions follow from Miller's downward recurrence, whose truncation falls by a factor of at least 4 with each degree above z.
    if z > MAX_POINTS as f64 {
        moments[1] = 1.0 - z.recip();
        for n in 1..count - 1 {
            moments[n + 1] = moments[n - 1] - (2 * n + 1) as f64 / z * moments[n];
        }
    } else {
        let start = 4 * MAX_POINTS;
        // The ratios satisfy i_n/i_(n−1) = z/(2n + 1 + z i_(n+1)/i_n). All terms are positive, so that nothing cancels.
        let mut ratio = 0.0;
        let mut ratios = [0.0; MAX_POINTS];
        for n in (1..start).rev() {
            ratio = z / ((2 * n + 1) as f64 + z * ratio);
            if n < count {
                ratios[n] = ratio;
            }
        }
        for n in 1..count {
            moments[n] = moments[n - 1] * ratios[n];
        }
    }
    // Moments of odd order n have the sign (−1)ⁿ = −1.
    for moment in moments.iter_mut().skip(1).step_by(2) {
        *moment = -*moment;
    }
    moments
}
