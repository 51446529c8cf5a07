//! Questions that have no answer: numbers out of range, steps far too large, contacts that fill their box.

use anyhow::Result;
use bem_halfspace::slide::{SlideOptions as MarchOptions, slide as march};
use bem_halfspace::steady::{FrictionOptions, SteadyOptions, steady, steady_friction};
use bem_halfspace::{BemError, ContactOptions, Footprint};
use indenters::{
    EquivalentLine, FlatPunch, IndenterError, PowerProfile, SampledLine, SlidingLoad, Sphere,
};
use mdr_core::{IndentOptions, MdrError, SlideOptions, indent, slide};
use rheology::{
    ExponentialStep, Material, RelaxationBranch, RelaxationSpectrum, RheologyError, Viscous,
};

use crate::stability::case::{Case, Family, Outcome, refused};
use crate::stability::rheology_cases::solid;

/// Numbers that no size, speed, force or modulus can be.
const NOT_POSITIVE: [f64; 5] = [0.0, -0.0, -1.0, f64::NAN, f64::INFINITY];

pub(super) fn families() -> Vec<Family> {
    let mut coarse = badly_solved();
    coarse.extend([1.0, 10.0, 1e6, 1e12].into_iter().flat_map(too_coarse));
    coarse.extend([0.3, 0.5].into_iter().flat_map(too_small));
    coarse.extend([1e-6, 1e-12].into_iter().flat_map(too_fine));
    let scenes = |name, cases| Family {
        name,
        parameter: "scene",
        cases,
        slow: false,
    };
    let mut families: Vec<Family> = no_numbers().into();
    families.push(scenes("refused: no stationary state", no_state()));
    families.push(scenes("refused: too coarse, too small", coarse));
    families
}

fn no_numbers() -> [Family; 6] {
    let family =
        |name, run: fn(f64) -> Result<Outcome>| Family::over((name, "number"), NOT_POSITIVE, run);
    [
        family("refused: viscosity", viscosity),
        family("refused: force", |force| load(force, 1.0)),
        family("refused: speed", |velocity| load(1.0, velocity)),
        family("refused: exponent", exponent),
        family("refused: step in time", time_step),
        family("refused: relaxation time", relaxation_time),
    ]
}

fn viscosity(value: f64) -> Result<Outcome> {
    Ok(refused!(
        Viscous::new(value),
        RheologyError::InvalidParameter {
            parameter: "viscosity",
            ..
        }
    ))
}

fn load(force: f64, velocity: f64) -> Result<Outcome> {
    Ok(refused!(
        SlidingLoad::new(force, velocity),
        IndenterError::InvalidParameter {
            parameter: "normal_force" | "velocity",
            ..
        }
    ))
}

fn exponent(value: f64) -> Result<Outcome> {
    Ok(refused!(
        PowerProfile::new(1.0, value),
        IndenterError::InvalidParameter {
            parameter: "exponent",
            ..
        }
    ))
}

fn time_step(value: f64) -> Result<Outcome> {
    let creep = Viscous::new(1.0)?.creep();
    Ok(refused!(
        ExponentialStep::creep(&creep, value),
        RheologyError::InvalidParameter {
            parameter: "time_step",
            ..
        }
    ))
}

fn relaxation_time(relaxation_time: f64) -> Result<Outcome> {
    let branch = RelaxationBranch {
        modulus: 1.0,
        relaxation_time,
    };
    Ok(refused!(
        RelaxationSpectrum::new(1.0, 0.0, vec![branch]),
        RheologyError::InvalidElement {
            parameter: "relaxation_time",
            ..
        }
    ))
}

fn no_state() -> Vec<Case> {
    vec![
        Case::new("sphere", || {
            let load = SlidingLoad::new(8.0, 1.0)?;
            let sphere = Sphere::new(1.0)?;
            let options = mdr_core::SteadyOptions::default();
            let state = mdr_core::steady(&EquivalentLine(&sphere), &solid(1.0)?, &load, &options);
            // The line of a sphere rises without limit towards its equator, so that it carries every force.
            let state = state?;
            let pairs = [("normal force", [state.normal_force, 8.0])];
            Ok(Outcome::relative(&pairs, 1e-8))
        }),
        Case::new("line too low", || {
            let line = SampledLine::new(vec![-1.0, 0.0, 1.0], vec![0.5, 0.0, 0.5])?;
            let load = SlidingLoad::new(4.0, 1.0)?;
            let options = mdr_core::SteadyOptions::default();
            let state = mdr_core::steady(&line, &Viscous::new(1.0)?, &load, &options);
            Ok(refused!(state, MdrError::NoStationaryState { .. }))
        }),
        Case::new("flat punch", || {
            let load = SlidingLoad::new(4.0, 1.0)?;
            let punch = FlatPunch::new(1.0)?;
            let state = steady_friction(
                &punch,
                &Viscous::new(1.0)?,
                &load,
                &FrictionOptions::default(),
            );
            Ok(refused!(
                state,
                BemError::VerticalWall { .. }
                    | BemError::InvalidParameter { .. }
                    | BemError::Indenter(_)
            ))
        }),
        Case::new("too short a way", || {
            let (cone, material) = (PowerProfile::cone(0.1)?, Viscous::new(1.0)?);
            let load = SlidingLoad::new(1.0, 1.0)?;
            let options = SlideOptions::with_elements(30, &cone, &material, &load)?;
            let options = SlideOptions {
                max_sliding_distance: 0.01 * options.max_sliding_distance,
                ..options
            };
            let state = slide(&EquivalentLine(&cone), &material, &load, &options);
            Ok(refused!(state, MdrError::NotStationary { .. }))
        }),
    ]
}

/// A cone of slope 0.1 on a dashpot, whose contact on the line is 1 m long.
fn scene() -> Result<(PowerProfile, Viscous, SlidingLoad)> {
    let force = 0.4 * std::f64::consts::FRAC_PI_2;
    Ok((
        PowerProfile::cone(0.1)?,
        Viscous::new(1.0)?,
        SlidingLoad::new(force, 1.0)?,
    ))
}

fn steady_options(spacing: f64, half_width: f64) -> SteadyOptions {
    SteadyOptions {
        spacing: [spacing; 2],
        phase: [0.0; 2],
        footprint: Footprint::square(half_width),
        tolerance: 1e-6,
        max_iterations: 100,
    }
}

fn march_options(spacing: f64, half_width: f64) -> MarchOptions {
    MarchOptions {
        spacing: [spacing; 2],
        footprint: Footprint::square(half_width),
        sliding_distance: 5.0 * spacing,
        contact: ContactOptions::default(),
    }
}

fn badly_solved() -> Vec<Case> {
    vec![
        Case::new("few iterations", || {
            let (cone, material, load) = scene()?;
            let mut options = march_options(0.05, 2.0);
            options.contact.max_iterations = 1;
            let state = march(&cone, &material, &load, &options);
            Ok(refused!(state, BemError::ContactNotConverged { .. }))
        }),
        Case::new("tolerance 0", || {
            let (cone, material, load) = scene()?;
            let mut options = march_options(0.05, 2.0);
            options.contact.tolerance = 0.0;
            let state = march(&cone, &material, &load, &options);
            Ok(refused!(
                state,
                BemError::InvalidParameter {
                    parameter: "contact tolerance",
                    ..
                }
            ))
        }),
        Case::new("error 1e-9", || {
            let (cone, material, load) = scene()?;
            let options = FrictionOptions {
                relative_error: 1e-9,
                aspect: 0.5,
                max_unknowns: 1000,
            };
            let state = steady_friction(&cone, &material, &load, &options);
            Ok(refused!(state, BemError::FrictionNotReached { .. }))
        }),
        Case::new("line, spacing 10", || {
            let (cone, material, _) = scene()?;
            let options = IndentOptions { spacing: 10.0 };
            let rows = indent(&EquivalentLine(&cone), &material, 1.0, &[1.0], &options);
            Ok(refused!(rows, MdrError::TooCoarse { .. }))
        }),
        Case::new("line, spacing 1e-12", || {
            let (cone, material, _) = scene()?;
            let options = IndentOptions { spacing: 1e-12 };
            let rows = indent(&EquivalentLine(&cone), &material, 1.0, &[1.0], &options);
            Ok(refused!(rows, MdrError::TooManyElements { .. }))
        }),
    ]
}

fn too_coarse(spacing: f64) -> [Case; 2] {
    [
        Case::new(format!("stationary, spacing {spacing:e}"), move || {
            let (cone, material, load) = scene()?;
            let options = steady_options(spacing, 10.0 * spacing);
            let state = steady(&cone, &material, &load, &options);
            Ok(refused!(state, BemError::GridTooCoarse { .. }))
        }),
        Case::new(format!("march, spacing {spacing:e}"), move || {
            let (cone, material, load) = scene()?;
            let options = march_options(spacing, 10.0 * spacing);
            let state = march(&cone, &material, &load, &options);
            Ok(refused!(state, BemError::GridTooCoarse { .. }))
        }),
    ]
}

fn too_small(half_width: f64) -> [Case; 2] {
    [
        Case::new(format!("stationary, box {half_width}"), move || {
            let (cone, material, load) = scene()?;
            let state = steady(&cone, &material, &load, &steady_options(0.05, half_width));
            Ok(refused!(state, BemError::ContactReachesBoundary { .. }))
        }),
        Case::new(format!("march, box {half_width}"), move || {
            let (cone, material, load) = scene()?;
            let mut options = march_options(0.05, half_width);
            options.sliding_distance = 3.0;
            let state = march(&cone, &material, &load, &options);
            Ok(refused!(state, BemError::ContactReachesBoundary { .. }))
        }),
    ]
}

fn too_fine(spacing: f64) -> [Case; 2] {
    [
        Case::new(format!("stationary, spacing {spacing:e}"), move || {
            let (cone, material, load) = scene()?;
            let state = steady(&cone, &material, &load, &steady_options(spacing, 2.0));
            Ok(refused!(state, BemError::GridTooLarge { .. }))
        }),
        Case::new(format!("march, spacing {spacing:e}"), move || {
            let (cone, material, load) = scene()?;
            let state = march(&cone, &material, &load, &march_options(spacing, 2.0));
            Ok(refused!(state, BemError::GridTooLarge { .. }))
        }),
    ]
}
