//! Line contact: a profile that is infinite along y slides in plane strain.
//!
//! One element along y is so long that its ends are beyond the influence radius. Up to a constant, the potential V of an element
//! of the length Δx along x and L along y is that of a line load,
//!
//! ```text
//! V(x) = 2 Δx ln(L/|x|) + O(x²/L²)
//! ```
//!
//! and the constant is absorbed in the depth, which in plane strain has a meaning on a layer only. All forces and areas are per unit
//! length along y. On a half space that flows there is no such limit: the surface sinks the faster the longer the line is.
//!
//! Theory: docs/theory/stationary-half-space.md, "Line contact".

use indenters::{SlidingLoad, Surface};
use numerics::{Estimate, Request};

use crate::elements::area::EXCESS_PER_EDGE;
use crate::estimate::bars;
use crate::estimate::plan::GridPlan;
use crate::stationary::steady::body_estimate::resolution;
use crate::stationary::steady::contact_scale::profile_scale;
use crate::stationary::steady::grid_refinement::{SteadyProblem, refine};
use crate::stationary::steady::loading::Loading;
use crate::stationary::steady::sliding_creep::SlidingCreep;
use crate::stationary::steady::{RefinementOptions, Reuse, SteadyEstimate, SteadyOptions, solve};
use crate::{BemError, Elastomer, Footprint};

/// Number of elements of the coarsest grid along half the contact of a cylinder on an elastic half space. Chosen; from 2 to 12
/// bars are 0.05 to 3.8 times as wide (case of `evidence tuning`).
const COARSEST_PER_HALF_LENGTH: f64 = 4.0;
/// Distance of both ends of the footprint from the lowest point, on a material without memory, in half lengths of the contact of a
/// cylinder on an elastic half space. No contact reaches further back than the elastic one, at 1. Chosen; from 1 to 4 no answer
/// changes by more than 2e-8 of its bar (case of `evidence tuning`).
const FOOTPRINT_OVER_HALF_LENGTH: f64 = 2.5;
/// Shift of the front of the footprint per e-fold of the memory length, in half lengths of the contact on an elastic half space.
/// The distance ahead at which the surface still rises grows with the logarithm of the memory length. Chosen; from 0.1 to 2 no
/// answer changes by more than 1e-8 of its bar (case of `evidence tuning`). Without it a cylinder on a Kelvin–Voigt solid of long
/// memory touches outside its footprint.
const FOOTPRINT_FRONT_PER_LOG_MEMORY: f64 = 0.5;

/// Largest number of unknown pressures in plane strain. Chosen to limit the time, since systems of this size are solved directly:
/// refinement ends before a larger one.
const MAX_UNKNOWNS_OF_LINE: usize = 2000;

/// The stationary state of a smooth profile that is infinite along y; arguments and errors as for [`steady`](super::steady()).
pub(super) fn steady_line(
    profile: &dyn Surface,
    elastomer: &dyn Elastomer,
    load: &SlidingLoad,
    request: Request,
) -> Result<SteadyEstimate, BemError> {
    // Replace the infinite profile by a strip of finite length, and plan grids from a few elements along half the contact on.
    let force = load.require_normal_force()?;
    let LineScale {
        half_length,
        footprint,
    } = line_scale(profile, elastomer, load)?;
    let loading = Loading::per_length(profile, elastomer, load, footprint)?;
    let strip = Strip::new(profile, &loading);
    let spacing = half_length / COARSEST_PER_HALF_LENGTH;
    let plan = GridPlan::smooth(strip.footprint(footprint), spacing, 2.0);
    let problem = SteadyProblem {
        surface: &strip,
        loading,
        plan: &plan,
        has_peak: bars::has_instantaneous_compliance(elastomer),
        watch: request.watch,
    };

    // The result has no friction on an elastic material, and no depth on a half space.
    let has_depth = elastomer.base().is_rigid();
    let finish = |mut found: SteadyEstimate| {
        found.normal_force = Estimate::exact(force);
        if problem.loading.creep.is_elastic() {
            found.remove_friction();
        }
        found.indentation_depth = found.indentation_depth.filter(|_| has_depth);
        Ok(found)
    };
    if let Some(relative_error) = request.accuracy.relative_error() {
        let options = RefinementOptions {
            relative_error,
            max_unknowns: MAX_UNKNOWNS_OF_LINE,
            ..RefinementOptions::default()
        };
        return refine(&problem, &options, finish);
    }

    // Solve on all grids that the error estimate for this number of elements needs.
    let loading = &problem.loading;
    let resolution = resolution(request, loading.control, problem.has_peak);
    let solve = |elements: usize, _: &dyn Fn(f64)| {
        let spacing = 2.0 * half_length / elements as f64;
        let options = SteadyOptions::new([spacing, strip.length], plan.footprint);
        let state = solve(&strip, loading, &options, &mut Reuse::default())?;
        let mut on_grid = state.on_grid(&loading.creep, 0.0, options, None);
        // Each end of a width of whole elements is off by up to half an element, and on average too far out by the excess.
        on_grid.area_uncertainty = (1.0 + 2.0 * EXCESS_PER_EDGE) * spacing;
        Ok(on_grid)
    };
    bars::resolve(&resolution, solve, finish)
}

/// Length scale of a line contact, and the interval along x in which contact may occur.
struct LineScale {
    /// Half the contact of a cylinder on an elastic half space, \[m].
    half_length: f64,
    /// Rear and front, \[m].
    footprint: [f64; 2],
}

/// Scale and footprint of the contact of a profile, before anything is solved.
fn line_scale(
    profile: &dyn Surface,
    elastomer: &dyn Elastomer,
    load: &SlidingLoad,
) -> Result<LineScale, BemError> {
    let creep = SlidingCreep::for_load(elastomer, load)?;
    let scale = profile_scale(profile, &creep, load.require_normal_force()?)?;
    let half_length = scale.half_length;
    let log_memory = (creep.memory_length() / half_length).ln_1p();
    let front = FOOTPRINT_OVER_HALF_LENGTH + FOOTPRINT_FRONT_PER_LOG_MEMORY * log_memory;
    Ok(LineScale {
        half_length,
        footprint: [
            -FOOTPRINT_OVER_HALF_LENGTH * half_length,
            front * half_length,
        ],
    })
}

/// The grid with a number of `elements` along the contact of a cylinder on an elastic half space.
pub(super) fn line_grid(
    profile: &dyn Surface,
    elastomer: &dyn Elastomer,
    load: &SlidingLoad,
    elements: f64,
) -> Result<SteadyOptions, BemError> {
    let LineScale {
        half_length,
        footprint,
    } = line_scale(profile, elastomer, load)?;
    let spacing = 2.0 * half_length / elements;
    let footprint = Footprint {
        x: footprint,
        y: [-spacing, spacing],
    };
    Ok(SteadyOptions::new([spacing; 2], footprint))
}

/// A profile of the length of one element along y, in place of an infinite one.
pub(super) struct Strip<'a> {
    /// Profile along x; its heights at y = 0 count.
    profile: &'a dyn Surface,
    /// Length along y, \[m].
    pub(super) length: f64,
}

impl<'a> Strip<'a> {
    /// Strip that replaces an infinite profile; its length along y is that of `loading`.
    pub(super) fn new(profile: &'a dyn Surface, loading: &Loading) -> Self {
        Self {
            profile,
            length: loading.strip.unwrap_or(f64::INFINITY),
        }
    }

    /// The footprint between two ends along x, with an empty element on either side along y.
    pub(super) fn footprint(&self, x: [f64; 2]) -> Footprint {
        let y = [-self.length, self.length];
        Footprint { x, y }
    }
}

impl Surface for Strip<'_> {
    /// Height of the profile within the length of the strip, infinite beyond its ends.
    fn height(&self, position: [f64; 2]) -> f64 {
        if position[1].abs() > 0.5 * self.length {
            f64::INFINITY
        } else {
            self.profile.height([position[0], 0.0])
        }
    }

    /// Slopes of the profile at y = 0.
    fn gradient(&self, position: [f64; 2]) -> [f64; 2] {
        self.profile.gradient([position[0], 0.0])
    }

    /// Symmetry of the profile about x = 0; every strip is symmetric about y = 0.
    fn mirrors(&self) -> [bool; 2] {
        let [along_x, _] = self.profile.mirrors();
        [along_x, true]
    }
}
