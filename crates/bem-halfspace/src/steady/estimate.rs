//! The stationary state with an error bar of every quantity.

use indenters::{Control, SlidingLoad, Surface};
use numerics::{Accuracy, ErrorParts, Estimate};
use rheology::Material;

use crate::BemError;
use crate::bars::{self, Resolution, Target, peak_has_limit};
use crate::error::below_one;
use crate::plan::GridPlan;
use crate::steady::loading::Loading;
use crate::steady::refinement::{Refined, limit, order_of_friction, refine};
use crate::steady::{Refinement, RefinementOptions, SteadyOptions, SteadySliding, steady_on_grid};

/// Δy/Δx of a grid of a given number of elements.
const ASPECT: f64 = 0.5;
/// Order in which the area of the elements in contact approaches that of the contact.
const AREA_ORDER: f64 = 1.0;

/// A stationary state with its error bars; an error of 0 says that the quantity is given.
#[derive(Debug, Clone, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize))]
#[must_use]
pub struct SteadyEstimate {
    /// Friction coefficient μ = F_h/F_N.
    pub friction_coefficient: Estimate,
    /// What the error of the friction coefficient consists of.
    pub error_parts: ErrorParts,
    /// Normal force F_N, \[N].
    pub normal_force: Estimate,
    /// Depth of the lowest point below the undeformed surface, \[m]; none where the material flows and the load has no
    /// sliding distance, because the body sinks for ever.
    pub indentation_depth: Option<Estimate>,
    /// Contact area, \[m²].
    pub contact_area: Estimate,
    /// Largest pressure \[Pa], of smooth bodies of revolution on materials that react at once; everywhere else it grows
    /// without limit on refinement, or is not known to have one.
    pub peak_pressure: Option<Estimate>,
    /// Error of the ends of the contact along x and y in [`finest`](Self::finest), \[m].
    pub contact_box_error: f64,
    /// The refinements that led there, from coarse to fine; none where the number of elements was given.
    pub refinements: Vec<Refinement>,
    /// The state on the finest grid.
    pub finest: SteadySliding,
    /// The finest grid.
    pub options: SteadyOptions,
}

/// Solves the stationary sliding of `surface` on a linear viscoelastic half space, under a force or at a depth, to a
/// relative error of the friction coefficient, and of the normal force where that is not given; or with a number of
/// elements along the contact, about, and whatever error that has.
///
/// A sliding distance of the load changes nothing but the depth of a material that flows.
///
/// # Errors
/// [`BemError::FrictionNotReached`] and [`BemError::ForceNotReached`] with what was reached on the finest grid allowed;
/// [`BemError::GridTooLarge`] where a body is so steep that no error bar can come of the grids allowed;
/// [`BemError::InvalidParameter`] for a relative error that is not between 0 and 1, an apex as sharp as √r, whose
/// friction is infinite, or a surface that is low everywhere; and the errors of [`steady_on_grid`](super::steady_on_grid).
pub fn steady(
    surface: &(impl Surface + ?Sized),
    material: &(impl Material + ?Sized),
    load: &SlidingLoad,
    accuracy: impl Into<Accuracy>,
) -> Result<SteadyEstimate, BemError> {
    let accuracy = accuracy.into();
    match accuracy {
        Accuracy::RelativeError(relative_error) => {
            let options = RefinementOptions {
                relative_error,
                ..RefinementOptions::default()
            };
            steady_refined(surface, material, load, &options)
        }
        Accuracy::Elements(_) => with_elements(&surface, material, load, accuracy),
    }
}

/// Like [`steady`], with elements and a limit of the work of one's own.
///
/// # Errors
/// As for [`steady`].
pub fn steady_refined(
    surface: &(impl Surface + ?Sized),
    material: &(impl Material + ?Sized),
    load: &SlidingLoad,
    options: &RefinementOptions,
) -> Result<SteadyEstimate, BemError> {
    let surface: &dyn Surface = &surface;
    below_one("relative_error", options.relative_error)?;
    let plan = GridPlan::sliding(surface, material, load)?;
    let loading = Loading::new(surface, material, load, &plan.footprint)?;
    let Refined {
        friction_coefficient: friction,
        normal_force,
        refinements,
        finest,
        options,
    } = refine(surface, loading, &plan, options)?;
    let order = order_of_friction(plan.apex_exponent)?;
    let iteration = finest.iteration_error();
    let parts = ErrorParts {
        discretisation: Some(friction.error),
        iteration: Some(iteration),
        ..ErrorParts::NONE
    };
    let depth = limit(&refinements, order, |r| r.indentation_depth).into();
    let peak = limit(&refinements, order, |r| r.peak_pressure).into();
    Ok(SteadyEstimate {
        friction_coefficient: Estimate {
            value: friction.value,
            error: friction.error + iteration,
        },
        error_parts: parts,
        normal_force: bars::force(load.control(), normal_force.into()),
        indentation_depth: depth_of(load, &finest, depth)?,
        contact_area: limit(&refinements, AREA_ORDER, |r| r.contact_area).into(),
        peak_pressure: peak_has_limit(surface, material).then_some(peak),
        contact_box_error: bars::of_box(options.spacing),
        refinements,
        finest,
        options,
    })
}

/// The state on a grid of a given number of elements, compared with grids of fewer.
fn with_elements(
    surface: &dyn Surface,
    material: &(impl Material + ?Sized),
    load: &SlidingLoad,
    accuracy: Accuracy,
) -> Result<SteadyEstimate, BemError> {
    let plan = GridPlan::sliding(surface, material, load)?;
    let options = |spacing: f64| {
        SteadyOptions::new([spacing, ASPECT * spacing], plan.footprint.widened(spacing))
    };
    let resolution = Resolution {
        accuracy,
        target: Target::Friction,
        largest: usize::MAX,
        order: bars::order_of_friction(plan.apex_exponent),
    };
    let resolved = bars::resolve(
        &resolution,
        |elements| {
            let options = options(plan.length() / elements as f64);
            steady_on_grid(surface, material, load, &options)
        },
        |state| state.quantities(load.sliding_distance()),
        |_, state| state.other_parts(),
    )?;
    let (finest, known) = (resolved.finest, resolved.estimates);
    let options = options(finest.pressure.grid.spacing()[0]);
    Ok(SteadyEstimate {
        friction_coefficient: known.friction_coefficient,
        error_parts: resolved.parts.friction_coefficient,
        normal_force: bars::force(load.control(), known.normal_force),
        indentation_depth: depth_of(load, &finest, known.indentation_depth)?,
        contact_area: known.contact_area,
        peak_pressure: peak_has_limit(surface, material).then_some(known.peak_pressure),
        contact_box_error: bars::of_box(options.spacing),
        refinements: Vec::new(),
        finest,
        options,
    })
}

/// The depth that is given, or the one that was found where it has a meaning.
fn depth_of(
    load: &SlidingLoad,
    finest: &SteadySliding,
    found: Estimate,
) -> Result<Option<Estimate>, BemError> {
    let sinks = finest.depth.depth_per_e_fold > 0.0;
    if let (Control::NormalForce(_), true) = (load.control(), sinks) {
        let Some(distance) = load.sliding_distance() else {
            return Ok(None);
        };
        // Refuses a distance on which the state is not stationary yet.
        finest.depth.after(distance)?;
    }
    Ok(Some(bars::depth(load.control(), found)))
}
