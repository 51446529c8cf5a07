//! Neither an iteration nor a whole solve allocates where the state is kept.

use allocation_counter::measure;
use bem_halfspace::{
    BemError, Contact, ContactOptions, ContactProblem, ContactState, Control, Convolution, Grid,
    solve_contact,
};

/// A paraboloid with ripples, under whose load the contact changes often before it is found.
fn heights(edge: usize, middle: [f64; 2]) -> Vec<f64> {
    let height = |index: usize| {
        let [x, y] = [
            (index / edge) as f64 - middle[0],
            (index % edge) as f64 - middle[1],
        ];
        0.004 * (x * x + 1.3 * y * y) + 0.3 * (0.9 * x).cos() * (0.7 * y).cos()
    };
    (0..edge * edge).map(height).collect()
}

/// Solves from the pressure 1 on some rows in at most so many iterations.
fn solve(
    problem: &ContactProblem,
    state: &mut ContactState,
    max_iterations: usize,
) -> Result<Contact, BemError> {
    let edge = problem.convolution.grid().shape()[1];
    state.pressure_mut().fill(0.0);
    state.pressure_mut()[38 * edge..edge * (edge - 38)].fill(1.0);
    let options = ContactOptions {
        tolerance: 1e-10,
        max_iterations,
    };
    solve_contact(problem, state, &options)
}

fn solves_without_allocation() {
    let kinds = [Convolution::new, Convolution::periodic];
    // Those in the middle have mirrors, between elements or through them.
    let bodies = [(96, [45.3, 50.8]), (96, [47.5; 2]), (97, [48.0; 2])];
    for (new, (edge, middle)) in kinds
        .into_iter()
        .flat_map(|new| bodies.map(|body| (new, body)))
    {
        let grid = Grid::new([edge; 2], [1.0; 2]).expect("a valid grid");
        let (convolution, heights) = (new(&grid), heights(edge, middle));
        let problem = ContactProblem {
            convolution: &convolution,
            separation: &heights,
            compliance: 1.0,
            control: Control::NormalForce(2000.0),
        };
        let mut state = ContactState::new(&convolution);
        for limit in [4, 500] {
            let first = solve(&problem, &mut state, limit);
            let mut again = None;
            let counted = measure(|| again = Some(solve(&problem, &mut state, limit)));
            assert_eq!(again.as_ref(), Some(&first), "at most {limit} iterations");
            assert_eq!(first.is_ok(), limit == 500, "iterations of {first:?}");
            assert_eq!(counted.count_total, 0, "{counted:?} in {first:?}");
        }
    }
}

#[cfg(not(feature = "rayon"))]
#[test]
fn a_solve_with_a_kept_state_does_not_allocate() {
    solves_without_allocation();
}

/// On the thread of a pool, because handing work to a pool allocates there.
#[cfg(feature = "rayon")]
#[test]
fn a_solve_with_a_kept_state_does_not_allocate() {
    let pool = rayon::ThreadPoolBuilder::new().num_threads(1).build();
    pool.expect("a pool").install(solves_without_allocation);
}
