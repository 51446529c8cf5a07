//! Integrals over several pieces, and when they count as known.

use numerics::{Estimate, integrate};

use crate::FrictionError;

/// Relative accuracy asked of an integral. Slopes that are integrals themselves are known to 1e-14, so that less could
/// not be told from noise.
const REQUESTED_ACCURACY: f64 = 1e-12;
/// Relative accuracy from which on an integral counts as known.
const ACCEPTED_ACCURACY: f64 = 1e-10;

/// The integral over the pieces between successive `ends`.
pub(crate) fn over_pieces(integrand: impl Fn(f64) -> f64, ends: &[f64]) -> Estimate {
    let piece = |ends: &[f64]| integrate(&integrand, [ends[0], ends[1]], REQUESTED_ACCURACY);
    ends.windows(2).map(piece).sum()
}

/// The integral, if its error is small enough to count as an answer.
pub(crate) fn accepted(
    quantity: &'static str,
    integral: Estimate,
) -> Result<Estimate, FrictionError> {
    let Estimate { value, error } = integral;
    if integral.is_within(ACCEPTED_ACCURACY) {
        return Ok(integral);
    }
    Err(FrictionError::NotConverged {
        quantity,
        value,
        error,
    })
}
