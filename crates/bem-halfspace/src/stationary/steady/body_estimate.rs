//! The stationary state of a body to a requested accuracy, with an error estimate of every quantity.
//!
//! Theory: docs/theory/stationary-half-space.md, "Scatter, order, error bar".

use indenters::{Control, SlidingLoad, Surface};
use numerics::{Accuracy, Request, positive};
use rheology::Material as _;

use crate::estimate::bars::{self, Resolution, Target, peak_has_limit};
use crate::estimate::plan::GridPlan;
use crate::estimate::refinement_limits::STATIONARY;
use crate::stationary::steady::extrapolation::FLAT_END_ORDER;
use crate::stationary::steady::grid_refinement::{DEFAULT_ASPECT, SteadyProblem, refine};
use crate::stationary::steady::line::{line_grid, steady_line};
use crate::stationary::steady::loading::Loading;
use crate::stationary::steady::patch_resolution::MIN_ELEMENTS_ACROSS;
use crate::stationary::steady::sliding_creep::SlidingCreep;
use crate::stationary::steady::solution::SteadyEstimate;
use crate::stationary::steady::steady_body::SteadyBody;
use crate::stationary::steady::{RefinementOptions, SteadyOptions, steady_on_grid};
use crate::{BemError, Elastomer};

/// Convergence order that is assumed for the friction of a smooth body on a given number of elements. The front of the contact
/// causes the order 3/2, a contact boundary that follows the elements a lower one. Chosen: with 1.1 the error estimates hold in
/// 98.8 of 100 random scenes (docs/calibration.md), with 3/2 in 90. With 1 they are wider. It has a case of `evidence tuning`.
const BODY_ORDER: f64 = 1.1;
/// Largest number of footprints that are tried. Chosen to limit the time: a contact that reaches the boundary of the last one is
/// an error. Each is 1.5 times as long as the one before, so that the last is 11 times as long as the first.
const MAX_FOOTPRINTS: usize = 7;
/// Upper bound of the memory per element of the footprint that is solved for, most of it for kernel and transforms, \[bytes].
/// Measured: a test compares memory stated and taken (tests/it/memory.rs).
const STEADY_BYTES_PER_ELEMENT: f64 = 1000.0;

/// Largest memory of [`steady`] for a number of elements along the contact, \[bytes]. Where the contact is longer than expected, its
/// footprint grows, and takes 9/4 of the memory each time.
///
/// For a requested relative error no grid takes more than 2 GB.
///
/// # Errors
/// As for [`steady`], before anything is solved.
pub fn steady_memory(
    surface: &dyn Surface,
    elastomer: &dyn Elastomer,
    load: &SlidingLoad,
    elements: usize,
) -> Result<f64, BemError> {
    let plan = plan_of_grids(surface, elastomer, load)?;
    let options = grid_of_plan(&plan, elements);
    // With a mirror symmetry half of the elements are unknowns. The kernel is not halved, so that less memory is saved.
    let solved_fraction = if surface.mirrors()[1] { 0.5 } else { 0.7 };
    Ok(STEADY_BYTES_PER_ELEMENT * solved_fraction * options.footprint.n_elements(options.spacing))
}

/// Calls `solve` with a plan, and with larger footprints while the contact reaches the boundary. Under a long surface, or one that
/// rises in steps, the length of the contact does not follow from heights alone.
fn in_growing_footprint<T>(
    mut plan: GridPlan,
    solve: impl Fn(&GridPlan) -> Result<T, BemError>,
) -> Result<T, BemError> {
    for _ in 1..MAX_FOOTPRINTS {
        match solve(&plan) {
            Err(BemError::ContactReachesBoundary { .. }) => {
                plan.footprint = plan.footprint.doubled();
            }
            result => return result,
        }
    }
    solve(&plan)
}

/// The plan of the grids of the stationary state, which does not depend on the sliding distance.
fn plan_of_grids(
    surface: &dyn Surface,
    elastomer: &dyn Elastomer,
    load: &SlidingLoad,
) -> Result<GridPlan, BemError> {
    // Build the load anew without its sliding distance, but on its track.
    let without_distance = SlidingLoad::with(load.control(), load.velocity())?;
    let stationary = match load.track() {
        None => without_distance,
        Some(track) => without_distance.on_track(track)?,
    };
    GridPlan::sliding(surface, elastomer, &stationary)
}

/// The grid with about `elements` elements along the contact, at least 1. Those of a body are half as wide as long.
///
/// # Errors
/// As for [`steady`], before anything is solved.
pub fn steady_grid<'a>(
    body: impl Into<SteadyBody<'a>>,
    elastomer: &dyn Elastomer,
    load: &SlidingLoad,
    elements: usize,
) -> Result<SteadyOptions, BemError> {
    let given = positive("elements", elements as f64)?;
    match body.into() {
        SteadyBody::Line(profile) => line_grid(profile, elastomer, load, given),
        SteadyBody::Body(surface) => {
            let plan = plan_of_grids(surface, elastomer, load)?;
            Ok(grid_of_plan(&plan, elements))
        }
    }
}

/// The grid with about `elements` elements along the contact, half as wide as long, in the footprint of a plan.
fn grid_of_plan(plan: &GridPlan, elements: usize) -> SteadyOptions {
    let dx = plan.length() / elements as f64;
    SteadyOptions::new([dx, DEFAULT_ASPECT * dx], plan.footprint.widened(dx))
}

/// Solves the stationary sliding of a body on a linear viscoelastic half space, under a force or at a depth. The request is a
/// relative error of the friction coefficient, and of the normal force where that is not given, or an approximate number of
/// elements along the contact.
///
/// A sliding distance of the load has an effect on a material that flows only. The depth is that after the distance, up to terms of the
/// order of (contact length)/(distance); [`slide`](crate::motions::slide::slide()) follows the motion from first touch.
///
/// On a [track](SlidingLoad::on_track) the surface ahead of the body still contains the creep of all passes before. Loads act on the
/// surface within half the length of the track only.
///
/// ```
/// use bem_halfspace::indenters::PowerProfile;
/// use bem_halfspace::rheology::{StandardSolid, StandardSolidParameters};
/// use bem_halfspace::{SlidingLoad, steady};
///
/// let ball = PowerProfile::paraboloid(50.0)?;
/// let rubber = StandardSolid::new(StandardSolidParameters {
///     equilibrium_modulus: 1e6,
///     maxwell_modulus: 9e6,
///     viscosity: 9e4,
/// })?;
/// let state = steady(&ball, &rubber, &SlidingLoad::new(1.0, 0.1)?, 1e-2)?;
/// let friction = state.friction_coefficient;
/// assert!(friction.value > 0.0 && friction.error <= 1e-2 * friction.value);
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
///
/// In plane strain, after Hertz, the half width is √(4 F' R/(π E*)) with E* = 4 G:
///
/// ```
/// use bem_halfspace::indenters::Cylinder;
/// use bem_halfspace::{SlidingLoad, SteadyBody, rheology::Elastic, steady};
///
/// let (roll, rubber) = (Cylinder::new(0.01)?, Elastic::new(1e6)?);
/// let state = steady(SteadyBody::Line(&roll), &rubber, &SlidingLoad::new(1e3, 0.1)?, 1e-2)?;
/// let width = 2.0 * (4.0 * 1e3 * 0.01 / (std::f64::consts::PI * 4e6)).sqrt();
/// assert!((state.contact_area.value - width).abs() <= state.contact_area.error);
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
///
/// # Errors
/// [`BemError::NotReached`] with the result on the finest grid allowed;
/// [`BemError::GridTooLarge`] where a body is so steep that the grids allowed give no error estimate;
/// [`BemError::InvalidParameter`] for a relative error that is not between 0 and 1, an apex as sharp as √r, whose
/// friction is infinite, or a surface that nowhere reaches the height needed; on a track [`BemError::NoCycle`] for a material that
/// flows, and
/// [`BemError::TrackTooShort`]; and the errors of [`steady_on_grid`].
pub fn steady<'a, 'w>(
    body: impl Into<SteadyBody<'a>>,
    elastomer: &dyn Elastomer,
    load: &SlidingLoad,
    request: impl Into<Request<'w>>,
) -> Result<SteadyEstimate, BemError> {
    match body.into() {
        SteadyBody::Line(profile) => steady_line(profile, elastomer, load, request.into()),
        SteadyBody::Body(surface) => {
            let options = RefinementOptions::default();
            refine_state(surface, elastomer, load, &options, request.into())
        }
    }
}

/// Like [`steady`] of a body in three dimensions, with the aspect ratio of the elements and the limit of the work as options.
///
/// # Errors
/// As for [`steady`].
pub fn steady_refined(
    surface: &dyn Surface,
    elastomer: &dyn Elastomer,
    load: &SlidingLoad,
    options: &RefinementOptions,
) -> Result<SteadyEstimate, BemError> {
    let request = options.relative_error.into();
    refine_state(surface, elastomer, load, options, request)
}

/// The stationary state to the relative error of the `request`, which replaces that of the options, or on its number of elements; in a
/// footprint that grows with the contact.
fn refine_state(
    surface: &dyn Surface,
    elastomer: &dyn Elastomer,
    load: &SlidingLoad,
    options: &RefinementOptions,
    request: Request,
) -> Result<SteadyEstimate, BemError> {
    let finish = |estimate| remove_undefined_quantities(load, elastomer, estimate);
    let has_peak = peak_has_limit(surface, elastomer);
    let creep = SlidingCreep::for_load(elastomer, load)?;
    in_growing_footprint(plan_of_grids(surface, elastomer, load)?, |plan| {
        // A relative error is reached by refinement.
        if let Some(relative_error) = request.accuracy.relative_error() {
            let problem = SteadyProblem {
                surface,
                loading: Loading::new(surface, elastomer, load, &plan.footprint)?,
                plan,
                has_peak,
                watch: request.watch,
            };
            let options = RefinementOptions {
                relative_error,
                ..*options
            };
            return refine(&problem, &options, finish);
        }

        // On a given number of elements the convergence order is assumed: that of the sharpest feature, an edge or the apex, or
        // of a smooth body.
        let mut resolution = resolution(request, load.control(), has_peak);
        if plan.has_edges {
            resolution.goal.order = FLAT_END_ORDER;
        } else {
            resolution.goal.order = bars::order_of_friction(plan.apex_exponent, BODY_ORDER);
        }
        let solve = |elements: usize, _: &dyn Fn(f64)| {
            let options = grid_of_plan(plan, elements);
            let state = steady_on_grid(surface, elastomer, load, &options)
                .map_err(|error| with_needed_elements(error, request.accuracy, elements))?;
            // Straight contact boundaries, as those of height maps, let grids agree by chance.
            let uncertainty = state.pressure.friction_uncertainty(surface);
            let mut on_grid = state.on_grid(&creep, plan.kinks, options, load.sliding_distance());
            on_grid.target_uncertainty = uncertainty;
            if plan.has_edges {
                // The dissipated power needs no slopes, which are not defined at edges.
                let friction = on_grid.state.friction_from_dissipation;
                on_grid.quantities.friction_coefficient = friction;
            }
            Ok(on_grid)
        };
        bars::resolve(&resolution, solve, finish)
    })
}

/// Converts the error of a grid of `elements` elements that does not resolve a patch into one that says how many elements to request.
/// Other errors do not change.
fn with_needed_elements(error: BemError, asked: Accuracy, elements: usize) -> BemError {
    let (
        &BemError::GridTooCoarse {
            elements: across,
            needed: least,
        },
        Accuracy::Elements(asked),
    ) = (&error, asked)
    else {
        return error;
    };
    // A patch may be narrower than its elements by about half an element. Grids of bodies need more across than along.
    let half_widths = (2 * across).saturating_sub(1).max(1);
    let on_coarsest = (2 * elements * least.max(MIN_ELEMENTS_ACROSS)).div_ceil(half_widths);
    BemError::ElementsTooFew {
        elements: asked,
        across,
        least,
        // The coarsest of the grids for the error estimate has 3/8 of the requested elements.
        needed: (8 * on_coarsest).div_ceil(3),
    }
}

/// Goal and error model of a solution on a given number of elements, with the convergence order of a smooth body.
pub(super) fn resolution(request: Request<'_>, control: Control, has_peak: bool) -> Resolution<'_> {
    Resolution {
        goal: STATIONARY.goal(request, BODY_ORDER),
        control,
        target: Target::Friction,
        has_peak,
    }
}

/// Removes the quantities that are not defined: the depth on a material that flows if there is no sliding distance, and the friction
/// of an elastic material, which is exactly 0 under any body.
///
/// # Errors
/// [`BemError::InvalidParameter`] for a sliding distance on which the state is not yet stationary.
fn remove_undefined_quantities(
    load: &SlidingLoad,
    elastomer: &dyn Elastomer,
    mut estimate: SteadyEstimate,
) -> Result<SteadyEstimate, BemError> {
    if elastomer.material().creep().is_elastic() {
        estimate.remove_friction();
    }
    let depth = &estimate.finest.depth;
    if let (Control::NormalForce(_), true) = (load.control(), depth.depth_per_e_fold > 0.0) {
        match load.sliding_distance() {
            None => estimate.indentation_depth = None,
            // The depth is not needed here: the call only checks that the distance is long enough.
            Some(distance) => drop(depth.after(distance)?),
        }
    }
    Ok(estimate)
}
