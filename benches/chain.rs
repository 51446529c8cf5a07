//! The chain of dashpots under a paraboloid, from first touch into the stationary state.

use std::error::Error;

use benches::report_error;
use criterion::Criterion;
use friction_analytic::power_sliding;
use indenters::{EquivalentLine, PowerProfile, SlidingLoad};
use mdr_core::{SlideOptions, slide_on_grid};
use rheology::Viscous;

fn main() -> Result<(), Box<dyn Error>> {
    let mut criterion = Criterion::default().configure_from_args();
    for elements in [100, 1000] {
        chain(&mut criterion, elements)?;
    }
    criterion.final_summary();
    Ok(())
}

fn chain(criterion: &mut Criterion, elements: usize) -> Result<(), Box<dyn Error>> {
    let body = PowerProfile::paraboloid(1.0)?;
    let (material, load) = (Viscous::new(1.0)?, SlidingLoad::new(4.0, 1.0)?);
    let options = SlideOptions::with_elements(elements, &EquivalentLine(&body), &material, &load)?;
    let run = || slide_on_grid(&EquivalentLine(&body), &material, &load, &options);
    let friction = run()?.last.friction_coefficient;
    let exact = power_sliding(&body, &material, &load)?.friction_coefficient;
    let name = format!("chain/{elements} elements");
    report_error(&name, "friction coefficient", [friction, exact]);
    let mut group = criterion.benchmark_group("chain");
    group.sample_size(20);
    group.bench_function(format!("{elements} elements"), |bencher| bencher.iter(run));
    group.finish();
    Ok(())
}
