//! Problems without a solution: numbers out of range, steps far too large, contacts that fill their box.

use std::f64::consts::FRAC_PI_2;

use anyhow::Result;
use bem_halfspace::steady::{RefinementOptions, SteadyOptions, steady_refined};
use bem_halfspace::{BemError, Footprint, GridOptions, slide_on_grid, steady_on_grid};
use indenters::{
    EquivalentLine, FlatPunch, IndenterError, PowerProfile, SampledLine, SlidingLoad, Sphere,
};
use mdr_core::{IndentOptions, MdrError, SlideOptions, indent, slide};
use rheology::{
    ExponentialStep, Material, RelaxationBranch, RelaxationSpectrum, RheologyError, Viscous,
};

use super::case::{Case, Family, Finding, compare, families, refused};
use super::rheology::solid;

/// Numbers that no size, speed, force or modulus can be.
const NOT_POSITIVE: [f64; 5] = [0.0, -0.0, -1.0, f64::NAN, f64::INFINITY];

pub(super) fn families() -> Vec<Family> {
    let mut families = families! {
        "refused: viscosity", "number", NOT_POSITIVE => viscosity;
        "refused: force", "number", NOT_POSITIVE => |force| load(force, 1.0);
        "refused: speed", "number", NOT_POSITIVE => |velocity| load(1.0, velocity);
        "refused: exponent", "number", NOT_POSITIVE => exponent;
        "refused: step in time", "number", NOT_POSITIVE => time_step;
        "refused: relaxation time", "number", NOT_POSITIVE => relaxation_time;
    };
    let no_state = vec![
        Case::new("sphere", sphere),
        Case::new("line too low", line_too_low),
        Case::new("flat punch", flat_punch),
        Case::new("too short a distance", too_short_a_distance),
    ];
    let mut coarse = vec![
        Case::new("few iterations", few_iterations),
        Case::new("tolerance 0", no_tolerance),
        Case::new("error 1e-9", error_not_reached),
        Case::new(
            "line, spacing 10",
            || refused!(pressed_line(10.0)? => MdrError::TooCoarse { .. }),
        ),
        Case::new(
            "line, spacing 1e-12",
            || refused!(pressed_line(1e-12)? => MdrError::TooManyElements { .. }),
        ),
    ];
    coarse.extend([1.0, 10.0, 1e6, 1e12].into_iter().flat_map(too_coarse));
    coarse.extend([0.3, 0.5].into_iter().flat_map(too_small));
    coarse.extend([1e-6, 1e-12].into_iter().flat_map(too_fine));
    families.extend([
        Family::of("refused: no stationary state", "scene", no_state),
        Family::of("refused: too coarse, too small", "scene", coarse),
    ]);
    families
}

fn viscosity(value: f64) -> Result<Finding> {
    refused!(Viscous::new(value) => RheologyError::InvalidParameter { parameter: "viscosity", .. })
}

fn load(force: f64, velocity: f64) -> Result<Finding> {
    let load = SlidingLoad::new(force, velocity);
    refused!(load => IndenterError::InvalidParameter { parameter: "normal_force" | "velocity", .. })
}

fn exponent(value: f64) -> Result<Finding> {
    let profile = PowerProfile::new(1.0, value);
    refused!(profile => IndenterError::InvalidParameter { parameter: "exponent", .. })
}

fn time_step(value: f64) -> Result<Finding> {
    let step = ExponentialStep::creep(&Viscous::new(1.0)?.creep(), value);
    refused!(step => RheologyError::InvalidParameter { parameter: "time_step", .. })
}

fn relaxation_time(relaxation_time: f64) -> Result<Finding> {
    let branch = RelaxationBranch {
        modulus: 1.0,
        relaxation_time,
    };
    let spectrum = RelaxationSpectrum::new(1.0, 0.0, vec![branch]);
    refused!(spectrum => RheologyError::InvalidElement { parameter: "relaxation_time", .. })
}

/// The line of a sphere rises without limit towards its equator, so that it carries every force.
fn sphere() -> Result<Finding> {
    let load = SlidingLoad::new(8.0, 1.0)?;
    let sphere = Sphere::new(1.0)?;
    let options = mdr_core::SteadyOptions::default();
    let state = mdr_core::steady(&EquivalentLine(&sphere), &solid(1.0)?, &load, &options)?;
    compare!(within 1e-8; "normal force" => state.normal_force, 8.0)
}

fn line_too_low() -> Result<Finding> {
    let line = SampledLine::new(vec![-1.0, 0.0, 1.0], vec![0.5, 0.0, 0.5])?;
    let load = SlidingLoad::new(4.0, 1.0)?;
    let options = mdr_core::SteadyOptions::default();
    let state = mdr_core::steady(&line, &Viscous::new(1.0)?, &load, &options);
    refused!(state => MdrError::NoStationaryState { .. })
}

fn flat_punch() -> Result<Finding> {
    let load = SlidingLoad::new(4.0, 1.0)?;
    let (punch, material) = (FlatPunch::new(1.0)?, Viscous::new(1.0)?);
    let state = steady_refined(&punch, &material, &load, &RefinementOptions::default());
    refused!(state => BemError::VerticalWall { .. } | BemError::InvalidParameter { .. } | BemError::Indenter(_))
}

fn too_short_a_distance() -> Result<Finding> {
    let (cone, material) = (PowerProfile::cone(0.1)?, Viscous::new(1.0)?);
    let load = SlidingLoad::new(1.0, 1.0)?;
    let mut options = SlideOptions::with_elements(30, &cone, &material, &load)?;
    options.max_sliding_distance *= 0.01;
    let state = slide(&EquivalentLine(&cone), &material, &load, &options);
    refused!(state => MdrError::NotStationary { .. })
}

/// A cone of slope 0.1 on a dashpot, whose contact on the line is 1 m long.
struct Scene {
    cone: PowerProfile,
    material: Viscous,
    load: SlidingLoad,
}

impl Scene {
    fn new() -> Result<Self> {
        Ok(Self {
            cone: PowerProfile::cone(0.1)?,
            material: Viscous::new(1.0)?,
            load: SlidingLoad::new(0.4 * FRAC_PI_2, 1.0)?,
        })
    }

    fn march(&self, options: &GridOptions, distance: f64) -> Result<(), BemError> {
        let load = self.load.after(distance)?;
        slide_on_grid(&self.cone, &self.material, &load, options).map(drop)
    }

    fn stationary(&self, spacing: f64, half_width: f64) -> Result<(), BemError> {
        let options = SteadyOptions {
            tolerance: 1e-6,
            ..SteadyOptions::new([spacing; 2], Footprint::square(half_width))
        };
        steady_on_grid(&self.cone, &self.material, &self.load, &options).map(drop)
    }
}

fn march_options(spacing: f64, half_width: f64) -> GridOptions {
    GridOptions::new([spacing; 2], Footprint::square(half_width))
}

fn few_iterations() -> Result<Finding> {
    let mut options = march_options(0.05, 2.0);
    options.contact.max_iterations = 1;
    let state = Scene::new()?.march(&options, 0.25);
    refused!(state => BemError::ContactNotConverged { .. })
}

fn no_tolerance() -> Result<Finding> {
    let mut options = march_options(0.05, 2.0);
    options.contact.tolerance = 0.0;
    let state = Scene::new()?.march(&options, 0.25);
    refused!(state => BemError::InvalidParameter { parameter: "contact tolerance", .. })
}

fn error_not_reached() -> Result<Finding> {
    let Scene {
        cone,
        material,
        load,
    } = Scene::new()?;
    let options = RefinementOptions {
        relative_error: 1e-9,
        aspect: 0.5,
        max_unknowns: 1000,
    };
    let state = steady_refined(&cone, &material, &load, &options);
    refused!(state => BemError::FrictionNotReached { .. })
}

fn pressed_line(spacing: f64) -> Result<Result<(), MdrError>> {
    let Scene { cone, material, .. } = Scene::new()?;
    let options = IndentOptions { spacing };
    Ok(indent(&EquivalentLine(&cone), &material, 1.0, &[1.0], &options).map(drop))
}

fn too_coarse(spacing: f64) -> [Case; 2] {
    [
        Case::new(format!("stationary, spacing {spacing:e}"), move || {
            let state = Scene::new()?.stationary(spacing, 10.0 * spacing);
            refused!(state => BemError::GridTooCoarse { .. })
        }),
        Case::new(format!("march, spacing {spacing:e}"), move || {
            let state = Scene::new()?.march(&march_options(spacing, 10.0 * spacing), 5.0 * spacing);
            refused!(state => BemError::GridTooCoarse { .. })
        }),
    ]
}

fn too_small(half_width: f64) -> [Case; 2] {
    [
        Case::new(format!("stationary, box {half_width}"), move || {
            let state = Scene::new()?.stationary(0.05, half_width);
            refused!(state => BemError::ContactReachesBoundary { .. })
        }),
        Case::new(format!("march, box {half_width}"), move || {
            let state = Scene::new()?.march(&march_options(0.05, half_width), 3.0);
            refused!(state => BemError::ContactReachesBoundary { .. })
        }),
    ]
}

fn too_fine(spacing: f64) -> [Case; 2] {
    [
        Case::new(format!("stationary, spacing {spacing:e}"), move || {
            let state = Scene::new()?.stationary(spacing, 2.0);
            refused!(state => BemError::GridTooLarge { .. })
        }),
        Case::new(format!("march, spacing {spacing:e}"), move || {
            let state = Scene::new()?.march(&march_options(spacing, 2.0), 5.0 * spacing);
            refused!(state => BemError::GridTooLarge { .. })
        }),
    ]
}
