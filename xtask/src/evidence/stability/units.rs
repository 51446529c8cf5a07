//! The same scene in other units: whatever has no dimension stays as it is.

use anyhow::Result;
use bem_halfspace::indent::{IndentStep, indent_history_on_grid};
use bem_halfspace::steady::SteadyOptions as StationaryOptions;
use bem_halfspace::{Footprint, GridOptions, slide_on_grid, steady_on_grid};
use friction_analytic::{ElasticContact, axisymmetric_sliding, low_speed_friction};
use indenters::{Control, EquivalentLine, RoundTippedCone, SlidingLoad};
use mdr_core::{SlideOptions, indent_history, steady};
use rheology::{StandardSolid, StandardSolidParameters, Viscous};

use super::case::{Case, Comparison, Family, Finding, power_of_ten};

/// Dimensionless numbers of a method.
type Numbers = Vec<(&'static str, f64)>;

/// A method, which solves the scene in other units.
type Method = fn(&Scene) -> Result<Numbers>;

/// How many of the new units are one of the old.
#[derive(Debug, Clone, Copy)]
struct Units {
    length: f64,
    time: f64,
    force: f64,
}

const SI: Units = Units {
    length: 1.0,
    time: 1.0,
    force: 1.0,
};

/// Another unit of one kind.
type Change = fn(f64) -> Units;

const CHANGES: [(&str, Change); 3] = [
    ("length", |length| Units { length, ..SI }),
    ("time", |time| Units { time, ..SI }),
    ("force", |force| Units { force, ..SI }),
];

/// A scene in other units.
struct Scene {
    units: Units,
    length: f64,
    cone: RoundTippedCone,
    viscous: Viscous,
    solid: StandardSolid,
    force: f64,
    load: SlidingLoad,
    /// Ends of the steps of pressing.
    times: [f64; 3],
    grid: GridOptions,
}

/// What is asked of the invariance.
const TOLERANCE: f64 = 1e-9;

pub(super) fn families() -> Vec<Family> {
    let methods: [(&str, Method); 7] = [
        ("units: theorems", theorems),
        ("units: line, stationary", line_stationary),
        ("units: line, march", line_march),
        ("units: line, pressed", line_pressed),
        ("units: half space, stationary", half_space_stationary),
        ("units: half space, march", half_space_march),
        ("units: half space, pressed", half_space_pressed),
    ];
    methods
        .map(|(name, method)| Family::of(name, "unit, 1e-12 … 1e12", cases(method)))
        .into()
}

fn cases(method: Method) -> Vec<Case> {
    let solve = move |units| method(&Scene::new(units)?);
    let mut cases = Vec::new();
    for (unit, change) in CHANGES {
        for exponent in [-12, -8, -4, -1, 1, 4, 8, 12] {
            let units = change(power_of_ten(exponent));
            let run = move || same(&solve(units)?, &solve(SI)?);
            cases.push(Case::new(format!("{unit} 1e{exponent}"), run));
        }
    }
    cases
}

fn same(got: &Numbers, expected: &Numbers) -> Result<Finding> {
    let pairs = got.iter().zip(expected);
    let comparisons = pairs.map(|((quantity, got), (_, expected))| {
        Comparison::relative(quantity, *got, *expected, TOLERANCE)
    });
    Ok(Finding::of(&comparisons.collect::<Vec<_>>()))
}

impl Scene {
    fn new(units: Units) -> Result<Self> {
        let (length, time) = (units.length, units.time);
        let (pressure, force) = (units.force / length / length, 20.0 * units.force);
        let mut grid = GridOptions::new([0.1 * length; 2], Footprint::square(1.5 * length));
        // Two roundings of one scene end at the same digits only when the contact is solved so far.
        grid.contact.tolerance = 1e-12;
        Ok(Self {
            units,
            length,
            cone: RoundTippedCone::new(0.3 * length, 0.4)?,
            viscous: Viscous::new(50.0 * pressure * time)?,
            solid: StandardSolid::new(StandardSolidParameters {
                equilibrium_modulus: 3.0 * pressure,
                maxwell_modulus: 70.0 * pressure,
                viscosity: 50.0 * pressure * time,
            })?,
            force,
            load: SlidingLoad::new(force, 0.4 * length / time)?,
            times: [0.1, 1.0, 10.0].map(|moment| moment * time),
            grid,
        })
    }
}

fn theorems(scene: &Scene) -> Result<Numbers> {
    let Scene { length, cone, .. } = scene;
    let state = axisymmetric_sliding(cone, &scene.viscous, &scene.load)?;
    let contact = ElasticContact {
        contact_radius: 0.7 * length,
        velocity: 1e-3 * length / scene.units.time,
    };
    let limit = low_speed_friction(cone, &scene.solid, contact)?;
    Ok(vec![
        ("friction coefficient", state.friction_coefficient),
        ("depth", state.indentation_depth / length),
        ("contact length", state.contact_length() / length),
        ("friction of the limit", limit.half_space),
        ("force of the limit", limit.normal_force / scene.units.force),
    ])
}

fn line_stationary(scene: &Scene) -> Result<Numbers> {
    let line = EquivalentLine(&scene.cone);
    let state = steady(&line, &scene.solid, &scene.load, 1e-10)?;
    Ok(vec![
        ("friction coefficient", state.friction_coefficient.value),
        ("depth", state.indentation_depth.value / scene.length),
        ("front", state.contacts[0][1] / scene.length),
    ])
}

fn line_march(scene: &Scene) -> Result<Numbers> {
    let options = SlideOptions {
        spacing: 0.01 * scene.length,
        drift_tolerance: 1e-6,
        max_sliding_distance: 100.0 * scene.length,
    };
    let line = EquivalentLine(&scene.cone);
    let state = mdr_core::slide_on_grid(&line, &scene.solid, &scene.load, &options)?.last;
    Ok(vec![
        ("friction coefficient", state.friction_coefficient),
        ("depth", state.indentation_depth / scene.length),
        ("distance", state.sliding_distance / scene.length),
    ])
}

fn line_pressed(scene: &Scene) -> Result<Numbers> {
    let control = Control::NormalForce(scene.force);
    let steps = scene
        .times
        .map(|time| mdr_core::IndentStep { time, control });
    let line = EquivalentLine(&scene.cone);
    let rows = indent_history(&line, &scene.solid, &steps, 0.01 * scene.length)?;
    let depths = rows.iter().map(|row| row.indentation_depth / scene.length);
    Ok(depths.map(|depth| ("depth", depth)).collect())
}

fn half_space_stationary(scene: &Scene) -> Result<Numbers> {
    let options = StationaryOptions {
        // Any solution within the tolerance is right, so that it is smaller than what is asked of the invariance.
        tolerance: 1e-11,
        ..StationaryOptions::new(scene.grid.spacing, scene.grid.footprint)
    };
    let state = steady_on_grid(&scene.cone, &scene.solid, &scene.load, &options)?;
    Ok(vec![
        ("friction coefficient", state.friction_coefficient),
        ("depth", state.depth.reference_depth / scene.length),
    ])
}

fn half_space_march(scene: &Scene) -> Result<Numbers> {
    let load = scene.load.after(3.0 * scene.length)?;
    let state = slide_on_grid(&scene.cone, &scene.solid, &load, &scene.grid)?;
    let last = state.last();
    Ok(vec![
        ("friction coefficient", last.friction_coefficient),
        ("depth", last.indentation_depth / scene.length),
        ("area", last.contact_area / scene.length / scene.length),
    ])
}

fn half_space_pressed(scene: &Scene) -> Result<Numbers> {
    let steps = IndentStep::constant(Control::NormalForce(scene.force), &scene.times);
    let rows = indent_history_on_grid(&scene.cone, &scene.solid, &steps, &scene.grid)?;
    Ok(vec![
        ("depth", rows[2].indentation_depth / scene.length),
        ("area", rows[2].contact_area / scene.length / scene.length),
    ])
}
