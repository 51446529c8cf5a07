//! The contact solver costs the same number of iterations on every grid, and boxes and guesses change nothing.

use std::f64::consts::PI;

use bem_halfspace::{ContactOptions, ContactState, Control, Convolution, Grid};
use casebook::{COMPLIANCE, HERTZ_DEPTH, hertz_heights};

use crate::support::{Pressing, assert_near, difference};

const OPTIONS: ContactOptions = ContactOptions {
    tolerance: 1e-10,
    max_iterations: 200,
};
const FORCE: Control = Control::NormalForce(0.036);

/// Hertz contact of radius 0.3 on the unit square for E* = R = 1, apex between four elements.
fn hertz(n: usize) -> Pressing {
    let grid = Grid::new([n, n], [1.0 / n as f64; 2]).expect("a valid grid");
    Pressing {
        heights: hertz_heights(n, 0.0),
        compliance: COMPLIANCE,
        options: OPTIONS,
        ..Pressing::new(Convolution::new(&grid), |_| 0.0)
    }
}

#[test]
fn iterations_hardly_depend_on_the_grid() {
    let iterations = [128, 256, 512, 1024].map(|n| {
        let (contact, _) = hertz(n).solve(FORCE);
        // Second order in the depth: 0.09 (0.3/h)^-2 with a factor of order one.
        let ratio = contact.indentation_depth / HERTZ_DEPTH;
        assert_near(n, ratio, 1.0, 4.0 / (n * n) as f64);
        contact.iterations
    });
    // Guesses that end at one residual on all grids fail here: with them it is 12, 12, 15, 15.
    let [coarse, .., fine] = iterations;
    assert!(fine <= coarse + 2, "iterations {iterations:?}");
    // Sums over many elements do not end the convergence early: the residual falls to rounding.
    let mut body = hertz(512);
    (body.options.tolerance, body.options.max_iterations) = (1e-13, 60);
    let (contact, _) = body.solve(FORCE);
    assert!(contact.residual <= 1e-13, "{contact:?}");
}

/// Wrong guesses: one that lies elsewhere, one with numbers outside the contact that are negative, infinite or NaN, and one where
/// there is no body.
#[test]
fn the_guess_does_not_matter() {
    let mut body = hertz(96);
    body.heights[3] = f64::INFINITY;
    let guesses: [fn(&mut [f64]); 3] = [
        |pressure| pressure[..700].fill(1.0),
        |pressure| {
            (pressure[96 * 48 + 48], pressure[7]) = (1.0, f64::INFINITY);
            (pressure[96 * 47 + 2], pressure[5]) = (-1.0, f64::NAN);
        },
        |pressure| pressure[3] = 1.0,
    ];
    for control in [FORCE, Control::IndentationDepth(0.09)] {
        let (expected, cold) = body.solve(control);
        for guess in guesses {
            let mut warm = ContactState::new(&body.convolution);
            guess(warm.pressure_mut());
            let actual = body.solve_from(&mut warm, control).expect("a contact");
            assert_eq!(actual.n_contact, expected.n_contact, "{control:?}");
            let largest = cold.pressure().iter().copied().fold(0.0, f64::max);
            let error = difference(warm.pressure(), cold.pressure()) * largest;
            assert_near(control, error, 0.0, 1e-7 * expected.normal_force / 0.3);
            let again = body.solve_from(&mut warm, control).expect("a contact");
            assert!(again.iterations <= 1, "solved already: {again:?}");
        }
    }
}

/// The displacement is that of the pressure on the whole grid, and nothing penetrates outside the box either.
#[test]
fn distant_summits_are_found_outside_the_box() {
    let mut body = hertz(96);
    // Lower than the surface around the contact at the same place.
    let summits = [96 * 2 + 2, 96 * 90 + 50];
    for summit in summits {
        body.heights[summit] = 0.05;
    }
    let mut state = ContactState::new(&body.convolution);
    state.pressure_mut()[96 * 48 + 48] = 1.0;
    let contact = body.solve_from(&mut state, FORCE).expect("a contact");
    let pressures = summits.map(|summit| state.pressure()[summit]);
    assert!(pressures.iter().all(|p| *p > 0.0), "{pressures:?}");
    for (height, displacement) in body.heights.iter().zip(state.displacement()) {
        let gap = height + displacement - contact.indentation_depth;
        assert!(gap > -1e-10, "gap {gap}");
    }
}

/// Summits of sixteen elements and of different heights under a periodic load, which touch in more and more patches on
/// larger grids.
fn summits(n: usize) -> Pressing {
    let wave = |index: f64| (2.0 * PI * (index % 16.0) / 16.0).cos();
    let height = |[row, column]: [f64; 2]| {
        let summit = (row / 16.0).floor() * (n / 16) as f64 + (column / 16.0).floor();
        // Equally distributed (Weyl).
        let depth = (summit * 0.618_033_988_749_894_9).fract();
        depth + wave(row) + wave(column)
    };
    let grid = Grid::new([n, n], [1.0, 1.0]).expect("a valid grid");
    Pressing {
        compliance: 4.0,
        options: OPTIONS,
        ..Pressing::new(Convolution::periodic(&grid), height)
    }
}

#[test]
fn iterations_hardly_depend_on_the_number_of_patches() {
    let iterations = [64, 128, 256, 512].map(|n| {
        let (contact, _) = summits(n).solve(Control::NormalForce(0.008 * (n * n) as f64));
        let part = contact.n_contact as f64 / (n * n) as f64;
        assert!((0.05..0.08).contains(&part), "{n}: {part} in contact");
        contact.iterations
    });
    // A preconditioner without the coarse-space correction needs 18, 22, 26, 34.
    let [coarse, .., fine] = iterations;
    assert!(5 * fine <= 8 * coarse, "iterations {iterations:?}");
}
