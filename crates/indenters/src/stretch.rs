//! Stretch of a power profile into its equivalent line.
//!
//! ```text
//! κ(p) = (√π / 2) p Γ(p/2) / Γ((p + 1)/2)  =  √π Γ(p/2 + 1) / Γ(p/2 + 1/2)        (9)
//! ```

use std::f64::consts::PI;

use crate::IndenterError;
use numerics::positive;

/// Half the exponent p from which the ratio of gamma functions is summed by its asymptotic series. Chosen: the series reaches
/// rounding there, and below it Γ is far from overflow.
const ASYMPTOTIC_FROM: f64 = 32.0;

/// Stretch κ(p) of Eq. (9), for any exponent p > 0.
///
/// # Errors
/// [`IndenterError::InvalidParameter`] when the exponent is not finite and greater than zero.
pub fn stretch(exponent: f64) -> Result<f64, IndenterError> {
    let x = 0.5 * positive("exponent", exponent)?;
    if x < ASYMPTOTIC_FROM {
        return Ok(PI.sqrt() * libm::tgamma(x + 1.0) / libm::tgamma(x + 0.5));
    }
    Ok((PI * x).sqrt() * half_step_series(x))
}

/// Γ(x + 1) / (Γ(x + 1/2) √x) for large x (NIST DLMF 5.11.13); the first neglected term is below 1e-16 for x ≥ 32.
fn half_step_series(x: f64) -> f64 {
    /// Coefficients of 1, 1/x, 1/x², … in the asymptotic series.
    const COEFFICIENTS: [f64; 9] = [
        1.0,
        1.0 / 8.0,
        1.0 / 128.0,
        -5.0 / 1024.0,
        -21.0 / 32768.0,
        399.0 / 262_144.0,
        869.0 / 4_194_304.0,
        -39_325.0 / 33_554_432.0,
        -334_477.0 / 2_147_483_648.0,
    ];
    // Sum the series from its highest order by Horner's rule in 1/x.
    let from_highest_order = COEFFICIENTS.iter().rev();
    from_highest_order.fold(0.0, |sum, coefficient| sum / x + coefficient)
}
