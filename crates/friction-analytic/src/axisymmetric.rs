//! Stationary sliding of any body of revolution in the one-dimensional model, by quadrature.
//!
//! ```text
//! h̃(x_d) = d        μ = (1/d) ∫₀^x_d h̃'(x)² dx        (16)
//! ```
//! h̃ is the height of the equivalent line of the body above its lowest point, d the stationary depth, x_d the front of the
//! contact, and μ the friction coefficient.

use indenters::{Axisymmetric, IndenterError, SlidingLoad, contact_radius};
use numerics::Estimate;
use rheology::Viscous;

use crate::pieces::{accept_accurate, ends_outside_apex, integrate_pieces};
use crate::stationary::checked_depth;
use crate::{DivergenceCause, FrictionError, StationarySliding};

/// Length of the interval at the apex on which the line is replaced by its leading power, divided by the distance from the apex
/// to the first kink.
///
/// Without a kink the distance to the front of the contact takes its place. In the interval any other power of the profile
/// whose exponent is larger by 0.11 or more is below rounding: 1e-150^0.11 = 3e-17.
const LEADING_POWER_REACH: f64 = 1e-150;

/// Stationary depth, contact line and friction coefficient of a body of revolution, from (12) and (16).
///
/// # Errors
/// [`FrictionError::FrictionDiverges`] with its cause; [`FrictionError::NoStationaryState`] when the body is not high
/// enough; [`FrictionError::Indenter`] when its line turns downwards inside the contact;
/// [`FrictionError::NotConverged`] when the integral is known to less than ten digits.
pub fn axisymmetric_sliding(
    body: &dyn Axisymmetric,
    material: &Viscous,
    load: &SlidingLoad,
) -> Result<StationarySliding, FrictionError> {
    let depth = checked_depth(material, load)?;
    let radius = radius_with_friction(body, depth)?;
    let energy = squared_slope_integral(body, radius)?;
    // The rounding of the contact radius moves the end of the integral.
    let end = body.line_slope(radius).powi(2) * radius;
    let contact = vec![[0.0, radius]];
    Ok(StationarySliding::from_energy(depth, contact, energy, end))
}

/// The front of the stationary contact at a depth, \[m], unless its friction is infinite.
pub(crate) fn radius_with_friction(
    body: &dyn Axisymmetric,
    depth: f64,
) -> Result<f64, FrictionError> {
    let radius = contact_radius(body, depth).map_err(no_stationary_state)?;
    refuse_divergence(body, 0.0, radius, depth)?;
    Ok(radius)
}

/// Translates the error that a body is not high enough into the absence of a stationary state, Remark 4 of Kürschner (2014).
pub(crate) fn no_stationary_state(error: IndenterError) -> FrictionError {
    match error {
        IndenterError::NotHighEnough { available, depth } => FrictionError::NoStationaryState {
            needed_depth: depth,
            available_depth: available,
        },
        other => other.into(),
    }
}

/// Refuses a contact from `rear` to `front` \[m] at a `depth` \[m] over which ∫ h̃'² dx is infinite.
pub(crate) fn refuse_divergence(
    body: &dyn Axisymmetric,
    rear: f64,
    front: f64,
    depth: f64,
) -> Result<(), FrictionError> {
    // The causes of a divergence are tried from the apex to the front, so that the innermost one is reported.
    let exponent = body.profile_exponent();
    let kinks = body.kinks().into_iter();
    let mut jumps = kinks.filter(|kink| kink.radius < front && kink.slope_jump > 0.0);
    let cause = if exponent <= 0.5 {
        DivergenceCause::ApexExponent { exponent }
    } else if let Some(kink) = jumps.next() {
        DivergenceCause::SlopeJump {
            radius: kink.radius,
            jump: kink.slope_jump,
        }
    } else if front >= body.max_radius() && body.line_height(front) < depth {
        DivergenceCause::VerticalEdge { radius: front }
    } else {
        return Ok(());
    };
    Err(FrictionError::FrictionDiverges {
        cause,
        indentation_depth: depth,
        contact_length: front - rear,
    })
}

/// Integral of the squared slope, ∫₀^a h̃'(x)² dx, \[m], for a line over which it does not diverge.
pub(crate) fn squared_slope_integral(
    body: &dyn Axisymmetric,
    radius: f64,
) -> Result<Estimate, FrictionError> {
    // The slope may be singular at the apex only; between kinks the line is smooth.
    let ends = ends_outside_apex(body, radius);
    let inner = squared_slope_integral_at_apex(body, ends[0]);
    let outer = integrate_pieces(|x| body.line_slope(x).powi(2), &ends);
    accept_accurate("integral of the squared slope", inner + outer)
}

/// Integral of the squared slope, ∫ h̃'² dx, from the apex, where h̃' ∼ x^(p−1) may be singular, to `end`, \[m].
fn squared_slope_integral_at_apex(body: &dyn Axisymmetric, end: f64) -> Estimate {
    let square = |x: f64| body.line_slope(x).powi(2);
    let exponent = body.profile_exponent();
    if exponent >= 1.0 {
        return integrate_pieces(square, &[0.0, end]);
    }
    // As p approaches 1/2, most of the integral lies below the smallest number. The innermost part is therefore that of the
    // leading power, and elsewhere x = end s^(1/(2p − 1)) makes the integrand of that power a constant.
    let rate = 2.0 * exponent - 1.0;
    let reach = LEADING_POWER_REACH * end;
    let innermost = reach * square(reach) / rate;
    let integrand = |s: f64| {
        let x = end * s.powf(rate.recip());
        square(x) * x / (rate * s)
    };
    integrate_pieces(integrand, &[LEADING_POWER_REACH.powf(rate), 1.0]) + Estimate::exact(innermost)
}
