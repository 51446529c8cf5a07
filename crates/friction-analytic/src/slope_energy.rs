//! The integral behind friction, ∫ h̃'² dx, of a body of revolution.

use indenters::Axisymmetric;
use numerics::Estimate;

use crate::pieces::{accepted, over_pieces};
use crate::{DivergenceCause, FrictionError};

/// Part of the first stretch in which the line is taken as its leading power. Any other power of the profile whose
/// exponent is larger by 0.11 or more has fallen to rounding there.
const APEX_REACH: f64 = 1e-150;

/// Why ∫ h̃'² dx over the contact of this `radius` is infinite, if it is.
pub(crate) fn divergence_cause(
    body: &(impl Axisymmetric + ?Sized),
    radius: f64,
    depth: f64,
) -> Option<DivergenceCause> {
    let exponent = body.profile_exponent();
    if exponent <= 0.5 {
        return Some(DivergenceCause::ApexExponent { exponent });
    }
    let inside = |kink: &indenters::Kink| kink.radius < radius && kink.slope_jump > 0.0;
    if let Some(kink) = body.kinks().into_iter().find(inside) {
        return Some(DivergenceCause::SlopeJump {
            radius: kink.radius,
            jump: kink.slope_jump,
        });
    }
    let at_edge = radius >= body.max_radius() && body.line_height(radius) < depth;
    at_edge.then_some(DivergenceCause::VerticalEdge { radius })
}

/// ∫₀^a h̃'(x)² dx, \[m], for a line without a reason to diverge.
pub(crate) fn slope_energy(
    body: &(impl Axisymmetric + ?Sized),
    radius: f64,
) -> Result<Estimate, FrictionError> {
    let ends = ends_outside_apex(body, radius);
    let inner = from_apex(body, ends[0]);
    let outer = over_pieces(|x| body.line_slope(x).powi(2), &ends);
    accepted("integral of the squared slope", inner + outer)
}

/// The kinks inside the radius, and the radius.
pub(crate) fn ends_outside_apex(body: &(impl Axisymmetric + ?Sized), radius: f64) -> Vec<f64> {
    let kinks = body.kinks().into_iter().map(|kink| kink.radius);
    kinks
        .take_while(|kink| *kink < radius)
        .chain([radius])
        .collect()
}

/// ∫ h̃'² dx from the apex, where h̃' ∼ x^(p−1) may be singular, to `end`.
fn from_apex(body: &(impl Axisymmetric + ?Sized), end: f64) -> Estimate {
    let square = |x: f64| body.line_slope(x).powi(2);
    let exponent = body.profile_exponent();
    if exponent >= 1.0 {
        return over_pieces(square, &[0.0, end]);
    }
    // As p approaches 1/2 most of the integral lies below the smallest number. So the innermost part is that of the
    // leading power, and in the rest x = end s^(1/(2p − 1)) makes the integrand of that power a constant.
    let rate = 2.0 * exponent - 1.0;
    let apex = APEX_REACH * end;
    let innermost = apex * square(apex) / rate;
    let integrand = |s: f64| {
        let x = end * s.powf(rate.recip());
        square(x) * x / (rate * s)
    };
    over_pieces(integrand, &[APEX_REACH.powf(rate), 1.0]) + Estimate::exact(innermost)
}
