//! Indentation histories on a bonded layer whose contact grows once and shrinks once.

use friction_analytic::{BondedLayer, FrictionError, LayerProfile, indentation_after_impulse};
use indenters::{Axisymmetric, Control, EquivalentProfile, HistoryPoint};
use mdr_core::indent_along;
use rheology::Viscous;

use super::answer::Answer;
use super::error::Result;
use super::mdr::{answer_from_curve, history_options};
use super::problem::Problem;
use crate::scene::Method;
use crate::scene::Revolution;

/// The answer along a history to the relative error `asked`, by the one-dimensional model of the layer; `None` without points.
/// An error means that the contact grows again, is too wide, or reaches the edge of the body.
pub(super) fn followed(
    problem: &Problem,
    body: &Revolution,
    points: &[HistoryPoint],
    asked: f64,
) -> Result<Option<Answer>> {
    let profile = layer_profile(problem, body, points)?;
    let mut options = history_options(problem, asked);
    options.modulus_error += profile.relative_error();
    let mut curve = indent_along(&profile, problem.material(), points, &options)?;
    for point in &mut curve {
        point.contact_radius = profile.contact_radius(point.contact_radius);
    }
    Ok(answer_from_curve(problem, Method::Analytic, &curve))
}

/// The body of revolution whose Winkler foundation has the force of the body on the layer at every depth, tabulated up to the
/// largest depth \[m] of the history. Under a given force that depth is bounded by the creep until the end.
fn layer_profile(
    problem: &Problem,
    body: &Revolution,
    points: &[HistoryPoint],
) -> Result<LayerProfile> {
    let material = problem.material();
    let layer = BondedLayer::new(problem.thickness(), material.poisson_ratio())
        .map_err(FrictionError::from)?;
    let values = points.iter().map(|point| point.control.value());
    let largest = values.fold(0.0, f64::max);
    let mut depth = largest;
    if let Control::NormalForce(_) = problem.motion().control() {
        let duration = problem.durations().into_iter().fold(0.0, f64::max);
        let compliance = material.creep_compliance(duration)? * material.half_space_factor();
        depth = depth_bound(&**body, &layer, largest * compliance)?;
    }
    Ok(LayerProfile::new(&**body, &layer, depth)?)
}

/// Upper bound of the depth \[m] on a layer that is reached by an impulse on a dashpot of 1 Pa s. The radius begins at that on
/// the half space and is halved as long as half of it has more than a quarter of the impulse.
fn depth_bound(body: &dyn Axisymmetric, layer: &BondedLayer, impulse: f64) -> Result<f64> {
    let on_half_space = indentation_after_impulse(body, &Viscous::new(1.0)?, impulse)?;
    let mut radius = on_half_space.contact_radius.min(layer.max_contact_radius());
    // Compare forces instead of depths: the depth of a flat punch does not depend on its radius.
    let force = |radius| {
        layer
            .press(body, radius)
            .map_or(0.0, |contact| contact.force_per_modulus)
    };
    while force(0.5 * radius) > 0.25 * impulse {
        radius *= 0.5;
    }
    let contact = layer.press(body, radius);
    // Stay below the largest contact radius that is allowed, by more than rounding.
    Ok((1.0 - 1e-6)
        * contact.map_or(on_half_space.indentation_depth, |contact| {
            contact.indentation_depth
        }))
}

/// The profile for the one-dimensional model: on a layer the equivalent one, on a half space that of the body itself.
pub(super) fn equivalent_profile<'a>(
    problem: &Problem,
    body: &'a Revolution,
    points: &[HistoryPoint],
) -> Result<Box<dyn EquivalentProfile + 'a>> {
    if problem.thickness().is_finite() {
        return Ok(Box::new(layer_profile(problem, body, points)?));
    }
    Ok(Box::new(&**body))
}
