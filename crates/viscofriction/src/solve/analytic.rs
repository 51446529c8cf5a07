//! Answers in closed form, or by quadrature.

use super::error::{Context as _, Result};
use std::f64::consts::PI;

use friction_analytic::{
    Indentation, SlidingContact, StationarySliding, ViscoelasticSliding, axisymmetric_sliding,
    half_space_power_friction, impulse_to_depth, indentation_after_impulse, kelvin_voigt_sliding,
    maxwell_sliding, power_sliding, superposition_sliding, transient_sliding,
};
use indenters::{Axisymmetric, PowerProfile, PressingLoad, SlidingLoad, contact_radius};
use numerics::Estimate;
use numerics::bracketed_root;
use rheology::{Material, Viscous};

use super::answer::{Answer, ContactBox, within};
use super::body::Revolution;
use super::error::bail;
use super::half_space::{Simple, simple};
use super::pressing::{impulse, stiffness, unit_dashpot};
use crate::scene::{Control, Method, Model};

/// Points of the load along the contact.
const N_POINTS: usize = 200;
/// Relative error of the depth by quadrature.
const QUADRATURE: f64 = 1e-10;
/// Relative error that is stated for closed forms of which only the front had to be searched; far above their rounding.
const SEARCHED: f64 = 1e-12;

/// A body that slides, on the half space or on the one-dimensional model.
pub(crate) fn slid(
    body: &Revolution,
    material: &dyn Material,
    load: &SlidingLoad,
    model: Model,
) -> Result<Answer> {
    let Some(simple) = simple(material)? else {
        bail!("there is no closed form on this material");
    };
    match (simple, body) {
        // Nothing is lost in a spring: the pressure is even, and the slope under it odd.
        (Simple::Elastic, body) => {
            let load = PressingLoad::new(load.control(), 1.0)?;
            Ok(Answer {
                friction_coefficient: Some(Estimate::exact(0.0)),
                ..pressed(body, material, &load)?
            })
        }
        (Simple::Viscous(material), Revolution::Power(profile)) if model == Model::HalfSpace => {
            viscous_half_space(profile, &material, load)
        }
        (Simple::Viscous(material), body) => match (load.sliding_distance(), body) {
            (Some(_), Revolution::Power(profile)) => viscous_transient(profile, &material, load),
            _ => viscous_line(body, &material, load),
        },
        (material, Revolution::Power(profile)) => viscoelastic_line(profile, &material, load),
        _ => bail!("there is no closed form for this body on this material"),
    }
}

/// The stationary state on a viscous line.
fn viscous_line(body: &Revolution, material: &Viscous, load: &SlidingLoad) -> Result<Answer> {
    let velocity = load.velocity();
    let load = line_load(material, load.control(), velocity)?;
    let state = match body {
        Revolution::Power(profile) => power_sliding(profile, material, &load),
        Revolution::Sum(profile) => superposition_sliding(profile, material, &load),
        Revolution::Sphere(_) | Revolution::Other(_) => axisymmetric_sliding(body, material, &load),
    }?;
    let force = Estimate::exact(load.require_normal_force()?);
    let mut answer = Answer {
        friction_coefficient: Some(Estimate {
            value: state.friction_coefficient,
            error: state.error,
        }),
        indentation_depth: Some(within(state.indentation_depth, SEARCHED)),
        contact_box: ends(&state.contact_line).map(along),
        ..Answer::new(Method::Analytic, Model::Line, force)
    };
    answer.fields.line_load = load_along(body, material, velocity, &state);
    Ok(answer)
}

/// d = F_N/(4 η v), (12), both ways.
fn line_load(material: &Viscous, control: Control, velocity: f64) -> Result<SlidingLoad> {
    let force = match control {
        Control::NormalForce(force) => force,
        Control::IndentationDepth(depth) => 4.0 * material.viscosity() * velocity * depth,
    };
    SlidingLoad::new(force, velocity).context("the force that belongs to the depth")
}

/// The contact of a closed form.
fn along(ends: [f64; 2]) -> ContactBox {
    let length = ends[1] - ends[0];
    ContactBox::along(ends, SEARCHED * length)
}

fn ends(intervals: &[[f64; 2]]) -> Option<[f64; 2]> {
    Some([intervals.first()?[0], intervals.last()?[1]])
}

/// w = 4 η v h̃'(x), where it is finite.
fn load_along(
    body: &Revolution,
    material: &Viscous,
    velocity: f64,
    state: &StationarySliding,
) -> Vec<[f64; 2]> {
    let Some([rear, front]) = ends(&state.contact_line) else {
        return Vec::new();
    };
    let position = |index: usize| rear + (front - rear) * (index as f64 / N_POINTS as f64);
    let load = |x: f64| {
        [
            x,
            4.0 * material.viscosity() * velocity * body.line_slope(x),
        ]
    };
    (0..=N_POINTS)
        .map(|index| load(position(index)))
        .filter(|[_, load]| load.is_finite())
        .collect()
}

/// The stationary state of a power profile on a viscous half space, from the table of s(p).
fn viscous_half_space(
    profile: &PowerProfile,
    material: &Viscous,
    load: &SlidingLoad,
) -> Result<Answer> {
    let friction = half_space_power_friction(profile, material, load)?;
    let force = Estimate::exact(load.require_normal_force()?);
    Ok(Answer {
        friction_coefficient: Some(Estimate {
            value: friction.value,
            error: friction.error,
        }),
        ..Answer::new(Method::Analytic, Model::HalfSpace, force)
    })
}

/// Cone and paraboloid on a viscous line, a distance after first touch.
fn viscous_transient(
    profile: &PowerProfile,
    material: &Viscous,
    load: &SlidingLoad,
) -> Result<Answer> {
    let distance = load.sliding_distance().context("no sliding distance")?;
    let load = &SlidingLoad::new(load.require_normal_force()?, load.velocity())?;
    let state = transient_sliding(profile, material, load, distance / load.velocity())?;
    let force = Estimate::exact(load.require_normal_force()?);
    Ok(Answer {
        friction_coefficient: Some(within(state.friction_coefficient, SEARCHED)),
        indentation_depth: Some(within(state.indentation_depth, SEARCHED)),
        contact_box: Some(along(state.contact_line)),
        ..Answer::new(Method::Analytic, Model::Line, force)
    })
}

/// Cone and paraboloid on a Kelvin–Voigt or Maxwell line.
fn viscoelastic_line(
    profile: &PowerProfile,
    material: &Simple,
    load: &SlidingLoad,
) -> Result<Answer> {
    let (control, velocity) = (load.control(), load.velocity());
    let at_front = |front: f64| -> Result<Option<ViscoelasticSliding>> {
        let contact = SlidingContact { front, velocity };
        Ok(match material {
            Simple::KelvinVoigt(solid) => Some(kelvin_voigt_sliding(profile, solid, contact)?),
            Simple::Maxwell(fluid) => Some(maxwell_sliding(profile, fluid, contact)?),
            Simple::Viscous(_) | Simple::Elastic => None,
        })
    };
    let front = match control {
        Control::IndentationDepth(depth) => profile.line_position(depth),
        Control::NormalForce(force) => {
            let excess = |front: f64| Some(at_front(front).ok()??.normal_force / force);
            front_of_force(excess).context("the front that carries the force was not found")?
        }
    };
    let state = at_front(front)?.context("there is no closed form on this material")?;
    let (force, depth) = match control {
        Control::NormalForce(force) => {
            let depth = within(state.indentation_depth, SEARCHED);
            (Estimate::exact(force), depth)
        }
        Control::IndentationDepth(depth) => {
            (within(state.normal_force, SEARCHED), Estimate::exact(depth))
        }
    };
    Ok(Answer {
        friction_coefficient: Some(within(state.friction_coefficient, SEARCHED)),
        indentation_depth: Some(depth),
        contact_box: Some(along(state.contact)),
        ..Answer::new(Method::Analytic, Model::Line, force)
    })
}

/// Where a ratio that grows with the front is one; no ratio means too far out.
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

/// A body that is pressed, in closed form or by quadrature: half space and line agree exactly.
pub(crate) fn pressed(
    body: &Revolution,
    material: &dyn Material,
    load: &PressingLoad,
) -> Result<Answer> {
    let (control, duration) = (load.control(), load.duration());
    let (force, contact) = match control {
        Control::NormalForce(force) => {
            let impulse = impulse(material, force, duration)?;
            let contact = indentation_after_impulse(body, &unit_dashpot()?, impulse)?;
            (force, contact)
        }
        Control::IndentationDepth(depth) => held(body, material, depth, duration)?,
    };
    let radius = contact.contact_radius;
    let depth = contact.indentation_depth;
    let peak_pressure = match (body, simple(material)?) {
        (Revolution::Power(profile), Some(Simple::Elastic)) => {
            peak_of_power(profile, material, radius)?
        }
        _ => None,
    };
    let (force, depth) = match control {
        Control::NormalForce(_) => (Estimate::exact(force), within(depth, QUADRATURE)),
        Control::IndentationDepth(_) => (within(force, QUADRATURE), Estimate::exact(depth)),
    };
    let across = [-radius, radius];
    Ok(Answer {
        indentation_depth: Some(depth),
        contact_area: Some(within(PI * radius * radius, 2.0 * QUADRATURE)),
        contact_box: Some(ContactBox::around(across, across, QUADRATURE * radius)),
        peak_pressure: peak_pressure.map(|pressure| within(pressure, QUADRATURE)),
        ..Answer::new(Method::Analytic, Model::HalfSpace, force)
    })
}

/// Force and contact of a body that is held at a depth.
fn held(
    body: &Revolution,
    material: &dyn Material,
    depth: f64,
    duration: f64,
) -> Result<(f64, Indentation)> {
    let force = stiffness(material, duration)? * impulse_to_depth(body, &unit_dashpot()?, depth)?;
    let contact = Indentation {
        contact_radius: contact_radius(body, depth)?,
        indentation_depth: depth,
    };
    Ok((force, contact))
}

/// p(0) = 4 G/(2 (1 − ν) π) ∫₀^a h̃'/x dx, infinite for p ≤ 1.
fn peak_of_power(
    profile: &PowerProfile,
    material: &dyn Material,
    radius: f64,
) -> Result<Option<f64>> {
    let p = profile.exponent();
    if p <= 1.0 {
        return Ok(None);
    }
    let modulus = material.relaxation().equilibrium_modulus() / material.half_space_factor();
    let height = profile.line_height(radius);
    Ok(Some(
        4.0 / PI * modulus * (p / (p - 1.0)) * (height / radius),
    ))
}
