//! A ball that adheres: a constant attraction where the gap is small, by an outer iteration around contacts without
//! adhesion, compared with the solution of Maugis (1992, J. Colloid Interface Sci. 150, 243).

#![expect(clippy::print_stdout, reason = "an example shows its results")]

use std::f64::consts::PI;

use bem_halfspace::{ContactOptions, ContactProblem, ContactState, Control};
use bem_halfspace::{Convolution, Grid, solve_contact};

/// Elements along an edge, and their edges, \[m].
const N: usize = 96;
const EDGE: f64 = 1.0 / 24.0;

fn main() -> Result<(), Box<dyn std::error::Error>> {
    // In Maugis' units π w = R = K = 1, K = 4E*/3, E* = 4/compliance; attraction acts to m times the radius of the contact.
    let (lambda, m, compliance) = (1.0, 1.25, 16.0 / 3.0);
    let (root, angle) = (f64::sqrt(m * m - 1.0), f64::acos(1.0 / m));
    let quadratic = 0.5 * lambda * (root + (m * m - 2.0) * angle);
    let linear = 4.0 / 3.0 * lambda * lambda * (root * angle - m + 1.0);
    let radius = (f64::sqrt(linear * linear + 4.0 * quadratic) - linear) / (2.0 * quadratic);
    let force = radius.powi(3) - lambda * radius * radius * (root + m * m * angle);
    let depth = radius * radius - 4.0 / 3.0 * lambda * radius * root;
    let (attraction, range) = (0.5 * lambda, 2.0 / (PI * lambda));
    let convolution = Convolution::new(&Grid::new([N; 2], [EDGE; 2])?);
    let place = |index: usize| (index as f64 - 0.5 * (N as f64 - 1.0)) * EDGE;
    let ball = |index: usize| 0.5 * (place(index / N).powi(2) + place(index % N).powi(2));
    let (mut work, mut state) = (convolution.workspace(), ContactState::new(&convolution));
    let [mut pull, mut raised] = [(); 2].map(|()| vec![0.0; N * N]);
    let mut held = f64::NEG_INFINITY;
    let contact = loop {
        convolution.apply(&mut work, &pull, &mut raised);
        let height = |index| ball(index) - compliance / (4.0 * PI) * raised[index];
        let problem = ContactProblem {
            convolution: &convolution,
            separation: &(0..N * N).map(height).collect::<Vec<f64>>(),
            compliance,
            largest_pressure: f64::INFINITY,
            control: Control::IndentationDepth(depth),
        };
        let contact = solve_contact(&problem, &mut state, &ContactOptions::default())?;
        // Attraction brings the surfaces closer, so that its area grows until it stays.
        for (pull, gap) in pull.iter_mut().zip(problem.gaps(&contact, &state)?) {
            *pull = if gap < range { attraction } else { *pull };
        }
        let now = pull.iter().sum::<f64>() * EDGE * EDGE;
        if std::mem::replace(&mut held, now) >= now {
            break contact;
        }
    };
    let [inner, outer] = [contact.n_contact as f64 * EDGE * EDGE, held / attraction];
    let [inner, outer] = [inner, outer].map(|area| (area / PI).sqrt());
    let (found, exact) = (contact.normal_force - held, m * radius);
    println!("F {found:.4} ({force:.4}), a {inner:.4} ({radius:.4}), c {outer:.4} ({exact:.4})");
    assert!((found - force).abs() < 0.01 * held, "force {found}");
    assert!((inner / radius - 1.0).abs() < 0.01, "contact {inner}");
    assert!((outer / exact - 1.0).abs() < 0.01, "attraction {outer}");
    Ok(())
}
