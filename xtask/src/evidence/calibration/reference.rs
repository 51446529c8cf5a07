//! What a result is compared with: a closed form, or the stationary solver of the model with a far smaller error.

use anyhow::Result;
use bem_halfspace::BemError;
use friction_analytic::power_indentation_after_impulse;
use rheology::Viscous;
use viscofriction::scene::{self, Control, Method, Model};
use viscofriction::solve::{Body, Problem, Revolution, SolveError};

use super::scenes::Scene;
use crate::evidence::request::{ROUNDING, Reference, Request, first_reached, presses};

/// Relative errors of the line; the first that is reached is taken.
const LINE_ERRORS: [f64; 3] = [1e-12, 1e-11, 1e-10];
/// How much smaller the error of the half space is than that asked for.
const FINER: f64 = 0.1;

/// What a request is compared with, if there is anything; `asked` is the smallest error that is asked of its model.
///
/// A closed form is compared with no other that the same method gives.
pub(super) fn reference(scene: &Scene, request: &Request, asked: f64) -> Result<Option<Reference>> {
    let asked = FINER * asked;
    if request.method == Method::Analytic {
        if presses(&scene.file) {
            return power_pressed(&scene.file);
        }
        if scene.file.solve.sliding_distance.is_some() {
            return Ok(None);
        }
    } else {
        let closed_form = Request::to_error(request.model, Method::Analytic, asked);
        if closed_form.is_offered(&scene.file)? {
            return closed_form.reference(&scene.file, ROUNDING).map(Some);
        }
    }
    numerical(scene, request.model, asked).map(Some)
}

fn numerical(scene: &Scene, model: Model, asked: f64) -> Result<Reference> {
    if scene.is_elastic() && !presses(&scene.file) {
        return Ok(Reference::new(
            0.0,
            0.0,
            "no friction on an elastic material",
        ));
    }
    match model {
        Model::Line => first_reached(&scene.file, model, &LINE_ERRORS),
        Model::HalfSpace => half_space(&scene.file, asked),
    }
}

/// Where the error is not reached, what was reached is the reference, with the error that it has.
fn half_space(scene: &scene::Scene, error: f64) -> Result<Reference> {
    first_reached(scene, Model::HalfSpace, &[error]).or_else(|failure| {
        match failure.downcast_ref() {
            Some(&SolveError::HalfSpace(BemError::NotReached {
                quantity: "friction coefficient",
                value,
                error,
                ..
            })) => {
                let source = "bem-steady, as far as it came";
                Ok(Reference::new(value, error, source))
            }
            _ => Err(failure),
        }
    })
}

/// The closed form of powers beside the quadrature that solves any body.
fn power_pressed(scene: &scene::Scene) -> Result<Option<Reference>> {
    let problem = Problem::try_from(scene)?;
    let (Body::Revolution(Revolution::Power(profile)), Control::NormalForce(force)) =
        (&problem.body, problem.motion.control())
    else {
        return Ok(None);
    };
    let material = &*problem.material;
    let compliance = material.creep_compliance(scene.solve.indentation_time()?)?;
    let impulse = force * (material.half_space_factor() * compliance);
    let contact = power_indentation_after_impulse(profile, &Viscous::new(1.0)?, impulse)?;
    let value = contact.indentation_depth;
    let source = "closed form of powers";
    Ok(Some(Reference::new(value, ROUNDING * value, source)))
}
