//! Indentation histories on a bonded layer whose contact grows once and shrinks once.

use friction_analytic::{BondedLayer, FrictionError, LayerProfile, indentation_after_impulse};
use indenters::{Axisymmetric, Control, EquivalentProfile, HistoryPoint};
use mdr_core::indent_along;
use rheology::Viscous;

use super::answer::Answer;
use super::body::Revolution;
use super::error::Result;
use super::mdr::{following, of_curve};
use super::problem::Problem;
use crate::scene::Method;

/// The answer along a history; `None` without points. An error means that the theory does not cover contact or material.
pub(super) fn followed(
    problem: &Problem,
    body: &Revolution,
    points: &[HistoryPoint],
    asked: f64,
) -> Result<Option<Answer>> {
    let profile = profile(problem, body, points)?;
    let mut options = following(problem, asked);
    options.modulus_error += profile.relative_error();
    let mut curve = indent_along(&profile, problem.material(), points, &options)?;
    for point in &mut curve {
        point.contact_radius = profile.contact_radius(point.contact_radius);
    }
    Ok(of_curve(problem, Method::Analytic, &curve))
}

/// The equivalent profile whose Winkler foundation has the force of the body, tabulated to the largest depth of the history.
fn profile(problem: &Problem, body: &Revolution, points: &[HistoryPoint]) -> Result<LayerProfile> {
    let material = problem.material();
    let layer = BondedLayer::new(problem.thickness(), material.poisson_ratio())
        .map_err(FrictionError::from)?;
    let value = |point: &HistoryPoint| match point.control {
        Control::IndentationDepth(value) | Control::NormalForce(value) => value,
    };
    let largest = points.iter().map(value).fold(0.0, f64::max);
    let mut depth = largest;
    if let Control::NormalForce(_) = problem.motion().control() {
        let duration = problem.durations().into_iter().fold(0.0, f64::max);
        let compliance = material.creep_compliance(duration)? * material.half_space_factor();
        depth = depth_of(&**body, &layer, largest * compliance)?;
    }
    Ok(LayerProfile::new(&**body, &layer, depth)?)
}

/// Upper bound of the depth reached by an impulse on the dashpot of unit viscosity.
fn depth_of(body: &dyn Axisymmetric, layer: &BondedLayer, impulse: f64) -> Result<f64> {
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

/// The profile equivalent to the body: on a layer that of the layer, on a half space the body itself.
pub(super) fn equivalent<'a>(
    problem: &Problem,
    body: &'a Revolution,
    points: &[HistoryPoint],
) -> Result<Box<dyn EquivalentProfile + 'a>> {
    if problem.thickness().is_finite() {
        return Ok(Box::new(profile(problem, body, points)?));
    }
    Ok(Box::new(&**body))
}
