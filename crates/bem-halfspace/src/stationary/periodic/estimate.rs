//! Periodic surfaces with error bars: stationary sliding, pressing, and sliding from rest, refined to a relative error.

use indenters::rough::PeriodicSurface;
use numerics::{Estimate, Request};

use crate::march::periodic::{PeriodicTransient, Steps, slide_with};
use crate::parallel::reductions::mean;
use crate::stationary::COARSE_GRID_TOLERANCE;
use crate::stationary::periodic::contact::PeriodicContact;
use crate::stationary::periodic::grid_sizes::first_shape;
use crate::stationary::periodic::kernel::MaterialAtSpeed;
use crate::stationary::periodic::perimeter_error::area_fraction;
use crate::stationary::periodic::refinement::{
    AREA_RATE, FIRST_ORDER_RATE, FRICTION_RATE, GridResult, RefinementGoal, SampledSurface, refine,
};
use crate::stationary::periodic::subgrid_gaps::SubgridGapBound;
use crate::stationary::periodic::{PeriodicLoad, PeriodicOptions, PeriodicSliding, solve_from};
use crate::{BemError, ContactOptions, Elastomer, PressureField};

/// Relative error in the request for the shape of a first grid. Chosen: any value serves, because the shape does not depend on
/// it.
const ANY_RELATIVE_ERROR: f64 = 0.1;
/// Smallest number of steps of a march on the first grid. Chosen: it makes steps shorter than elements over short distances. The
/// steps are halved with the elements, so that the bars contain their error with any number.
const MIN_FIRST_STEPS: f64 = 4.0;

/// Results for a periodic surface with error bars.
///
/// The bars are those of the given surface; waves that it lacks may change the results by more.
#[derive(Debug, Clone, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize))]
#[must_use]
#[non_exhaustive]
pub struct PeriodicEstimate<S> {
    /// Friction coefficient.
    ///
    /// In a stationary state it is the mean of that from slopes and that from the dissipated power, weighted by the inverse of
    /// their error bars. The bars of both reach each other.
    pub friction_coefficient: Estimate,
    /// Friction coefficient from the dissipated power alone; `None` for a transient state.
    pub friction_from_dissipation: Option<Estimate>,
    /// Fraction of the period in contact.
    pub area_fraction: Estimate,
    /// Mean pressure, \[Pa]; exact if it is prescribed.
    pub mean_pressure: Estimate,
    /// Depth of the mean plane, \[m]; exact if it is prescribed.
    pub mean_depth: Estimate,
    /// Result on the finest grid.
    pub finest: S,
}

/// Solves the stationary sliding of a sum of waves, or its pressing without sliding, to a relative error, or with a number of
/// elements.
///
/// The relative error is that of the friction, or of the area without friction, and at a prescribed depth also of the mean
/// pressure. The number of elements is that along the edge of the period that has more of them.
///
/// ```
/// use bem_halfspace::indenters::rough::{PeriodicSurface, Wave};
/// use bem_halfspace::rheology::{StandardSolid, StandardSolidParameters};
/// use bem_halfspace::{PeriodicLoad, periodic};
///
/// let wave = |numbers| Wave { numbers, amplitude: 1e-5, phase: 0.0 };
/// let road = PeriodicSurface::new([1e-3; 2], vec![wave([1, 1]), wave([3, -2])])?;
/// let rubber = StandardSolid::new(StandardSolidParameters {
///     equilibrium_modulus: 1e6,
///     maxwell_modulus: 9e6,
///     viscosity: 9e2,
/// })?;
/// let state = periodic::steady(&road, &rubber, &PeriodicLoad::new(1e4, 0.1)?, 0.05)?;
/// let area = state.area_fraction;
/// assert!(0.0 < area.value && area.value < 1.0 && state.friction_coefficient.value > 0.0);
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
///
/// # Errors
/// [`BemError::NotReached`] with the best result if the largest grids are too coarse, or have too few elements in a small contact;
/// [`BemError::GridTooLarge`] if not even the coarsest three grids are small enough;
/// [`BemError::PeriodTooCoarse`] for too few elements; [`BemError::Indenter`] for a load with a sliding distance;
/// [`BemError::InvalidParameter`] for a depth at which nothing touches, or all of a half space; and those of
/// [`steady_on_grid`](super::steady_on_grid).
pub fn steady<'w>(
    surface: &PeriodicSurface,
    elastomer: &dyn Elastomer,
    load: &PeriodicLoad,
    request: impl Into<Request<'w>>,
) -> Result<PeriodicEstimate<PeriodicSliding>, BemError> {
    let control = load.require_stationary()?;
    let sliding = MaterialAtSpeed::under_load(elastomer, load)?;
    let goal = RefinementGoal {
        request: request.into(),
        control,
        friction: FRICTION_RATE,
        area: AREA_RATE,
        steps_per_row: None,
    };
    // Each grid starts from the pressure on the grid before.
    let mut guess = Vec::new();
    refine(surface, &goal, |sampled, tolerance, _| {
        let problem = PeriodicContact {
            sliding: &sliding,
            grid: &sampled.grid,
            heights: &sampled.heights,
            control,
            options: PeriodicOptions {
                tolerance,
                ..PeriodicOptions::default()
            },
        };
        let state = solve_from(&mut guess, problem)?;
        let found = GridResult {
            friction: state.friction_coefficient,
            from_dissipation: Some(state.friction_from_dissipation),
            area_fraction: area_fraction(&state.pressure.grid, &state.pressure.pressure, surface),
            in_contact: n_in_contact(&state.pressure),
            has_all_waves: sampled.has_all_waves,
            subgrid_gaps: SubgridGapBound::new(&state.pressure, surface),
            mean_pressure: mean(&state.pressure.pressure),
            mean_depth: state.mean_depth,
            residual: state.residual,
        };
        Ok((found, state))
    })
}

/// The result of [`steady`] on its first grid, or on one with `factor` times the elements along both axes, without an error bar.
///
/// It is meant for differences between surfaces, which coarse grids resolve well.
///
/// # Errors
/// Those of [`steady`] but [`BemError::NotReached`].
pub fn steady_on_coarse_grid(
    surface: &PeriodicSurface,
    elastomer: &dyn Elastomer,
    load: &PeriodicLoad,
    factor: usize,
) -> Result<PeriodicSliding, BemError> {
    // Sample the waves that the first grid resolves. The relative error of the request has no effect on its shape.
    let first = first_shape(surface, &Request::from(ANY_RELATIVE_ERROR))?;
    let shape = first.map(|edge| factor * edge);
    let SampledSurface { grid, heights, .. } = SampledSurface::new(surface, shape)?;
    let problem = PeriodicContact {
        sliding: &MaterialAtSpeed::under_load(elastomer, load)?,
        grid: &grid,
        heights: &heights,
        control: load.require_stationary()?,
        options: PeriodicOptions {
            tolerance: COARSE_GRID_TOLERANCE,
            ..PeriodicOptions::default()
        },
    };
    solve_from(&mut Vec::new(), problem)
}

/// Slides a sum of waves from rest over the sliding distance of the load.
///
/// The relative error of the request is that of the friction at the end; a number of elements is that of [`steady`]. The error is of
/// the first order in the spacing, and the work grows with its inverse third power, so that errors below some per cent take long.
///
/// # Errors
/// Those of [`slide_on_grid`](crate::periodic::slide_on_grid), and [`BemError::NotReached`] and [`BemError::GridTooLarge`] as for
/// [`steady`], also if a march that is fine enough would take longer than about half an hour.
pub fn slide<'w>(
    surface: &PeriodicSurface,
    elastomer: &dyn Elastomer,
    load: &PeriodicLoad,
    request: impl Into<Request<'w>>,
) -> Result<PeriodicEstimate<PeriodicTransient>, BemError> {
    let (mean_pressure, distance) = load.require_march()?;
    let request = request.into();
    let period = surface.period()[0];
    let edge = period / first_shape(surface, &request)?[0] as f64;
    // The steps are halved with the elements, so that the bars contain their errors too.
    let per_element = (MIN_FIRST_STEPS * edge / distance).ceil();
    let goal = RefinementGoal {
        request,
        control: load.control(),
        friction: FIRST_ORDER_RATE,
        area: FIRST_ORDER_RATE,
        steps_per_row: Some(distance / period * per_element),
    };
    refine(surface, &goal, |sampled, tolerance, tell| {
        let options = ContactOptions {
            tolerance,
            ..ContactOptions::default()
        };
        let steps = Steps {
            per_element,
            options,
            report: tell,
        };
        let state = slide_with(&sampled.grid, &sampled.heights, elastomer, load, &steps)?;
        let last = state.rows[state.rows.len() - 1];
        let found = GridResult {
            friction: last.friction_coefficient,
            from_dissipation: None,
            area_fraction: area_fraction(&state.pressure.grid, &state.pressure.pressure, surface),
            in_contact: n_in_contact(&state.pressure),
            has_all_waves: sampled.has_all_waves,
            subgrid_gaps: SubgridGapBound::new(&state.pressure, surface),
            mean_pressure,
            mean_depth: last.mean_depth,
            residual: tolerance,
        };
        Ok((found, state))
    })
}

/// Number of elements with a positive pressure.
fn n_in_contact(field: &PressureField) -> usize {
    let pressures = field.pressure.iter();
    pressures.filter(|pressure| **pressure > 0.0).count()
}
