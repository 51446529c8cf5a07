//! The scaling factors compared with the paper's: the plain simulation, the biases of its sources, and the converged value.

use anyhow::Result;
use bem_halfspace::slide::Transient;
use serde::{Deserialize, Serialize};

use crate::scaling::{MAX_UNKNOWNS, scaling_factor};
use crate::scene::Scene;
use crate::tasks::in_parallel;

/// Name of the table of scaling factors.
pub(super) const NAME: &str = "scaling_factors";

/// Exponent p and scaling factor of cone and paraboloid, as Kürschner (2014) prints them.
pub(super) const PAPER: [(f64, f64); 2] = [(1.0, 0.55), (2.0, 0.67)];
/// Number of elements along the contact length of the one-dimensional model in the plain simulation. Chosen: the smallest round
/// number for which the outline of the contact is more than a few elements.
const PLAIN_ELEMENTS: f64 = 10.0;
/// Ratio of the sliding distance of the plain simulation to the contact length. Chosen: the first doubling of five over whose
/// second half friction changes by less than one per cent.
const PLAIN_LENGTHS: f64 = 40.0;
/// Relative error requested of the converged factors. Chosen an order below the biases that they reveal.
const RELATIVE_ERROR: f64 = 2e-4;
/// Largest relative change of friction over the second half of the distance with which the end still counts as stationary
/// enough to be extrapolated. Chosen: the extrapolation removes most of the remaining change, which is of the same order.
const DRIFT_TOLERANCE: f64 = 0.02;

/// Factors of one profile, each the ratio of the friction of the half space to that of the one-dimensional model. They satisfy
/// plain + time_level_bias + distance_bias + grid_bias = converged.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub(super) struct Row {
    pub(super) exponent: f64,
    pub(super) paper: f64,
    /// Friction ratio at the end of the plain simulation, with the slope at the end of the step.
    pub(super) plain: f64,
    /// Change of the factor if friction is computed with the mean slope over each step.
    time_level_bias: f64,
    /// Change of the factor by an infinite sliding distance.
    distance_bias: f64,
    /// Change of the factor by an infinitely fine grid.
    grid_bias: f64,
    pub(super) converged: f64,
    pub(super) error: f64,
    plain_elements: f64,
    plain_lengths: f64,
    /// Relative change over the second half of the distance of the plain simulation.
    plain_drift: f64,
}

/// Rows of the table of scaling factors, for the profiles of [`PAPER`].
pub(super) fn compute() -> Result<Vec<Row>> {
    in_parallel("scaling factors", &PAPER, |&(exponent, paper)| {
        let converged = scaling_factor(exponent, RELATIVE_ERROR, MAX_UNKNOWNS)?.value();
        let plain = Plain::new(exponent, PLAIN_ELEMENTS)?;
        let stationary = plain.transient.stationary(DRIFT_TOLERANCE)?;
        let mean_slope = plain.transient.last().friction_coefficient / plain.theory;
        let far = stationary.friction_coefficient / plain.theory;
        Ok(Row {
            exponent,
            paper,
            plain: plain.ratio,
            time_level_bias: mean_slope - plain.ratio,
            distance_bias: far - mean_slope,
            grid_bias: converged.value - far,
            converged: converged.value,
            error: converged.error,
            plain_elements: PLAIN_ELEMENTS,
            plain_lengths: PLAIN_LENGTHS,
            plain_drift: stationary.drift,
        })
    })
}

/// The plain simulation of a power profile.
pub(super) struct Plain {
    transient: Transient,
    theory: f64,
    /// Ratio of the friction at the end of the simulation, with the slope at the end of each step, to that of the one-dimensional
    /// model.
    pub(super) ratio: f64,
}

impl Plain {
    /// Slides a profile with `elements` along the contact length over [`PLAIN_LENGTHS`] of it.
    pub(super) fn new(exponent: f64, elements: f64) -> Result<Self> {
        let scene = Scene::unit(exponent)?;
        let theory = scene.theory()?;
        let transient = scene.half_space(theory.contact_length() / elements, PLAIN_LENGTHS)?;
        let friction = theory.friction_coefficient;
        Ok(Self {
            ratio: transient.last().friction_coefficient_end_of_step / friction,
            transient,
            theory: friction,
        })
    }
}
