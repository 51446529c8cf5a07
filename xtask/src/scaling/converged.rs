//! The converged scaling factor, from the stationary solution of the half space.

use anyhow::{Context, Result, bail};
use bem_halfspace::steady::RefinementOptions;
use numerics::Estimate;

use crate::scene::{Scene, as_far_as_reached};

/// From this exponent on the elements are squares.
const STEEP: f64 = 4.0;
/// Unknown pressures for which an answer is worth waiting.
pub(crate) const MAX_UNKNOWNS: usize = 100_000;

/// s_p.
#[derive(Debug, Clone, Copy)]
pub(crate) struct ScalingFactor {
    /// Friction of the half space over that of the line, with its absolute error.
    pub(crate) friction_ratio: Estimate,
    /// Unknown pressures on the finest grid.
    pub(crate) unknowns: usize,
}

/// Computes s_p to the relative error asked for with at most about `max_unknowns`.
pub(crate) fn scaling_factor(
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
    let half_space = as_far_as_reached(scene.friction(&options))
        .with_context(|| format!("scaling factor of p = {exponent}"))?;
    let friction = half_space.friction;
    let (value, error) = (friction.value / line, friction.error / line);
    let Some(unknowns) = half_space.unknowns else {
        bail!(
            "the scaling factor of p = {exponent} was not reached to the relative error {relative_error:e}: it is {value} \
             with an error of {error:.1e}"
        )
    };
    Ok(ScalingFactor {
        friction_ratio: Estimate { value, error },
        unknowns,
    })
}
