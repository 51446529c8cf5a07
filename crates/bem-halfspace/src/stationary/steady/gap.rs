//! Gap around a stationary contact, from its pressure.
//!
//! One product with the kernel of the solver gives the displacement u at the collocation points of all elements around the contact:
//!
//! ```text
//! gap = h + u − d,        d = mean of h + u over the elements with pressure
//! ```
//!
//! Theory: docs/theory/stationary-half-space.md, "One complementarity problem" and "Where the gap is evaluated".

use indenters::SlidingLoad;
use numerics::whole_part;

use crate::elements::bounds::Bounds;
use crate::elements::gap_field::{GapField, surroundings};
use crate::elements::pressure_field::PressureField;
use crate::stationary::steady::SteadyOptions;
use crate::stationary::steady::plans::Plans;
use crate::stationary::steady::steady_body::SteadyBody;
use crate::transform::plane_transform::Workspace;
use crate::{BemError, Elastomer, Grid};

/// Gap around the contact of a body in stationary sliding, from the `pressure` of its state on the grid of `options`. The field covers
/// the contact and a quarter of its length and width on each side, less where the footprint or the body ends before; `None` if the body
/// does not cover the box of the contact, as a flat punch.
///
/// ```
/// use bem_halfspace::indenters::PowerProfile;
/// use bem_halfspace::steady::{SteadyOptions, gap};
/// use bem_halfspace::{Footprint, SlidingLoad, rheology::Elastic, steady_on_grid};
///
/// let (ball, rubber) = (PowerProfile::paraboloid(50.0)?, Elastic::new(1e6)?);
/// let load = SlidingLoad::new(1.0, 0.1)?;
/// let grid = SteadyOptions::new([4e-5; 2], Footprint::square(2.5e-3));
/// let state = steady_on_grid(&ball, &rubber, &load, &grid)?;
/// let field = gap(&ball, &rubber, &load, &grid, &state.pressure)?.ok_or("a field")?;
/// assert!(field.gap.iter().all(|gap| *gap > -1e-12));
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
///
/// # Errors
/// As for [`steady_on_grid`](super::steady_on_grid), before anything is solved; [`BemError::LengthMismatch`] and
/// [`BemError::InvalidParameter`] for a field without one pressure per element or without a positive one.
pub fn gap<'a>(
    body: impl Into<SteadyBody<'a>>,
    elastomer: &dyn Elastomer,
    load: &SlidingLoad,
    options: &SteadyOptions,
    pressure: &PressureField,
) -> Result<Option<GapField>, BemError> {
    pressure.check_contact()?;
    let (surface, loading, options) = body.into().on_grid(elastomer, load, options)?;
    // Find the box of the pressure in the footprint, and the elements around it that the body covers.
    let (spacing, origin) = (options.spacing, pressure.origin);
    let on_grid = loading.on_grid(spacing)?;
    let footprint = options.footprint.elements(spacing)?;
    let lower = [0, 1].map(|axis| {
        let [before, _] = footprint[axis];
        let from_first = origin[axis] / spacing[axis] - options.phase[axis] + before as f64;
        whole_part(from_first.round().max(0.0))
    });
    let shape = pressure.grid.shape();
    let contact = Bounds {
        lower,
        upper: [0, 1].map(|axis| lower[axis] + shape[axis]),
    };
    let limits = Bounds {
        lower: [0; 2],
        upper: footprint.map(|[before, after]| before + after + 1),
    };
    let centre = |axis: usize, index: usize| {
        origin[axis] + (index as f64 - lower[axis] as f64) * spacing[axis]
    };
    // Take the heights at the collocation points, and grow the box as far as the body reaches.
    let shift = on_grid.creep.collocation_shift * spacing[0];
    let height = |[row, column]: [usize; 2]| {
        surface.height([centre(0, row) + shift, centre(1, column)]) / on_grid.depth_scale
    };
    let Some(bounds) = surroundings(&contact, &limits, |element| height(element).is_finite())
    else {
        return Ok(None);
    };

    // Displace all elements by the loads of the contact.
    let grid = Grid::new(bounds.shape(), spacing)?;
    let elements =
        (bounds.rows()).flat_map(|row| bounds.columns().map(move |column| [row, column]));
    let unit = on_grid.pressure_unit();
    let load = |element: [usize; 2]| {
        let is_inside = contact.contains(element);
        is_inside.then(|| pressure.pressure[contact.index_of(element)] / unit)
    };
    let loads: Vec<f64> = elements.clone().map(|at| load(at).unwrap_or(0.0)).collect();
    let mut gap = loads.clone();
    let mut plans = Plans::default();
    plans.prepare(&on_grid.creep, spacing[1] / spacing[0], bounds.shape());
    let filters = plans.kernel(bounds.shape());
    let mut workspace = Workspace::new(&filters.transform, bounds.shape());
    filters
        .transform
        .filter(&mut workspace, &mut gap, &filters.spectra[0]);

    // Subtract the depth, which is the mean of height and displacement in the contact.
    let (mut sum, mut count) = (0.0, 0.0);
    for ((gap, element), load) in gap.iter_mut().zip(elements).zip(&loads) {
        *gap += height(element);
        if *load > 0.0 {
            sum += *gap;
            count += 1.0;
        }
    }
    let depth = sum / count;
    for gap in &mut gap {
        *gap = (*gap - depth) * on_grid.depth_scale;
    }
    Ok(Some(GapField {
        grid,
        origin: [0, 1].map(|axis| centre(axis, bounds.lower[axis])),
        gap,
    }))
}
