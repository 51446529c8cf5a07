//! The half space: stationary sliding, the march in time, and pressing.

use std::f64::consts::FRAC_PI_2;

use anyhow::Result;
use bem_halfspace::indent::{IndentStep, indent_history_on_grid};
use bem_halfspace::slide::{SlideRow, slide_on_grid};
use bem_halfspace::steady::{RefinementOptions, SteadyEstimate, steady_refined};
use bem_halfspace::{BemError, Footprint, GridOptions};
use friction_analytic::{
    ElasticContact, ElasticLimitFriction, half_space_power_friction, high_speed_friction,
    low_speed_friction,
};
use indenters::{Control, PowerProfile, SlidingLoad, Surface};
use rheology::{Elastic, KelvinVoigt, Material, Maxwell, Viscous};

use super::case::{Case, Comparison, Family, Finding, compare, decades, families, refused};
use super::rheology::{prony_over, solid};

/// Relative error asked of the stationary solver.
const ASKED: f64 = 1e-2;
/// Enough for all of these cases, and seconds at most.
const MAX_UNKNOWNS: usize = 20_000;
const EXPONENTS: [f64; 10] = [0.55, 0.6, 0.75, 0.9, 1.0, 1.5, 2.0, 4.0, 8.0, 16.0];

pub(super) fn families() -> Vec<Family> {
    let gammas = || decades(-12, 3, 3);
    let mut stationary = families! {
        "half space, dashpot, stationary", "p", EXPONENTS => power_profile;
        "half space, three elements, slow", "γ", gammas() => slow;
        "half space, three elements, fast", "γ", gammas() => fast;
        "half space, three elements, plateau", "γ", decades(-12, -8, 1) => plateau;
        "half space, 16 branches over 15 decades", "vτ/a", decades(-12, 12, 2) => branches;
        "half space, slender paraboloid", "width/length", [0.2, 0.5, 1.0, 2.0, 5.0, 10.0] => slender;
    };
    let powers = &mut stationary[0].cases;
    powers.insert(0, Case::new("0.5", too_sharp));
    powers.extend(
        [100.0, 300.0, 1000.0]
            .map(|exponent: f64| Case::new(exponent.to_string(), move || nearly_flat(exponent))),
    );
    let ratios = || decades(-12, 12, 1);
    let limits = || decades(-12, -5, 1).chain(decades(5, 12, 1));
    let in_time = families! {
        "half space, pressed, Kelvin–Voigt", "Δt/λ", ratios() => |ratio| pressed(&KelvinVoigt::new(1.0, 1.0)?, ratio);
        "half space, pressed, Maxwell", "Δt/τ", ratios() => |ratio| pressed(&Maxwell::new(1.0, 1.0)?, ratio);
        "half space, pressed, 16 branches", "Δt", ratios() => |ratio| pressed(&prony_over(15.0)?, ratio);
        "half space, march on Maxwell", "Δt/τ", limits() => march_on_maxwell;
        "half space, march on three elements", "Δt/τ", limits() => march_on_solid;
    };
    let stationary = stationary.into_iter().map(Family::slow);
    stationary.chain(in_time).collect()
}

fn options(aspect: f64) -> RefinementOptions {
    RefinementOptions {
        relative_error: ASKED,
        aspect,
        max_unknowns: MAX_UNKNOWNS,
    }
}

/// Friction under a load, within the error asked for and that of the right value.
fn judged(
    profile: &PowerProfile,
    material: &dyn Material,
    load: &SlidingLoad,
    [expected, error]: [f64; 2],
) -> Result<Finding> {
    let got = steady_refined(profile, material, load, &options(0.5))?;
    let tolerance = ASKED + error / expected;
    compare!(within tolerance; "friction coefficient" => got.friction_coefficient.value, expected)
}

fn on_dashpot() -> Result<(Viscous, SlidingLoad)> {
    Ok((Viscous::new(50.0)?, SlidingLoad::new(2.0, 0.1)?))
}

/// The table of s(p), whose errors are far below what is asked here.
fn power_profile(exponent: f64) -> Result<Finding> {
    let profile = PowerProfile::new(0.4, exponent)?;
    let (material, load) = on_dashpot()?;
    let expected = half_space_power_friction(&profile, &material, &load)?;
    judged(&profile, &material, &load, [expected.value, expected.error])
}

fn too_sharp() -> Result<Finding> {
    let profile = PowerProfile::new(0.4, 0.5)?;
    let (material, load) = on_dashpot()?;
    let got = steady_refined(&profile, &material, &load, &options(0.5));
    refused!(got => BemError::InvalidParameter { parameter: "apex exponent", .. })
}

/// At its rim the body rises within a hundredth of its radius and less; the elements allowed are larger.
fn nearly_flat(exponent: f64) -> Result<Finding> {
    let profile = PowerProfile::new(0.4, exponent)?;
    let (material, load) = on_dashpot()?;
    let options = RefinementOptions {
        max_unknowns: 2000,
        ..options(0.5)
    };
    let got = steady_refined(&profile, &material, &load, &options);
    refused!(got => BemError::GridTooLarge { .. })
}

fn at_limit(
    material: &dyn Material,
    velocity: f64,
    limit: ElasticLimitFriction,
) -> Result<Finding> {
    let load = SlidingLoad::new(limit.normal_force, velocity)?;
    let profile = PowerProfile::paraboloid(0.1)?;
    // The next order is the speed over that at which the limit ends, some 1e-4.
    judged(
        &profile,
        material,
        &load,
        [limit.half_space, 1e-3 * limit.half_space],
    )
}

const fn contact(velocity: f64) -> ElasticContact {
    ElasticContact {
        contact_radius: 1.0,
        velocity,
    }
}

/// Slow sliding, v τ (1 + γ)/γ = 1e-4 a: friction by the exact elastic limit.
fn slow(gamma: f64) -> Result<Finding> {
    let (body, solid) = (PowerProfile::paraboloid(0.1)?, solid(gamma)?);
    let velocity = 1e-4 * gamma / (1.0 + gamma);
    at_limit(
        &solid,
        velocity,
        low_speed_friction(&body, &solid, contact(velocity))?,
    )
}

/// Fast sliding, v τ = 1e4 a.
fn fast(gamma: f64) -> Result<Finding> {
    let (body, solid) = (PowerProfile::paraboloid(0.1)?, solid(gamma)?);
    at_limit(
        &solid,
        1e4,
        high_speed_friction(&body, &solid, contact(1e4))?,
    )
}

/// Between the limits a solid with a soft spring is a dashpot, at v τ = 1e-5 a within γ/1e-5 and 1e-5.
fn plateau(gamma: f64) -> Result<Finding> {
    let (body, solid) = (PowerProfile::cone(0.1)?, solid(gamma)?);
    let velocity = 1e-5;
    // F = 4 η v a h̃(a)/a for a = 1.
    let load = SlidingLoad::new(0.4 * FRAC_PI_2 * velocity, velocity)?;
    let expected = half_space_power_friction(&body, &Viscous::new(1.0)?, &load)?;
    let error = expected.error + 1e-2 * expected.value;
    judged(&body, &solid, &load, [expected.value, error])
}

/// Two estimates on different elements agree within their error bars.
fn agreeing(got: &SteadyEstimate, other: &SteadyEstimate) -> Result<Finding> {
    let [got, other] = [got, other].map(|estimate| estimate.friction_coefficient);
    let tolerance = (got.error + other.error) / other.value;
    compare!(within tolerance; "friction coefficient" => got.value, other.value)
}

/// Every speed meets some of the branches; the same by elements of another shape.
fn branches(velocity: f64) -> Result<Finding> {
    let body = PowerProfile::paraboloid(0.1)?;
    let material = prony_over(15.0)?;
    let load = SlidingLoad::new(1.0, velocity)?;
    let solve = |aspect| steady_refined(&body, &material, &load, &options(aspect));
    agreeing(&solve(0.5)?, &solve(1.0)?)
}

/// h = x² + (y/r)² on the elements of a grid that is as slender as the body.
struct SlenderParaboloid {
    aspect: f64,
}

impl Surface for SlenderParaboloid {
    fn height(&self, [x, y]: [f64; 2]) -> f64 {
        x * x + (y / self.aspect).powi(2)
    }

    fn gradient(&self, [x, y]: [f64; 2]) -> [f64; 2] {
        [2.0 * x, 2.0 * y / self.aspect / self.aspect]
    }

    fn mirrors(&self) -> [bool; 2] {
        [true; 2]
    }

    fn apex_exponent(&self) -> f64 {
        2.0
    }
}

/// Under this force the contact is about as long as one, however wide; the same by elements of another shape.
fn slender(aspect: f64) -> Result<Finding> {
    let surface = SlenderParaboloid { aspect };
    let material = Viscous::new(1.0)?;
    let load = SlidingLoad::new(aspect.max(1.0), 1.0)?;
    let solve = |shape: f64| steady_refined(&surface, &material, &load, &options(shape * aspect));
    agreeing(&solve(0.5)?, &solve(1.0)?)
}

/// Under a constant force any number of steps of any length ends where one elastic step of compliance J(t) does, on the
/// same elements.
fn pressed(material: &dyn Material, step: f64) -> Result<Finding> {
    let body = PowerProfile::paraboloid(0.1)?;
    let times = [step, 2.0 * step, 3.0 * step];
    let options = GridOptions::new([0.1; 2], Footprint::square(2.0));
    // A force under which the last contact has a radius of about one.
    let force = 1.0 / material.creep_compliance(times[2])?;
    let steps = IndentStep::constant(Control::NormalForce(force), &times);
    let got = indent_history_on_grid(&body, material, &steps, &options)?;
    let step = IndentStep::constant(Control::NormalForce(1.0), &[1.0]);
    let expected = indent_history_on_grid(&body, &Elastic::new(1.0)?, &step, &options)?;
    // Three solutions, each to the contact tolerance.
    let tolerance = 1e2 * options.contact.tolerance;
    compare!(got[2], expected[0], within tolerance; indentation_depth, contact_area)
}

/// The last row of a short march over elements of 0.1 m, at a speed of one element in the given time.
fn marched(material: &dyn Material, time_step: f64, force: f64) -> Result<SlideRow> {
    let body = PowerProfile::paraboloid(0.1)?;
    let options = GridOptions::new([0.1; 2], Footprint::square(3.0));
    let load = SlidingLoad::new(force, 0.1 / time_step)?.after(1.5)?;
    Ok(slide_on_grid(&body, material, &load, &options)?
        .last()
        .clone())
}

/// A march beside one on the simpler material that is left in the limit of the ratio Δt/τ.
fn beside_limit(
    material: &dyn Material,
    limit: &dyn Material,
    ratio: f64,
    force: f64,
) -> Result<Finding> {
    let got = marched(material, ratio, force)?;
    let limit = marched(limit, ratio, force)?;
    // Part by which a limit is missed after some fifteen steps, and contacts solved to 1e-9.
    let tolerance = 1e2 * ratio.min(1.0 / ratio) + 1e-6;
    // Friction is a part of the slope 2 c a, with c = 0.1 and a about one.
    let [depths, frictions] = [
        [got.indentation_depth, limit.indentation_depth],
        [got.friction_coefficient, limit.friction_coefficient],
    ];
    Ok(Finding::Values(vec![
        Comparison::relative("depth", depths[0], depths[1], tolerance),
        Comparison::relative(
            "friction coefficient",
            frictions[0],
            frictions[1],
            tolerance,
        )
        .in_units_of(0.2),
    ]))
}

/// A spring in the short run, a dashpot in the long one.
fn march_on_maxwell(ratio: f64) -> Result<Finding> {
    let material = Maxwell::new(1.0, 1.0)?;
    if ratio < 1.0 {
        beside_limit(&material, &Elastic::new(1.0)?, ratio, 1.0)
    } else {
        beside_limit(&material, &Viscous::new(1.0)?, ratio, 1.0 / ratio)
    }
}

/// The stiff spring in the short run, the soft one in the long one.
fn march_on_solid(ratio: f64) -> Result<Finding> {
    let modulus = if ratio < 1.0 { 1.1 } else { 0.1 };
    beside_limit(&solid(0.1)?, &Elastic::new(modulus)?, ratio, modulus)
}
