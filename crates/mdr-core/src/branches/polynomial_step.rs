//! The stress of one Maxwell branch under a piece of the line, in closed form (docs/theory/line-viscoelastic.md, "No mesh in
//! the material").
//!
//! ```text
//! e' + a e = G u'(t),   e(−1) given,   a = H/(2 v τ) for a piece of length H on −1 ≤ t ≤ 1
//! ```
//! For a polynomial u the solution is a polynomial and a boundary layer, `e = p(t) + C e^(−a (1 + t))`, whatever the
//! ratio of time constant and piece. Where the layer is wider than the piece the two would cancel, and e itself is
//! expanded: the integrated equation is tridiagonal in Legendre polynomials, and its pivots are above one.

use crate::line::{DEGREE, end_value, square_integral, start_value};

/// Ratio a from which on the stress is split into a polynomial and a boundary layer. Below it, the terms of one Legendre
/// expansion vanish like (a/2)^k/k!. For a = 4 that takes 28 terms, which [`MAX_TERMS`] holds; a = 8 would need 37.
const MIN_LAYER_RATIO: f64 = 4.0;
/// Largest number of Legendre terms of a stress: enough for the polynomial of a piece and for an exponential of a =
/// [`MIN_LAYER_RATIO`] to the last digit.
pub(crate) const MAX_TERMS: usize = DEGREE + 30;

/// Stress e of a branch over one piece.
pub(crate) struct BranchStress {
    /// Legendre coefficients of the smooth part p.
    pub(crate) smooth: [f64; MAX_TERMS],
    /// Number of its coefficients that may differ from 0.
    pub(crate) n_terms: usize,
    /// Amplitude C of the layer e^(−a (1 + t)).
    pub(crate) layer: f64,
    /// Stress e(1) at the end of the piece.
    pub(crate) end: f64,
    /// Integral ∫ e dt over [−1, 1].
    pub(crate) integral: f64,
    /// Integral ∫ e² dt over [−1, 1].
    pub(crate) square_integral: f64,
}

/// The stress of a branch with `ratio` a and stress `start` = e(−1); `rates` are the Legendre coefficients of G u'(t).
pub(crate) fn branch_stress(ratio: f64, start: f64, rates: &[f64]) -> BranchStress {
    let solve = if ratio < MIN_LAYER_RATIO {
        solve_by_expansion
    } else {
        solve_with_layer
    };
    solve(ratio, start, rates)
}

/// The solution of [`branch_stress`] as one Legendre expansion, for a < [`MIN_LAYER_RATIO`].
fn solve_by_expansion(ratio: f64, start: f64, rates: &[f64]) -> BranchStress {
    let n_terms = rates.len() + exponential_terms(ratio);
    let slopes = solve_for_slopes(ratio, start, rates, n_terms);
    // Integrate e' = Σ f_k P_k from e(−1) on, with (2k + 1) ∫ P_k dt = P_(k+1) − P_(k−1).
    let mut smooth = [0.0; MAX_TERMS];
    smooth[0] = start + slopes[0] - slopes[1] / 3.0;
    for k in 1..n_terms {
        smooth[k] = slopes[k - 1] / (2 * k - 1) as f64 - slopes[k + 1] / (2 * k + 3) as f64;
    }
    BranchStress {
        n_terms,
        layer: 0.0,
        end: start + 2.0 * slopes[0],
        integral: 2.0 * smooth[0],
        square_integral: square_integral(&smooth[..n_terms]),
        smooth,
    }
}

/// Number of Legendre terms beyond those of the rates from which on the terms of e^(−a t), of the size a^k/(2k − 1)!!, are
/// negligible.
fn exponential_terms(ratio: f64) -> usize {
    /// Size of the terms of e^(−a t) that are left out: 1/200 of the rounding error of a sum of the order 1.
    const NEGLIGIBLE_TERM: f64 = 1e-18;
    let mut terms = 2;
    let mut size = ratio;
    while size > NEGLIGIBLE_TERM && terms < MAX_TERMS - DEGREE - 2 {
        size *= ratio / (2 * terms - 1) as f64;
        terms += 1;
    }
    terms
}

/// Legendre coefficients f_k of e', by elimination in the tridiagonal system
/// f_k + a (f_(k−1)/(2k − 1) − f_(k+1)/(2k + 3)) = G u'_k, k ≥ 1, and f₀ + a (e(−1) + f₀ − f₁/3) = G u'_0.
///
/// The `rates` G u'_k are 0 beyond their last entry.
fn solve_for_slopes(ratio: f64, start: f64, rates: &[f64], n_terms: usize) -> [f64; MAX_TERMS + 1] {
    // The first loop eliminates the coefficients below the diagonal; the second one solves for the slopes from the last to the
    // first.
    let mut slopes = [0.0; MAX_TERMS + 1];
    let mut pivots = [0.0; MAX_TERMS];
    for k in 0..n_terms {
        let rate = rates.get(k).map_or(0.0, |rate| *rate);
        if k == 0 {
            pivots[0] = 1.0 + ratio;
            slopes[0] = rate - ratio * start;
        } else {
            let below = ratio / (2 * k - 1) as f64 / pivots[k - 1];
            pivots[k] = 1.0 + below * (ratio / (2 * k + 1) as f64);
            slopes[k] = rate - below * slopes[k - 1];
        }
    }
    for k in (0..n_terms).rev() {
        slopes[k] = (slopes[k] + ratio / (2 * k + 3) as f64 * slopes[k + 1]) / pivots[k];
    }
    slopes
}

/// The solution of [`branch_stress`] as a polynomial and a boundary layer, for a ≥ [`MIN_LAYER_RATIO`].
fn solve_with_layer(ratio: f64, start: f64, rates: &[f64]) -> BranchStress {
    let smooth = particular_solution(ratio, rates);
    let layer = start - start_value(&smooth);
    let decay = (-2.0 * ratio).exp();
    // The integral of e² contains twice the product of layer and smooth part p. Its factor is ∫ e^(−a (1 + t)) p dt = [e^(−a (1
    // + t)) s], where the polynomial s solves s' − a s = p.
    let dual = particular_solution(-ratio, &smooth[..rates.len()]);
    let cross = decay * end_value(&dual) - start_value(&dual);
    let width = -(-2.0 * ratio).exp_m1() / ratio;
    let square_width = -(-4.0 * ratio).exp_m1() / (2.0 * ratio);
    BranchStress {
        n_terms: rates.len(),
        layer,
        end: end_value(&smooth) + layer * decay,
        integral: 2.0 * smooth[0] + layer * width,
        square_integral: square_integral(&smooth)
            + 2.0 * layer * cross
            + layer * layer * square_width,
        smooth,
    }
}

/// Legendre coefficients of the polynomial p with p' + a p = Σ r_k P_k, from the highest one down.
fn particular_solution(ratio: f64, right_hand_side: &[f64]) -> [f64; MAX_TERMS] {
    let mut solution = [0.0; MAX_TERMS];
    // The Legendre coefficient k of p' is (2k + 1) (c_(k+1) + c_(k+3) + …), with c_k those of p: `sums` has one running sum for
    // even k and one for odd k.
    let mut sums = [0.0; 2];
    for (k, rate) in right_hand_side.iter().enumerate().rev() {
        sums[k % 2] += solution[k + 1];
        solution[k] = (rate - (2 * k + 1) as f64 * sums[k % 2]) / ratio;
    }
    solution
}
