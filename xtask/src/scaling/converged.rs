//! The converged scaling factor, from the stationary solution of the half space.

use anyhow::{Context, Result, bail};
use bem_halfspace::BemError;
use bem_halfspace::steady::{RefinementOptions, steady_refined};

use crate::scene::Scene;

/// From this exponent on the elements are squares.
const STEEP: f64 = 4.0;

/// s_p with its absolute error.
#[derive(Debug, Clone, Copy)]
pub(crate) struct ScalingFactor {
    pub(crate) value: f64,
    pub(crate) error: f64,
    /// Unknown pressures on the finest grid.
    pub(crate) unknowns: usize,
}

/// Unknown pressures for which an answer is worth waiting.
const MAX_UNKNOWNS: usize = 100_000;

/// Computes s_p to the relative error asked for.
pub(crate) fn scaling_factor(exponent: f64, relative_error: f64) -> Result<ScalingFactor> {
    scaling_factor_within(exponent, relative_error, MAX_UNKNOWNS)
}

/// Computes s_p to the relative error asked for with at most about `max_unknowns`.
pub(crate) fn scaling_factor_within(
    exponent: f64,
    relative_error: f64,
    max_unknowns: usize,
) -> Result<ScalingFactor> {
    let scene = Scene::unit(exponent)?;
    let line = scene.theory()?.friction_coefficient;
    let options = RefinementOptions {
        relative_error,
        // The contact of a steep profile is a thin crescent, as long across the sliding direction as along it.
        aspect: if exponent < STEEP { 0.5 } else { 1.0 },
        max_unknowns,
    };
    let half_space = match steady_refined(&scene.body, &scene.material, &scene.load, &options) {
        Ok(half_space) => half_space,
        Err(BemError::FrictionNotReached {
            friction_coefficient,
            error,
            ..
        }) => bail!(
            "the scaling factor of p = {exponent} was not reached to the relative error {relative_error:e}: it is {} \
             with an error of {:.1e}",
            friction_coefficient / line,
            error / line
        ),
        Err(other) => {
            return Err(other).with_context(|| format!("scaling factor of p = {exponent}"));
        }
    };
    Ok(ScalingFactor {
        value: half_space.friction_coefficient.value / line,
        error: half_space.friction_coefficient.error / line,
        unknowns: half_space
            .refinements
            .last()
            .map_or(0, |refinement| refinement.unknowns),
    })
}
