//! Extreme cases of the half space: stationary sliding, the march in time, and pressing.

use anyhow::Result;
use bem_halfspace::HistoryPoint;
use bem_halfspace::indent::indent_history_on_grid;
use bem_halfspace::slide::{SlideRow, slide_on_grid};
use bem_halfspace::steady::{RefinementOptions, steady_refined};
use bem_halfspace::{BemError, Footprint, GridOptions};
use casebook::Formula;
use friction_analytic::{
    ElasticContact, ElasticLimitFriction, FrictionError, half_space_power_friction,
    high_speed_friction, low_speed_friction,
};
use indenters::{
    Axisymmetric, Control, FlatCone, PowerProfile, RoundTippedCone, SlidingLoad, Surface,
};
use numerics::{Estimate, InvalidParameter};
use rheology::{Elastic, Material, Maxwell, Viscous};

use super::case::{Row, refused};
use super::line::{on_dashpot, under};
use crate::scene::{Scene, solid};

/// Accuracy of all stationary cases. The number of unknowns suffices for each of them, and bounds its time.
const OPTIONS: RefinementOptions = RefinementOptions {
    relative_error: 1e-2,
    aspect: 0.5,
    max_unknowns: 40_000,
};

/// Judges the stationary friction by `expected`, within the error requested, that of `expected`, and the relative difference
/// `part` between this problem and the one to which `expected` belongs.
fn judged(
    body: &dyn Surface,
    material: &dyn Material,
    load: &SlidingLoad,
    expected: Estimate,
    part: f64,
) -> Result<Row> {
    let got = steady_refined(body, &material, load, &OPTIONS)?;
    let tolerance = OPTIONS.relative_error + expected.error / expected.value + part;
    let pair = [got.friction_coefficient.value, expected.value];
    Ok(Row::relative("friction coefficient", pair, tolerance))
}

/// Compares a body with the tabulated s(p) for the power profile of `scene`, to which it is nearly equal: `part` bounds the
/// relative difference between the frictions of both.
fn beside_table(body: &dyn Surface, scene: &Scene, part: f64) -> Result<Row> {
    let expected = half_space_power_friction(&scene.body, &scene.material, &scene.load)?;
    judged(body, &scene.material, &scene.load, expected, part)
}

/// A power profile with an exponent p on a dashpot, compared with the tabulated s(p), whose errors are far below the tolerance.
///
/// Friction diverges at p = 1/2; for p = 100 and more the rise at the rim is narrower than the elements allowed.
pub(super) fn power_profile(exponent: f64) -> Result<Row> {
    let scene = on_dashpot(PowerProfile::new(0.4, exponent)?)?;
    if exponent < 0.55 {
        let got = scene.friction(&OPTIONS);
        return refused!(got => BemError::InvalidParameter(InvalidParameter { parameter: "apex exponent", .. }));
    }
    if exponent > 99.0 {
        let max_unknowns = 2000;
        let options = RefinementOptions {
            max_unknowns,
            ..OPTIONS
        };
        return refused!(scene.friction(&options) => BemError::GridTooLarge { .. });
    }
    beside_table(&scene.body, &scene, 0.0)
}

/// A profile on a dashpot under such a load that the depth by Eq. (12) of the paper is 1 m.
fn on_unit_dashpot(body: PowerProfile) -> Result<Scene> {
    let unit = Scene::unit(1.0)?;
    Ok(Scene { body, ..unit })
}

/// A cone with this slope: friction is proportional to it, however steep the cone.
pub(super) fn any_slope(slope: f64) -> Result<Row> {
    let scene = on_unit_dashpot(PowerProfile::cone(slope)?)?;
    beside_table(&scene.body, &scene, 0.0)
}

/// A cone whose tip is cut off at the radius `end` \[m], compared with a whole one; a part of the order of `end` is missing.
pub(super) fn flat_end(end: f64) -> Result<Row> {
    let cone = on_unit_dashpot(PowerProfile::cone(1.0)?)?;
    beside_table(&FlatCone::new(end, 1.0)?, &cone, 10.0 * end)
}

/// A cone with a tip rounded up to the radius `tip` \[m]: a cone if this is much smaller than the contact of 1 m, and a
/// paraboloid if it is much larger.
pub(super) fn round_tip(tip: f64) -> Result<Row> {
    let (profile, part) = if tip < 1.0 {
        (PowerProfile::cone(1.0)?, 10.0 * tip)
    } else {
        (PowerProfile::paraboloid(0.5 / tip)?, 0.0)
    };
    let body = RoundTippedCone::new(tip, 1.0)?;
    beside_table(&body, &on_unit_dashpot(profile)?, part)
}

/// A function for the exact friction in the limit of slow or of fast sliding.
type Limit = fn(
    &dyn Axisymmetric,
    &dyn Material,
    ElasticContact,
) -> Result<ElasticLimitFriction, FrictionError>;

/// Compares a paraboloid on the three-element solid of the stiffness ratio γ with an elastic limit, at a contact radius of 1 m
/// and a speed \[m/s], where τ = 1 s.
fn at_limit(gamma: f64, velocity: f64, limit: Limit) -> Result<Row> {
    let (profile, solid) = (PowerProfile::paraboloid(0.1)?, solid(gamma)?);
    let contact = ElasticContact {
        contact_radius: 1.0,
        velocity,
    };
    let limit = limit(&profile, &solid, contact)?;
    let load = SlidingLoad::new(limit.normal_force, velocity)?;
    // Allow a relative error of 1e-3 of the limit: the next order is the ratio of the speed to that at which the limit ends, some
    // 1e-4.
    let expected = Estimate::new(limit.half_space, 1e-3 * limit.half_space);
    judged(&profile, &solid, &load, expected, 0.0)
}

/// Slow sliding, v τ (1 + γ)/γ = 1e-4 a, where τ (1 + γ)/γ is the retardation time and a the contact radius.
pub(super) fn slow(gamma: f64) -> Result<Row> {
    let velocity = 1e-4 * gamma / (1.0 + gamma);
    at_limit(gamma, velocity, low_speed_friction)
}

/// Fast sliding, v τ = 1e4 a, with the relaxation time τ and the contact radius a.
pub(super) fn fast(gamma: f64) -> Result<Row> {
    at_limit(gamma, 1e4, high_speed_friction)
}

/// Friction of h = x² + (y/r)², r = `aspect`, on elements of the same aspect and of half the width must agree within both error
/// bars.
///
/// Under this force the contact is about as long as one, however wide.
pub(super) fn slender(aspect: f64) -> Result<Row> {
    let load = SlidingLoad::new(aspect.max(1.0), 1.0)?;
    let body = Formula::new([true; 2], |[x, y]| {
        let height = x * x + (y / aspect).powi(2);
        (height, [2.0 * x, 2.0 * y / aspect / aspect])
    });
    let material = Viscous::new(1.0)?;
    let solve = |aspect| {
        let options = RefinementOptions { aspect, ..OPTIONS };
        Ok::<_, BemError>(steady_refined(&body, &material, &load, &options)?.friction_coefficient)
    };
    let (got, other) = (solve(0.5 * aspect)?, solve(aspect)?);
    let tolerance = (got.error + other.error) / other.value;
    let pair = [got.value, other.value];
    Ok(Row::relative("friction coefficient", pair, tolerance))
}

/// A paraboloid pressed by a constant force in three steps of the length `step` \[s]. The depth and the area must be those of
/// one elastic step of the compliance J(t), t = 3 `step`, on the same elements (correspondence of Lee & Radok, 1960).
pub(super) fn pressed(material: &dyn Material, step: f64) -> Result<Row> {
    let body = PowerProfile::paraboloid(0.1)?;
    let times = [step, 2.0 * step, 3.0 * step];
    let options = GridOptions::new([0.1; 2], Footprint::square(2.0));
    // Choose a force under which the last contact has a radius of about one.
    let force = 1.0 / material.creep_compliance(times[2])?;
    let steps = HistoryPoint::held(Control::NormalForce(force), &times);
    let got = indent_history_on_grid(&body, &material, &steps, &options)?;
    let step = HistoryPoint::held(Control::NormalForce(1.0), &[1.0]);
    let expected = indent_history_on_grid(&body, &Elastic::new(1.0)?, &step, &options)?;
    // The tolerance allows for three solutions, each of which is found to the tolerance of the contact.
    let tolerance = 1e2 * options.contact.tolerance;
    let [got, expected] = [&got[2], &expected[0]];
    let depths = [got.indentation_depth, expected.indentation_depth];
    let areas = [got.contact_area, expected.contact_area];
    Ok(Row::worst([
        Row::relative("indentation depth", depths, tolerance),
        Row::relative("contact area", areas, tolerance),
    ]))
}

/// The last row of a march of a paraboloid under a force \[N] over 1.5 m on elements of 0.1 m, with one element in a time step
/// \[s].
fn marched(material: &dyn Material, time_step: f64, force: f64) -> Result<SlideRow> {
    let body = PowerProfile::paraboloid(0.1)?;
    let options = GridOptions::new([0.1; 2], Footprint::square(3.0));
    let load = SlidingLoad::new(force, 0.1 / time_step)?.after(1.5)?;
    let march = slide_on_grid(&body, &material, &load, &options)?;
    Ok(march.last().clone())
}

/// Compares a march with one on the simpler material to which the first tends with `ratio` = Δt/τ, τ = 1 s.
fn beside_limit(
    material: &dyn Material,
    limit: &dyn Material,
    ratio: f64,
    force: f64,
) -> Result<Row> {
    let got = marched(material, ratio, force)?;
    let limit = marched(limit, ratio, force)?;
    // Allow the fraction by which the limit is missed after some fifteen steps, and the error of contacts solved to 1e-9.
    let tolerance = 1e2 * ratio.min(1.0 / ratio) + 1e-6;
    let depths = [got.indentation_depth, limit.indentation_depth];
    let friction = [got.friction_coefficient, limit.friction_coefficient];
    Ok(Row::worst([
        Row::number("depth", depths, depths[1], tolerance),
        // Compare friction with 0.2 as the scale, because it is a fraction of the slope 2 c a, with c = 0.1 and the contact
        // radius a about one.
        Row::number("friction coefficient", friction, 0.2, tolerance),
    ]))
}

/// Maxwell's material: a spring in steps much shorter than τ, a dashpot in much longer ones.
pub(super) fn march_on_maxwell(ratio: f64) -> Result<Row> {
    let material = Maxwell::new(1.0, 1.0)?;
    if ratio < 1.0 {
        beside_limit(&material, &Elastic::new(1.0)?, ratio, 1.0)
    } else {
        beside_limit(&material, &Viscous::new(1.0)?, ratio, 1.0 / ratio)
    }
}

/// The three-element solid with γ = 0.1: the stiff spring in steps much shorter than τ, the soft one in much longer ones.
pub(super) fn march_on_solid(ratio: f64) -> Result<Row> {
    let modulus = if ratio < 1.0 { 1.1 } else { 0.1 };
    beside_limit(&solid(0.1)?, &Elastic::new(modulus)?, ratio, modulus)
}

/// A paraboloid under a force \[N] near an end of the range of f64. Under the smallest ones the depth underflows to 0, which
/// has to be refused.
pub(super) fn half_space_under(force: f64) -> Result<Row> {
    let scene = under(force)?;
    if force < 1e-320 {
        return refused!(scene.friction(&OPTIONS) => BemError::InvalidParameter(_));
    }
    beside_table(&scene.body, &scene, 0.0)
}
