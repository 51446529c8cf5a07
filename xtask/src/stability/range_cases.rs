//! Forces, speeds, viscosities and sizes over many decades in SI, up to the ends of floating-point numbers.

use anyhow::Result;
use bem_halfspace::BemError;
use bem_halfspace::steady::{FrictionOptions, steady_friction};
use friction_analytic::{FrictionError, half_space_power_friction, power_sliding};
use indenters::{EquivalentLine, PowerProfile, SlidingLoad};
use mdr_core::{MdrError, SlideOptions, SteadyOptions, slide, steady};
use rheology::Viscous;

use crate::stability::case::{Case, Family, Outcome, decades, refused};

/// A paraboloid on a dashpot; all four numbers are one unless a case changes one of them.
#[derive(Debug, Clone, Copy)]
struct Scene {
    force: f64,
    velocity: f64,
    viscosity: f64,
    curvature: f64,
}

const UNIT: Scene = Scene {
    force: 1.0,
    velocity: 1.0,
    viscosity: 1.0,
    curvature: 1.0,
};

/// Solves a scene and compares with the closed form.
type Method = fn(Scene) -> Result<Outcome>;

/// A parameter with the scene that belongs to its value.
type Parameter = (&'static str, fn(f64) -> Scene);

/// The parameters that are changed one at a time.
const PARAMETERS: [Parameter; 4] = [
    ("force / N", |force| Scene { force, ..UNIT }),
    ("speed / (m/s)", |velocity| Scene { velocity, ..UNIT }),
    ("viscosity / (Pa s)", |viscosity| Scene {
        viscosity,
        ..UNIT
    }),
    ("curvature · m", |curvature| Scene { curvature, ..UNIT }),
];

pub(super) fn families() -> Vec<Family> {
    let mut families = Vec::new();
    for (name, method, step) in [
        ("line, stationary, paraboloid", line as Method, 1),
        ("line, march, paraboloid", march, 3),
        ("half space, stationary, paraboloid", half_space, 3),
    ] {
        for (parameter, scene) in PARAMETERS {
            let run = move |value| method(scene(value));
            let family = Family::over((name, parameter), decades(-12, 12, step), run);
            let slow = name.starts_with("half space");
            families.push(Family { slow, ..family });
        }
    }
    let refusals: [(&str, Method, Refusal); 4] = [
        ("theorem, ends of numbers", theorem, theorem_refuses),
        ("line, ends of numbers", line, line_refuses),
        ("line, march, ends of numbers", march, march_refuses),
        (
            "half space, ends of numbers",
            half_space,
            half_space_refuses,
        ),
    ];
    families.extend(refusals.map(ends_of_numbers));
    families
}

/// Solves a scene that has no answer.
type Refusal = fn(Scene) -> Result<Outcome>;

/// Forces that a depth can be computed from, and one that leaves no depth.
///
/// 1e-310 N leaves one with fewer digits than others have, which the solvers on the line refuse; the march also has no
/// room at 1.7e308 N.
fn ends_of_numbers((name, method, refuses): (&'static str, Method, Refusal)) -> Family {
    let forces = [1e-300, 1e-200, 1e-100, 1e100, 1e200, 1e300];
    let mut family = Family::over((name, "force / N"), forces, move |force| {
        method(Scene { force, ..UNIT })
    });
    let smallest = Scene {
        force: f64::from_bits(1),
        ..UNIT
    };
    let [denormal, largest] = [1e-310, 1.7e308].map(|force| Scene { force, ..UNIT });
    let on_line = name.starts_with("line");
    let in_steps = name.starts_with("line, march");
    let answers = move |refused: bool, scene| {
        if refused {
            refuses(scene)
        } else {
            method(scene)
        }
    };
    let first = [
        Case::new("5e-324", move || refuses(smallest)),
        Case::new("1e-310", move || answers(on_line, denormal)),
    ];
    family.cases.splice(0..0, first);
    let last = Case::new("1.7e308", move || answers(in_steps, largest));
    family.cases.push(last);
    family
}

impl Scene {
    fn of(self) -> Result<(PowerProfile, Viscous, SlidingLoad)> {
        Ok((
            PowerProfile::paraboloid(self.curvature)?,
            Viscous::new(self.viscosity)?,
            SlidingLoad::new(self.force, self.velocity)?,
        ))
    }
}

/// Eqs. (12) and (22) as the paper prints them, in an order that neither overflows nor underflows.
fn closed_form(scene: Scene) -> [f64; 2] {
    let depth = 0.25 * scene.force / scene.viscosity / scene.velocity;
    let friction = 4.0 / 3.0 * (2.0 * scene.curvature).sqrt() * depth.sqrt();
    [depth, friction]
}

/// A depth below the normal numbers has fewer digits.
fn rounded(tolerance: f64, depth: f64) -> f64 {
    tolerance + f64::from_bits(1) / depth
}

fn beside(scene: Scene, [depth, friction]: [f64; 2], tolerance: f64) -> Outcome {
    let [expected_depth, expected_friction] = closed_form(scene);
    let pairs = [
        ("depth", [depth, expected_depth]),
        ("friction coefficient", [friction, expected_friction]),
    ];
    Outcome::relative(&pairs, rounded(tolerance, expected_depth))
}

fn theorem(scene: Scene) -> Result<Outcome> {
    let (profile, material, load) = scene.of()?;
    let got = power_sliding(&profile, &material, &load)?;
    let numbers = [got.indentation_depth, got.friction_coefficient];
    Ok(beside(scene, numbers, 1e-12))
}

fn theorem_refuses(scene: Scene) -> Result<Outcome> {
    let (profile, material, load) = scene.of()?;
    let got = power_sliding(&profile, &material, &load);
    Ok(refused!(got, FrictionError::OutOfRange { .. }))
}

fn line(scene: Scene) -> Result<Outcome> {
    let (profile, material, load) = scene.of()?;
    let options = SteadyOptions::default();
    let got = steady(&EquivalentLine(&profile), &material, &load, &options)?;
    let numbers = [got.indentation_depth, got.friction_coefficient];
    Ok(beside(scene, numbers, options.relative_error))
}

fn line_refuses(scene: Scene) -> Result<Outcome> {
    let (profile, material, load) = scene.of()?;
    let options = SteadyOptions::default();
    let got = steady(&EquivalentLine(&profile), &material, &load, &options);
    Ok(refused!(
        got,
        MdrError::InvalidParameter { .. } | MdrError::NonFinite { .. }
    ))
}

const ELEMENTS: usize = 100;

fn march(scene: Scene) -> Result<Outcome> {
    let (profile, material, load) = scene.of()?;
    let options = SlideOptions::with_elements(ELEMENTS, &profile, &material, &load)?;
    let got = slide(&EquivalentLine(&profile), &material, &load, &options)?.stationary;
    let numbers = [got.indentation_depth, got.friction_coefficient];
    // Second order in the spacing: the mean slope over a step beside the slope.
    Ok(beside(scene, numbers, 1.0 / (ELEMENTS * ELEMENTS) as f64))
}

fn march_refuses(scene: Scene) -> Result<Outcome> {
    let (profile, material, load) = scene.of()?;
    let got = SlideOptions::with_elements(ELEMENTS, &profile, &material, &load)
        .and_then(|options| slide(&EquivalentLine(&profile), &material, &load, &options));
    Ok(refused!(
        got,
        MdrError::InvalidParameter { .. } | MdrError::NonFinite { .. }
    ))
}

const ASKED: FrictionOptions = FrictionOptions {
    relative_error: 1e-2,
    aspect: 0.5,
    max_unknowns: 40_000,
};

fn half_space(scene: Scene) -> Result<Outcome> {
    let (profile, material, load) = scene.of()?;
    let factor = half_space_power_friction(&profile, &material, &load)?;
    let got = steady_friction(&profile, &material, &load, &ASKED)?;
    let pairs = [(
        "friction coefficient",
        [got.friction_coefficient, factor.value],
    )];
    let tolerance = ASKED.relative_error + factor.error / factor.value;
    Ok(Outcome::relative(&pairs, tolerance))
}

fn half_space_refuses(scene: Scene) -> Result<Outcome> {
    let (profile, material, load) = scene.of()?;
    let got = steady_friction(&profile, &material, &load, &ASKED);
    Ok(refused!(got, BemError::InvalidParameter { .. }))
}
