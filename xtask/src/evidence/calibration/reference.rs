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
use crate::evidence::request::{CLOSED_FORM_ROUNDING, Reference, Request, first_reached, presses};

/// Range in which the ratio of half the contact length to the radius of a cylinder is sought. Above 1 the contact would be wider
/// than the cylinder; the lower end is chosen.
const HALF_LENGTHS: [f64; 2] = [1e-6, 1.0];
/// Relative error assumed of the friction of Hunter's cylinder. Chosen: the root is found to rounding, and the formula amplifies
/// it.
const CYLINDER_ERROR: f64 = 1e-12;
/// Relative errors requested of references in the one-dimensional model; the first that is reached is taken.
const LINE_ERRORS: [f64; 3] = [1e-12, 1e-11, 1e-10];
/// Largest ratio of the error of a reference to an error bar with which the reference judges the bar sharply. Chosen: the
/// error of the reference then changes the ratio of deviation to bar by at most a third.
pub(super) const SHARP_REFERENCE_RATIO: f64 = 1.0 / 3.0;
/// Range of the relative errors requested of references on the half space. Chosen: smaller errors take too long.
const HALF_SPACE_ERRORS: [f64; 2] = [1e-5, 1e-3];

/// The closed form with which a result of another method is compared, sharp for an error bar of the relative length `bar`;
/// `None` where there is none.
pub(super) fn closed_form(scene: &Scene, request: &Request, bar: f64) -> Result<Option<Reference>> {
    let (file, presses) = (&scene.file, presses(&scene.file));
    match request.method {
        Method::Analytic if presses => return power_pressed(file),
        Method::Analytic => return Ok(None),
        _ => {}
    }
    if file.heat.is_some() || file.strain.is_some() {
        return Ok(None);
    }
    if scene.is("cylinder") && scene.is("kelvin-voigt standard-solid") && !presses {
        return cylinder(file).map(Some);
    }
    let closed_form = Request::to_error(request.model, Method::Analytic, sharp_for(bar));
    let is_offered = closed_form.is_offered(file)?;
    let reference = is_offered.then(|| closed_form.reference(file, CLOSED_FORM_ROUNDING));
    reference.transpose()
}

/// Whether a result for which there is no closed form is compared with that of a stationary solver.
pub(super) fn is_numerical(scene: &Scene, request: &Request) -> bool {
    request.method != Method::Analytic || scene.is_stationary()
}

/// Relative error of a reference that judges an error bar of the relative length `bar`, within [`HALF_SPACE_ERRORS`].
fn sharp_for(bar: f64) -> f64 {
    let [smallest, largest] = HALF_SPACE_ERRORS;
    (SHARP_REFERENCE_RATIO * bar).max(smallest).min(largest)
}

/// The result of the stationary solver of a model, sharp for error bars of the relative length `bar`. Where the solver does
/// not reach that, what it reached is the reference, with its larger error.
pub(super) fn numerical(scene: &Scene, model: Model, bar: f64) -> Result<Reference> {
    if scene.is("elastic") && !presses(&scene.file) && scene.file.interface.is_none() {
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

/// Friction coefficient of a cylinder that rolls on a standard solid (Hunter 1961). The formula takes the contact length, so
/// that the length under which the given force is carried is sought first, in logarithms of both.
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
    let log_half_length = try_bracketed_root(missing, HALF_LENGTHS.map(f64::ln))?
        .context("no contact carries the force")?;
    // The shear of the interface acts on the whole contact length.
    let length = 2.0 * log_half_length.exp() * cylinder.radius();
    let shear = problem.shear_strength()?.unwrap_or_default() * length / force;
    let friction = slide(log_half_length)?.friction_coefficient + shear;
    let error = CYLINDER_ERROR * friction;
    Ok(Reference::new(friction, error, "Hunter's cylinder"))
}

/// Depth \[m] of a power profile under a constant force by its closed form, with which the quadrature for any body is compared;
/// `None` for other bodies and where the depth is given.
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
    Ok(Some(Reference::new(
        value,
        CLOSED_FORM_ROUNDING * value,
        source,
    )))
}
