//! Archard's wear of a ball that slides under a constant force: the depth worn off grows by k p per distance.

#![expect(clippy::print_stdout, reason = "an example shows its results")]

use std::f64::consts::PI;

use bem_halfspace::{ContactOptions, ContactProblem, ContactState, Control};
use bem_halfspace::{Convolution, Grid, solve_contact};

/// Elements along an edge, and their edges, \[m].
const N: usize = 48;
const EDGE: f64 = 1.0 / 60.0;

fn main() -> Result<(), Box<dyn std::error::Error>> {
    // A ball of 1 m on a half space of 1 Pa; Hertz's contact has the radius 0.1 m.
    let (hertz, compliance) = (0.1_f64, 1.0);
    let force = 16.0 * hertz.powi(3) / (3.0 * compliance);
    let convolution = Convolution::new(&Grid::new([N; 2], [EDGE; 2])?);
    let place = |index: usize| (index as f64 - 0.5 * (N as f64 - 1.0)) * EDGE;
    let ball = |index: usize| 0.5 * (place(index / N).powi(2) + place(index % N).powi(2));
    let mut heights: Vec<f64> = (0..N * N).map(ball).collect();
    let (mut state, options) = (ContactState::new(&convolution), ContactOptions::default());
    // k Δs: a pressure of the shortest wave must not be worn off by more than itself in one step.
    let (step, n_steps) = (0.8 * compliance * EDGE / (PI * 2.0_f64.sqrt()), 400);
    for _ in 0..n_steps {
        let problem = ContactProblem {
            convolution: &convolution,
            separation: &heights,
            compliance,
            largest_pressure: f64::INFINITY,
            control: Control::NormalForce(force),
        };
        let _contact = solve_contact(&problem, &mut state, &options)?;
        for (height, pressure) in heights.iter_mut().zip(state.pressure()) {
            *height += step * pressure;
        }
    }
    // The volume is k F s exactly, and a cap of it of the radius a has the volume π a⁴/4.
    let worn = step * f64::from(n_steps) * force;
    let volume = (0..N * N).map(|index| heights[index] - ball(index));
    let volume = volume.sum::<f64>() * EDGE * EDGE;
    let cap = (4.0 * PI * worn).sqrt();
    let area = state.contact().len() as f64 * EDGE * EDGE;
    let middle = state.pressure()[N / 2 * N + N / 2] * area / force;
    println!(
        "volume {volume:.6e} m³, k F s {worn:.6e} m³; area {area:.4} m², of the cap {cap:.4} m²"
    );
    println!("pressure in the middle {middle:.3} of the mean, 1.5 in Hertz's contact");
    assert!((volume / worn - 1.0).abs() < 1e-9, "the volume is exact");
    // What is elastic is (0.1 m / a)³ of the cap.
    assert!((area / cap - 1.0).abs() < 0.03, "a cap is worn off");
    assert!((middle - 1.0).abs() < 0.05, "the pressure is uniform");
    Ok(())
}
