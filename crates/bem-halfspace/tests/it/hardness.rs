//! A largest pressure: the conditions of the contact hold with it, the solution is that of another method and of closed
//! forms, and what is read off a contact is right.

use bem_halfspace::{Contact, ContactProblem, ContactState, Control, Convolution, Grid, influence};

use crate::support::{Pressing, assert_close, assert_near, assert_refused, paraboloid};

/// A rough periodic or free surface on `n` × `n` elements of the unit square.
fn rough(is_periodic: bool, n: usize) -> Pressing {
    let grid = Grid::new([n; 2], [1.0 / n as f64; 2]).expect("a valid grid");
    let convolution = if is_periodic {
        Convolution::periodic(&grid)
    } else {
        Convolution::new(&grid)
    };
    Pressing::new(convolution, |[row, column]| {
        let [x, y] = [row, column].map(|index| 6.3 * index / n as f64);
        let bowl = if is_periodic {
            0.0
        } else {
            0.02 * ((x - 3.0).powi(2) + (y - 3.1).powi(2))
        };
        bowl + 0.02 * (x + y).cos() + 0.02 * (2.0 * y - x).sin() + 0.005 * (7.0 * x + 5.0 * y).cos()
    })
}

fn problem(body: &Pressing, control: Control) -> ContactProblem<'_> {
    ContactProblem {
        convolution: &body.convolution,
        separation: &body.heights,
        compliance: body.compliance,
        largest_pressure: body.largest_pressure,
        control,
    }
}

/// Checks the conditions of the contact on every element; lengths within `allowed`.
fn check_conditions(body: &Pressing, solved: &(Contact, ContactState), allowed: f64) {
    let (contact, state) = solved;
    let problem = problem(body, Control::NormalForce(0.0));
    let gaps = problem.gaps(contact, state).expect("gaps");
    let limit = body.largest_pressure;
    let largest = state.pressure().iter().copied().fold(0.0, f64::max);
    assert!(largest <= limit, "{largest} above the limit {limit}");
    for (element, (gap, pressure)) in gaps.iter().zip(state.pressure()).enumerate() {
        let holds = if *pressure == 0.0 {
            *gap >= -allowed
        } else if *pressure >= limit {
            *gap <= allowed
        } else {
            (0.0..limit).contains(pressure) && gap.abs() <= allowed
        };
        assert!(
            holds,
            "{element}: gap {gap:e} under {pressure}, limit {limit}"
        );
    }
    let at_limit = state.pressure().iter().filter(|p| **p >= limit).count();
    assert_eq!(at_limit, contact.n_at_limit, "{contact:?}");
}

/// From a limit that only the highest asperity reaches to one that hardly bears the force, and back from guesses that hold
/// too many elements at the limit and too few.
#[test]
fn the_conditions_of_the_contact_hold_at_any_limit() {
    for is_periodic in [false, true] {
        for n in [31, 48] {
            let mut body = rough(is_periodic, n);
            let force = 0.02;
            let (elastic, state) = body.solve(Control::NormalForce(force));
            let largest = state.pressure().iter().copied().fold(0.0, f64::max);
            let mut warm = state.clone();
            for part in [2.0, 1.0, 0.9, 0.5, 0.2, 0.05, 0.2, 0.7] {
                body.largest_pressure = part * largest;
                let problem_force = force.min(0.95 * body.largest_pressure);
                let control = Control::NormalForce(problem_force);
                let solved = body.solve(control);
                check_conditions(&body, &solved, 1e-11);
                let depth = solved.0.indentation_depth;
                assert_close(part, solved.0.normal_force, problem_force, 1e-12);
                let again = body.solve_from(&mut warm, control).expect("a contact");
                assert_close(part, again.indentation_depth, depth, 1e-9);
                assert!(solved.0.iterations < 600, "{part}: {:?}", solved.0);
                if part >= 1.0 {
                    assert_close(part, depth, elastic.indentation_depth, 1e-11);
                }
                let at_depth = Control::IndentationDepth(depth);
                let mean = body.heights.iter().sum::<f64>() / body.heights.len() as f64;
                if !is_periodic || depth < mean {
                    let held = body.solve(at_depth);
                    check_conditions(&body, &held, 1e-11);
                    assert_close(part, held.0.normal_force, problem_force, 1e-8);
                }
            }
        }
    }
}

/// Projected Gauss–Seidel on the matrix of Love's coefficients finds the same pressures.
#[test]
fn another_method_finds_the_same_pressures() {
    let n = 12;
    let mut body = rough(false, n);
    let depth = 0.035;
    let (_, elastic) = body.solve(Control::IndentationDepth(depth));
    body.largest_pressure = 0.3 * elastic.pressure().iter().copied().fold(0.0, f64::max);
    let solved = body.solve(Control::IndentationDepth(depth));
    check_conditions(&body, &solved, 1e-11);
    let edge = 1.0 / n as f64;
    let place = |element: usize| [(element / n) as f64 * edge, (element % n) as f64 * edge];
    let entry = |index: usize| {
        let [a, b] = [place(index / (n * n)), place(index % (n * n))];
        influence([a[0] - b[0], a[1] - b[1]], [edge; 2]) / (4.0 * std::f64::consts::PI)
    };
    let matrix: Vec<f64> = (0..(n * n) * (n * n)).map(entry).collect();
    let mut pressure = vec![0.0; n * n];
    for _ in 0..2000 {
        for i in 0..n * n {
            let row = &matrix[i * n * n..(i + 1) * n * n];
            let moved: f64 = row.iter().zip(&pressure).map(|(k, p)| k * p).sum();
            let next = pressure[i] + (depth - body.heights[i] - moved) / row[i];
            pressure[i] = f64::clamp(next, 0.0, body.largest_pressure);
        }
    }
    let Contact {
        n_contact,
        n_at_limit,
        ..
    } = solved.0;
    assert!(
        n_at_limit > 3 && n_at_limit + 1 < n_contact,
        "{n_at_limit} of {n_contact}"
    );
    for (element, pair) in solved.1.pressure().iter().zip(&pressure).enumerate() {
        assert_near(element, *pair.0, *pair.1, 1e-9 * body.largest_pressure);
    }
}

/// The area that bears a force near the limit is the force over the limit, and a force that no area bears is refused.
#[test]
fn the_limit_decides_what_is_borne() {
    let mut body = Pressing::centred(&paraboloid(0.5), 64, 0.04);
    body.largest_pressure = 0.05;
    let force = 0.05;
    let (contact, _) = body.solve(Control::NormalForce(force));
    let needed = force / body.largest_pressure / body.convolution.grid().element_area();
    let (n_contact, n_at_limit) = (contact.n_contact as f64, contact.n_at_limit as f64);
    assert!(
        n_at_limit <= needed && needed <= n_contact,
        "{needed}: {contact:?}"
    );
    assert!(n_contact - n_at_limit < 0.15 * n_contact, "{contact:?}");
    assert!(!contact.reaches_edge, "{contact:?}");
    let all = body.largest_pressure * (64.0 * 0.04_f64).powi(2);
    let mut state = ContactState::new(&body.convolution);
    let refused = body.solve_from(&mut state, Control::NormalForce(1.001 * all));
    assert_refused("too much", refused, "ForceNotBorne");
    let nearly = body.solve(Control::NormalForce(0.999 * all));
    check_conditions(&body, &nearly, 1e-10);
    assert!(nearly.0.reaches_edge, "{:?}", nearly.0);
    for bad in [0.0, -1.0, f64::NAN] {
        body.largest_pressure = bad;
        let refused = body.solve_from(&mut state, Control::NormalForce(force));
        assert_refused(bad, refused, "largest_pressure");
    }
}

/// If the lower of two elements is at the limit, the other one bears the remaining force, and the depth follows from it.
#[test]
fn two_elements_share_what_one_does_not_bear() {
    let grid = Grid::new([1, 2], [1.0; 2]).expect("a valid grid");
    let mut body = Pressing::new(Convolution::new(&grid), |[_, column]| 0.1 * column);
    body.largest_pressure = 1.5;
    let (contact, state) = body.solve(Control::NormalForce(2.5));
    assert_eq!(
        state.pressure()[0].to_bits(),
        1.5_f64.to_bits(),
        "{contact:?}"
    );
    assert_close("rest", state.pressure()[1], 1.0, 1e-15);
    let [own, other] = [0.0, 1.0].map(|y| influence([0.0, y], [1.0; 2]));
    let moved = (own + 1.5 * other) / (4.0 * std::f64::consts::PI);
    assert_close("depth", contact.indentation_depth, 0.1 + moved, 1e-12);
}

/// A wave has one crest per period, which on a periodic grid hangs together across the boundary.
#[test]
fn patches_connect_across_a_period() {
    let n = 32;
    let grid = Grid::new([n; 2], [1.0 / n as f64; 2]).expect("a valid grid");
    let height = |[row, column]: [f64; 2]| {
        let turn = |index: f64| (std::f64::consts::TAU * index / n as f64).cos();
        -0.01 * (turn(row + 0.5) + turn(column + 0.5))
    };
    let periodic = Pressing::new(Convolution::periodic(&grid), height);
    let free = Pressing::new(Convolution::new(&grid), height);
    for (body, count) in [(&periodic, 1), (&free, 4)] {
        let control = Control::NormalForce(0.002);
        let (contact, state) = body.solve(control);
        let patches = problem(body, control).patches(&state).expect("patches");
        assert_eq!(patches.len(), count, "{contact:?}");
        assert_eq!(contact.reaches_edge, count == 4, "{contact:?}");
        let force: f64 = patches.iter().map(|patch| patch.normal_force).sum();
        assert_close("force", force, 0.002, 1e-12);
        let mut elements: Vec<usize> = patches
            .iter()
            .flat_map(|one| one.elements.clone())
            .collect();
        elements.sort_unstable();
        assert_eq!(elements, state.contact(), "every element once");
        let area: f64 = patches.iter().map(|patch| patch.area).sum();
        assert_close(
            "area",
            area,
            contact.n_contact as f64 / (n * n) as f64,
            1e-12,
        );
    }
}
