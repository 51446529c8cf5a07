//! Contacts of one instant on a given grid.

use std::sync::Arc;

use anyhow::Result;
use bem_halfspace::{
    BemError, Contact, ContactOptions, ContactProblem, ContactState, Control, Convolution, Grid,
    solve_contact,
};
use viscofriction::scene::Model;

use super::rough::self_affine;
use super::scenes::HERTZ;
use super::series::{DEPTH, Found, Run, Series, deviation};

/// Tolerance of the Hertz contact, far below the error of its grids.
const TOLERANCE: f64 = 1e-9;
/// Tolerances on the rough surface.
const TOLERANCES: [f64; 5] = [1e-2, 1e-4, 1e-6, 1e-8, 1e-10];
const REFERENCE_TOLERANCE: f64 = 1e-12;
/// Contact radius of the Hertz contact on the unit square, \[m].
const RADIUS: f64 = 0.3;

/// The depth of the Hertz contact on grids with these edges; the convolution is made in the time that is measured.
pub(super) fn hertz(edges: &[usize]) -> Series {
    let run = |&edge: &usize| Run {
        kind: "elements",
        resolution: Some(edge as f64),
        solve: Box::new(move || {
            let (contact, state) = hertz_scene(edge)?.solve(TOLERANCE)?;
            Ok(Found {
                error: deviation(&[contact.indentation_depth], &[RADIUS * RADIUS]),
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
    let scene = rough_scene(edge)?;
    let (contact, exact) = scene.solve(REFERENCE_TOLERANCE)?;
    let scene = Arc::new((scene, exact.pressure().to_vec()));
    let run = |&tolerance: &f64| {
        let scene = Arc::clone(&scene);
        Run {
            kind: "tolerance",
            resolution: Some(tolerance),
            solve: Box::new(move || {
                let (scene, exact) = &*scene;
                let (_, state) = scene.solve(tolerance)?;
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
