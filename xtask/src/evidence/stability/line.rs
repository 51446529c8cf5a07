//! Extreme cases of the one-dimensional model, compared with closed forms: stationary sliding, the march in time, and pressing.

use std::f64::consts::FRAC_2_PI;

use anyhow::Result;
use casebook::prony;
use friction_analytic::{
    FrictionError, SlidingContact, StationarySliding, ViscoelasticSliding, axisymmetric_sliding,
    kelvin_voigt_sliding, maxwell_sliding, power_indentation_after_impulse, power_sliding,
};
use indenters::{Axisymmetric, Control, EquivalentLine, PowerProfile, PressingLoad, SlidingLoad};
use mdr_core::{MdrError, SteadySliding, indent, slide, steady};
use numerics::Accuracy;
use rheology::{KelvinVoigt, Material, Maxwell, Prony, Viscous};

use super::case::{Row, refused};
use super::cone_on_solid::cone_on_solid;
use crate::scene::Scene;

/// Relative error requested of the stationary solver (its default) and of pressing. Results must agree with closed forms as
/// closely.
const REQUESTED_ERROR: f64 = 1e-8;

/// A profile on a dashpot under such a load that the depth by Eq. (12) of the paper is 0.1 m.
pub(super) fn on_dashpot(body: PowerProfile) -> Result<Scene> {
    let (material, load) = (Viscous::new(50.0)?, SlidingLoad::new(2.0, 0.1)?);
    Ok(Scene {
        body,
        material,
        load,
    })
}

/// Sixteen branches of different moduli, over fifteen decades of time constants around 1 s.
pub(super) fn sixteen_branches() -> Prony {
    let modulus = |index: i32| 1.0 + 0.5 * f64::from(index).sin();
    let time = |index: i32| 10_f64.powf(15.0 * (f64::from(index) / 15.0 - 0.5));
    let branches: Vec<_> = (0..16).map(|index| (modulus(index), time(index))).collect();
    prony([0.1, 0.0], &branches)
}

/// A cone of slope 0.1, h = 0.1 r.
pub(super) fn cone() -> Result<PowerProfile> {
    Ok(PowerProfile::cone(0.1)?)
}

/// A paraboloid h = 0.1 r², with r and h in metres.
pub(super) fn paraboloid() -> Result<PowerProfile> {
    Ok(PowerProfile::paraboloid(0.1)?)
}

/// Stationary state of sliding in the one-dimensional model, to the relative error [`REQUESTED_ERROR`].
fn state(
    body: &dyn Axisymmetric,
    material: &dyn Material,
    load: &SlidingLoad,
) -> Result<SteadySliding, MdrError> {
    steady(&EquivalentLine(body), material, load, REQUESTED_ERROR)
}

/// Compares friction coefficient and depth \[m] with exact ones; the worse of both.
fn compared(got: &SteadySliding, friction: f64, depth: f64) -> Result<Row> {
    let frictions = [got.friction_coefficient.value, friction];
    let depths = [got.indentation_depth.value, depth];
    Ok(Row::worst([
        Row::relative("friction coefficient", frictions, REQUESTED_ERROR),
        Row::relative("depth", depths, REQUESTED_ERROR),
    ]))
}

/// Compares friction coefficient and depth \[m] with the closed form on a dashpot; the worse of both.
fn beside_theorem(got: &SteadySliding, theorem: &StationarySliding) -> Result<Row> {
    compared(got, theorem.friction_coefficient, theorem.indentation_depth)
}

/// Any body on a dashpot: the stationary solver against the quadrature of Eq. (16) of the paper. The two methods share only the
/// one-dimensional profile.
pub(super) fn both(body: &dyn Axisymmetric) -> Result<Row> {
    let Scene { material, load, .. } = Scene::unit(1.0)?;
    let expected = axisymmetric_sliding(body, &material, &load)?;
    beside_theorem(&state(body, &material, &load)?, &expected)
}

/// A power profile with an exponent p on a dashpot, compared with the closed form of Eq. (16), which shares nothing with the
/// solver.
///
/// The friction integral diverges up to p = 1/2, and close above it converges too slowly to be summed.
pub(super) fn power_profile(exponent: f64) -> Result<Row> {
    let scene = on_dashpot(PowerProfile::new(0.4, exponent)?)?;
    let got = state(&scene.body, &scene.material, &scene.load);
    if exponent < 0.55 {
        return refused!(got => MdrError::FrictionDiverges { .. });
    }
    beside_theorem(&got?, &scene.theory()?)
}

/// A contact whose front is 1 m ahead of the apex, at a speed \[m/s].
const fn contact(velocity: f64) -> SlidingContact {
    SlidingContact {
        front: 1.0,
        velocity,
    }
}

/// A profile on a spring and a dashpot in parallel, of the retardation time 1 s, at a speed \[m/s].
pub(super) fn kelvin_voigt(profile: &PowerProfile, velocity: f64) -> Result<Row> {
    let material = KelvinVoigt::new(1.0, 1.0)?;
    let expected = kelvin_voigt_sliding(profile, &material, contact(velocity))?;
    closed_form(profile, &material, velocity, &expected)
}

/// A profile on a spring and a dashpot in series, of the relaxation time 1 s, at a speed \[m/s].
pub(super) fn maxwell(profile: &PowerProfile, velocity: f64) -> Result<Row> {
    let material = Maxwell::new(1.0, 1.0)?;
    let expected = maxwell_sliding(profile, &material, contact(velocity))?;
    closed_form(profile, &material, velocity, &expected)
}

/// Compares the stationary solver under the force of a closed form with its friction and depth.
fn closed_form(
    profile: &PowerProfile,
    material: &dyn Material,
    velocity: f64,
    expected: &ViscoelasticSliding,
) -> Result<Row> {
    let load = SlidingLoad::new(expected.normal_force, velocity)?;
    let got = state(profile, material, &load)?;
    let [friction, depth] = [expected.friction_coefficient, expected.indentation_depth];
    compared(&got, friction, depth)
}

/// The cone whose one-dimensional profile has the slope 1, held at the depth 1 m: friction and force against [`cone_on_solid`].
pub(super) fn cone_at_depth(material: &dyn Material, velocity: f64) -> Result<Row> {
    let profile = PowerProfile::cone(FRAC_2_PI)?;
    let expected = cone_on_solid(&material.relaxation(), velocity)?;
    let got = state(&profile, material, &SlidingLoad::at_depth(1.0, velocity)?)?;
    let frictions = [
        got.friction_coefficient.value,
        expected.friction_coefficient,
    ];
    let forces = [got.normal_force.value, expected.normal_force];
    Ok(Row::worst([
        Row::relative("friction coefficient", frictions, REQUESTED_ERROR),
        Row::relative("normal force", forces, REQUESTED_ERROR),
    ]))
}

/// A cone under a constant force at a time \[s]: 8 ∫ x h̃' dx = F J(t), with the contact radius as the upper limit, is the same
/// equation as on a dashpot of 1 Pa s after the impulse F J(t), for which there is a closed form.
pub(super) fn pressed(material: &dyn Material, time: f64) -> Result<Row> {
    let profile = cone()?;
    let last = material.creep_compliance(time)?;
    // Choose a force under which the contact has a radius of about one.
    let force = 1.0 / last;
    let dashpot = Viscous::new(1.0)?;
    let expected = power_indentation_after_impulse(&profile, &dashpot, force * last)?;
    let load = PressingLoad::new(Control::NormalForce(force), time)?;
    let got = indent(&EquivalentLine(&profile), material, &load, REQUESTED_ERROR)?;
    let depths = [got.indentation_depth.value, expected.indentation_depth];
    Ok(Row::relative("indentation depth", depths, REQUESTED_ERROR))
}

/// Number of elements along the stationary contact of [`march`]. Chosen: the comparison is then to 1 %, at a small cost.
const MARCH_ELEMENTS: usize = 400;

/// A march of a cone on Maxwell's material into the stationary state, at a speed \[m/s]; compared with the closed form to 4/n
/// on n elements. Loads are linear on the parts of elements at both ends of the contact: the error is of second order in 1/n.
pub(super) fn march(velocity: f64) -> Result<Row> {
    let profile = cone()?;
    let material = Maxwell::new(1.0, 1.0)?;
    let expected = maxwell_sliding(&profile, &material, contact(velocity))?;
    let load = SlidingLoad::new(expected.normal_force, velocity)?;
    let line = EquivalentLine(&profile);
    let got = slide(&line, &material, &load, Accuracy::Elements(MARCH_ELEMENTS))?;
    let tolerance = 4.0 / MARCH_ELEMENTS as f64;
    let frictions = [
        got.friction_coefficient.value,
        expected.friction_coefficient,
    ];
    let depths = [got.indentation_depth.value, expected.indentation_depth];
    Ok(Row::worst([
        Row::relative("friction coefficient", frictions, tolerance),
        Row::relative("indentation depth", depths, tolerance),
    ]))
}

/// A paraboloid on a dashpot under a force \[N]; all other numbers are 1 in SI.
pub(super) fn under(force: f64) -> Result<Scene> {
    let (body, material) = (PowerProfile::paraboloid(1.0)?, Viscous::new(1.0)?);
    let load = SlidingLoad::new(force, 1.0)?;
    Ok(Scene {
        body,
        material,
        load,
    })
}

/// Compares depth \[m] and friction coefficient of [`under`] with Eqs. (12) and (22) of the paper, evaluated in an order in
/// which nothing overflows or underflows.
fn beside_paper([depth, friction]: [f64; 2], force: f64, tolerance: f64) -> Result<Row> {
    let expected = 0.25 * force;
    // Add one unit in the last place of the smallest numbers, because a depth below the normal numbers has fewer digits.
    let tolerance = tolerance + f64::from_bits(1) / expected;
    let frictions = [friction, 4.0 / 3.0 * 2.0_f64.sqrt() * expected.sqrt()];
    Ok(Row::worst([
        Row::relative("depth", [depth, expected], tolerance),
        Row::relative("friction coefficient", frictions, tolerance),
    ]))
}

/// The closed form under a force \[N] near an end of the range of f64; under the smallest one the depth underflows to 0, which
/// has to be refused.
pub(super) fn theorem_under(force: f64) -> Result<Row> {
    let scene = under(force)?;
    let got = power_sliding(&scene.body, &scene.material, &scene.load);
    if force < 1e-320 {
        return refused!(got => FrictionError::OutOfRange { .. });
    }
    let sliding = got?;
    beside_paper(
        [sliding.indentation_depth, sliding.friction_coefficient],
        force,
        1e-12,
    )
}

/// The stationary solver under a force \[N] near an end of the range of f64; below the normal numbers the depth has too few
/// digits, which has to be refused.
pub(super) fn line_under(force: f64) -> Result<Row> {
    let scene = under(force)?;
    let got = state(&scene.body, &scene.material, &scene.load);
    if force < 1e-300 {
        return refused!(got => MdrError::InvalidParameter(_) | MdrError::NonFinite { .. });
    }
    let state = got?;
    let [depth, friction] = [state.indentation_depth, state.friction_coefficient];
    beside_paper([depth.value, friction.value], force, REQUESTED_ERROR)
}
