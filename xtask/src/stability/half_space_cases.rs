//! The half space: stationary sliding, the march in time, and pressing.

use anyhow::Result;
use bem_halfspace::indent::indent;
use bem_halfspace::slide::{SlideOptions, SlideRow, slide};
use bem_halfspace::steady::{
    FrictionEstimate, FrictionOptions, Ladder, steady_friction, steady_friction_of_surface,
};
use bem_halfspace::{BemError, ContactOptions, Footprint, Resolution};
use friction_analytic::{
    ElasticContact, ElasticLimitFriction, half_space_power_friction, high_speed_friction,
    low_speed_friction,
};
use indenters::{PowerProfile, SlidingLoad, Surface};
use rheology::{Elastic, KelvinVoigt, Material, Maxwell, Viscous};

use crate::stability::case::{Case, Comparison, Family, Outcome, decades, refused};
use crate::stability::rheology_cases::{prony_over, solid};

/// Relative error asked of the stationary solver.
const ASKED: f64 = 1e-2;
/// Enough for all of these cases, and seconds at most.
const MAX_UNKNOWNS: usize = 20_000;

pub(super) fn families() -> Vec<Family> {
    let exponents = [0.55, 0.6, 0.75, 0.9, 1.0, 1.5, 2.0, 4.0, 8.0, 16.0];
    let mut powers = Family::over(
        ("half space, dashpot, stationary", "p"),
        exponents,
        power_profile,
    );
    powers.cases.insert(0, Case::new("0.5", too_sharp));
    for exponent in [100.0, 300.0, 1000.0] {
        powers.cases.push(Case::new(format!("{exponent}"), move || {
            nearly_flat(exponent)
        }));
    }
    let mut families = vec![powers];
    families.extend(solids());
    let mut families: Vec<Family> = families.into_iter().map(Family::slow).collect();
    families.extend(in_time());
    families
}

fn solids() -> [Family; 5] {
    let gammas = || decades(-12, 3, 3);
    [
        Family::over(("half space, three elements, slow", "γ"), gammas(), slow),
        Family::over(("half space, three elements, fast", "γ"), gammas(), fast),
        Family::over(
            ("half space, three elements, plateau", "γ"),
            decades(-12, -8, 1),
            plateau,
        ),
        Family::over(
            ("half space, 16 branches over 15 decades", "vτ/a"),
            decades(-12, 12, 2),
            branches,
        ),
        Family::over(
            ("half space, slender paraboloid", "width/length"),
            [0.2, 0.5, 1.0, 2.0, 5.0, 10.0],
            slender,
        ),
    ]
}

fn in_time() -> Vec<Family> {
    let ratios = || decades(-12, 12, 1);
    let limits = || decades(-12, -5, 1).chain(decades(5, 12, 1));
    vec![
        Family::over(
            ("half space, pressed, Kelvin–Voigt", "Δt/λ"),
            ratios(),
            |ratio| pressed(&KelvinVoigt::new(1.0, 1.0)?, ratio),
        ),
        Family::over(
            ("half space, pressed, Maxwell", "Δt/τ"),
            ratios(),
            |ratio| pressed(&Maxwell::new(1.0, 1.0)?, ratio),
        ),
        Family::over(
            ("half space, pressed, 16 branches", "Δt"),
            ratios(),
            |ratio| pressed(&prony_over(15.0)?, ratio),
        ),
        Family::over(
            ("half space, march on Maxwell", "Δt/τ"),
            limits(),
            march_on_maxwell,
        ),
        Family::over(
            ("half space, march on three elements", "Δt/τ"),
            limits(),
            march_on_solid,
        ),
    ]
}

fn options(aspect: f64) -> FrictionOptions {
    FrictionOptions {
        relative_error: ASKED,
        aspect,
        max_unknowns: MAX_UNKNOWNS,
    }
}

/// An estimate beside the right value, within the error asked for and that of the value itself.
fn judged(estimate: &FrictionEstimate, [expected, error]: [f64; 2]) -> Outcome {
    let tolerance = ASKED + error / expected;
    let pairs = [(
        "friction coefficient",
        [estimate.friction_coefficient, expected],
    )];
    Outcome::relative(&pairs, tolerance)
}

/// The table of s(p), whose errors are far below what is asked here.
fn power_profile(exponent: f64) -> Result<Outcome> {
    let profile = PowerProfile::new(0.4, exponent)?;
    let (material, load) = (Viscous::new(50.0)?, SlidingLoad::new(2.0, 0.1)?);
    let expected = half_space_power_friction(&profile, &material, &load)?;
    let got = steady_friction(&profile, &material, &load, &options(0.5))?;
    Ok(judged(&got, [expected.value, expected.error]))
}

fn too_sharp() -> Result<Outcome> {
    let profile = PowerProfile::new(0.4, 0.5)?;
    let (material, load) = (Viscous::new(50.0)?, SlidingLoad::new(2.0, 0.1)?);
    let got = steady_friction(&profile, &material, &load, &options(0.5));
    Ok(refused!(
        got,
        BemError::InvalidParameter {
            parameter: "apex exponent",
            ..
        }
    ))
}

/// At its rim the body rises within a hundredth of its radius and less; the elements allowed are larger.
fn nearly_flat(exponent: f64) -> Result<Outcome> {
    let profile = PowerProfile::new(0.4, exponent)?;
    let (material, load) = (Viscous::new(50.0)?, SlidingLoad::new(2.0, 0.1)?);
    let options = FrictionOptions {
        max_unknowns: 2000,
        ..options(0.5)
    };
    let got = steady_friction(&profile, &material, &load, &options);
    Ok(refused!(got, BemError::GridTooLarge { .. }))
}

/// Two estimates on different elements agree within their error bars.
fn agreeing(got: &FrictionEstimate, other: &FrictionEstimate) -> Outcome {
    Outcome::Values(vec![Comparison {
        quantity: "friction coefficient",
        expected: other.friction_coefficient,
        got: got.friction_coefficient,
        scale: other.friction_coefficient,
        tolerance: (got.error + other.error) / other.friction_coefficient,
    }])
}

fn at_limit(
    material: &dyn Material,
    (velocity, limit): (f64, ElasticLimitFriction),
) -> Result<Outcome> {
    let load = SlidingLoad::new(limit.normal_force, velocity)?;
    let profile = PowerProfile::paraboloid(0.1)?;
    let got = steady_friction(&profile, material, &load, &options(0.5))?;
    // The next order is the speed over that at which the limit ends, some 1e-4.
    Ok(judged(&got, [limit.half_space, 1e-3 * limit.half_space]))
}

/// Slow sliding, v τ (1 + γ)/γ = 1e-4 a: friction by the exact elastic limit.
fn slow(gamma: f64) -> Result<Outcome> {
    let (body, solid) = (PowerProfile::paraboloid(0.1)?, solid(gamma)?);
    let velocity = 1e-4 * gamma / (1.0 + gamma);
    let contact = ElasticContact {
        contact_radius: 1.0,
        velocity,
    };
    at_limit(
        &solid,
        (velocity, low_speed_friction(&body, &solid, contact)?),
    )
}

/// Fast sliding, v τ = 1e4 a.
fn fast(gamma: f64) -> Result<Outcome> {
    let (body, solid) = (PowerProfile::paraboloid(0.1)?, solid(gamma)?);
    let contact = ElasticContact {
        contact_radius: 1.0,
        velocity: 1e4,
    };
    at_limit(&solid, (1e4, high_speed_friction(&body, &solid, contact)?))
}

/// Between the limits a solid with a soft spring is a dashpot, at v τ = 1e-5 a within γ/1e-5 and 1e-5.
fn plateau(gamma: f64) -> Result<Outcome> {
    let (body, solid) = (PowerProfile::cone(0.1)?, solid(gamma)?);
    let velocity = 1e-5;
    // F = 4 η v a h̃(a)/a for a = 1.
    let load = SlidingLoad::new(0.4 * std::f64::consts::FRAC_PI_2 * velocity, velocity)?;
    let expected = half_space_power_friction(&body, &Viscous::new(1.0)?, &load)?;
    let got = steady_friction(&body, &solid, &load, &options(0.5))?;
    let error = expected.error + 1e-2 * expected.value;
    Ok(judged(&got, [expected.value, error]))
}

/// Every speed meets some of the branches; the same by elements of another shape.
fn branches(velocity: f64) -> Result<Outcome> {
    let body = PowerProfile::paraboloid(0.1)?;
    let material = prony_over(15.0)?;
    let load = SlidingLoad::new(1.0, velocity)?;
    let solve = |aspect| steady_friction(&body, &material, &load, &options(aspect));
    Ok(agreeing(&solve(0.5)?, &solve(1.0)?))
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
}

/// Under this force the contact is about as long as one, however wide; the same by elements of another shape.
fn slender(aspect: f64) -> Result<Outcome> {
    let surface = SlenderParaboloid { aspect };
    let material = Viscous::new(1.0)?;
    let load = SlidingLoad::new(aspect.max(1.0), 1.0)?;
    let ladder = Ladder {
        footprint: Footprint {
            x: [-4.0, 4.0],
            y: [-4.0 * aspect, 4.0 * aspect],
        },
        coarsest_spacing: 0.2,
        apex_exponent: 2.0,
    };
    let solve = |shape: f64| {
        let options = options(shape * aspect);
        steady_friction_of_surface(&surface, (&material, &load), &ladder, &options)
    };
    Ok(agreeing(&solve(0.5)?, &solve(1.0)?))
}

/// Under a constant force any number of steps of any length ends where one elastic step of compliance J(t) does, on the
/// same elements.
fn pressed(material: &dyn Material, step: f64) -> Result<Outcome> {
    let body = PowerProfile::paraboloid(0.1)?;
    let times = [step, 2.0 * step, 3.0 * step];
    let last = material.creep_compliance(times[2])?;
    let resolution = Resolution {
        spacing: [0.1; 2],
        footprint: Footprint::square(2.0),
        contact: ContactOptions::default(),
    };
    // A force under which the last contact has a radius of about one.
    let force = 1.0 / last;
    let rows = indent(&body, material, (force, &times), &resolution)?;
    let elastic = Elastic::new(1.0)?;
    let expected = indent(&body, &elastic, (1.0, &[1.0]), &resolution)?;
    let [got, expected] = [&rows, &expected].map(|rows| {
        let last = rows.last();
        last.map_or([f64::NAN; 2], |row| {
            [row.indentation_depth, row.contact_area]
        })
    });
    let pairs = [
        ("depth", [got[0], expected[0]]),
        ("contact area", [got[1], expected[1]]),
    ];
    // Three solutions, each to the contact tolerance.
    Ok(Outcome::relative(
        &pairs,
        1e2 * resolution.contact.tolerance,
    ))
}

/// The last row of a short way over elements of 0.1 m, at a speed of one element in the given time.
fn marched(material: &dyn Material, time_step: f64, force: f64) -> Result<SlideRow> {
    let body = PowerProfile::paraboloid(0.1)?;
    let options = SlideOptions {
        spacing: [0.1; 2],
        footprint: Footprint::square(3.0),
        sliding_distance: 1.5,
        contact: ContactOptions::default(),
    };
    let load = SlidingLoad::new(force, 0.1 / time_step)?;
    Ok(slide(&body, material, &load, &options)?.last().clone())
}

/// Depth and friction beside those of the simpler material that is left in the limit.
fn beside(got: &SlideRow, limit: &SlideRow, allowed: f64) -> Outcome {
    // Friction is a part of the slope 2 c a, with c = 0.1 and a about one.
    let slope = 0.2;
    let part = |quantity, got, expected, scale| Comparison {
        quantity,
        expected,
        got,
        scale,
        tolerance: allowed,
    };
    let friction = (got.friction_coefficient, limit.friction_coefficient);
    let depth = (got.indentation_depth, limit.indentation_depth);
    Outcome::Values(vec![
        part("depth", depth.0, depth.1, depth.1),
        part("friction coefficient", friction.0, friction.1, slope),
    ])
}

/// Part by which a limit of the ratio Δt/τ is missed after some fifteen steps, and contacts solved to 1e-9.
fn missed(ratio: f64) -> f64 {
    1e2 * ratio.min(1.0 / ratio) + 1e-6
}

/// A spring in the short run, a dashpot in the long one.
fn march_on_maxwell(ratio: f64) -> Result<Outcome> {
    let material = Maxwell::new(1.0, 1.0)?;
    let (got, limit) = if ratio < 1.0 {
        let elastic = Elastic::new(1.0)?;
        (
            marched(&material, ratio, 1.0)?,
            marched(&elastic, ratio, 1.0)?,
        )
    } else {
        let force = 1.0 / ratio;
        let viscous = Viscous::new(1.0)?;
        (
            marched(&material, ratio, force)?,
            marched(&viscous, ratio, force)?,
        )
    };
    Ok(beside(&got, &limit, missed(ratio)))
}

/// The stiff spring in the short run, the soft one in the long one.
fn march_on_solid(ratio: f64) -> Result<Outcome> {
    let material = solid(0.1)?;
    let modulus = if ratio < 1.0 { 1.1 } else { 0.1 };
    let elastic = Elastic::new(modulus)?;
    let got = marched(&material, ratio, modulus)?;
    let limit = marched(&elastic, ratio, modulus)?;
    Ok(beside(&got, &limit, missed(ratio)))
}
