//! Problems without a solution: numbers out of range, steps far too large, contacts that fill their box.

use std::f64::consts::FRAC_PI_2;

use anyhow::Result;
use bem_halfspace::steady::{RefinementOptions, SteadyOptions, steady_refined};
use bem_halfspace::{BemError, Footprint, GridOptions, slide_on_grid, steady_on_grid};
use indenters::{
    Control, EquivalentLine, FlatPunch, IndenterError, PowerProfile, PressingLoad, SampledLine,
    SlidingLoad, Sphere,
};
use mdr_core::{IndentOptions, MdrError, SlideOptions};
use rheology::{
    ExponentialStep, Material, RelaxationBranch, RelaxationSpectrum, RheologyError, Viscous,
};

use super::case::{Case, Family, Finding, cases, compare, families, refused};
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
    let no_state = cases! {
        "sphere" => sphere();
        "line too low" => line_too_low();
        "flat punch" => flat_punch();
        "too short a distance" => too_short_a_distance();
    };
    families.extend([
        Family::of("refused: no stationary state", "scene", no_state),
        Family::of("refused: too coarse, too small", "scene", grids()),
    ]);
    families
}

fn grids() -> Vec<Case> {
    cases! {
        "few iterations" => few_iterations();
        "tolerance 0" => no_tolerance();
        "error 1e-9" => error_not_reached();
        "line, spacing 10" => refused!(pressed_line(10.0)? => MdrError::TooCoarse { .. });
        "line, spacing 1e-12" => refused!(pressed_line(1e-12)? => MdrError::TooManyElements { .. });
        "stationary, spacing 1e0" => refused!(stationary(1.0, 10.0)? => BemError::GridTooCoarse { .. });
        "march, spacing 1e0" => refused!(march(1.0, 10.0, 5.0)? => BemError::GridTooCoarse { .. });
        "stationary, spacing 1e1" => refused!(stationary(10.0, 100.0)? => BemError::GridTooCoarse { .. });
        "march, spacing 1e1" => refused!(march(10.0, 100.0, 50.0)? => BemError::GridTooCoarse { .. });
        "stationary, spacing 1e6" => refused!(stationary(1e6, 1e7)? => BemError::GridTooCoarse { .. });
        "march, spacing 1e6" => refused!(march(1e6, 1e7, 5e6)? => BemError::GridTooCoarse { .. });
        "stationary, spacing 1e12" => refused!(stationary(1e12, 1e13)? => BemError::GridTooCoarse { .. });
        "march, spacing 1e12" => refused!(march(1e12, 1e13, 5e12)? => BemError::GridTooCoarse { .. });
        "stationary, box 0.3" => refused!(stationary(0.05, 0.3)? => BemError::ContactReachesBoundary { .. });
        "march, box 0.3" => refused!(march(0.05, 0.3, 3.0)? => BemError::ContactReachesBoundary { .. });
        "stationary, box 0.5" => refused!(stationary(0.05, 0.5)? => BemError::ContactReachesBoundary { .. });
        "march, box 0.5" => refused!(march(0.05, 0.5, 3.0)? => BemError::ContactReachesBoundary { .. });
        "stationary, spacing 1e-6" => refused!(stationary(1e-6, 2.0)? => BemError::GridTooLarge { .. });
        "march, spacing 1e-6" => refused!(march(1e-6, 2.0, 5e-6)? => BemError::GridTooLarge { .. });
        "stationary, spacing 1e-12" => refused!(stationary(1e-12, 2.0)? => BemError::GridTooLarge { .. });
        "march, spacing 1e-12" => refused!(march(1e-12, 2.0, 5e-12)? => BemError::GridTooLarge { .. });
    }
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
    let state = mdr_core::steady(&EquivalentLine(&sphere), &solid(1.0)?, &load, 1e-8)?;
    compare!(within 1e-8; "normal force" => state.normal_force.value, 8.0)
}

fn line_too_low() -> Result<Finding> {
    let line = SampledLine::new(vec![-1.0, 0.0, 1.0], vec![0.5, 0.0, 0.5])?;
    let load = SlidingLoad::new(4.0, 1.0)?;
    let state = mdr_core::steady(&line, &Viscous::new(1.0)?, &load, 1e-8);
    refused!(state => MdrError::ForceBeyondEdge { .. })
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
    let line = EquivalentLine(&cone);
    let mut options = SlideOptions::with_elements(30, &line, &material, &load)?;
    options.max_sliding_distance *= 0.01;
    let state = mdr_core::slide_on_grid(&line, &material, &load, &options);
    refused!(state => MdrError::NotStationary { .. })
}

/// A cone of slope 0.1 on a dashpot, whose contact on the line is 1 m long.
fn scene() -> Result<(PowerProfile, Viscous, SlidingLoad)> {
    let load = SlidingLoad::new(0.4 * FRAC_PI_2, 1.0)?;
    Ok((PowerProfile::cone(0.1)?, Viscous::new(1.0)?, load))
}

fn stationary(spacing: f64, half_width: f64) -> Result<Result<(), BemError>> {
    let (cone, material, load) = scene()?;
    let options = SteadyOptions {
        tolerance: 1e-6,
        ..SteadyOptions::new([spacing; 2], Footprint::square(half_width))
    };
    Ok(steady_on_grid(&cone, &material, &load, &options).map(drop))
}

fn march(spacing: f64, half_width: f64, distance: f64) -> Result<Result<(), BemError>> {
    marched(
        &GridOptions::new([spacing; 2], Footprint::square(half_width)),
        distance,
    )
}

fn marched(options: &GridOptions, distance: f64) -> Result<Result<(), BemError>> {
    let (cone, material, load) = scene()?;
    Ok(slide_on_grid(&cone, &material, &load.after(distance)?, options).map(drop))
}

fn few_iterations() -> Result<Finding> {
    let mut options = GridOptions::new([0.05; 2], Footprint::square(2.0));
    options.contact.max_iterations = 1;
    refused!(marched(&options, 0.25)? => BemError::ContactNotConverged { .. })
}

fn no_tolerance() -> Result<Finding> {
    let mut options = GridOptions::new([0.05; 2], Footprint::square(2.0));
    options.contact.tolerance = 0.0;
    let state = marched(&options, 0.25)?;
    refused!(state => BemError::InvalidParameter { parameter: "contact tolerance", .. })
}

fn error_not_reached() -> Result<Finding> {
    let (cone, material, load) = scene()?;
    let options = RefinementOptions {
        relative_error: 1e-9,
        aspect: 0.5,
        max_unknowns: 1000,
    };
    let state = steady_refined(&cone, &material, &load, &options);
    refused!(state => BemError::FrictionNotReached { .. })
}

fn pressed_line(spacing: f64) -> Result<Result<(), MdrError>> {
    let (cone, material, _) = scene()?;
    let options = IndentOptions {
        spacing,
        n_steps: 1,
    };
    let load = PressingLoad::new(Control::NormalForce(1.0), 1.0)?;
    Ok(mdr_core::indent_on_grid(&EquivalentLine(&cone), &material, &load, &options).map(drop))
}
