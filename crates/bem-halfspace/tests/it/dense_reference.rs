//! The contact solver finds the solution of a dense active-set method on bodies without symmetry.
//!
//! The reference factorises the influence matrix of the contact (faer) and changes the active set until there is neither
//! tension nor penetration; it shares only the influence coefficient with the solver.

use bem_halfspace::{Control, influence};
use faer::linalg::solvers::Solve;
use faer::{Mat, Side};

use crate::support::{Pressing, difference};

/// Two bumps of different height and an inclined, wavy ground.
fn heights(n: usize) -> Vec<f64> {
    let height = |index: usize| {
        let (x, y) = ((index / n) as f64 - 4.0, (index % n) as f64 - 3.0);
        let far = ((x - 6.0).powi(2) + 2.0 * (y - 7.0).powi(2)).mul_add(0.03, 0.15);
        (0.02 * (x * x + 1.5 * y * y + x * y)).min(far) + 0.01 * (x + 2.0 * y).sin()
    };
    (0..n * n).map(height).collect()
}

fn coefficient(n: usize, to: usize, from: usize) -> f64 {
    let distance = |a: usize, b: usize| a as f64 - b as f64;
    let offset = [distance(to / n, from / n), distance(to % n, from % n)];
    influence(offset, [1.0, 1.0]) / (4.0 * std::f64::consts::PI)
}

/// Pressures at the given depth.
fn dense_solution(heights: &[f64], n: usize, depth: f64) -> Vec<f64> {
    let mut contact: Vec<usize> = (0..n * n).filter(|&to| heights[to] < depth).collect();
    for _ in 0..100 {
        let size = contact.len();
        let entry = |i: usize, j: usize| coefficient(n, contact[i], contact[j]);
        let right = Mat::from_fn(size, 1, |i, _| depth - heights[contact[i]]);
        let factors = Mat::from_fn(size, size, entry).llt(Side::Lower);
        let solution = factors.expect("positive definite").solve(&right);
        let mut pressure = vec![0.0; n * n];
        for (i, &element) in contact.iter().enumerate() {
            pressure[element] = solution[(i, 0)];
        }
        let gap = |to: usize| {
            let displacements = contact
                .iter()
                .map(|&from| coefficient(n, to, from) * pressure[from]);
            heights[to] + displacements.sum::<f64>() - depth
        };
        let is_next = |element: &usize| {
            if contact.contains(element) {
                pressure[*element] > 0.0
            } else {
                gap(*element) < 0.0
            }
        };
        let next: Vec<usize> = (0..n * n).filter(is_next).collect();
        if next == contact {
            return pressure;
        }
        contact = next;
    }
    panic!("the reference did not find its active set");
}

#[test]
fn several_patches_without_symmetry() {
    let n = 16;
    let heights = heights(n);
    let body = Pressing::on_unit_elements([n, n], &heights);
    for depth in [0.02, 0.3, 0.9] {
        let expected = dense_solution(&heights, n, depth);
        let force: f64 = expected.iter().sum();
        for control in [
            Control::IndentationDepth(depth),
            Control::NormalForce(force),
        ] {
            let (contact, state) = body.solve(control);
            let error = (contact.indentation_depth / depth - 1.0).abs();
            assert!(error < 1e-10, "{control:?}: {contact:?} instead of {depth}");
            // Relative to the largest pressure, which is less than the force on unit elements.
            let error = difference(state.pressure(), &expected);
            assert!(error < 1e-10, "{control:?}: pressure off by {error:e}");
        }
    }
}
