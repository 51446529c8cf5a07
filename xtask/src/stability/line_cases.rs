//! The one-dimensional model: stationary sliding, the march in time, and pressing.

use anyhow::Result;
use friction_analytic::{
    SlidingContact, kelvin_voigt_sliding, maxwell_sliding, power_indentation_after_impulse,
    power_sliding,
};
use indenters::{EquivalentLine, PowerProfile, SlidingLoad};
use mdr_core::{
    IndentOptions, MdrError, SlideOptions, SlidingDepth, SteadyOptions, indent, slide, steady,
    steady_at_depth,
};
use rheology::{KelvinVoigt, Material, Maxwell, Viscous};

use crate::stability::case::{Case, Family, Outcome, decades, refused};
use crate::stability::cone_on_solid::cone_on_solid;
use crate::stability::rheology_cases::{prony_over, solid};

/// What the stationary solver is asked for by default.
const ASKED: f64 = 1e-8;
/// Distance of branch or retardation over the front of the contact.
const RATIOS: [i32; 2] = [-12, 12];

pub(super) fn families() -> Vec<Family> {
    let exponents = [
        0.55, 0.6, 0.75, 0.9, 1.0, 1.5, 2.0, 3.0, 5.0, 10.0, 30.0, 100.0, 300.0, 1000.0,
    ];
    let mut powers = Family::over(("line, dashpot, stationary", "p"), exponents, power_profile);
    for exponent in [0.51, 0.501, 0.5, 0.1] {
        let refused = Case::new(format!("{exponent}"), move || too_sharp(exponent));
        powers.cases.insert(0, refused);
    }
    let mut families = vec![powers];
    families.extend(closed_forms());
    families.extend(cones());
    families.extend(in_time());
    families
}

fn ratios() -> impl Iterator<Item = f64> + Clone {
    let [first, last] = RATIOS;
    decades(first, last, 1)
}

fn closed_forms() -> [Family; 4] {
    [
        Family::over(
            ("line, cone on Kelvin–Voigt", "vλ/x_r"),
            ratios(),
            |ratio| kelvin_voigt(&PowerProfile::cone(0.1)?, ratio),
        ),
        Family::over(
            ("line, paraboloid on Kelvin–Voigt", "vλ/x_r"),
            ratios(),
            |ratio| kelvin_voigt(&PowerProfile::paraboloid(0.1)?, ratio),
        ),
        Family::over(("line, cone on Maxwell", "vτ/x_r"), ratios(), |ratio| {
            maxwell(&PowerProfile::cone(0.1)?, ratio)
        }),
        Family::over(
            ("line, paraboloid on Maxwell", "vτ/x_r"),
            ratios(),
            |ratio| maxwell(&PowerProfile::paraboloid(0.1)?, ratio),
        ),
    ]
}

fn cones() -> [Family; 3] {
    [
        Family::over(
            ("line, cone on 16 branches over 15 decades", "v/x_r"),
            ratios(),
            |velocity| cone(&prony_over(15.0)?, velocity),
        ),
        Family::over(
            ("line, cone on three elements, vτ = x_r", "γ"),
            decades(-12, 3, 1),
            |gamma| cone(&solid(gamma)?, 1.0),
        ),
        Family::over(
            ("line, cone on three elements, slow", "γ"),
            decades(-12, 3, 1),
            |gamma| cone(&solid(gamma)?, 1e-3 * gamma),
        ),
    ]
}

fn in_time() -> Vec<Family> {
    vec![
        Family::over(
            ("line, pressed, Kelvin–Voigt", "Δt/λ"),
            ratios(),
            |ratio| pressed(&KelvinVoigt::new(1.0, 1.0)?, ratio),
        ),
        Family::over(("line, pressed, Maxwell", "Δt/τ"), ratios(), |ratio| {
            pressed(&Maxwell::new(1.0, 1.0)?, ratio)
        }),
        Family::over(("line, pressed, 16 branches", "Δt"), ratios(), |ratio| {
            pressed(&prony_over(15.0)?, ratio)
        }),
        Family::over(
            ("line, march, cone on Maxwell", "vτ/x_r"),
            ratios().step_by(2),
            march,
        ),
        Family::over(
            ("line, march, cone on dashpot", "elements"),
            [1.0, 2.0, 3.0, 4.0, 7.0, 30.0, 100.0, 1000.0],
            coarse_march,
        ),
    ]
}

/// The closed form (16) of the theorem, which shares nothing with the solver.
fn power_profile(exponent: f64) -> Result<Outcome> {
    let profile = PowerProfile::new(0.4, exponent)?;
    let material = Viscous::new(50.0)?;
    let load = SlidingLoad::new(2.0, 0.1)?;
    let expected = power_sliding(&profile, &material, &load)?;
    let options = SteadyOptions::default();
    let got = steady(&EquivalentLine(&profile), &material, &load, &options)?;
    let pairs = [
        (
            "friction coefficient",
            [got.friction_coefficient, expected.friction_coefficient],
        ),
        ("depth", [got.indentation_depth, expected.indentation_depth]),
    ];
    Ok(Outcome::relative(&pairs, ASKED))
}

/// The friction integral diverges up to p = 1/2, and close above it converges too slowly to be summed.
fn too_sharp(exponent: f64) -> Result<Outcome> {
    let profile = PowerProfile::new(0.4, exponent)?;
    let load = SlidingLoad::new(2.0, 0.1)?;
    let options = SteadyOptions::default();
    let state = steady(
        &EquivalentLine(&profile),
        &Viscous::new(50.0)?,
        &load,
        &options,
    );
    Ok(refused!(state, MdrError::FrictionDiverges { .. }))
}

/// Spring and dashpot in parallel with the retardation time 1 s, the front 1 m ahead.
fn kelvin_voigt(profile: &PowerProfile, ratio: f64) -> Result<Outcome> {
    let material = KelvinVoigt::new(1.0, 1.0)?;
    let contact = SlidingContact {
        front: 1.0,
        velocity: ratio,
    };
    let expected = kelvin_voigt_sliding(profile, &material, contact)?;
    closed_form(profile, &material, (ratio, expected))
}

fn maxwell(profile: &PowerProfile, ratio: f64) -> Result<Outcome> {
    let material = Maxwell::new(1.0, 1.0)?;
    let contact = SlidingContact {
        front: 1.0,
        velocity: ratio,
    };
    let expected = maxwell_sliding(profile, &material, contact)?;
    closed_form(profile, &material, (ratio, expected))
}

fn closed_form(
    profile: &PowerProfile,
    material: &dyn Material,
    (velocity, expected): (f64, friction_analytic::ViscoelasticSliding),
) -> Result<Outcome> {
    let load = SlidingLoad::new(expected.normal_force, velocity)?;
    let options = SteadyOptions::default();
    let got = steady(&EquivalentLine(profile), material, &load, &options)?;
    let pairs = [
        (
            "friction coefficient",
            [got.friction_coefficient, expected.friction_coefficient],
        ),
        ("depth", [got.indentation_depth, expected.indentation_depth]),
    ];
    Ok(Outcome::relative(&pairs, ASKED))
}

/// The cone whose line has the slope 1, held at the depth 1 m.
fn cone(material: &dyn Material, velocity: f64) -> Result<Outcome> {
    let profile = PowerProfile::cone(std::f64::consts::FRAC_2_PI)?;
    let expected = cone_on_solid(&material.relaxation(), velocity)?;
    let motion = SlidingDepth {
        indentation_depth: 1.0,
        velocity,
    };
    let options = SteadyOptions::default();
    let got = steady_at_depth(&EquivalentLine(&profile), material, &motion, &options)?;
    let pairs = [
        (
            "friction coefficient",
            [got.friction_coefficient, expected.friction_coefficient],
        ),
        ("normal force", [got.normal_force, expected.normal_force]),
    ];
    Ok(Outcome::relative(&pairs, ASKED))
}

/// Elements under the contact at the end of pressing.
const PRESSED: f64 = 2000.0;

/// Under a constant force 8 ∫ x h̃' dx = F J(t) in steps of any length; the same as on a dashpot of 1 Pa s after the
/// impulse F J(t).
fn pressed(material: &dyn Material, step: f64) -> Result<Outcome> {
    let profile = PowerProfile::cone(0.1)?;
    let times = [step, 2.0 * step, 3.0 * step];
    let last = material.creep_compliance(times[2])?;
    // A force under which the last contact has the radius of about one.
    let force = 1.0 / last;
    let dashpot = Viscous::new(1.0)?;
    let expected = power_indentation_after_impulse(&profile, &dashpot, force * last)?;
    let options = IndentOptions {
        spacing: 2.0 * expected.contact_radius / PRESSED,
    };
    let rows = indent(&EquivalentLine(&profile), material, force, &times, &options)?;
    let got = rows.last().map_or(f64::NAN, |row| row.indentation_depth);
    // The sum over elements errs by a part of the last element at each end, of second order.
    let tolerance = 4.0 / (PRESSED * PRESSED);
    let pairs = [("depth", [got, expected.indentation_depth])];
    Ok(Outcome::relative(&pairs, tolerance))
}

/// Elements along the stationary contact of a march.
const MARCHED: usize = 400;

/// The load of an element is held over a step in which the cone moves by one element, so that the state is that of a
/// contact moved by a part of an element: first order in 1/n.
fn march(ratio: f64) -> Result<Outcome> {
    let profile = PowerProfile::cone(0.1)?;
    let material = Maxwell::new(1.0, 1.0)?;
    let contact = SlidingContact {
        front: 1.0,
        velocity: ratio,
    };
    let expected = maxwell_sliding(&profile, &material, contact)?;
    let load = SlidingLoad::new(expected.normal_force, ratio)?;
    let options = SlideOptions::with_elements(MARCHED, &profile, &material, &load)?;
    let got = slide(&EquivalentLine(&profile), &material, &load, &options)?.stationary;
    let pairs = [
        (
            "friction coefficient",
            [got.friction_coefficient, expected.friction_coefficient],
        ),
        ("depth", [got.indentation_depth, expected.indentation_depth]),
    ];
    Ok(Outcome::relative(&pairs, 4.0 / MARCHED as f64))
}

/// On a dashpot the cone has its friction (21) at any spacing that has three elements.
fn coarse_march(elements: f64) -> Result<Outcome> {
    let profile = PowerProfile::cone(0.1)?;
    let material = Viscous::new(50.0)?;
    let load = SlidingLoad::new(2.0, 0.1)?;
    let expected = power_sliding(&profile, &material, &load)?;
    let options = SlideOptions {
        spacing: expected.contact_length() / elements,
        drift_tolerance: 1e-9,
        max_sliding_distance: 100.0 * expected.contact_length(),
    };
    let got = slide(&EquivalentLine(&profile), &material, &load, &options);
    if elements < 3.0 {
        return Ok(refused!(got, MdrError::TooCoarse { .. }));
    }
    let got = got?.stationary;
    let pairs = [
        (
            "friction coefficient",
            [got.friction_coefficient, expected.friction_coefficient],
        ),
        ("depth", [got.indentation_depth, expected.indentation_depth]),
    ];
    // What is left of the way to the stationary state is less than the drift.
    Ok(Outcome::relative(&pairs, 1e-9))
}
