//! Neither an iteration nor a whole solve allocates if the state is reused.

use allocation_counter::measure;
use bem_halfspace::{BemError, Contact, ContactOptions, ContactState, Control, Convolution, Grid};

use crate::support::{Pressing, on_threads};

/// Solves from the pressure 1 on some rows.
fn solve(body: &Pressing, state: &mut ContactState) -> Result<Contact, BemError> {
    let edge = body.convolution.grid().shape()[1];
    state.pressure_mut().fill(0.0);
    state.pressure_mut()[38 * edge..edge * (edge - 38)].fill(1.0);
    body.solve_from(state, Control::NormalForce(2000.0))
}

#[test]
fn a_solve_with_a_kept_state_does_not_allocate() {
    // On a thread of the pool, because handing work to a pool from outside allocates.
    on_threads(1, solves_without_allocation);
}

fn solves_without_allocation() {
    // The cases in the middle have mirrors, between elements or through them.
    for (edge, middle) in [(96, [45.3, 50.8]), (96, [47.5; 2]), (97, [48.0; 2])] {
        // A paraboloid with ripples, under whose load the active set changes often before it is found.
        let height = |element: [f64; 2]| {
            let [x, y] = [0, 1].map(|axis| element[axis] - middle[axis]);
            0.004 * (x * x + 1.3 * y * y) + 0.3 * (0.9 * x).cos() * (0.7 * y).cos()
        };
        let grid = Grid::new([edge; 2], [1.0; 2]).expect("a valid grid");
        for new in [Convolution::new, Convolution::periodic] {
            let mut body = Pressing::new(new(&grid), height);
            let mut state = ContactState::new(&body.convolution);
            for max_iterations in [4, 500] {
                body.options = ContactOptions {
                    tolerance: 1e-10,
                    max_iterations,
                };
                let first = solve(&body, &mut state);
                let mut again = None;
                let counted = measure(|| again = Some(solve(&body, &mut state)));
                assert_eq!(again.as_ref(), Some(&first), "{max_iterations} at most");
                assert_eq!(first.is_ok(), max_iterations == 500, "{first:?}");
                assert_eq!(counted.count_total, 0, "{counted:?} in {first:?}");
            }
        }
    }
}
