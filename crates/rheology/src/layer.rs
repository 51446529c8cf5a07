//! Compliance of a layer bonded to a rigid base, relative to the half space, for a wave of pressure.
//!
//! ```text
//! û = 2 p̂ M(|q|t)/(|q| E*)
//! M(s) = [(3 − 4ν) sinh 2s − 2s]/[5 + 2s² − 4ν(3 − 2ν) + (3 − 4ν) cosh 2s]
//! ```
//!
//! With a constant Poisson ratio the ratio does not depend on time, whatever the relaxation spectrum.

/// Argument s above which the ratio M(s) of the compliances is computed as 1 − [`layer_deficit`]. Chosen: the deficit is then
/// below rounding.
const DEFICIT_FORM_FROM: f64 = 24.0;
/// Largest argument s that is distinguished from larger ones: e^(−2s) is 0 there, and s² does not overflow.
const MAX_ARGUMENT: f64 = 1e3;

/// Ratio M(s) of the compliance of a layer on a rigid base to that of the half space, for s = |q|t ≥ 0 and −1 < ν ≤ 1/2.
///
/// Accurate to rounding. The limits are `(1 − 2ν) s/(2 (1 − ν)²)` for long waves, 2 s³/3 if ν = 1/2, and 1 for short waves.
pub fn layer_factor(s: f64, poisson_ratio: f64) -> f64 {
    if s > DEFICIT_FORM_FROM {
        return 1.0 - layer_deficit(s, poisson_ratio);
    }
    let (kappa, decay) = (3.0 - 4.0 * poisson_ratio, (-2.0 * s).exp());
    // Numerator and denominator are multiplied by 2 e^(−2s) against overflow; a series replaces sinh 2s − 2s for small s.
    let excess = if s < 0.5 {
        let square = 4.0 * s * s;
        let series = (1..=10).rev().fold(0.0, |sum, n| {
            square / f64::from(2 * n * (2 * n + 1)) * (1.0 + sum)
        });
        4.0 * s * series * decay
    } else {
        1.0 - decay * decay - 4.0 * s * decay
    };
    let numerator = 8.0 * s * decay * (1.0 - 2.0 * poisson_ratio) + kappa * excess;
    numerator / denominator(s, poisson_ratio)
}

/// Deficit 1 − M(s) of the ratio of the compliances of a layer and a half space, without cancellation where it is small.
pub fn layer_deficit(s: f64, poisson_ratio: f64) -> f64 {
    let s = s.min(MAX_ARGUMENT);
    let (kappa, decay) = (3.0 - 4.0 * poisson_ratio, (-2.0 * s).exp());
    let rest = kappa * decay + 2.0 * s * (1.0 + s) + denominator_constant(poisson_ratio);
    2.0 * decay * rest / denominator(s, poisson_ratio)
}

/// Denominator of M, multiplied by 2 e^(−2s) against overflow.
fn denominator(s: f64, poisson_ratio: f64) -> f64 {
    let (kappa, decay) = (3.0 - 4.0 * poisson_ratio, (-2.0 * s).exp());
    2.0 * decay * (denominator_constant(poisson_ratio) + 2.0 * s * s)
        + kappa * (1.0 + decay * decay)
}

/// Constant 5 − 4ν(3 − 2ν) in the denominator of M.
fn denominator_constant(poisson_ratio: f64) -> f64 {
    5.0 - 4.0 * poisson_ratio * (3.0 - 2.0 * poisson_ratio)
}
