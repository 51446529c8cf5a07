//! One convolution of a pressure with the influence coefficients, on square grids.

use std::hint::black_box;

use bem_halfspace::{BemError, Convolution, Grid};
use criterion::{Criterion, Throughput};

fn main() -> Result<(), BemError> {
    let mut criterion = Criterion::default().configure_from_args();
    for edge in [64, 256, 512] {
        convolution(&mut criterion, edge)?;
    }
    criterion.final_summary();
    Ok(())
}

fn convolution(criterion: &mut Criterion, edge: usize) -> Result<(), BemError> {
    let convolution = Convolution::new(&Grid::new([edge, edge], [1e-3; 2])?);
    let mut workspace = convolution.workspace();
    let pressure = vec![1.0; edge * edge];
    let mut displacement = vec![0.0; edge * edge];
    let mut group = criterion.benchmark_group("convolution");
    group.throughput(Throughput::Elements((edge * edge) as u64));
    group.bench_function(format!("{edge}x{edge}"), |bencher| {
        bencher.iter(|| {
            let pressure = black_box(&pressure[..]);
            convolution.apply(
                &mut workspace,
                (pressure, 0..edge),
                (&mut displacement, 0..edge),
            );
        });
    });
    group.finish();
    Ok(())
}
