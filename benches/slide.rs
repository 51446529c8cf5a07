//! One transient of the paraboloid on the half space, from first touch, in front of its mirror and on both sides.

use std::error::Error;

use bem_halfspace::{Footprint, GridOptions, slide_on_grid};
use benches::report_error;
use criterion::Criterion;
use friction_analytic::{half_space_power_friction, power_sliding};
use indenters::{PowerProfile, SlidingLoad, Surface, Unmirrored};
use rheology::Viscous;

/// Elements along the contact length of the one-dimensional model.
const ELEMENTS: [f64; 3] = [10.0, 20.0, 40.0];
/// Contact lengths slid.
const LENGTHS: f64 = 8.0;
/// Larger than any change that a run of this length leaves.
const DRIFT_TOLERANCE: f64 = 0.5;

fn main() -> Result<(), Box<dyn Error>> {
    let mut criterion = Criterion::default().sample_size(10).configure_from_args();
    for elements in ELEMENTS {
        let body = PowerProfile::paraboloid(1.0)?;
        let name = format!("slide/{elements}");
        march(&mut criterion, &name, &body, elements)?;
        let name = format!("slide/{elements}/both sides");
        march(&mut criterion, &name, &Unmirrored(&body), elements)?;
    }
    criterion.final_summary();
    Ok(())
}

fn march(
    criterion: &mut Criterion,
    name: &str,
    surface: &impl Surface,
    elements: f64,
) -> Result<(), Box<dyn Error>> {
    let body = PowerProfile::paraboloid(1.0)?;
    let (material, load) = (Viscous::new(1.0)?, SlidingLoad::new(4.0, 1.0)?);
    let line = power_sliding(&body, &material, &load)?;
    let footprint = Footprint::sliding(&body, &material, &load)?;
    let options = GridOptions::new([line.contact_length() / elements; 2], footprint);
    let exact = half_space_power_friction(&body, &material, &load)?.value;
    let load = load.after(LENGTHS * line.contact_length())?;
    let run = || slide_on_grid(surface, &material, &load, &options);
    let transient = run()?;
    let last = transient.last().friction_coefficient;
    let limit = transient.stationary(DRIFT_TOLERANCE)?.friction_coefficient;
    report_error(name, "last friction coefficient", [last, exact]);
    report_error(name, "extrapolated friction coefficient", [limit, exact]);
    criterion.bench_function(name, |bencher| bencher.iter(run));
    Ok(())
}
