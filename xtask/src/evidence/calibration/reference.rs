//! What a result is compared with: a closed form, or the stationary solver of the model with a far smaller error.

use anyhow::{Context, Error, Result, bail};
use friction_analytic::{
    FrictionError, LineContact, cylinder_sliding, power_indentation_after_impulse,
};
use numerics::try_bracketed_root;
use rheology::Viscous;
use viscofriction::scene::{self, Control, MaterialTable, Method, Model};
use viscofriction::solve::{Body, Motion, Problem, Revolution, SolveError};

use super::scene::Scene;
use crate::evidence::request::{ROUNDING, Reference, Request, first_reached, presses};

/// Half the lengths of contacts over the radius of a cylinder, between which a force is sought.
const HALF_LENGTHS: [f64; 2] = [1e-6, 1.0];
/// Relative error of the friction of a contact whose length is found to rounding.
const CYLINDER: f64 = 1e-12;
/// Relative errors of the line; the first that is reached is taken.
const LINE_ERRORS: [f64; 3] = [1e-12, 1e-11, 1e-10];
/// Errors of references, as a part of the bars that they judge sharply, at most.
pub(super) const SHARP: f64 = 1.0 / 3.0;
/// Smallest and largest relative errors asked of the half space.
const HALF_SPACE_ERRORS: [f64; 2] = [1e-5, 1e-3];

/// The closed form that a result is compared with, if there is one that is not of the same method, and is sharp for a bar
/// of this relative length.
pub(super) fn closed_form(scene: &Scene, request: &Request, bar: f64) -> Result<Option<Reference>> {
    if request.method == Method::Analytic {
        return if presses(&scene.file) {
            power_pressed(&scene.file)
        } else {
            Ok(None)
        };
    }
    let has_one_time = matches!(
        scene.file.material,
        MaterialTable::KelvinVoigt { .. } | MaterialTable::StandardSolid { .. }
    );
    if scene.is_cylinder() && has_one_time && !presses(&scene.file) {
        return cylinder(&scene.file).map(Some);
    }
    let closed_form = Request::to_error(request.model, Method::Analytic, sharp_for(bar));
    if !closed_form.is_offered(&scene.file)? {
        return Ok(None);
    }
    closed_form.reference(&scene.file, ROUNDING).map(Some)
}

/// Whether a stationary solver can judge a result that no closed form does.
pub(super) fn is_numerical(scene: &Scene, request: &Request) -> bool {
    request.method != Method::Analytic || scene.is_stationary()
}

fn sharp_for(bar: f64) -> f64 {
    let [smallest, largest] = HALF_SPACE_ERRORS;
    (SHARP * bar).max(smallest).min(largest)
}

/// The stationary solver of a model, sharp for bars of this relative length.
pub(super) fn numerical(scene: &Scene, model: Model, bar: f64) -> Result<Reference> {
    if scene.is_elastic() && !presses(&scene.file) {
        return Ok(Reference::new(
            0.0,
            0.0,
            "no friction on an elastic material",
        ));
    }
    let found = match model {
        Model::Line => first_reached(&scene.file, model, &LINE_ERRORS),
        Model::HalfSpace if scene.is_rough() || scene.is_flat() => {
            first_reached(&scene.file, model, &[SHARP * bar])
        }
        Model::HalfSpace => first_reached(&scene.file, model, &[sharp_for(bar)]),
    };
    found.or_else(as_far_as_it_came)
}

/// Where the error is not reached, what was reached is the reference, with the error that it has.
fn as_far_as_it_came(failure: Error) -> Result<Reference> {
    let reached = failure.downcast_ref().and_then(SolveError::reached);
    match reached.and_then(|answer| answer.friction_coefficient) {
        Some(friction) => {
            let source = "the stationary solver, as far as it came";
            Ok(Reference::new(friction.value, friction.error, source))
        }
        None => Err(failure),
    }
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
        let half_length = logarithm.exp() * cylinder.radius();
        let velocity = load.velocity();
        cylinder_sliding(
            cylinder,
            problem.material(),
            LineContact {
                half_length,
                velocity,
            },
        )
    };
    let missing = |logarithm| Ok::<_, FrictionError>(slide(logarithm)?.line_load.ln() - force.ln());
    let half_length = try_bracketed_root(missing, HALF_LENGTHS.map(f64::ln))?;
    let friction =
        slide(half_length.context("no contact carries the force")?)?.friction_coefficient;
    Ok(Reference::new(
        friction,
        CYLINDER * friction,
        "Hunter's cylinder",
    ))
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
