//! Answers in closed form, or by quadrature.

use super::error::{Context as _, Result};
use friction_analytic::{
    SlidingContact, StationarySliding, ViscoelasticSliding, axisymmetric_sliding,
    half_space_power_friction, kelvin_voigt_sliding, maxwell_sliding, power_sliding,
    superposition_sliding, transient_sliding,
};
use indenters::{Axisymmetric, PowerProfile, SlidingLoad, bracketed_root};
use rheology::Viscous;

use super::answer::{Answer, ContactBox};
use super::body::Revolution;
use super::half_space::Simple;
use crate::scene::{Control, Method, Model};

/// Points of the load along the contact.
const N_POINTS: usize = 200;
/// Relative error that is stated for closed forms of which only the front had to be searched; far above their rounding.
const SEARCHED: f64 = 1e-12;

/// The stationary state on a viscous line.
pub(crate) fn viscous_line(
    body: &Revolution,
    material: &Viscous,
    (control, velocity): (Control, f64),
) -> Result<Answer> {
    let load = line_load(material, control, velocity)?;
    let state = match body {
        Revolution::Power(profile) => power_sliding(profile, material, &load),
        Revolution::Sum(profile) => superposition_sliding(profile, material, &load),
        Revolution::Other(_) => axisymmetric_sliding(body, material, &load),
    }?;
    let answer = Answer::new(Method::Analytic, Model::Line, load.require_normal_force()?)
        .with_friction(state.friction_coefficient, state.error);
    let mut answer = Answer {
        indentation_depth: Some(state.indentation_depth),
        contact_box: ends(&state.contact_line).map(ContactBox::along),
        ..answer
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
pub(crate) fn viscous_half_space(
    profile: &PowerProfile,
    material: &Viscous,
    load: &SlidingLoad,
) -> Result<Answer> {
    let friction = half_space_power_friction(profile, material, load)?;
    Ok(Answer {
        ..Answer::new(
            Method::Analytic,
            Model::HalfSpace,
            load.require_normal_force()?,
        )
        .with_friction(friction.value, friction.error)
    })
}

/// Cone and paraboloid on a viscous line, a distance after first touch.
pub(crate) fn viscous_transient(
    profile: &PowerProfile,
    material: &Viscous,
    load: &SlidingLoad,
    distance: f64,
) -> Result<Answer> {
    let state = transient_sliding(profile, material, load, distance / load.velocity())?;
    let friction = state.friction_coefficient;
    Ok(Answer {
        indentation_depth: Some(state.indentation_depth),
        contact_box: Some(ContactBox::along(state.contact_line)),
        ..Answer::new(Method::Analytic, Model::Line, load.require_normal_force()?)
            .with_friction(friction, SEARCHED * friction)
    })
}

/// Cone and paraboloid on a Kelvin–Voigt or Maxwell line.
pub(crate) fn viscoelastic_line(
    profile: &PowerProfile,
    material: &Simple,
    (control, velocity): (Control, f64),
) -> Result<Answer> {
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
    let force = match control {
        Control::NormalForce(force) => force,
        Control::IndentationDepth(_) => state.normal_force,
    };
    let friction = state.friction_coefficient;
    Ok(Answer {
        indentation_depth: Some(state.indentation_depth),
        contact_box: Some(ContactBox::along(state.contact)),
        ..Answer::new(Method::Analytic, Model::Line, force)
            .with_friction(friction, SEARCHED * friction)
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
