//! Answers in closed form, or by quadrature.

use std::f64::consts::{FRAC_1_PI, PI};

use friction_analytic::{
    ElasticContact, FrictionError, SlidingContact, StationarySliding, ViscoelasticSliding,
    axisymmetric_sliding, cylinder_half_width_after_impulse, half_space_power_friction,
    impulse_to_depth, indentation_after_impulse, power_peak_pressure, power_sliding, slow_sliding,
    superposition_sliding, transient_sliding,
};
use indenters::{Control, Cylinder, PowerProfile, SlidingLoad, contact_radius};
use numerics::{Estimate, bracketed_root};
use rheology::{Compressible, Elastic, Material, Viscous};

use super::answer::{Answer, ContactBox, within};
use super::error::{Result, SolveError};
use super::half_space::{Simple, simple};
use crate::scene::Revolution;
use crate::scene::{Method, Model};

/// Number of intervals at whose ends the line load along the contact is sampled for the output. Chosen; it changes no other
/// number.
const N_LOAD_INTERVALS: usize = 200;
/// Relative error stated for force, depth and radius of a body pressed into the half space. Chosen, above the error of the
/// quadrature and of the search for the radius.
const QUADRATURE_ERROR: f64 = 1e-10;
/// Relative error stated for closed forms whose contact front is found by root search. Chosen, far above rounding.
const FRONT_ERROR: f64 = 1e-12;
/// Relative error stated for the closed form of the pressed cylinder. Chosen: about 50 times the rounding error of one operation.
const ROUNDING_ERROR: f64 = 1e-14;

/// The answer of frictionless sliding on an elastic material: the pressed contact with μ = 0.
pub(crate) fn without_friction(pressed: Answer) -> Answer {
    Answer {
        friction_coefficient: Some(Estimate::exact(0.0)),
        ..pressed
    }
}

/// Stationary sliding on a viscous Winkler foundation (one-dimensional model).
pub(crate) fn viscous_line(
    body: &Revolution,
    material: &Viscous,
    load: &SlidingLoad,
) -> Result<Answer> {
    let velocity = load.velocity();
    let per_depth = 4.0 * material.viscosity() * velocity;
    let force = match load.control() {
        Control::NormalForce(force) => force,
        // The force follows from the depth d = F_N/(4 η v), Eq. (12) of Kürschner (2014), with the normal force F_N, viscosity η
        // and speed v.
        Control::IndentationDepth(depth) => per_depth * depth,
    };
    let under_force = SlidingLoad::new(force, velocity)?;
    let state = match body {
        Revolution::Power(profile) => power_sliding(profile, material, &under_force),
        Revolution::Sum(profile) => superposition_sliding(profile, material, &under_force),
        Revolution::Sphere(_) | Revolution::Other(_) => {
            axisymmetric_sliding(&**body, material, &under_force)
        }
    }?;
    let (force, depth) = force_and_depth(
        load.control(),
        [force, state.indentation_depth],
        FRONT_ERROR,
    );
    let mut answer = Answer {
        friction_coefficient: Some(Estimate::new(state.friction_coefficient, state.error)),
        indentation_depth: Some(depth),
        contact_box: ends(&state.contact_line).map(contact_interval),
        ..Answer::new(Method::Analytic, Model::Line, force)
    };
    answer.fields.line_load = load_along(body, per_depth, &state);
    Ok(answer)
}

/// Normal force \[N] and indentation depth \[m] as estimates: the given one is exact, the other has the relative error `error`.
fn force_and_depth(given: Control, [force, depth]: [f64; 2], error: f64) -> (Estimate, Estimate) {
    match given {
        Control::NormalForce(force) => (Estimate::exact(force), within(depth, error)),
        Control::IndentationDepth(depth) => (within(force, error), Estimate::exact(depth)),
    }
}

/// The contact interval between rear and front \[m] of a closed form, with the error of a front found by root search.
fn contact_interval(ends: [f64; 2]) -> ContactBox {
    let length = ends[1] - ends[0];
    ContactBox::along(ends, FRONT_ERROR * length)
}

/// Rear end of the first and front end of the last interval of a contact line, \[m]; `None` if it is empty.
fn ends(intervals: &[[f64; 2]]) -> Option<[f64; 2]> {
    Some([intervals.first()?[0], intervals.last()?[1]])
}

/// Position \[m] and line load 4 η v h̃'(x) \[N/m], `per_depth` being 4 η v \[N/m], at equally spaced positions from the rear
/// to the front of the contact. Infinite values are left out.
fn load_along(body: &Revolution, per_depth: f64, state: &StationarySliding) -> Vec<[f64; 2]> {
    let Some([rear, front]) = ends(&state.contact_line) else {
        return Vec::new();
    };
    let position = |index: usize| rear + (front - rear) * (index as f64 / N_LOAD_INTERVALS as f64);
    let load = |position: f64| [position, per_depth * body.line_slope(position)];
    let loads = (0..=N_LOAD_INTERVALS).map(position).map(load);
    loads.filter(|[_, load]| load.is_finite()).collect()
}

/// Stationary sliding of a power profile on a viscous half space, from the table of the scaling factor s(p).
pub(crate) fn viscous_half_space(
    profile: &PowerProfile,
    material: &Viscous,
    load: &SlidingLoad,
) -> Result<Answer> {
    let force = Estimate::exact(load.require_normal_force()?);
    let friction = half_space_power_friction(profile, material, load)?;
    Ok(Answer {
        friction_coefficient: Some(friction),
        ..Answer::new(Method::Analytic, Model::HalfSpace, force)
    })
}

/// Slow sliding over a viscoelastic half space with an equilibrium modulus: first order in the velocity about the elastic contact.
/// `None` if the truncation estimate exceeds the relative error `asked`, or if the elastic contact fails.
pub(crate) fn slow_half_space(
    body: &Revolution,
    material: &dyn Material,
    load: &SlidingLoad,
    asked: f64,
) -> Option<Answer> {
    let modulus = material.relaxation().equilibrium_modulus();
    let spring = Compressible::new(&Elastic::new(modulus).ok()?, material.poisson_ratio());
    let elastic = pressed(body, &spring.ok()?, load.control(), 1.0).ok()?;
    let [_, front] = elastic.contact_box.as_ref()?.x;
    let contact = ElasticContact {
        contact_radius: front,
        velocity: load.velocity(),
    };
    let slow = slow_sliding(&**body, material, contact).ok()?;
    let widened = |found: Estimate| match found.error {
        0.0 => found,
        error => within(found.value, slow.elastic_error + error / found.value),
    };
    let ends = [slow.rear.value, front];
    let mut friction = slow.friction_coefficient;
    if let Control::IndentationDepth(_) = load.control() {
        // The friction coefficient was computed with the normal force of the elastic contact. Its error is widened by that of the
        // force, because it falls with the force less than in proportion.
        friction = friction.widened(slow.elastic_error * friction.value.abs());
    }
    (friction.value > 0.0 && friction.is_within(asked)).then(|| Answer {
        friction_coefficient: Some(friction),
        normal_force: widened(elastic.normal_force),
        indentation_depth: elastic.indentation_depth.map(widened),
        contact_area: Some(slow.contact_area),
        contact_box: Some(ContactBox::around(ends, [-front, front], slow.rear.error)),
        peak_pressure: None,
        ..elastic
    })
}

/// Cone or paraboloid on a viscous Winkler foundation after a sliding distance from first touch, \[m].
pub(crate) fn viscous_transient(
    profile: &PowerProfile,
    material: &Viscous,
    load: &SlidingLoad,
    distance: f64,
) -> Result<Answer> {
    let load = &SlidingLoad::new(load.require_normal_force()?, load.velocity())?;
    let state = transient_sliding(profile, material, load, distance / load.velocity())?;
    let force = Estimate::exact(load.require_normal_force()?);
    Ok(Answer {
        friction_coefficient: Some(within(state.friction_coefficient, FRONT_ERROR)),
        indentation_depth: Some(within(state.indentation_depth, FRONT_ERROR)),
        contact_box: Some(contact_interval(state.contact_line)),
        ..Answer::new(Method::Analytic, Model::Line, force)
    })
}

/// Stationary sliding of a cone or paraboloid on a Kelvin–Voigt or Maxwell foundation (one-dimensional model).
pub(crate) fn viscoelastic_line(
    profile: &PowerProfile,
    load: &SlidingLoad,
    sliding: impl Fn(SlidingContact) -> Result<ViscoelasticSliding, FrictionError>,
) -> Result<Answer> {
    let velocity = load.velocity();
    let at_front = |front: f64| sliding(SlidingContact { front, velocity });
    let front = match load.control() {
        Control::IndentationDepth(depth) => profile.line_position(depth),
        Control::NormalForce(force) => {
            let ratio = |front: f64| Some(at_front(front).ok()?.normal_force / force);
            let normal_force = force;
            front_of_force(ratio).ok_or(SolveError::FrontNotFound { normal_force })?
        }
    };
    let state = at_front(front)?;
    let found = [state.normal_force, state.indentation_depth];
    let (force, depth) = force_and_depth(load.control(), found, FRONT_ERROR);
    Ok(Answer {
        friction_coefficient: Some(within(state.friction_coefficient, FRONT_ERROR)),
        indentation_depth: Some(depth),
        contact_box: Some(contact_interval(state.contact)),
        ..Answer::new(Method::Analytic, Model::Line, force)
    })
}

/// Contact front \[m] at which an increasing ratio, that of its force to the given one, equals 1. The search for a bracket
/// begins at 1 m and halves or doubles; a ratio of `None` counts as above 1 while it halves. `None` if no bracket is found.
fn front_of_force(ratio: impl Fn(f64) -> Option<f64>) -> Option<f64> {
    let mut front = 1.0;
    while ratio(front).is_none_or(|ratio| ratio > 1.0) {
        front *= 0.5;
        (front > f64::MIN_POSITIVE).then_some(())?;
    }
    while ratio(2.0 * front)? < 1.0 {
        front *= 2.0;
    }
    let excess = |front: f64| ratio(front).map_or(0.0, f64::ln);
    bracketed_root(excess, [front, 2.0 * front])
}

/// Indentation by a body of revolution without sliding, in closed form or by quadrature.
///
/// As long as the contact does not shrink, the half space and the one-dimensional model agree exactly (Lee & Radok 1960).
/// A constant force acts on every material like the impulse F J(t) on a dashpot of unit viscosity:
///
/// ```text
/// 8 ∫₀^a x h̃' dx = 2 (1 − ν) F J(t)         constant force
/// F(t) = 8 G(t)/(2 (1 − ν)) ∫₀^a x h̃' dx    constant depth, contact radius a
/// ```
pub(crate) fn pressed(
    body: &Revolution,
    material: &dyn Material,
    control: Control,
    duration: f64,
) -> Result<Answer> {
    let dashpot = Viscous::new(1.0)?;
    let (force, depth, radius) = match control {
        Control::NormalForce(force) => {
            let impulse = impulse(material, force, duration)?;
            let contact = indentation_after_impulse(&**body, &dashpot, impulse)?;
            (force, contact.indentation_depth, contact.contact_radius)
        }
        Control::IndentationDepth(depth) => {
            let impulse = impulse_to_depth(&**body, &dashpot, depth)?;
            let force = stiffness(material, duration)? * impulse;
            (force, depth, contact_radius(&**body, depth)?)
        }
    };
    // State the peak pressure only for an elastic material, because otherwise it depends on the history of the contact. For
    // exponents p ≤ 1 of the profile it has no bound.
    let peak_pressure = match (body, simple(material)?) {
        (Revolution::Power(profile), Some(Simple::Elastic)) if profile.exponent() > 1.0 => {
            Some(stiffness(material, duration)? * power_peak_pressure(profile, radius)?)
        }
        _ => None,
    };
    let (force, depth) = force_and_depth(control, [force, depth], QUADRATURE_ERROR);
    let across = [-radius, radius];
    Ok(Answer {
        indentation_depth: Some(depth),
        contact_area: Some(within(PI * radius * radius, 2.0 * QUADRATURE_ERROR)),
        contact_box: Some(ContactBox::around(
            across,
            across,
            QUADRATURE_ERROR * radius,
        )),
        peak_pressure: peak_pressure.map(|pressure| within(pressure, 2.0 * QUADRATURE_ERROR)),
        ..Answer::new(Method::Analytic, Model::HalfSpace, force)
    })
}

/// Impulse on a dashpot of the viscosity 1 Pa s that leads to the contact of a force \[N] held for a duration \[s]: 2 (1 − ν) F
/// J(t).
fn impulse(material: &dyn Material, force: f64, duration: f64) -> Result<f64> {
    let compliance = material.half_space_factor() * material.creep_compliance(duration)?;
    Ok(force * compliance)
}

/// Ratio of the force at a depth held for a duration \[s] to the impulse on a dashpot of 1 Pa s that reaches the same depth:
/// G(t)/(2 (1 − ν)), in units of 1 Pa s. Here G is the relaxation modulus and ν the Poisson ratio. An error if the material has
/// relaxed to 0.
pub(crate) fn stiffness(material: &dyn Material, duration: f64) -> Result<f64> {
    let modulus = material.relaxation_modulus(duration)?;
    let stiffness = modulus / material.half_space_factor();
    if !(stiffness.is_finite() && stiffness > 0.0) {
        return Err(SolveError::Relaxed { duration, modulus });
    }
    Ok(stiffness)
}

/// Indentation by an infinite cylinder under a constant force in plane strain; forces and areas are per unit length along y.
pub(crate) fn cylinder_pressed(
    cylinder: &Cylinder,
    material: &dyn Material,
    force: f64,
    duration: f64,
) -> Result<Answer> {
    let impulse = impulse(material, force, duration)?;
    let dashpot = Viscous::new(1.0)?;
    let half_width = cylinder_half_width_after_impulse(cylinder, &dashpot, impulse)?;
    let is_elastic = simple(material)? == Some(Simple::Elastic);
    let peak_pressure = is_elastic.then(|| 2.0 * FRAC_1_PI * (force / half_width));
    let ends = [-half_width, half_width];
    Ok(Answer {
        is_per_length: true,
        contact_area: Some(within(2.0 * half_width, ROUNDING_ERROR)),
        contact_box: Some(ContactBox::along(ends, ROUNDING_ERROR * half_width)),
        peak_pressure: peak_pressure.map(|pressure| within(pressure, ROUNDING_ERROR)),
        ..Answer::new(Method::Analytic, Model::HalfSpace, Estimate::exact(force))
    })
}
