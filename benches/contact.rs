//! Hertz contact of a paraboloid at a given force, from no pressure at all and from that of a smaller force, and contact
//! of a periodic rough surface.

use bem_halfspace::{
    BemError, Contact, ContactOptions, ContactProblem, ContactState, Control, Convolution, Grid,
    solve_contact,
};
use benches::{report_error, self_affine};
use criterion::{BatchSize, Criterion};

/// Half the edge of the grid over the contact radius.
const MARGIN: f64 = 1.5;

fn main() -> Result<(), BemError> {
    let mut criterion = Criterion::default().configure_from_args();
    for edge in [128, 256, 512, 1024, 2048] {
        hertz(&mut criterion, edge)?;
    }
    for edge in [512, 1024] {
        rough(&mut criterion, edge)?;
    }
    criterion.final_summary();
    Ok(())
}

/// The paraboloid h = r² on a half space of shear modulus 1, with the depth 2: contact radius 1, force 32/3.
fn hertz(criterion: &mut Criterion, edge: usize) -> Result<(), BemError> {
    let spacing = 2.0 * MARGIN / edge as f64;
    let convolution = Convolution::new(&Grid::new([edge; 2], [spacing; 2])?);
    let heights = heights(edge, spacing);
    let at_force = |force: f64| ContactProblem {
        convolution: &convolution,
        separation: &heights,
        compliance: 1.0,
        control: Control::NormalForce(force),
    };
    let force = 32.0 / 3.0;
    let unloaded = ContactState::new(&convolution);
    let mut loaded = unloaded.clone();
    let _smaller = solve(&at_force(0.9 * force), &mut loaded)?;
    let depth = solve(&at_force(force), &mut loaded.clone())?.indentation_depth;
    let name = format!("contact/{edge}x{edge}");
    report_error(&name, "depth", [depth, 2.0]);
    let mut group = criterion.benchmark_group(name);
    group.sample_size(10);
    for (start, state) in [("cold", unloaded), ("warm", loaded)] {
        group.bench_function(start, |bencher| {
            let problem = at_force(force);
            let run = |mut state| solve(&problem, &mut state);
            bencher.iter_batched(|| state.clone(), run, BatchSize::LargeInput);
        });
    }
    group.finish();
    Ok(())
}

/// The rough surface on a half space of shear modulus 1/4, E* = 1, with a tenth of the area in contact.
fn rough(criterion: &mut Criterion, edge: usize) -> Result<(), BemError> {
    let convolution = Convolution::periodic(&Grid::new([edge; 2], [1.0 / edge as f64; 2])?);
    let heights: Vec<f64> = self_affine(edge).iter().map(|summit| -summit).collect();
    let problem = ContactProblem {
        convolution: &convolution,
        separation: &heights,
        compliance: 4.0,
        control: Control::NormalForce(0.05),
    };
    let unloaded = ContactState::new(&convolution);
    let contact = solve(&problem, &mut unloaded.clone())?;
    let name = format!("rough/{edge}x{edge}");
    let residual = [1.0 + contact.residual, 1.0];
    report_error(&name, "gap to the displacement", residual);
    let mut group = criterion.benchmark_group(name);
    group.sample_size(10);
    group.bench_function("cold", |bencher| {
        let run = |mut state| solve(&problem, &mut state);
        bencher.iter_batched(|| unloaded.clone(), run, BatchSize::LargeInput);
    });
    group.finish();
    Ok(())
}

fn solve(problem: &ContactProblem, state: &mut ContactState) -> Result<Contact, BemError> {
    solve_contact(problem, state, &ContactOptions::default())
}

fn heights(edge: usize, spacing: f64) -> Vec<f64> {
    let centre = |index: usize| (index as f64 + 0.5) * spacing - MARGIN;
    let height = |index: usize| centre(index / edge).powi(2) + centre(index % edge).powi(2);
    (0..edge * edge).map(height).collect()
}
