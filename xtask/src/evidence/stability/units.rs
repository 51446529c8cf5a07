//! The same scene in other units: whatever has no dimension stays as it is.

use anyhow::Result;
use bem_halfspace::indent::{IndentStep, indent_history_on_grid};
use bem_halfspace::steady::SteadyOptions as StationaryOptions;
use bem_halfspace::{Footprint, GridOptions, slide_on_grid, steady_on_grid};
use friction_analytic::{ElasticContact, axisymmetric_sliding, low_speed_friction};
use indenters::{Control, EquivalentLine, RoundTippedCone, SlidingLoad};
use mdr_core::{SlideOptions, steady};
use rheology::{StandardSolid, StandardSolidParameters, Viscous};

use super::case::{Case, Comparison, Family, Finding, power_of_ten};

/// Dimensionless numbers of a method.
type Numbers = Vec<(&'static str, f64)>;

/// A method, which solves the scene in other units.
type Method = fn(Units) -> Result<Numbers>;

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
    let mut cases = Vec::new();
    for unit in ["length", "time", "force"] {
        for exponent in [-12, -8, -4, -1, 1, 4, 8, 12] {
            let [length, time, force] = ["length", "time", "force"].map(|kind| {
                if kind == unit {
                    power_of_ten(exponent)
                } else {
                    1.0
                }
            });
            let units = Units {
                length,
                time,
                force,
            };
            let run = move || same(&method(units)?, &method(SI)?);
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

impl Units {
    fn pressure(self) -> f64 {
        self.force / self.length / self.length
    }

    fn cone(self) -> Result<RoundTippedCone> {
        Ok(RoundTippedCone::new(0.3 * self.length, 0.4)?)
    }

    fn viscous(self) -> Result<Viscous> {
        Ok(Viscous::new(50.0 * self.pressure() * self.time)?)
    }

    fn solid(self) -> Result<StandardSolid> {
        Ok(StandardSolid::new(StandardSolidParameters {
            equilibrium_modulus: 3.0 * self.pressure(),
            maxwell_modulus: 70.0 * self.pressure(),
            viscosity: 50.0 * self.pressure() * self.time,
        })?)
    }

    fn force(self) -> f64 {
        20.0 * self.force
    }

    fn load(self) -> Result<SlidingLoad> {
        let velocity = 0.4 * self.length / self.time;
        Ok(SlidingLoad::new(self.force(), velocity)?)
    }

    fn times(self) -> [f64; 3] {
        [0.1, 1.0, 10.0].map(|time| time * self.time)
    }

    fn grid(self) -> GridOptions {
        let footprint = Footprint::square(1.5 * self.length);
        let mut options = GridOptions::new([0.1 * self.length; 2], footprint);
        // Two roundings of one scene end at the same digits only when the contact is solved so far.
        options.contact.tolerance = 1e-12;
        options
    }
}

fn theorems(units: Units) -> Result<Numbers> {
    let cone = units.cone()?;
    let state = axisymmetric_sliding(&cone, &units.viscous()?, &units.load()?)?;
    let contact = ElasticContact {
        contact_radius: 0.7 * units.length,
        velocity: 1e-3 * units.length / units.time,
    };
    let limit = low_speed_friction(&cone, &units.solid()?, contact)?;
    Ok(vec![
        ("friction coefficient", state.friction_coefficient),
        ("depth", state.indentation_depth / units.length),
        ("contact length", state.contact_length() / units.length),
        ("friction of the limit", limit.half_space),
        ("force of the limit", limit.normal_force / units.force),
    ])
}

fn line_stationary(units: Units) -> Result<Numbers> {
    let cone = units.cone()?;
    let state = steady(
        &EquivalentLine(&cone),
        &units.solid()?,
        &units.load()?,
        1e-10,
    )?;
    Ok(vec![
        ("friction coefficient", state.friction_coefficient.value),
        ("depth", state.indentation_depth.value / units.length),
        ("front", state.contacts[0][1] / units.length),
    ])
}

fn line_march(units: Units) -> Result<Numbers> {
    let options = SlideOptions {
        spacing: 0.01 * units.length,
        drift_tolerance: 1e-6,
        max_sliding_distance: 100.0 * units.length,
    };
    let cone = units.cone()?;
    let state = mdr_core::slide_on_grid(
        &EquivalentLine(&cone),
        &units.solid()?,
        &units.load()?,
        &options,
    )?
    .last;
    Ok(vec![
        ("friction coefficient", state.friction_coefficient),
        ("depth", state.indentation_depth / units.length),
        ("distance", state.sliding_distance / units.length),
    ])
}

fn line_pressed(units: Units) -> Result<Numbers> {
    let cone = units.cone()?;
    let force = units.force();
    let steps = units.times().map(|time| mdr_core::IndentStep {
        time,
        control: Control::NormalForce(force),
    });
    let rows = mdr_core::indent_history(
        &EquivalentLine(&cone),
        &units.solid()?,
        &steps,
        0.01 * units.length,
    )?;
    let depths = rows.iter().map(|row| row.indentation_depth / units.length);
    Ok(depths.map(|depth| ("depth", depth)).collect())
}

fn half_space_stationary(units: Units) -> Result<Numbers> {
    let grid = units.grid();
    let options = StationaryOptions {
        // Any solution within the tolerance is right, so that it is smaller than what is asked of the invariance.
        tolerance: 1e-11,
        ..StationaryOptions::new(grid.spacing, grid.footprint)
    };
    let state = steady_on_grid(&units.cone()?, &units.solid()?, &units.load()?, &options)?;
    Ok(vec![
        ("friction coefficient", state.friction_coefficient),
        ("depth", state.depth.reference_depth / units.length),
    ])
}

fn half_space_march(units: Units) -> Result<Numbers> {
    let load = units.load()?.after(3.0 * units.length)?;
    let state = slide_on_grid(&units.cone()?, &units.solid()?, &load, &units.grid())?;
    let last = state.last();
    Ok(vec![
        ("friction coefficient", last.friction_coefficient),
        ("depth", last.indentation_depth / units.length),
        ("area", last.contact_area / units.length / units.length),
    ])
}

fn half_space_pressed(units: Units) -> Result<Numbers> {
    let steps = IndentStep::constant(Control::NormalForce(units.force()), &units.times());
    let rows = indent_history_on_grid(&units.cone()?, &units.solid()?, &steps, &units.grid())?;
    Ok(vec![
        ("depth", rows[2].indentation_depth / units.length),
        ("area", rows[2].contact_area / units.length / units.length),
    ])
}
