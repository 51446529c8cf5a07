//! Grids and contact problems that several claims share.

use bem_halfspace::{
    Contact, ContactOptions, ContactProblem, ContactState, Control, Convolution, Grid,
    solve_contact,
};
use indenters::Surface;

/// Tight enough that the contact set and ten digits are those of the exact discrete solution.
pub const TIGHT: ContactOptions = ContactOptions {
    tolerance: 1e-13,
    max_iterations: 5000,
};

/// Heights over `n` × `n` square elements of the given edge, with the apex over the centre of the grid.
pub fn centred_heights(surface: &impl Surface, n: usize, spacing: f64) -> Vec<f64> {
    let position = |index: usize| (index as f64 - 0.5 * (n as f64 - 1.0)) * spacing;
    (0..n * n)
        .map(|index| surface.height([position(index / n), position(index % n)]))
        .collect()
}

/// Solves an elastic contact (compliance 1/G) on a square grid of unit elements.
pub fn elastic_contact(heights: &[f64], n: usize, control: Control) -> (Contact, ContactState) {
    let grid = Grid::new([n, n], [1.0, 1.0]).expect("a valid grid");
    let convolution = Convolution::new(&grid);
    let mut state = ContactState::new(&convolution);
    let problem = ContactProblem {
        convolution: &convolution,
        separation: heights,
        compliance: 1.0,
        control,
    };
    let contact = solve_contact(&problem, &mut state, &TIGHT).expect("a solved contact");
    (contact, state)
}
