//! Contacts of one instant on a given grid.

use std::sync::Arc;

use anyhow::Result;
use bem_halfspace::{
    Contact, ContactOptions, ContactProblem, ContactState, Control, Convolution, Grid,
    solve_contact,
};
use casebook::{SquareContact, deviation};
use viscofriction::scene::Model;

use super::rough::self_affine;
use super::scenes::HERTZ;
use super::series::{DEPTH, Found, Run, Series};

/// Tolerance of the Hertz contact, far below the error of its grids.
const TOLERANCE: f64 = 1e-9;
/// Tolerances on the rough surface.
const TOLERANCES: [f64; 5] = [1e-2, 1e-4, 1e-6, 1e-8, 1e-10];
const REFERENCE_TOLERANCE: f64 = 1e-12;

/// The depth of the Hertz contact on grids with these edges; the convolution is made in the time that is measured.
pub(super) fn hertz(edges: &[usize]) -> Series {
    let run = |&edge: &usize| Run {
        kind: "elements",
        resolution: Some(edge as f64),
        solve: Box::new(move || {
            let convolution = Convolution::new(&grid(edge)?);
            let body = SquareContact::hertz(edge, 0.0);
            let (contact, state) = solve(&convolution, &body, TOLERANCE)?;
            Ok(Found {
                error: deviation(&[contact.indentation_depth], &[SquareContact::HERTZ_DEPTH]),
                error_bar: None,
                unknowns: state.pressure().len(),
            })
        }),
    };
    Series {
        scene: HERTZ,
        model: Model::HalfSpace,
        quantity: DEPTH,
        method: None,
        reference: "closed form".to_owned(),
        reference_error: f64::EPSILON,
        runs: edges.iter().map(run).collect(),
    }
}

/// The pressure on a rough surface, against a far more accurate solution of the same discrete problem.
pub(super) fn rough(edge: usize) -> Result<Series> {
    let body = SquareContact::rough(self_affine(edge));
    let convolution = Convolution::periodic(&grid(edge)?);
    let (contact, exact) = solve(&convolution, &body, REFERENCE_TOLERANCE)?;
    let scene = Arc::new((convolution, body, exact.pressure().to_vec()));
    let run = |&tolerance: &f64| {
        let scene = Arc::clone(&scene);
        Run {
            kind: "tolerance",
            resolution: Some(tolerance),
            solve: Box::new(move || {
                let (convolution, body, exact) = &*scene;
                let (_, state) = solve(convolution, body, tolerance)?;
                Ok(Found {
                    error: deviation(state.pressure(), exact),
                    error_bar: None,
                    unknowns: state.pressure().len(),
                })
            }),
        }
    };
    Ok(Series {
        scene: "rough surface",
        model: Model::HalfSpace,
        quantity: "pressure",
        method: None,
        reference: format!("the same grid to {REFERENCE_TOLERANCE:e}"),
        reference_error: contact.residual.max(REFERENCE_TOLERANCE),
        runs: TOLERANCES.iter().map(run).collect(),
    })
}

fn grid(edge: usize) -> Result<Grid> {
    Ok(Grid::new([edge; 2], [1.0 / edge as f64; 2])?)
}

/// Solves a contact from a cold start.
fn solve(
    convolution: &Convolution,
    body: &SquareContact,
    tolerance: f64,
) -> Result<(Contact, ContactState)> {
    let problem = ContactProblem {
        convolution,
        separation: &body.heights,
        compliance: SquareContact::COMPLIANCE,
        control: Control::NormalForce(body.force),
    };
    let options = ContactOptions {
        tolerance,
        ..ContactOptions::default()
    };
    let mut state = ContactState::new(convolution);
    Ok((solve_contact(&problem, &mut state, &options)?, state))
}
