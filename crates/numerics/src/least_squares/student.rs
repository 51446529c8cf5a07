//! Student's t distribution, for confidence intervals from an estimated standard error.

use std::f64::consts::{FRAC_2_PI, FRAC_PI_2};

use crate::root::bracketed_root;

/// The t for which the fraction `coverage` of all deviations lies between −t and t standard errors.
///
/// The standard error is one that was estimated with the given degrees of freedom ≥ 1.
/// Returns `None` unless the coverage is between 0 and 1 and there is a degree of freedom.
///
/// ```
/// use numerics::least_squares::student_quantile;
///
/// let [one, ten] = [1, 10].map(|freedom| student_quantile(0.95, freedom).unwrap());
/// assert!((one - 12.706_204_7).abs() < 1e-6 && (ten - 2.228_138_9).abs() < 1e-6);
/// ```
pub fn student_quantile(coverage: f64, degrees_of_freedom: usize) -> Option<f64> {
    let excess = |angle: f64| probability_within(angle, degrees_of_freedom) - coverage;
    let angle = bracketed_root(excess, [0.0, FRAC_PI_2]);
    let quantile = angle?.tan() * (degrees_of_freedom as f64).sqrt();
    (degrees_of_freedom > 0 && quantile.is_finite()).then_some(quantile)
}

/// Probability P(|T| < t) for t = √ν tan θ and ν degrees of freedom (Abramowitz & Stegun 1964, 26.7.3 and 26.7.4).
fn probability_within(angle: f64, degrees_of_freedom: usize) -> f64 {
    let (sine, cosine) = angle.sin_cos();
    let is_odd = degrees_of_freedom % 2 == 1;
    let (mut term, mut power) = if is_odd { (cosine, 3) } else { (1.0, 2) };
    let mut sum = if degrees_of_freedom > 1 { term } else { 0.0 };
    // The probability contains a finite series of powers of cos θ, in which each term follows from the one before.
    while power < degrees_of_freedom {
        let order = power as f64;
        term *= cosine * cosine * (order - 1.0) / order;
        sum += term;
        power += 2;
    }
    if is_odd {
        FRAC_2_PI * (angle + sine * sum)
    } else {
        sine * sum
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Two-sided 5 % points of Fisher and Yates, and the normal distribution.
    #[test]
    fn quantiles_are_those_of_tables() {
        let known = [
            (1, 12.7062),
            (2, 4.3027),
            (3, 3.1824),
            (4, 2.7764),
            (5, 2.5706),
            (30, 2.0423),
            (120, 1.9799),
            (1_000_000, 1.959_97),
        ];
        for (degrees_of_freedom, expected) in known {
            let found = student_quantile(0.95, degrees_of_freedom).expect("a quantile");
            assert!(
                (found - expected).abs() < 6e-5,
                "{degrees_of_freedom}: {found}"
            );
        }
        assert_eq!(student_quantile(0.95, 0), None, "no freedom");
    }
}
