//! Contacts of one instant on a given grid.

use anyhow::Result;
use bem_halfspace::ContactState;
use benches::{ContactScene, rough_heights};
use casebook::{HERTZ_DEPTH, deviation};
use viscofriction::scene::Model;

use super::scenes::HERTZ;
use super::series::{DEPTH, Found, Measured, Row};

/// Tolerance of the Hertz contact, far below the error of its grids.
const TOLERANCE: f64 = 1e-9;
/// Tolerances on the rough surface.
const TOLERANCES: [f64; 5] = [1e-2, 1e-4, 1e-6, 1e-8, 1e-10];
const REFERENCE_TOLERANCE: f64 = 1e-12;

/// The depth of the Hertz contact on grids with these edges; the convolution is made in the time that is measured.
pub(super) fn hertz(measured: &mut Measured, edges: &[usize]) {
    for &edge in edges {
        let run = Row {
            scene: HERTZ,
            quantity: DEPTH,
            resolution_kind: "elements",
            resolution: Some(edge as f64),
            reference: "closed form".to_owned(),
            reference_error: f64::EPSILON,
            ..row()
        };
        measured.add(run, || {
            let (contact, state) = ContactScene::hertz(edge, 0.0)?.solve(TOLERANCE)?;
            let depth = [contact.indentation_depth];
            Ok(found(&state, &depth, &[HERTZ_DEPTH]))
        });
    }
}

/// The pressure on a rough surface, against a far more accurate solution of the same discrete problem.
pub(super) fn rough(measured: &mut Measured, edge: usize) -> Result<()> {
    let scene = ContactScene::periodic(rough_heights(edge, 0)?)?;
    let (contact, exact) = scene.solve(REFERENCE_TOLERANCE)?;
    for tolerance in TOLERANCES {
        let run = Row {
            scene: "rough surface",
            quantity: "pressure",
            resolution_kind: "tolerance",
            resolution: Some(tolerance),
            reference: format!("the same grid to {REFERENCE_TOLERANCE:e}"),
            reference_error: contact.residual.max(REFERENCE_TOLERANCE),
            ..row()
        };
        measured.add(run, || {
            let (_, state) = scene.solve(tolerance)?;
            Ok(found(&state, state.pressure(), exact.pressure()))
        });
    }
    Ok(())
}

fn row() -> Row {
    Row {
        model: Model::HalfSpace.name(),
        method: "bem contact".to_owned(),
        ..Row::default()
    }
}

fn found(state: &ContactState, values: &[f64], exact: &[f64]) -> Found {
    Found {
        error: deviation(values, exact),
        error_bar: None,
        unknowns: state.pressure().len(),
    }
}
