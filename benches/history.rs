//! Pressing and pulling back a paraboloid: 1000 segments on a material with 10 branches, and the derivatives of the force on
//! a standard solid, as a fit needs them.

use std::error::Error;

use benches::report_error;
use criterion::Criterion;
use indenters::{Control, HistoryPoint, PowerProfile};
use mdr_core::{HistoryOptions, force_derivatives, indent_along};
use rheology::{Prony, RelaxationBranch, RelaxationSpectrum};

/// 8 ∫ G(1 − s) √(0.01 s) 0.01 ds by quadrature with 40 digits (mpmath 1.3).
const PEAK: f64 = 0.042_091_691_145_751_2;

fn main() -> Result<(), Box<dyn Error>> {
    let mut criterion = Criterion::default().configure_from_args();
    let body = PowerProfile::paraboloid(0.5)?;
    let branch =
        |decade: f64| RelaxationBranch::new(1.0 + 0.1 * decade, 10.0_f64.powf(-2.5 + 0.4 * decade));
    let branches = (0..10).map(f64::from).map(branch).collect();
    let material = Prony::new(RelaxationSpectrum::new(1.0, 0.0, branches)?)?;
    let point = |index: i32| {
        let time = f64::from(index) / 500.0;
        HistoryPoint {
            time,
            control: Control::IndentationDepth(0.01 * time.min(2.0 - time)),
        }
    };
    let history: Vec<HistoryPoint> = (0..=1000).map(point).collect();
    let run = || indent_along(&body, &material, &history, &HistoryOptions::default());
    let peak = run()?[500].normal_force.value;
    report_error("history/1000 segments", "peak force", [peak, PEAK]);
    let mut group = criterion.benchmark_group("history");
    group.bench_function("1000 segments, 10 branches", |bencher| bencher.iter(run));
    let branch = RelaxationBranch::new(4.0, 1.0);
    let solid = Prony::new(RelaxationSpectrum::new(1.0, 0.0, vec![branch])?)?;
    let differentiate = || force_derivatives(&body, &solid, &history);
    // Casebook-2.json, sphere on SLS at t = 1.
    report_error(
        "history/derivatives",
        "peak force",
        [differentiate()?.normal_force[500], 0.020_114_789_112_124_74],
    );
    group.bench_function("1000 segments, standard solid, derivatives", |bencher| {
        bencher.iter(differentiate);
    });
    group.finish();
    criterion.final_summary();
    Ok(())
}
