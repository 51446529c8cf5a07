//! The contact solver costs the same number of iterations on every grid, and boxes and guesses change nothing.

use std::f64::consts::PI;

use bem_halfspace::{
    Contact, ContactOptions, ContactProblem, ContactState, Control, Convolution, Grid,
    solve_contact,
};

const OPTIONS: ContactOptions = ContactOptions {
    tolerance: 1e-10,
    max_iterations: 200,
};

/// Hertz contact of radius 0.3 on the unit square for E* = R = 1, apex between four elements.
fn hertz(n: usize) -> (Convolution, Vec<f64>) {
    let edge = 1.0 / n as f64;
    let centre = |index: usize| (index as f64 + 0.5) * edge - 0.5;
    let height = |index: usize| 0.5 * (centre(index / n).powi(2) + centre(index % n).powi(2));
    let grid = Grid::new([n, n], [edge; 2]).expect("a valid grid");
    (Convolution::new(&grid), (0..n * n).map(height).collect())
}

fn solve(
    (convolution, heights): (&Convolution, &[f64]),
    state: &mut ContactState,
    control: Control,
) -> Contact {
    let problem = ContactProblem {
        convolution,
        separation: heights,
        compliance: 4.0,
        control,
    };
    solve_contact(&problem, state, &OPTIONS).expect("a contact")
}

#[test]
fn iterations_hardly_depend_on_the_grid() {
    let iterations = [128, 256, 512, 1024].map(|n| {
        let (convolution, heights) = hertz(n);
        let mut state = ContactState::new(&convolution);
        let force = Control::NormalForce(0.036);
        let contact = solve((&convolution, &heights), &mut state, force);
        // Second order in the depth: 0.09 (0.3/h)^-2 with a factor of order one.
        let error = (contact.indentation_depth / 0.09 - 1.0).abs();
        assert!(error < 4.0 / (n * n) as f64, "{n}: {contact:?}");
        contact.iterations
    });
    // Guesses that end at one residual on all grids fail here: with them it is 12, 12, 15, 15.
    let [coarse, .., fine] = iterations;
    assert!(fine <= coarse + 2, "iterations {iterations:?}");
}

/// Sums over many elements do not end the convergence early.
#[test]
fn the_residual_falls_to_rounding() {
    let (convolution, heights) = hertz(512);
    let mut state = ContactState::new(&convolution);
    let problem = ContactProblem {
        convolution: &convolution,
        separation: &heights,
        compliance: 4.0,
        control: Control::NormalForce(0.036),
    };
    let options = ContactOptions {
        tolerance: 1e-13,
        max_iterations: 60,
    };
    let contact = solve_contact(&problem, &mut state, &options).expect("a contact");
    assert!(contact.residual <= 1e-13, "{contact:?}");
}

/// Guesses that are wrong: one that lies elsewhere, numbers that are no pressures beside the contact, and one where
/// there is no body.
#[test]
fn the_guess_does_not_matter() {
    let (convolution, mut heights) = hertz(96);
    heights[3] = f64::INFINITY;
    let problem = (&convolution, &heights[..]);
    let elsewhere = |pressure: &mut [f64]| pressure[..700].fill(1.0);
    let no_pressures = |pressure: &mut [f64]| {
        pressure[96 * 48 + 48] = 1.0;
        (pressure[96 * 47 + 2], pressure[5]) = (-1.0, f64::NAN);
        pressure[7] = f64::INFINITY;
    };
    let no_body = |pressure: &mut [f64]| pressure[3] = 1.0;
    for control in [Control::NormalForce(0.036), Control::IndentationDepth(0.09)] {
        check_guess(problem, control, elsewhere);
        check_guess(problem, control, no_pressures);
        check_guess(problem, control, no_body);
    }
}

fn check_guess(problem: (&Convolution, &[f64]), control: Control, guess: impl Fn(&mut [f64])) {
    let mut cold = ContactState::new(problem.0);
    let expected = solve(problem, &mut cold, control);
    let mut warm = ContactState::new(problem.0);
    guess(warm.pressure_mut());
    let actual = solve(problem, &mut warm, control);
    assert_eq!(actual.n_contact, expected.n_contact, "{control:?}");
    let scale = expected.normal_force / 0.3;
    for (actual, expected) in warm.pressure().iter().zip(cold.pressure()) {
        let error = (actual - expected).abs() / scale;
        assert!(error < 1e-7, "{control:?}: {actual} instead of {expected}");
    }
    let again = solve(problem, &mut warm, control);
    assert!(again.iterations <= 1, "solved already: {again:?}");
}

/// A guess with load only where there is no body, on a grid too small for a box.
#[test]
fn a_guess_without_a_body_counts_as_none() {
    let mut heights = [0.0; 16];
    heights[0] = f64::INFINITY;
    let convolution = Convolution::new(&Grid::new([4; 2], [1.0; 2]).expect("a valid grid"));
    let mut state = ContactState::new(&convolution);
    state.pressure_mut()[0] = 1.0;
    let contact = solve(
        (&convolution, &heights),
        &mut state,
        Control::NormalForce(1.0),
    );
    assert_eq!(contact.n_contact, 15, "{contact:?}");
    assert!((contact.normal_force - 1.0).abs() < 1e-14, "{contact:?}");
}

/// The displacement is that of the pressure on the whole grid, and nothing penetrates outside the box either.
#[test]
fn distant_summits_are_found_outside_the_box() {
    let (convolution, mut heights) = hertz(96);
    // Lower than the surface around the contact at the same place.
    let summits = [96 * 2 + 2, 96 * 90 + 50];
    for summit in summits {
        heights[summit] = 0.05;
    }
    let mut state = ContactState::new(&convolution);
    state.pressure_mut()[96 * 48 + 48] = 1.0;
    let control = Control::NormalForce(0.036);
    let contact = solve((&convolution, &heights), &mut state, control);
    for summit in summits {
        assert!(
            state.pressure()[summit] > 0.0,
            "summit {summit} carries load"
        );
    }
    for (height, displacement) in heights.iter().zip(state.displacement()) {
        let gap = height + displacement - contact.indentation_depth;
        assert!(gap > -1e-10, "gap {gap}");
    }
}

/// Summits of sixteen elements and of different heights under a periodic load, which touch in more and more patches on
/// larger grids.
fn summits(n: usize) -> Vec<f64> {
    let wave = |index: usize| (2.0 * PI * (index % 16) as f64 / 16.0).cos();
    let height = |index: usize| {
        let [row, column] = [index / n, index % n];
        let summit = row / 16 * (n / 16) + column / 16;
        // Equally distributed (Weyl).
        let depth = (summit as f64 * 0.618_033_988_749_894_9).fract();
        depth + wave(row) + wave(column)
    };
    (0..n * n).map(height).collect()
}

#[test]
fn iterations_hardly_depend_on_the_number_of_patches() {
    let iterations = [64, 128, 256, 512].map(|n| {
        let grid = Grid::new([n, n], [1.0, 1.0]).expect("a valid grid");
        let convolution = Convolution::periodic(&grid);
        let mut state = ContactState::new(&convolution);
        let force = Control::NormalForce(0.008 * (n * n) as f64);
        let contact = solve((&convolution, &summits(n)), &mut state, force);
        let part = contact.n_contact as f64 / (n * n) as f64;
        assert!((0.05..0.08).contains(&part), "{n}: {part} in contact");
        contact.iterations
    });
    // An inverse that knows nothing of other patches needs 18, 22, 26, 34.
    let [coarse, .., fine] = iterations;
    assert!(5 * fine <= 8 * coarse, "iterations {iterations:?}");
}
