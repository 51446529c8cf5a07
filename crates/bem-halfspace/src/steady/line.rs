//! Line contact: a profile that is infinite along y slides in plane strain.
//!
//! One element along y is so long that its ends are not felt: up to a constant, its potential is that of a line load,
//!
//! ```text
//! V(x) = 2 Δx ln(L/|x|) + O(x²/L²)
//! ```
//!
//! and the constant is absorbed in the depth, which in plane strain has no meaning. All forces and areas are per length
//! along y. On a half space that flows there is no such limit: the surface sinks the faster the longer the line is.

use indenters::{SlidingLoad, Surface};
use numerics::{Accuracy, ErrorParts, Estimate};
use rheology::Material;

use crate::bars::{self, Resolution, Target};
use crate::plan::GridPlan;
use crate::steady::loading::{Loading, scale_of_profile};
use crate::steady::refinement::{Refined, limit, refine};
use crate::steady::sliding_creep::SlidingCreep;
use crate::steady::{Refinement, RefinementOptions, Reuse, SteadyOptions, SteadySliding, solve};
use crate::{BemError, Footprint};

/// One grid for stationary sliding in plane strain.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct LineOptions {
    /// Length Δx of an element, \[m].
    pub spacing: f64,
    /// Where in its element the lowest point of the profile lies, in elements from its centre, between −1/2 and 1/2.
    pub phase: f64,
    /// From rear to front, where contact may occur: `footprint[0] < 0 < footprint[1]`, \[m].
    pub footprint: [f64; 2],
    /// Largest residual h + u − d allowed in the contact, and largest penetration outside, relative to the depth scale
    /// D = h(a) = 2 (1 − ν) F' J(a/v)/(2π), with the force F' per length and the mean height h(a) at the distance a from
    /// the lowest point.
    pub tolerance: f64,
    /// Active sets tried before the solver gives up.
    pub max_iterations: usize,
}

/// A stationary state in plane strain on one grid.
#[derive(Debug, Clone, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize))]
#[must_use]
pub struct LineSliding {
    /// Friction coefficient μ.
    pub friction_coefficient: f64,
    /// Mean of |∂h/∂x| under the load.
    pub mean_slope: f64,
    /// Rear and front of the contact relative to the lowest point, \[m].
    pub contact: [f64; 2],
    /// Number of unknown pressures.
    pub unknowns: usize,
    /// Active sets tried.
    pub iterations: usize,
    /// Largest residual |h + u − d| in the contact relative to the depth scale, see [`LineOptions::tolerance`].
    pub residual: f64,
    /// Centre of each element from rear to front \[m], and its pressure \[Pa].
    pub pressure: Vec<[f64; 2]>,
}

/// A stationary state in plane strain with its error bars.
#[derive(Debug, Clone, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize))]
#[must_use]
pub struct LineEstimate {
    /// Friction coefficient μ.
    pub friction_coefficient: Estimate,
    /// What its error consists of.
    pub error_parts: ErrorParts,
    /// Width of the contact along x, which is its area per length, \[m].
    pub contact_width: Estimate,
    /// Error of the ends of the contact in [`finest`](Self::finest), \[m].
    pub contact_error: f64,
    /// Largest pressure \[Pa], where the material reacts at once; everywhere else it grows without limit on refinement.
    pub peak_pressure: Option<Estimate>,
    /// The refinements that led there, from coarse to fine, with forces and areas per length; none where the number of
    /// elements was given.
    pub refinements: Vec<Refinement>,
    /// The state on the finest grid.
    pub finest: LineSliding,
}

/// Elements of the coarsest grids along the half contact of a cylinder on an elastic half space.
const COARSEST: f64 = 4.0;
/// Coarsest elements along the contact of a cylinder on an elastic half space.
const ELEMENTS_OF_CYLINDER: f64 = 8.0;
/// Rear of the footprint in the same lengths: nothing reaches further back than the elastic contact.
const REAR: f64 = 2.0;
/// Front of the footprint, and what a long memory adds: how far ahead the surface still rises grows with its logarithm.
const FRONT: f64 = 2.5;
const FRONT_BY_MEMORY: f64 = 0.5;

/// Unknown pressures at most; as many are factorised at once.
const MOST_UNKNOWNS: usize = 2000;

/// Solves the stationary sliding of a smooth `profile` that is infinite along y, under a load whose normal force is per
/// length \[N/m], to a relative error of the friction coefficient; or with a number of elements along the contact of a
/// cylinder on an elastic half space, and whatever error that has.
///
/// Of the profile only the heights at y = 0 matter.
///
/// # Errors
/// As for [`steady`](super::steady()); [`BemError::InvalidParameter`] for a material that flows, and
/// [`BemError::Indenter`] for a depth, which does not exist in plane strain.
pub fn steady_line(
    profile: &(impl Surface + ?Sized),
    material: &(impl Material + ?Sized),
    load: &SlidingLoad,
    accuracy: impl Into<Accuracy>,
) -> Result<LineEstimate, BemError> {
    let problem = Problem::new(&profile, material, load)?;
    match accuracy.into() {
        Accuracy::RelativeError(relative_error) => problem.refined(relative_error),
        accuracy @ Accuracy::Elements(_) => problem.with_elements(accuracy),
    }
}

/// Solves the stationary sliding of a `profile` on one grid, under a load whose normal force is per length, \[N/m].
///
/// # Errors
/// As for [`steady_on_grid`](super::steady_on_grid), and [`BemError::InvalidParameter`] for a material that flows.
pub fn steady_line_on_grid(
    profile: &(impl Surface + ?Sized),
    material: &(impl Material + ?Sized),
    load: &SlidingLoad,
    options: &LineOptions,
) -> Result<LineSliding, BemError> {
    let profile: &dyn Surface = &profile;
    let loading = Loading::per_length(profile, material, load, options.footprint)?;
    let strip = Strip::new(profile, &loading);
    let grid = SteadyOptions {
        phase: [options.phase, 0.0],
        tolerance: options.tolerance,
        max_iterations: options.max_iterations,
        ..SteadyOptions::new(
            [options.spacing, strip.length],
            strip.footprint(options.footprint),
        )
    };
    let state = solve(&strip, &loading, &grid, &mut Reuse::default())?;
    Ok(LineSliding::of(&state))
}

/// A profile in plane strain and the grids for it.
struct Problem<'a> {
    strip: Strip<'a>,
    loading: Loading,
    plan: GridPlan,
    reacts_at_once: bool,
}

impl<'a> Problem<'a> {
    fn new(
        profile: &'a dyn Surface,
        material: &(impl Material + ?Sized),
        load: &SlidingLoad,
    ) -> Result<Self, BemError> {
        let creep = SlidingCreep::new(material, load.velocity())?;
        let [_, length] = scale_of_profile(profile, &creep, load.require_normal_force()?)?;
        let front = FRONT + FRONT_BY_MEMORY * (creep.memory() / length).ln_1p();
        let footprint = [-REAR * length, front * length];
        let loading = Loading::per_length(profile, material, load, footprint)?;
        let strip = Strip::new(profile, &loading);
        Ok(Self {
            plan: GridPlan {
                footprint: strip.footprint(footprint),
                coarsest_spacing: length / COARSEST,
                apex_exponent: 2.0,
            },
            strip,
            loading,
            reacts_at_once: bars::reacts_at_once(material),
        })
    }

    fn refined(self, relative_error: f64) -> Result<LineEstimate, BemError> {
        let options = RefinementOptions {
            relative_error,
            max_unknowns: MOST_UNKNOWNS,
            ..RefinementOptions::default()
        };
        let length = self.strip.length;
        let Refined {
            friction_coefficient: friction,
            refinements,
            finest,
            ..
        } = refine(&self.strip, self.loading, &self.plan, &options)?;
        let iteration = finest.iteration_error();
        let per_length = |refinement: Refinement| refinement.per_length(length);
        let refinements: Vec<Refinement> = refinements.into_iter().map(per_length).collect();
        let width = limit(&refinements, 1.0, |r| r.contact_area);
        let peak = limit(&refinements, 1.5, |r| r.peak_pressure);
        Ok(LineEstimate {
            friction_coefficient: Estimate {
                value: friction.value,
                error: friction.error + iteration,
            },
            error_parts: ErrorParts {
                discretisation: Some(friction.error),
                iteration: Some(iteration),
                ..ErrorParts::NONE
            },
            contact_width: width.into(),
            contact_error: bars::of_box([finest.pressure.grid.spacing()[0]; 2]),
            peak_pressure: self.reacts_at_once.then(|| peak.into()),
            refinements,
            finest: LineSliding::of(&finest),
        })
    }

    fn with_elements(self, accuracy: Accuracy) -> Result<LineEstimate, BemError> {
        let length = ELEMENTS_OF_CYLINDER * self.plan.coarsest_spacing;
        let resolution = Resolution {
            accuracy,
            target: Target::Friction,
            largest: usize::MAX,
            order: bars::order_of_friction(self.plan.apex_exponent),
        };
        let solve = |elements: usize| {
            let spacing = [length / elements as f64, self.strip.length];
            let options = SteadyOptions::new(spacing, self.plan.footprint);
            solve(&self.strip, &self.loading, &options, &mut Reuse::default())
        };
        let resolved = bars::resolve(
            &resolution,
            solve,
            |state| state.quantities(None),
            |_, state| state.other_parts(),
        )?;
        let (finest, known) = (resolved.finest, resolved.estimates);
        let per_length = |area: Estimate| Estimate {
            value: area.value / self.strip.length,
            error: area.error / self.strip.length,
        };
        Ok(LineEstimate {
            friction_coefficient: known.friction_coefficient,
            error_parts: resolved.parts.friction_coefficient,
            contact_width: per_length(known.contact_area),
            contact_error: bars::of_box([finest.pressure.grid.spacing()[0]; 2]),
            peak_pressure: self.reacts_at_once.then_some(known.peak_pressure),
            refinements: Vec::new(),
            finest: LineSliding::of(&finest),
        })
    }
}

impl LineSliding {
    fn of(state: &SteadySliding) -> Self {
        let field = &state.pressure;
        let [first, _] = field.origin;
        let [dx, _] = field.grid.spacing();
        // One element along y: the rows are all there is.
        let row = |(row, pressure): (usize, &f64)| [first + row as f64 * dx, *pressure];
        Self {
            friction_coefficient: state.friction_coefficient,
            mean_slope: state.mean_slope,
            contact: state.contact_x,
            unknowns: state.unknowns,
            iterations: state.iterations,
            residual: state.residual,
            pressure: field.pressure.iter().enumerate().map(row).collect(),
        }
    }
}

/// A profile that is as long along y as one element.
struct Strip<'a> {
    profile: &'a dyn Surface,
    length: f64,
}

impl<'a> Strip<'a> {
    fn new(profile: &'a dyn Surface, loading: &Loading) -> Self {
        Self {
            profile,
            length: loading.strip().unwrap_or(f64::INFINITY),
        }
    }

    /// With an empty element on either side.
    fn footprint(&self, x: [f64; 2]) -> Footprint {
        let y = [-self.length, self.length];
        Footprint { x, y }
    }
}

impl Surface for Strip<'_> {
    fn height(&self, [x, y]: [f64; 2]) -> f64 {
        if y.abs() > 0.5 * self.length {
            f64::INFINITY
        } else {
            self.profile.height([x, 0.0])
        }
    }

    fn gradient(&self, [x, _]: [f64; 2]) -> [f64; 2] {
        self.profile.gradient([x, 0.0])
    }

    fn mirrors(&self) -> [bool; 2] {
        let [along_x, _] = self.profile.mirrors();
        [along_x, true]
    }
}
