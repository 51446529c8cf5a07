//! The stationary state of a sum of waves with error bars, from finer and finer grids of the same surface.

use indenters::rough::PeriodicSurface;
use numerics::{Estimate, between_zero_and_one};

use crate::periodic::{PeriodicLoad, PeriodicOptions, PeriodicSliding, steady_periodic_on_grid};
use crate::{BemError, Elastomer, Grid};

/// Elements per shortest wave along an axis on the first grid, and fewest elements along an edge.
const FIRST: usize = 4;
const FEWEST: usize = 32;
/// What is left of an error of the first order is what the last refinement changed; tripled, as elsewhere in this crate,
/// because which elements touch jumps from grid to grid.
const SAFETY: f64 = 3.0;

/// A stationary state of a periodic surface, with error bars for the surface that is given: waves that it lacks may change
/// everything.
#[derive(Debug, Clone, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize))]
#[must_use]
pub struct PeriodicEstimate {
    /// Friction coefficient, from slopes or from the dissipated power, whichever the last refinement changed less.
    pub friction_coefficient: Estimate,
    /// The same from the dissipated power alone.
    pub friction_from_dissipation: Estimate,
    /// Part of the period in contact.
    pub area_fraction: Estimate,
    /// Depth of the mean plane, \[m].
    pub mean_depth: Estimate,
    /// The state on the finest grid.
    pub finest: PeriodicSliding,
}

/// Solves the stationary sliding of a sum of waves to a relative error of friction and area.
///
/// # Errors
/// [`BemError::NotReached`] with what was reached on the largest grid of at most `max_elements`; [`BemError::GridTooLarge`]
/// where not even three grids have so few; and those of [`steady_periodic_on_grid`].
pub fn steady_periodic(
    surface: &PeriodicSurface,
    elastomer: &(impl Elastomer + ?Sized),
    load: &PeriodicLoad,
    relative_error: f64,
    max_elements: usize,
) -> Result<PeriodicEstimate, BemError> {
    between_zero_and_one("relative_error", relative_error)?;
    let first = |number: usize| (FIRST * number).next_power_of_two().max(FEWEST);
    let mut shape = surface.largest_numbers().map(first);
    let mut states = Vec::new();
    loop {
        let elements = shape[0] as f64 * shape[1] as f64;
        if elements > max_elements as f64 {
            return Err(too_large(&states, elements, relative_error, max_elements));
        }
        let spacing = [0, 1].map(|axis| surface.period()[axis] / shape[axis] as f64);
        let (grid, heights) = (Grid::new(shape, spacing)?, surface.heights(shape)?);
        let options = PeriodicOptions::default();
        let state = steady_periodic_on_grid(&grid, &heights, elastomer, load, &options)?;
        states.push(state);
        if let Some(estimate) = estimate(&states)
            && missed(&estimate, relative_error).is_none()
        {
            return Ok(estimate);
        }
        shape = shape.map(|n| 2 * n);
    }
}

/// The first quantity without the error asked for.
fn missed(estimate: &PeriodicEstimate, relative_error: f64) -> Option<(&'static str, Estimate)> {
    let mut quantities = [
        ("friction coefficient", estimate.friction_coefficient),
        ("area fraction", estimate.area_fraction),
    ]
    .into_iter();
    quantities.find(|(_, quantity)| !quantity.is_within(relative_error))
}

fn too_large(
    states: &[PeriodicSliding],
    elements: f64,
    relative_error: f64,
    max_elements: usize,
) -> BemError {
    match estimate(states).and_then(|estimate| missed(&estimate, relative_error)) {
        Some((quantity, Estimate { value, error })) => BemError::NotReached {
            quantity,
            value,
            error,
            relative_error,
        },
        None => BemError::GridTooLarge {
            elements,
            limit: max_elements as f64,
        },
    }
}

/// From three grids or more.
fn estimate(states: &[PeriodicSliding]) -> Option<PeriodicEstimate> {
    let [.., coarse, middle, fine] = states else {
        return None;
    };
    let of = |quantity: fn(&PeriodicSliding) -> f64| {
        let [coarse, middle, value] = [coarse, middle, fine].map(quantity);
        let change = (value - middle).abs().max(0.5 * (middle - coarse).abs());
        let residual = fine.residual * value.abs();
        Estimate::new(value, SAFETY * change + residual)
    };
    let slopes = of(|state| state.friction_coefficient);
    let dissipation = of(|state| state.friction_from_dissipation);
    Some(PeriodicEstimate {
        friction_coefficient: if slopes.error < dissipation.error {
            slopes
        } else {
            dissipation
        },
        friction_from_dissipation: dissipation,
        area_fraction: of(|state| state.area_fraction),
        mean_depth: of(|state| state.mean_depth),
        finest: fine.clone(),
    })
}
