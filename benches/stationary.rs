//! Stationary sliding of the paraboloid: one grid of three sizes, and friction to a relative error.

use std::error::Error;

use bem_halfspace::steady::SteadyOptions;
use bem_halfspace::{Footprint, steady, steady_on_grid};
use benches::report_error;
use criterion::Criterion;
use friction_analytic::{half_space_power_friction, power_sliding};
use indenters::{PowerProfile, SlidingLoad};
use rheology::Viscous;

/// Elements along the contact length of the one-dimensional model; the contact has about 2.2 times the square of it.
const ELEMENTS: [f64; 3] = [20.0, 60.0, 180.0];
/// Δy/Δx.
const ASPECT: f64 = 0.5;
const TOLERANCE: f64 = 1e-7;
const RELATIVE_ERROR: f64 = 1e-3;

fn main() -> Result<(), Box<dyn Error>> {
    let body = PowerProfile::paraboloid(1.0)?;
    let (material, load) = (Viscous::new(1.0)?, SlidingLoad::new(4.0, 1.0)?);
    let line = power_sliding(&body, &material, &load)?;
    let exact = half_space_power_friction(&body, &material, &load)?.value;
    let mut criterion = Criterion::default().sample_size(10).configure_from_args();
    for elements in ELEMENTS {
        let spacing = line.contact_length() / elements;
        let footprint = Footprint::sliding(&body, &material, &load)?;
        let options = SteadyOptions {
            tolerance: TOLERANCE,
            ..SteadyOptions::new([spacing, ASPECT * spacing], footprint)
        };
        let run = || steady_on_grid(&body, &material, &load, &options);
        let solution = run()?;
        let name = format!("stationary/{} unknowns", solution.unknowns);
        let friction = solution.friction_coefficient;
        report_error(&name, "friction coefficient", [friction, exact]);
        criterion.bench_function(&name, |bencher| bencher.iter(run));
    }
    let run = || steady(&body, &material, &load, RELATIVE_ERROR);
    let name = format!("stationary/friction to {RELATIVE_ERROR:e}");
    let friction = run()?.friction_coefficient.value;
    report_error(&name, "friction coefficient", [friction, exact]);
    criterion.bench_function(&name, |bencher| bencher.iter(run));
    criterion.final_summary();
    Ok(())
}
