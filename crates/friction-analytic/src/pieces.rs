//! Integrals over several smooth pieces, and the accuracy that they must have.

use indenters::Axisymmetric;
use numerics::{Estimate, integrate};

use crate::FrictionError;

/// Requested relative accuracy of an integral. Chosen: slopes that are integrals themselves are known to 1e-14, so that a much
/// smaller one could not be distinguished from noise.
const REQUESTED_ACCURACY: f64 = 1e-12;
/// Largest relative error of an integral that is accepted. Chosen as a hundred times the requested one, for integrands that are
/// known less accurately (docs/conventions.md, "Errors and tolerances"); a larger error is refused.
const ACCEPTED_ACCURACY: f64 = 1e2 * REQUESTED_ACCURACY;

/// Integral over the pieces between successive `ends`, each of which may have a singular end; its error is the sum of theirs, each
/// requested to [`REQUESTED_ACCURACY`].
pub(crate) fn integrate_pieces(integrand: impl Fn(f64) -> f64, ends: &[f64]) -> Estimate {
    let piece = |ends: &[f64]| integrate(&integrand, [ends[0], ends[1]], REQUESTED_ACCURACY);
    ends.windows(2).map(piece).sum()
}

/// Radii of the kinks of a body inside a radius, and that radius, \[m]: ends of the smooth pieces without the apex.
pub(crate) fn ends_outside_apex(body: &dyn Axisymmetric, radius: f64) -> Vec<f64> {
    let kinks = body.kinks().into_iter().map(|kink| kink.radius);
    let inside = kinks.take_while(|kink| *kink < radius);
    inside.chain([radius]).collect()
}

/// The integral if its error is at most [`ACCEPTED_ACCURACY`], otherwise [`FrictionError::NotConverged`].
pub(crate) fn accept_accurate(
    quantity: &'static str,
    integral: Estimate,
) -> Result<Estimate, FrictionError> {
    if integral.is_within(ACCEPTED_ACCURACY) {
        return Ok(integral);
    }
    Err(FrictionError::NotConverged {
        quantity,
        value: integral.value,
        error: integral.error,
    })
}
