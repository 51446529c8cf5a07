//! One transient of the paraboloid on the half space, from first touch.

use std::error::Error;

use bem_halfspace::slide::{SlideOptions, slide};
use bem_halfspace::{ContactOptions, Footprint};
use benches::report_error;
use criterion::Criterion;
use friction_analytic::power_sliding;
use indenters::{PowerProfile, SlidingLoad};
use rheology::Viscous;

/// Elements along the contact length of the one-dimensional model, and contact lengths slid.
const ELEMENTS: f64 = 10.0;
const LENGTHS: f64 = 8.0;
/// Converged ratio s₂ of the friction on the half space to that on the line, from `docs/figures/scaling_factors.csv`,
/// which puts its error at 6.3e-5.
const SCALING_FACTOR: f64 = 0.69955;
/// Larger than any change that a run of this length leaves.
const DRIFT_TOLERANCE: f64 = 0.5;

fn main() -> Result<(), Box<dyn Error>> {
    let body = PowerProfile::paraboloid(1.0)?;
    let (material, load) = (Viscous::new(1.0)?, SlidingLoad::new(4.0, 1.0)?);
    let line = power_sliding(&body, &material, &load)?;
    let options = SlideOptions {
        spacing: [line.contact_length() / ELEMENTS; 2],
        footprint: Footprint::of_body(&body, &material, &load)?,
        sliding_distance: LENGTHS * line.contact_length(),
        contact: ContactOptions::default(),
    };
    let run = || slide(&body, &material, &load, &options);
    let transient = run()?;
    let exact = SCALING_FACTOR * line.friction_coefficient;
    let name = format!("slide/{ELEMENTS} elements/{LENGTHS} lengths");
    let last = transient.last().friction_coefficient;
    let limit = transient.stationary(DRIFT_TOLERANCE)?.friction_coefficient;
    report_error(&name, "last friction coefficient", [last, exact]);
    report_error(&name, "extrapolated friction coefficient", [limit, exact]);
    let mut criterion = Criterion::default().sample_size(10).configure_from_args();
    criterion.bench_function("slide", |bencher| bencher.iter(run));
    criterion.final_summary();
    Ok(())
}
