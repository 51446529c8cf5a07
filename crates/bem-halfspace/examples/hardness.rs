//! A ball on a surface that yields at its hardness: Hertz's contact up to the first yield, and the force over the hardness
//! as its area when it is deep.

#![expect(clippy::print_stdout, reason = "an example shows its results")]

use std::f64::consts::PI;

use bem_halfspace::{BemError, Contact, ContactOptions, ContactProblem, ContactState, Control};
use bem_halfspace::{Convolution, Grid, solve_contact};

/// Elements along an edge, and their edges, \[m].
const N: usize = 96;
const EDGE: f64 = 1.0 / 15.0;

fn main() -> Result<(), Box<dyn std::error::Error>> {
    let convolution = Convolution::new(&Grid::new([N; 2], [EDGE; 2])?);
    let place = |index: usize| (index as f64 - 0.5 * (N as f64 - 1.0)) * EDGE;
    let ball = |index: usize| 0.5 * (place(index / N).powi(2) + place(index % N).powi(2));
    let ball: Vec<f64> = (0..N * N).map(ball).collect();
    // On 1 Pa Hertz's contact of the force 16/3 N has the radius 1 m, and the largest pressure 8/π Pa.
    let hardness = 8.0 / PI;
    let at_yield = 16.0 / 3.0;
    let press = |force: f64| -> Result<(Contact, f64), BemError> {
        let problem = ContactProblem {
            convolution: &convolution,
            separation: &ball,
            compliance: 1.0,
            largest_pressure: hardness,
            control: Control::NormalForce(force),
        };
        let mut state = ContactState::new(&convolution);
        let contact = solve_contact(&problem, &mut state, &ContactOptions::default())?;
        let gaps = problem.gaps(&contact, &state)?;
        Ok((contact, -gaps.into_iter().fold(0.0, f64::min)))
    };
    for part in [0.5, 0.9, 2.0, 10.0] {
        let force = part * at_yield;
        let (contact, imprint) = press(force)?;
        let hertz = part.powf(2.0 / 3.0);
        let mean = force / (contact.n_contact as f64 * EDGE * EDGE);
        let (part_of_it, depth) = (mean / hardness, contact.indentation_depth);
        println!(
            "{part} of the force at yield: pressure {part_of_it:.3} H, imprint {imprint:.4} m, {depth:.4} m deep"
        );
        assert!(contact.n_at_limit > 0 || part < 1.0, "it yields");
        assert!(mean <= hardness, "the hardness is not exceeded");
        if part < 1.0 {
            let error = (depth / hertz - 1.0).abs();
            assert!(contact.n_at_limit == 0 && error < 5e-3, "Hertz, {error}");
        } else if part > 5.0 {
            assert!(mean > 0.97 * hardness, "all of it has yielded");
        }
    }
    Ok(())
}
