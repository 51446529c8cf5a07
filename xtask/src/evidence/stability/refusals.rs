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
use numerics::InvalidParameter;
use rheology::{
    ExponentialStep, Material, RelaxationBranch, RelaxationSpectrum, RheologyError, Viscous,
};

use super::case::{Case, Finding, cases, compare, refused};
use super::line::{Dashpot, state, unit_dashpot};
use crate::scene::solid;

pub(super) fn no_state() -> Vec<Case> {
    cases! {
        "sphere" => sphere();
        "line too low" => line_too_low();
        "flat punch" => flat_punch();
        "too short a distance" => too_short_a_distance();
    }
}

/// The stationary state and the march on one grid, with the spacing or the box in the name, and the right error.
macro_rules! both {
    ($name:literal, $spacing:expr, $half_width:expr => $pattern:pat) => {
        cases! {
            concat!("stationary, ", $name) => refused!(stationary($spacing, $half_width)? => $pattern);
            concat!("march, ", $name) => refused!(march($spacing, $half_width)? => $pattern);
        }
    };
}

pub(super) fn grids() -> Vec<Case> {
    let single = cases! {
        "few iterations" => few_iterations();
        "tolerance 0" => no_tolerance();
        "error 1e-9" => error_not_reached();
        "line, spacing 10" => refused!(pressed_line(10.0)? => MdrError::TooCoarse { .. });
        "line, spacing 1e-12" => refused!(pressed_line(1e-12)? => MdrError::TooManyElements { .. });
    };
    [
        single,
        both!("spacing 1e0", 1.0, 10.0 => BemError::GridTooCoarse { .. }),
        both!("spacing 1e1", 10.0, 100.0 => BemError::GridTooCoarse { .. }),
        both!("spacing 1e6", 1e6, 1e7 => BemError::GridTooCoarse { .. }),
        both!("spacing 1e12", 1e12, 1e13 => BemError::GridTooCoarse { .. }),
        both!("box 0.3", 0.05, 0.3 => BemError::ContactReachesBoundary { .. }),
        both!("box 0.5", 0.05, 0.5 => BemError::ContactReachesBoundary { .. }),
        both!("spacing 1e-6", 1e-6, 2.0 => BemError::GridTooLarge { .. }),
        both!("spacing 1e-12", 1e-12, 2.0 => BemError::GridTooLarge { .. }),
    ]
    .into_iter()
    .flatten()
    .collect()
}

pub(super) fn viscosity(value: f64) -> Result<Finding> {
    refused!(Viscous::new(value) => RheologyError::InvalidParameter(InvalidParameter { parameter: "viscosity", .. }))
}

pub(super) fn load(force: f64, velocity: f64) -> Result<Finding> {
    let load = SlidingLoad::new(force, velocity);
    refused!(load => IndenterError::InvalidParameter(InvalidParameter { parameter: "normal_force" | "velocity", .. }))
}

pub(super) fn exponent(value: f64) -> Result<Finding> {
    let profile = PowerProfile::new(1.0, value);
    refused!(profile => IndenterError::InvalidParameter(InvalidParameter { parameter: "exponent", .. }))
}

pub(super) fn time_step(value: f64) -> Result<Finding> {
    let step = ExponentialStep::creep(&Viscous::new(1.0)?.creep(), value);
    refused!(step => RheologyError::InvalidParameter(InvalidParameter { parameter: "time_step", .. }))
}

pub(super) fn relaxation_time(relaxation_time: f64) -> Result<Finding> {
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
    let state = state(&sphere, &solid(1.0)?, &load)?;
    compare!(within 1e-8; "normal force" => state.normal_force.value, 8.0)
}

fn line_too_low() -> Result<Finding> {
    let line = SampledLine::new(vec![-1.0, 0.0, 1.0], vec![0.5, 0.0, 0.5])?;
    let Dashpot { material, load } = unit_dashpot()?;
    let state = mdr_core::steady(&line, &material, &load, 1e-8);
    refused!(state => MdrError::ForceBeyondEdge { .. })
}

fn flat_punch() -> Result<Finding> {
    let Dashpot { material, load } = unit_dashpot()?;
    let options = RefinementOptions::default();
    let state = steady_refined(&FlatPunch::new(1.0)?, &material, &load, &options);
    refused!(state => BemError::VerticalWall { .. } | BemError::InvalidParameter(_) | BemError::Indenter(_))
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
fn scene() -> Result<(PowerProfile, Dashpot)> {
    let (material, load) = (Viscous::new(1.0)?, SlidingLoad::new(0.4 * FRAC_PI_2, 1.0)?);
    Ok((PowerProfile::cone(0.1)?, Dashpot { material, load }))
}

fn stationary(spacing: f64, half_width: f64) -> Result<Result<(), BemError>> {
    let (cone, Dashpot { material, load }) = scene()?;
    let options = SteadyOptions {
        tolerance: 1e-6,
        ..SteadyOptions::new([spacing; 2], Footprint::square(half_width))
    };
    Ok(steady_on_grid(&cone, &material, &load, &options).map(drop))
}

fn march(spacing: f64, half_width: f64) -> Result<Result<(), BemError>> {
    let footprint = Footprint::square(half_width);
    marched(&GridOptions::new([spacing; 2], footprint))
}

/// A march over five elements.
fn marched(options: &GridOptions) -> Result<Result<(), BemError>> {
    let (cone, Dashpot { material, load }) = scene()?;
    let load = load.after(5.0 * options.spacing[0])?;
    Ok(slide_on_grid(&cone, &material, &load, options).map(drop))
}

fn few_iterations() -> Result<Finding> {
    let mut options = GridOptions::new([0.05; 2], Footprint::square(2.0));
    options.contact.max_iterations = 1;
    refused!(marched(&options)? => BemError::ContactNotConverged { .. })
}

fn no_tolerance() -> Result<Finding> {
    let mut options = GridOptions::new([0.05; 2], Footprint::square(2.0));
    options.contact.tolerance = 0.0;
    let state = marched(&options)?;
    refused!(state => BemError::InvalidParameter(InvalidParameter { parameter: "contact tolerance", .. }))
}

fn error_not_reached() -> Result<Finding> {
    let (cone, Dashpot { material, load }) = scene()?;
    let options = RefinementOptions {
        relative_error: 1e-9,
        aspect: 0.5,
        max_unknowns: 1000,
    };
    let state = steady_refined(&cone, &material, &load, &options);
    refused!(state => BemError::NotReached { .. })
}

fn pressed_line(spacing: f64) -> Result<Result<(), MdrError>> {
    let (cone, Dashpot { material, .. }) = scene()?;
    let options = IndentOptions {
        spacing,
        n_steps: 1,
    };
    let load = PressingLoad::new(Control::NormalForce(1.0), 1.0)?;
    Ok(mdr_core::indent_on_grid(&EquivalentLine(&cone), &material, &load, &options).map(drop))
}
