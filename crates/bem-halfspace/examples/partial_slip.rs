//! Partial slip of a ball by two normal contacts (Cattaneo 1938, Mindlin 1949; Jäger 1998, Ciavarella 1998): under a
//! tangential force Q below f F the traction is `q = f [p(F) − p(F − Q/f)]`, and the second contact is the area that sticks.

#![expect(clippy::print_stdout, reason = "an example shows its results")]

use std::f64::consts::PI;

use bem_halfspace::{BemError, ContactOptions, ContactProblem, ContactState, Control};
use bem_halfspace::{Convolution, Grid, solve_contact};

/// Elements along an edge, and their edges, \[m].
const N: usize = 96;
const EDGE: f64 = 1.0 / 40.0;

fn main() -> Result<(), Box<dyn std::error::Error>> {
    let convolution = Convolution::new(&Grid::new([N; 2], [EDGE; 2])?);
    let place = |index: usize| (index as f64 - 0.5 * (N as f64 - 1.0)) * EDGE;
    let distance = |index: usize| place(index / N).hypot(place(index % N));
    let height = |index| 0.5 * distance(index).powi(2);
    let ball: Vec<f64> = (0..N * N).map(height).collect();
    let pressures = |force: f64| -> Result<(Vec<f64>, f64), BemError> {
        let problem = ContactProblem {
            convolution: &convolution,
            separation: &ball,
            compliance: 1.0,
            largest_pressure: f64::INFINITY,
            control: Control::NormalForce(force),
        };
        let mut state = ContactState::new(&convolution);
        let contact = solve_contact(&problem, &mut state, &ContactOptions::default())?;
        let area = contact.n_contact as f64 * EDGE * EDGE;
        Ok((state.pressure().to_vec(), (area / PI).sqrt()))
    };
    // The contact has the radius 1 m.
    let (force, friction, tangential_force) = (16.0 / 3.0, 0.3, 0.8);
    let (pressure, _) = pressures(force)?;
    let (less, stick) = pressures(force - tangential_force / friction)?;
    let pairs = pressure.iter().zip(&less);
    let traction: Vec<f64> = pairs.map(|(p, less)| friction * (p - less)).collect();

    let sum = traction.iter().sum::<f64>() * EDGE * EDGE;
    let radius = (1.0 - tangential_force / (friction * force)).cbrt();
    let half_sphere = |size: f64, r: f64| (size * size - r * r).max(0.0).sqrt();
    let peak = friction * 1.5 * force / PI;
    let exact = |r: f64| peak * (half_sphere(1.0, r) - half_sphere(radius, r));
    // Beside an edge the traction has an infinite slope, and an element only its mean.
    let near = |r: f64, edge: f64| (r - edge).abs() < 1.5 * EDGE;
    let is_beside = |r: f64| near(r, 1.0) || near(r, radius);
    let elements = (0..N * N).filter(|index| !is_beside(distance(*index)));
    let errors = elements.map(|index| (traction[index] - exact(distance(index))).abs());
    let error = errors.fold(0.0, f64::max) / peak;
    println!("stick radius {stick:.4} m, exact {radius:.4} m; traction off by {error:.1e} f p₀");
    assert!((sum / tangential_force - 1.0).abs() < 1e-9, "Q = {sum}");
    assert!((stick / radius - 1.0).abs() < 0.01, "radius {stick}");
    assert!(error < 5e-3, "traction {error}");
    Ok(())
}
