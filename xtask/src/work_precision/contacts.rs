//! Contacts of one instant on a given grid.

use std::sync::Arc;

use anyhow::Result;
use benches::{ContactScene, self_affine};

use super::asked::DEPTH;
use super::scenes::HERTZ;
use super::series::{Attempt, Outcome, Reference, Resolution, Series, Solver};
use crate::scene_file::Model;

/// Tolerance of the Hertz contact, far below the error of its grids.
const TOLERANCE: f64 = 1e-9;
/// Tolerances on the rough surface.
const TOLERANCES: [f64; 5] = [1e-2, 1e-4, 1e-6, 1e-8, 1e-10];
const REFERENCE_TOLERANCE: f64 = 1e-12;

/// The depth of the Hertz contact on grids with these edges; the convolution is made in the time that is measured.
pub(super) fn hertz(edges: &[usize]) -> Series {
    let attempt = |&edge: &usize| Attempt {
        resolution: Resolution::Elements(edge),
        solve: Box::new(move || {
            let (contact, state) = ContactScene::hertz(edge)?.solve(TOLERANCE)?;
            Ok(Outcome {
                values: vec![contact.indentation_depth],
                error_bar: None,
                unknowns: state.pressure().len(),
            })
        }),
    };
    Series {
        scene: HERTZ,
        model: Model::HalfSpace,
        quantity: DEPTH,
        solver: Solver::Contact,
        reference: Arc::new(Reference {
            values: vec![ContactScene::HERTZ_DEPTH],
            error: f64::EPSILON,
            source: "closed form".to_owned(),
        }),
        attempts: edges.iter().map(attempt).collect(),
    }
}

/// The pressure on a rough surface, against a far more accurate solution of the same discrete problem.
pub(super) fn rough(edge: usize) -> Result<Series> {
    let scene = Arc::new(ContactScene::rough(self_affine(edge))?);
    let (contact, exact) = scene.solve(REFERENCE_TOLERANCE)?;
    let attempt = |&tolerance: &f64| {
        let scene = Arc::clone(&scene);
        Attempt {
            resolution: Resolution::Tolerance(tolerance),
            solve: Box::new(move || {
                let (_, state) = scene.solve(tolerance)?;
                Ok(Outcome {
                    values: state.pressure().to_vec(),
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
        solver: Solver::Contact,
        reference: Arc::new(Reference {
            values: exact.pressure().to_vec(),
            error: contact.residual.max(REFERENCE_TOLERANCE),
            source: format!("the same grid to {REFERENCE_TOLERANCE:e}"),
        }),
        attempts: TOLERANCES.iter().map(attempt).collect(),
    })
}
