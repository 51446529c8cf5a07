//! Contacts of one instant on a given grid.

use std::sync::Arc;

use anyhow::Result;
use bem_halfspace::{
    BemError, Contact, ContactOptions, ContactProblem, ContactState, Control, Convolution, Grid,
    solve_contact,
};

use super::asked::DEPTH;
use super::rough::self_affine;
use super::scenes::HERTZ;
use super::series::{Attempt, Outcome, Reference, Resolution, Series, Solver};
use crate::scene_file::Model;

/// Tolerance of the Hertz contact, far below the error of its grids.
const TOLERANCE: f64 = 1e-9;
/// Tolerances on the rough surface.
const TOLERANCES: [f64; 5] = [1e-2, 1e-4, 1e-6, 1e-8, 1e-10];
const REFERENCE_TOLERANCE: f64 = 1e-12;
/// Contact radius of the Hertz contact on the unit square, \[m].
const RADIUS: f64 = 0.3;

/// The depth of the Hertz contact on grids with these edges; the convolution is made in the time that is measured.
pub(super) fn hertz(edges: &[usize]) -> Series {
    let attempt = |&edge: &usize| Attempt {
        resolution: Resolution::Elements(edge),
        solve: Box::new(move || {
            let (contact, state) = hertz_scene(edge)?.solve(TOLERANCE)?;
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
            values: vec![RADIUS * RADIUS],
            error: f64::EPSILON,
            source: "closed form".to_owned(),
        }),
        attempts: edges.iter().map(attempt).collect(),
    }
}

/// The pressure on a rough surface, against a far more accurate solution of the same discrete problem.
pub(super) fn rough(edge: usize) -> Result<Series> {
    let scene = Arc::new(rough_scene(edge)?);
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

/// A contact at a given force on E* = 1.
struct ContactScene {
    convolution: Convolution,
    /// Heights of the rigid body, row-major, \[m].
    heights: Vec<f64>,
    /// \[N].
    force: f64,
}

/// Hertz contact on the unit square of `n` × `n` elements, apex between the four middle elements.
fn hertz_scene(n: usize) -> Result<ContactScene, BemError> {
    let edge = 1.0 / n as f64;
    let centre = |index: usize| (index as f64 + 0.5 - 0.5 * n as f64) * edge;
    let height = |index: usize| 0.5 * (centre(index / n).powi(2) + centre(index % n).powi(2));
    Ok(ContactScene {
        convolution: Convolution::new(&Grid::new([n; 2], [edge; 2])?),
        heights: (0..n * n).map(height).collect(),
        force: 4.0 / 3.0 * RADIUS.powi(3),
    })
}

/// A periodic rough surface on the unit square, pressed with the mean pressure 0.05 on its summits.
fn rough_scene(n: usize) -> Result<ContactScene, BemError> {
    Ok(ContactScene {
        convolution: Convolution::periodic(&Grid::new([n; 2], [1.0 / n as f64; 2])?),
        heights: self_affine(n).into_iter().map(|summit| -summit).collect(),
        force: 0.05,
    })
}

impl ContactScene {
    /// Solves from a cold start.
    fn solve(&self, tolerance: f64) -> Result<(Contact, ContactState), BemError> {
        let problem = ContactProblem {
            convolution: &self.convolution,
            separation: &self.heights,
            compliance: 4.0,
            control: Control::NormalForce(self.force),
        };
        let options = ContactOptions {
            tolerance,
            max_iterations: 500,
        };
        let mut state = ContactState::new(&self.convolution);
        let contact = solve_contact(&problem, &mut state, &options)?;
        Ok((contact, state))
    }
}
