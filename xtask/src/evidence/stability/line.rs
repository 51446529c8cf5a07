//! The one-dimensional model: stationary sliding, the march in time, and pressing.

use std::f64::consts::FRAC_2_PI;

use anyhow::Result;
use friction_analytic::{
    SlidingContact, ViscoelasticSliding, kelvin_voigt_sliding, maxwell_sliding,
    power_indentation_after_impulse, power_sliding,
};
use indenters::{Control, EquivalentLine, PowerProfile, PressingLoad, SlidingLoad};
use mdr_core::{
    IndentOptions, MdrError, SlideOptions, SteadySliding, indent_on_grid, slide_on_grid, steady,
};
use rheology::{KelvinVoigt, Material, Maxwell, Viscous};

use super::case::{Case, Family, Finding, compare, decades, families, refused};
use super::cone_on_solid::cone_on_solid;
use super::rheology::{prony_over, solid};

/// What the stationary solver is asked for by default.
const ASKED: f64 = 1e-8;
const EXPONENTS: [f64; 14] = [
    0.55, 0.6, 0.75, 0.9, 1.0, 1.5, 2.0, 3.0, 5.0, 10.0, 30.0, 100.0, 300.0, 1000.0,
];
const ELEMENTS: [f64; 8] = [1.0, 2.0, 3.0, 4.0, 7.0, 30.0, 100.0, 1000.0];

pub(super) fn families() -> Vec<Family> {
    // Distance that a branch or a retardation takes, over the front of the contact.
    let ratios = || decades(-12, 12, 1);
    let gammas = || decades(-12, 3, 1);
    let cone = || PowerProfile::cone(0.1);
    let paraboloid = || PowerProfile::paraboloid(0.1);
    let mut families = families! {
        "line, dashpot, stationary", "p", EXPONENTS => power_profile;
        "line, cone on Kelvin–Voigt", "vλ/x_r", ratios() => move |ratio| kelvin_voigt(&cone()?, ratio);
        "line, paraboloid on Kelvin–Voigt", "vλ/x_r", ratios() => move |ratio| kelvin_voigt(&paraboloid()?, ratio);
        "line, cone on Maxwell", "vτ/x_r", ratios() => move |ratio| maxwell(&cone()?, ratio);
        "line, paraboloid on Maxwell", "vτ/x_r", ratios() => move |ratio| maxwell(&paraboloid()?, ratio);
        "line, cone on 16 branches over 15 decades", "v/x_r", ratios() => |speed| cone_at_depth(&prony_over(15.0)?, speed);
        "line, cone on three elements, vτ = x_r", "γ", gammas() => |gamma| cone_at_depth(&solid(gamma)?, 1.0);
        "line, cone on three elements, slow", "γ", gammas() => |gamma| cone_at_depth(&solid(gamma)?, 1e-3 * gamma);
        "line, pressed, Kelvin–Voigt", "Δt/λ", ratios() => |ratio| pressed(&KelvinVoigt::new(1.0, 1.0)?, ratio);
        "line, pressed, Maxwell", "Δt/τ", ratios() => |ratio| pressed(&Maxwell::new(1.0, 1.0)?, ratio);
        "line, pressed, 16 branches", "Δt", ratios() => |ratio| pressed(&prony_over(15.0)?, ratio);
        "line, march, cone on Maxwell", "vτ/x_r", ratios().step_by(2) => march;
        "line, march, cone on dashpot", "elements", ELEMENTS => coarse_march;
    };
    for exponent in [0.51, 0.501, 0.5, 0.1] {
        let refused = Case::new(format!("{exponent}"), move || too_sharp(exponent));
        families[0].cases.insert(0, refused);
    }
    families
}

/// The closed form (16) of the theorem, which shares nothing with the solver.
fn power_profile(exponent: f64) -> Result<Finding> {
    let profile = PowerProfile::new(0.4, exponent)?;
    let (material, load) = (Viscous::new(50.0)?, SlidingLoad::new(2.0, 0.1)?);
    let expected = power_sliding(&profile, &material, &load)?;
    let got = steady(&EquivalentLine(&profile), &material, &load, ASKED)?;
    compared(
        &got,
        expected.friction_coefficient,
        expected.indentation_depth,
    )
}

fn compared(got: &SteadySliding, friction: f64, depth: f64) -> Result<Finding> {
    compare!(within ASKED;
        "friction coefficient" => got.friction_coefficient.value, friction;
        "depth" => got.indentation_depth.value, depth)
}

/// The friction integral diverges up to p = 1/2, and close above it converges too slowly to be summed.
fn too_sharp(exponent: f64) -> Result<Finding> {
    let profile = PowerProfile::new(0.4, exponent)?;
    let (material, load) = (Viscous::new(50.0)?, SlidingLoad::new(2.0, 0.1)?);
    let state = steady(&EquivalentLine(&profile), &material, &load, ASKED);
    refused!(state => MdrError::FrictionDiverges { .. })
}

/// The front is 1 m ahead.
const fn contact(velocity: f64) -> SlidingContact {
    SlidingContact {
        front: 1.0,
        velocity,
    }
}

/// Spring and dashpot in parallel with the retardation time 1 s.
fn kelvin_voigt(profile: &PowerProfile, velocity: f64) -> Result<Finding> {
    let material = KelvinVoigt::new(1.0, 1.0)?;
    let expected = kelvin_voigt_sliding(profile, &material, contact(velocity))?;
    closed_form(profile, &material, velocity, &expected)
}

fn maxwell(profile: &PowerProfile, velocity: f64) -> Result<Finding> {
    let material = Maxwell::new(1.0, 1.0)?;
    let expected = maxwell_sliding(profile, &material, contact(velocity))?;
    closed_form(profile, &material, velocity, &expected)
}

fn closed_form(
    profile: &PowerProfile,
    material: &dyn Material,
    velocity: f64,
    expected: &ViscoelasticSliding,
) -> Result<Finding> {
    let load = SlidingLoad::new(expected.normal_force, velocity)?;
    let got = steady(&EquivalentLine(profile), material, &load, ASKED)?;
    compared(
        &got,
        expected.friction_coefficient,
        expected.indentation_depth,
    )
}

/// The cone whose line has the slope 1, held at the depth 1 m.
fn cone_at_depth(material: &dyn Material, velocity: f64) -> Result<Finding> {
    let profile = PowerProfile::cone(FRAC_2_PI)?;
    let expected = cone_on_solid(&material.relaxation(), velocity)?;
    let load = SlidingLoad::at_depth(1.0, velocity)?;
    let got = steady(&EquivalentLine(&profile), material, &load, ASKED)?;
    compare!(within ASKED;
        "friction coefficient" => got.friction_coefficient.value, expected.friction_coefficient;
        "normal force" => got.normal_force.value, expected.normal_force)
}

/// Elements under the contact at the end of pressing.
const PRESSED: f64 = 2000.0;

/// Under a constant force 8 ∫ x h̃' dx = F J(t) in steps of any length; the same as on a dashpot of 1 Pa s after the
/// impulse F J(t).
fn pressed(material: &dyn Material, step: f64) -> Result<Finding> {
    let profile = PowerProfile::cone(0.1)?;
    let duration = 3.0 * step;
    let last = material.creep_compliance(duration)?;
    // A force under which the last contact has the radius of about one.
    let force = 1.0 / last;
    let dashpot = Viscous::new(1.0)?;
    let expected = power_indentation_after_impulse(&profile, &dashpot, force * last)?;
    let options = IndentOptions {
        spacing: 2.0 * expected.contact_radius / PRESSED,
        n_steps: 3,
    };
    let load = PressingLoad::new(Control::NormalForce(force), duration)?;
    let rows = indent_on_grid(&EquivalentLine(&profile), material, &load, &options)?;
    // The sum over elements errs by a part of the last element at each end, of second order.
    compare!(rows[2], expected, within 4.0 / (PRESSED * PRESSED); indentation_depth)
}

/// Elements along the stationary contact of a march.
const MARCHED: usize = 400;

/// The load of an element is held over a step in which the cone moves by one element, so that the state is that of a
/// contact moved by a part of an element: first order in 1/n.
fn march(velocity: f64) -> Result<Finding> {
    let profile = PowerProfile::cone(0.1)?;
    let material = Maxwell::new(1.0, 1.0)?;
    let expected = maxwell_sliding(&profile, &material, contact(velocity))?;
    let load = SlidingLoad::new(expected.normal_force, velocity)?;
    let line = EquivalentLine(&profile);
    let options = SlideOptions::with_elements(MARCHED, &line, &material, &load)?;
    let got = slide_on_grid(&line, &material, &load, &options)?.last;
    let tolerance = 4.0 / MARCHED as f64;
    compare!(got, expected, within tolerance; friction_coefficient, indentation_depth)
}

/// On a dashpot the cone has its friction (21) at any spacing that has three elements.
fn coarse_march(elements: f64) -> Result<Finding> {
    let profile = PowerProfile::cone(0.1)?;
    let (material, load) = (Viscous::new(50.0)?, SlidingLoad::new(2.0, 0.1)?);
    let expected = power_sliding(&profile, &material, &load)?;
    let options = SlideOptions {
        spacing: expected.contact_length() / elements,
        drift_tolerance: 1e-9,
        max_sliding_distance: 100.0 * expected.contact_length(),
    };
    let got = slide_on_grid(&EquivalentLine(&profile), &material, &load, &options);
    if elements < 3.0 {
        return refused!(got => MdrError::TooCoarse { .. });
    }
    // The distance from the stationary state is less than the drift.
    compare!(got?.last, expected, within 1e-9; friction_coefficient, indentation_depth)
}
