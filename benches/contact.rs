//! Hertz contact of a paraboloid at a given force, from no pressure at all and from that of a smaller force, and contact
//! of a periodic rough surface.

use bem_halfspace::{BemError, ContactState};
use benches::{ContactScene, report_error, rough_heights};
use casebook::SquareContact;
use criterion::{BatchSize, BenchmarkGroup, Criterion, measurement::WallTime};

const TOLERANCE: f64 = 1e-9;

fn main() -> Result<(), BemError> {
    let mut criterion = Criterion::default().sample_size(10).configure_from_args();
    for edge in [128, 256, 512, 1024, 2048] {
        let mut scene = ContactScene::hertz(edge, 0.0)?;
        let unloaded = ContactState::new(&scene.convolution);
        let mut loaded = unloaded.clone();
        let force = scene.contact.force;
        scene.contact.force = 0.9 * force;
        let _smaller = scene.solve_from(&mut loaded, TOLERANCE)?;
        scene.contact.force = force;
        let depth = scene.solve(TOLERANCE)?.0.indentation_depth;
        let name = format!("contact/{edge}x{edge}");
        report_error(&name, "depth", [depth, SquareContact::HERTZ_DEPTH]);
        let mut group = criterion.benchmark_group(name);
        time(&mut group, ("cold", &unloaded), &scene);
        time(&mut group, ("warm", &loaded), &scene);
        group.finish();
    }
    for edge in [512, 1024] {
        let scene = ContactScene::periodic(rough_heights(edge))?;
        let (contact, _) = scene.solve(TOLERANCE)?;
        let name = format!("rough/{edge}x{edge}");
        let residual = [1.0 + contact.residual, 1.0];
        report_error(&name, "gap to the displacement", residual);
        let mut group = criterion.benchmark_group(name);
        let unloaded = ContactState::new(&scene.convolution);
        time(&mut group, ("cold", &unloaded), &scene);
        group.finish();
    }
    criterion.final_summary();
    Ok(())
}

fn time(
    group: &mut BenchmarkGroup<WallTime>,
    (name, state): (&str, &ContactState),
    scene: &ContactScene,
) {
    group.bench_function(name, |bencher| {
        let run = |mut state| scene.solve_from(&mut state, TOLERANCE);
        bencher.iter_batched(|| state.clone(), run, BatchSize::LargeInput);
    });
}
