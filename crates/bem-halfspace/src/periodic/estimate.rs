//! The stationary state of a sum of waves with error bars, from finer and finer grids of the same surface.

use indenters::rough::PeriodicSurface;
use numerics::{Estimate, between_zero_and_one};

use crate::periodic::kernel::Sliding;
use crate::periodic::search::Problem;
use crate::periodic::{PeriodicLoad, PeriodicOptions, PeriodicSliding, check_surface, solve_from};
use crate::{BemError, Elastomer, Grid};

/// Elements per shortest wave along an axis on the first grid, and fewest elements along an edge that is not level.
const FIRST: usize = 4;
const FEWEST: usize = 32;
/// The error is at most twice what the last refinement changed, or what the one before leaves of its change at the order:
/// first of the area and the depth, second of the friction. It is doubled because which elements touch jumps from grid to
/// grid; of 120 random surfaces, loads and solids two erred by more.
const SAFETY: f64 = 2.0;
const LEFT_OF_AREA: f64 = 0.5;
const LEFT_OF_FRICTION: f64 = 0.25;
/// Tolerance of the contact, as a part of the relative error asked for and at most; ten residuals are added to the bars.
const TOLERANCE: f64 = 1e-3;
const LARGEST_TOLERANCE: f64 = 1e-5;
const RESIDUALS: f64 = 10.0;
/// Rounding of what is known in closed form.
const ROUNDING: f64 = 1e-12;

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

/// Solves the stationary sliding of a sum of waves to a relative error of the friction, and of the area where nothing rubs.
///
/// # Errors
/// [`BemError::NotReached`] with what was reached on the largest grid of at most `max_elements`; [`BemError::GridTooLarge`]
/// where not even three grids have so few; and those of
/// [`steady_periodic_on_grid`](crate::steady_periodic_on_grid).
pub fn steady_periodic(
    surface: &PeriodicSurface,
    elastomer: &(impl Elastomer + ?Sized),
    load: &PeriodicLoad,
    relative_error: f64,
    max_elements: usize,
) -> Result<PeriodicEstimate, BemError> {
    between_zero_and_one("relative_error", relative_error)?;
    let first = |number: usize| match number {
        0 => 2,
        _ => (FIRST * number).next_power_of_two().max(FEWEST),
    };
    let mut shape = surface.largest_numbers().map(first);
    let sliding = Sliding::new(elastomer, load.velocity)?;
    let (mut states, mut guess) = (Vec::new(), Vec::new());
    loop {
        let elements = shape[0] as f64 * shape[1] as f64;
        if elements > max_elements as f64 {
            return Err(too_large(&states, elements, relative_error, max_elements));
        }
        let spacing = [0, 1].map(|axis| surface.period()[axis] / shape[axis] as f64);
        let (grid, heights) = (Grid::new(shape, spacing)?, surface.heights(shape)?);
        check_surface(&grid, &heights)?;
        let problem = Problem {
            sliding: &sliding,
            grid: &grid,
            heights: &heights,
            mean_pressure: load.mean_pressure,
            tolerance: (TOLERANCE * relative_error).min(LARGEST_TOLERANCE),
            max_products: PeriodicOptions::default().max_products,
        };
        let state = solve_from(&mut guess, problem)?;
        states.push(state);
        if let Some(estimate) = estimate(&states)
            && missed(&estimate, relative_error).is_none()
        {
            return Ok(estimate);
        }
        shape = shape.map(|n| 2 * n);
    }
}

/// What was asked for, should it not have its error.
fn missed(estimate: &PeriodicEstimate, relative_error: f64) -> Option<(&'static str, Estimate)> {
    let asked = if estimate.friction_coefficient.value == 0.0 {
        ("area fraction", estimate.area_fraction)
    } else {
        ("friction coefficient", estimate.friction_coefficient)
    };
    (!asked.1.is_within(relative_error)).then_some(asked)
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
    let of = |quantity: fn(&PeriodicSliding) -> f64, left: f64| {
        let [coarse, middle, value] = [coarse, middle, fine].map(quantity);
        let change = (value - middle).abs().max(left * (middle - coarse).abs());
        let solved = RESIDUALS * fine.residual + ROUNDING;
        Estimate::new(value, SAFETY * change + solved * value.abs())
    };
    let slopes = of(|state| state.friction_coefficient, LEFT_OF_FRICTION);
    let dissipation = of(|state| state.friction_from_dissipation, LEFT_OF_FRICTION);
    Some(PeriodicEstimate {
        friction_coefficient: if slopes.error < dissipation.error {
            slopes
        } else {
            dissipation
        },
        friction_from_dissipation: dissipation,
        area_fraction: of(|state| state.area_fraction, LEFT_OF_AREA),
        mean_depth: of(|state| state.mean_depth, LEFT_OF_AREA),
        finest: fine.clone(),
    })
}
