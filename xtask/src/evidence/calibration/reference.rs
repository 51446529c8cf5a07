//! What a result is compared with: a closed form, or the stationary solver of the model with a far smaller error.

use anyhow::{Context, Result, bail};
use friction_analytic::{
    FrictionError, LineContact, cylinder_sliding, power_indentation_after_impulse,
};
use numerics::{Estimate, try_bracketed_root};
use rheology::Viscous;
use viscofriction::scene::{self, Control, Method, Model};
use viscofriction::solve::{Body, Motion, Problem, Revolution, SolveError};

use super::scene::{FLAT, Scene};
use crate::evidence::request::{ROUNDING, Reference, Request, first_reached, presses};

/// Half the lengths of contacts over the radius of a cylinder, between which a force is sought.
const HALF_LENGTHS: [f64; 2] = [1e-6, 1.0];
/// Relative error of the friction of a contact whose length is found to rounding.
const CYLINDER_ERROR: f64 = 1e-12;
/// Relative errors of the line; the first that is reached is taken.
const LINE_ERRORS: [f64; 3] = [1e-12, 1e-11, 1e-10];
/// Errors of references, as a part of the bars that they judge sharply, at most.
pub(super) const SHARP_REFERENCE_RATIO: f64 = 1.0 / 3.0;
/// Smallest and largest relative errors asked of the half space.
const HALF_SPACE_ERRORS: [f64; 2] = [1e-5, 1e-3];

/// The closed form that a result is compared with, if there is one that is not of the same method, and is sharp for a bar
/// of this relative length.
pub(super) fn closed_form(scene: &Scene, request: &Request, bar: f64) -> Result<Option<Reference>> {
    let (file, presses) = (&scene.file, presses(&scene.file));
    match request.method {
        Method::Analytic if presses => return power_pressed(file),
        Method::Analytic => return Ok(None),
        _ => {}
    }
    if scene.is("cylinder") && scene.is("kelvin-voigt standard-solid") && !presses {
        return cylinder(file).map(Some);
    }
    let closed_form = Request::to_error(request.model, Method::Analytic, sharp_for(bar));
    let is_offered = closed_form.is_offered(file)?;
    let reference = is_offered.then(|| closed_form.reference(file, ROUNDING));
    reference.transpose()
}

/// Whether a stationary solver can judge a result that no closed form does.
pub(super) fn is_numerical(scene: &Scene, request: &Request) -> bool {
    request.method != Method::Analytic || scene.is_stationary()
}

fn sharp_for(bar: f64) -> f64 {
    let [smallest, largest] = HALF_SPACE_ERRORS;
    (SHARP_REFERENCE_RATIO * bar).max(smallest).min(largest)
}

/// The stationary solver of a model, sharp for bars of this relative length; where its error is not reached, what was
/// reached is the reference, with the error that it has.
pub(super) fn numerical(scene: &Scene, model: Model, bar: f64) -> Result<Reference> {
    if scene.is("elastic") && !presses(&scene.file) {
        let source = "no friction on an elastic material";
        return Ok(Reference::new(0.0, 0.0, source));
    }
    let is_coarse = scene.is("self-affine") || scene.is(FLAT);
    let sharp = if is_coarse {
        SHARP_REFERENCE_RATIO * bar
    } else {
        sharp_for(bar)
    };
    let found = match model {
        Model::Line => first_reached(&scene.file, model, &LINE_ERRORS),
        Model::HalfSpace => first_reached(&scene.file, model, &[sharp]),
    };
    found.or_else(|failure| {
        let reached = failure.downcast_ref().and_then(SolveError::reached);
        let friction = reached.and_then(|answer| answer.friction_coefficient);
        let source = "the stationary solver, as far as it came";
        let reference = |found: Estimate| Reference::new(found.value, found.error, source);
        friction.map(reference).ok_or(failure)
    })
}

/// The contact of Hunter's cylinder (1961) that carries the force.
fn cylinder(scene: &scene::Scene) -> Result<Reference> {
    let problem = Problem::try_from(scene)?;
    let (Body::Cylinder(cylinder), Motion::Sliding(load)) = (problem.body(), problem.motion())
    else {
        bail!("no cylinder that slides");
    };
    let force = load.require_normal_force()?;
    let slide = |logarithm: f64| {
        let contact = LineContact {
            half_length: logarithm.exp() * cylinder.radius(),
            velocity: load.velocity(),
        };
        cylinder_sliding(cylinder, problem.material(), contact)
    };
    let missing = |logarithm| Ok::<_, FrictionError>(slide(logarithm)?.line_load.ln() - force.ln());
    let half_length = try_bracketed_root(missing, HALF_LENGTHS.map(f64::ln))?;
    let half_length = half_length.context("no contact carries the force")?;
    let friction = slide(half_length)?.friction_coefficient;
    let error = CYLINDER_ERROR * friction;
    Ok(Reference::new(friction, error, "Hunter's cylinder"))
}

/// The closed form of powers beside the quadrature that solves any body.
fn power_pressed(scene: &scene::Scene) -> Result<Option<Reference>> {
    let problem = Problem::try_from(scene)?;
    let (Body::Revolution(Revolution::Power(profile)), Control::NormalForce(force)) =
        (problem.body(), problem.motion().control())
    else {
        return Ok(None);
    };
    let material = problem.material();
    let compliance = material.creep_compliance(scene.solve.indentation_time()?)?;
    let impulse = force * (material.half_space_factor() * compliance);
    let contact = power_indentation_after_impulse(profile, &Viscous::new(1.0)?, impulse)?;
    let value = contact.indentation_depth;
    let source = "closed form of powers";
    Ok(Some(Reference::new(value, ROUNDING * value, source)))
}
