//! The stationary state with an error bar of every quantity.

use indenters::{Control, SlidingLoad, Surface};
use numerics::{
    Accuracy, ErrorParts, Estimate, FIRST_ELEMENTS, Goal, Progress, Request, SilentProgress,
    positive,
};
use rheology::Material as _;

use crate::estimate::bars::{self, Resolution, Target, peak_has_limit};
use crate::estimate::plan::{GridPlan, NEGLIGIBLE_KINKS};
use crate::stationary::steady::grid_refinement::{SteadyProblem, refine};
use crate::stationary::steady::loading::Loading;
use crate::stationary::steady::patch_resolution::MIN_ELEMENTS_ACROSS;
use crate::stationary::steady::sliding_creep::SlidingCreep;
use crate::stationary::steady::solution::SteadyEstimate;
use crate::stationary::steady::{RefinementOptions, SteadyOptions, steady_on_grid};
use crate::{BemError, Elastomer};

/// Δy/Δx of a grid of a given number of elements.
const BODY_ASPECT: f64 = 0.5;
/// Order of the error under a smooth body. The front leaves 3/2, and an outline that follows the elements less: with 1.1 the
/// bars hold in 98.8 of 100 random scenes (docs/calibration.md), with 3/2 in 90, and with the first order they are wider.
const BODY_ORDER: f64 = 1.1;
/// Order at the edge of a flat end just inside the contact, under which elements see a punch.
const FLAT_END_ORDER: f64 = 0.5;
/// Part of the error of the friction from slopes that the error of that from dissipation must be below, to be taken: the
/// lesser of two bars holds less often than either.
const DISSIPATION_ERROR_RATIO_ON_ELEMENTS: f64 = 0.2;
/// Of a transform of the elements along x and y, of which finer grids take hardly more.
const WORK_EXPONENT: f64 = 2.0;
/// Footprints that are tried at most: the last one is 11 times as long as the first.
const MAX_FOOTPRINTS: usize = 7;
/// Memory for an element of the footprint that is followed, most of it for the kernel and the transforms, \[bytes].
const BYTES_PER_ELEMENT: f64 = 900.0;

/// Memory that [`steady`] takes at most for a number of elements along the contact, \[bytes]; a relative error is not sought
/// on grids that take more than 2 GB. Where the
/// contact is longer than expected, its footprint grows, and takes 9/4 of it each time.
///
/// # Errors
/// As for [`steady`], before anything is solved.
pub fn steady_memory(
    surface: &dyn Surface,
    elastomer: &dyn Elastomer,
    load: &SlidingLoad,
    elements: usize,
) -> Result<f64, BemError> {
    let plan = plan(surface, elastomer, load)?;
    let options = grid(&plan, elements);
    // A mirror halves the unknowns, and saves less of the kernel.
    let followed = if surface.mirrors()[1] { 0.5 } else { 0.7 };
    Ok(BYTES_PER_ELEMENT * followed * options.footprint.n_elements(options.spacing))
}

/// Solves in the footprint of a plan, and in larger ones while the contact reaches the boundary: how far a long surface, or one that
/// rises in steps, is met does not follow from its height alone.
fn in_growing_footprint<T>(
    mut plan: GridPlan,
    solve: impl Fn(&GridPlan) -> Result<T, BemError>,
) -> Result<T, BemError> {
    for _ in 1..MAX_FOOTPRINTS {
        match solve(&plan) {
            Err(BemError::ContactReachesBoundary { .. }) => plan.footprint = plan.footprint.grown(),
            result => return result,
        }
    }
    solve(&plan)
}

/// The grids of the stationary state, at whichever distance it is seen.
fn plan(
    surface: &dyn Surface,
    elastomer: &dyn Elastomer,
    load: &SlidingLoad,
) -> Result<GridPlan, BemError> {
    let endless = SlidingLoad::with(load.control(), load.velocity())?;
    let endless = load
        .track()
        .map_or(Ok(endless), |track| endless.on_track(track))?;
    GridPlan::sliding(surface, elastomer, &endless)
}

/// The grid of about so many elements along the contact, at least 1, and half as wide.
///
/// # Errors
/// As for [`steady`], before anything is solved.
pub fn steady_grid(
    surface: &dyn Surface,
    elastomer: &dyn Elastomer,
    load: &SlidingLoad,
    elements: usize,
) -> Result<SteadyOptions, BemError> {
    positive("elements", elements as f64)?;
    Ok(grid(&plan(surface, elastomer, load)?, elements))
}

fn grid(plan: &GridPlan, elements: usize) -> SteadyOptions {
    let dx = plan.length() / elements as f64;
    SteadyOptions::new([dx, BODY_ASPECT * dx], plan.footprint.widened(dx))
}

/// Solves the stationary sliding of `surface` on a linear viscoelastic half space, under a force or at a depth, to a
/// relative error of the friction coefficient, and of the normal force where that is not given; or with a number of
/// elements along the contact, about, and whatever error that has.
///
/// The state of a load with a sliding distance is stationary too, but for the depth of a material that flows, which is that
/// after the distance, up to terms of the order of (contact length)/(distance); [`slide`](crate::motions::slide::slide()) follows the
/// motion from first touch.
///
/// On a [track](SlidingLoad::on_track) the surface ahead of the body is what is left of all passes before, and the track acts on
/// itself within half its length only.
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
/// # Errors
/// [`BemError::NotReached`] with what was reached on the finest grid allowed;
/// [`BemError::GridTooLarge`] where a body is so steep that no error bar can come of the grids allowed;
/// [`BemError::InvalidParameter`] for a relative error that is not between 0 and 1, an apex as sharp as √r, whose
/// friction is infinite, or a surface that is low everywhere; on a track [`BemError::NoCycle`] for a material that flows, and
/// [`BemError::TrackTooShort`]; and the errors of [`steady_on_grid`](super::steady_on_grid).
pub fn steady<'w>(
    surface: &dyn Surface,
    elastomer: &dyn Elastomer,
    load: &SlidingLoad,
    request: impl Into<Request<'w>>,
) -> Result<SteadyEstimate, BemError> {
    let request = request.into();
    match request.accuracy {
        Accuracy::RelativeError(relative_error) => {
            let options = RefinementOptions {
                relative_error,
                ..RefinementOptions::default()
            };
            refined(surface, elastomer, load, &options, request.watch)
        }
        Accuracy::Elements(_) => with_elements(surface, elastomer, load, request),
    }
}

/// Like [`steady`], with elements and a limit of the work of one's own.
///
/// # Errors
/// As for [`steady`].
pub fn steady_refined(
    surface: &dyn Surface,
    elastomer: &dyn Elastomer,
    load: &SlidingLoad,
    options: &RefinementOptions,
) -> Result<SteadyEstimate, BemError> {
    refined(surface, elastomer, load, options, &SilentProgress)
}

fn refined(
    surface: &dyn Surface,
    elastomer: &dyn Elastomer,
    load: &SlidingLoad,
    options: &RefinementOptions,
    watch: &dyn Progress,
) -> Result<SteadyEstimate, BemError> {
    in_growing_footprint(plan(surface, elastomer, load)?, |plan| {
        let problem = SteadyProblem {
            surface,
            loading: Loading::new(surface, elastomer, load, &plan.footprint)?,
            plan,
            has_peak: peak_has_limit(surface, elastomer),
            watch,
        };
        refine(&problem, options, |estimate| {
            with_meaning(load, elastomer, estimate)
        })
    })
}

/// The state on a grid of a given number of elements, compared with grids of fewer.
fn with_elements(
    surface: &dyn Surface,
    elastomer: &dyn Elastomer,
    load: &SlidingLoad,
    request: Request,
) -> Result<SteadyEstimate, BemError> {
    in_growing_footprint(plan(surface, elastomer, load)?, |plan| {
        with_elements_in(plan, surface, elastomer, load, request)
    })
}

/// The same in the footprint of a plan.
fn with_elements_in(
    plan: &GridPlan,
    surface: &dyn Surface,
    elastomer: &dyn Elastomer,
    load: &SlidingLoad,
    request: Request,
) -> Result<SteadyEstimate, BemError> {
    let has_peak = peak_has_limit(surface, elastomer);
    let mut resolution = resolution(request, load.control(), BODY_ORDER, has_peak);
    if plan.kinks > NEGLIGIBLE_KINKS || plan.shows_cells {
        (
            resolution.goal.order,
            resolution.max_dissipation_error_ratio,
        ) = (FLAT_END_ORDER, f64::INFINITY);
    } else {
        resolution.goal.order = bars::order_of_friction(plan.apex_exponent, BODY_ORDER);
    }
    let creep = SlidingCreep::for_load(elastomer, load)?;
    let solve = |elements: usize, _: &dyn Fn(f64)| {
        let options = grid(plan, elements);
        let state = steady_on_grid(surface, elastomer, load, &options)
            .map_err(|error| with_needed_elements(error, request.accuracy, elements))?;
        Ok(state.on_grid((&creep, plan.kinks), options, load.sliding_distance()))
    };
    bars::resolve(&resolution, solve, |estimate| {
        with_meaning(load, elastomer, estimate)
    })
}

/// How many elements to ask for where one of the grids that make the error bar is too coarse, which has `elements`.
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
    // A patch may be narrower than its elements by about half of one, and other grids need as many across.
    let half_widths = (2 * across).saturating_sub(1).max(1);
    let on_coarsest = (2 * elements * least.max(MIN_ELEMENTS_ACROSS)).div_ceil(half_widths);
    BemError::ElementsTooFew {
        elements: asked,
        across,
        least,
        // The coarsest grid has three eighths of them.
        needed: (8 * on_coarsest).div_ceil(3),
    }
}

/// On a given number of elements.
pub(super) fn resolution(
    request: Request<'_>,
    control: Control,
    order: f64,
    has_peak: bool,
) -> Resolution<'_> {
    Resolution {
        goal: Goal {
            request,
            initial_elements: FIRST_ELEMENTS,
            max_elements: usize::MAX,
            order,
            work_exponent: WORK_EXPONENT,
            extra_work: 0.0,
            selection_factor: 2.0,
        },
        control,
        target: Target::Friction,
        has_peak,
        max_dissipation_error_ratio: DISSIPATION_ERROR_RATIO_ON_ELEMENTS,
    }
}

/// The estimate with a depth only where that has a meaning, and without the friction of an elastic material, which is
/// exactly 0 under any body: what the elements make of it is rounding.
fn with_meaning(
    load: &SlidingLoad,
    elastomer: &dyn Elastomer,
    mut estimate: SteadyEstimate,
) -> Result<SteadyEstimate, BemError> {
    if elastomer.material().creep().is_elastic() {
        estimate.friction_coefficient = Estimate::exact(0.0);
        estimate.error_parts = ErrorParts::NONE;
    }
    let depth = &estimate.finest.depth;
    if let (Control::NormalForce(_), true) = (load.control(), depth.depth_per_e_fold > 0.0) {
        match load.sliding_distance() {
            None => estimate.indentation_depth = None,
            // Refuses a distance on which the state is not stationary yet.
            Some(distance) => drop(depth.after(distance)?),
        }
    }
    Ok(estimate)
}
