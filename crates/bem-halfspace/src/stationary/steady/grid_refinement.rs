//! Refinement to a requested error.
//!
//! The outline of the contact follows the elements. On one grid that scatters the friction around its trend, so each
//! refinement averages over four grids that are shifted by half an element along x and y, in plane strain by quarters
//! along x. The averages converge with the order 3/2, as the singular front edge does, or 2p − 1 where the apex h ∼ r^p
//! is slower, and are extrapolated. On materials that recover the outline is closed behind, and what is left of the
//! scatter decides: it widens the error bar.

use std::ops::Range;

use indenters::Surface;
use numerics::{
    ErrorParts, Estimate, Progress, WorkProgress, between_zero_and_one, in_range, positive,
};

use crate::BemError;
use crate::Reached;
use crate::estimate::averages::{Average, Refinement};
use crate::estimate::bars;
use crate::estimate::plan::{GridPlan, MAX_REFINEMENTS};
use crate::estimate::quantities::Name;
use crate::stationary::steady::extrapolation::{
    HIDDEN_EDGE_ORDERS, OBSERVED_ORDERS, change_at_observed_order, extrapolate, extrapolate_faster,
};
use crate::stationary::steady::loading::Loading;
use crate::stationary::steady::solution::{SteadyEstimate, SteadySliding};
use crate::stationary::steady::{Reuse, SteadyOptions, solve};

/// Shifts of the grid along x and y that keep the mirror symmetry in y; the first of them along x only.
const BODY_PHASES: [[f64; 2]; 4] = [[0.0, 0.0], [0.5, 0.5], [0.5, 0.0], [0.0, 0.5]];
/// Shifts in plane strain. The means over the first two and over the last two differ by the second harmonic of how the
/// friction varies with the shift, which all four average out.
const STRIP_PHASES: [[f64; 2]; 4] = [[0.0, 0.0], [0.5, 0.0], [0.25, 0.0], [-0.25, 0.0]];
/// Refinements in plane strain of which the largest scatter counts: on one of them it may be small by chance, and the
/// extrapolated limit contains the scatter of all that it eliminates.
const STRIP_SCATTER_WINDOW: usize = 4;
/// Order of the error that the singular front leaves.
const FRONT_ORDER: f64 = 1.5;
/// Order in which the area of the elements in contact approaches that of the contact.
const AREA_ORDER: f64 = 1.0;
/// Part of the error of the friction from slopes that the error of that from dissipation must be below, to be taken: the
/// lesser of two bars holds less often than either.
const DISSIPATION_ERROR_RATIO: f64 = 0.5;
/// Weight of the error on materials that recover, where all outlines scatter and the refinement that ends is one that does so
/// little by chance: without it 95.8 of 100 bars hold on random solids and cylinders, with it 98.6 (docs/calibration.md).
const SAFETY_FACTOR_CREEPING: f64 = 1.5;
/// Friction as a part of the mean slope, below which it is a small difference of slopes, and faster orders are looked for: chosen;
/// larger ones reach what is asked for without.
const SMALL_FRICTION: f64 = 0.2;
/// Refinements of which an error bar can come, at least.
const MIN_REFINEMENTS: i32 = 5;
/// Elements of the footprint for each unknown pressure that is allowed: a steep body touches with a thin crescent.
const ELEMENTS_PER_UNKNOWN: f64 = 50.0;
/// Elements of the footprint up to which that holds, and for each unknown pressure beyond: they take some GB.
const LARGE_GRID_ELEMENTS: f64 = 2e6;
const LARGE_GRID_ELEMENTS_PER_UNKNOWN: f64 = 12.5;
/// Elements that hardly cost anything.
const MIN_GRID_LIMIT: f64 = 1e5;
/// At the edge of a contact elements may change sides without end; then the grid is this much finer, and its own spacing is
/// the one that is reported.
const CYCLING_SPACING_FACTORS: [f64; 2] = [0.99, 0.98];
/// Residual left on one grid, relative to the error asked for as a part of the mean slope, and what rounding allows.
const RESIDUAL_SHARE: f64 = 1e-4;
const MIN_TOLERANCE: f64 = 1e-12;
/// The same part under a strip: the potential of its whole length, which is absorbed in the depth, leaves more rounding.
const STRIP_RESIDUAL_SHARE: f64 = 1e-2;
/// Friction as a part of the mean slope on the first grid, where it is not known yet, on materials that recover.
const INITIAL_FRICTION_RATIO: f64 = 1e-3;
/// Friction on an elastic material that is known to this part of the mean slope counts as known: what is left is rounding.
const ELASTIC_ROUNDING: f64 = 1e-9;

/// How far a friction coefficient is refined.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct RefinementOptions {
    /// Relative error asked for, of the friction coefficient, and of the normal force where the depth is given.
    pub relative_error: f64,
    /// Δy/Δx. The outline of the contact is steeper across the sliding direction than along it.
    pub aspect: f64,
    /// Refinement stops before a grid that will have more unknown pressures than this, judged by the grid before it, or
    /// whose footprint has more than 50 times as many elements, from 2e6 elements on 12.5 times as many, and more than 1e5.
    pub max_unknowns: usize,
}

impl Default for RefinementOptions {
    /// A relative error of 1e-3, elements half as wide as long, and at most 160 000 unknowns, which take some ten seconds.
    fn default() -> Self {
        Self {
            relative_error: 1e-3,
            aspect: 0.5,
            max_unknowns: 160_000,
        }
    }
}

/// A surface that slides, and the grids for it.
pub(super) struct SteadyProblem<'a> {
    pub(super) surface: &'a dyn Surface,
    pub(super) loading: Loading,
    pub(super) plan: &'a GridPlan,
    /// Whether the largest pressure is known to have a limit.
    pub(super) has_peak: bool,
    pub(super) watch: &'a dyn Progress,
}

/// Refines until friction and force have the error asked for; `finish` makes of the estimate what is returned, also where
/// that error was not reached.
pub(super) fn refine<E: Into<Reached>>(
    problem: &SteadyProblem,
    options: &RefinementOptions,
    finish: impl FnOnce(SteadyEstimate) -> Result<E, BemError>,
) -> Result<E, BemError> {
    let relative_error = between_zero_and_one("relative_error", options.relative_error)?;
    positive("aspect", options.aspect)?;
    let mut grids = Grids {
        problem,
        options,
        order: order_of_friction(problem.plan.apex_exponent)?,
        reuse: Reuse::default(),
        progress: WorkProgress::new(problem.watch, refinement_work(0..MIN_REFINEMENTS)),
    };
    let (mut index, mut finest) = grids.coarsest(0)?;
    let mut refinements = vec![finest.averages];
    loop {
        let friction = grids.friction(&refinements);
        let force = grids.force(&refinements);
        let is_elastic = problem.loading.creep.is_elastic();
        let rounding = [MIN_TOLERANCE, ELASTIC_ROUNDING][usize::from(is_elastic)];
        // Without friction the contact is known as well as its depth, and finer grids leave what is rounding.
        let is_rounding = friction.error <= rounding * finest.state.mean_slope;
        let (name, driving) = match grids.depth(&refinements) {
            Some(depth) if is_rounding => (Name::Depth, depth),
            None if is_rounding => (Name::Force, force),
            _ => (Name::Friction, friction),
        };
        let is_enough = driving.is_within(relative_error) && force.is_within(relative_error);
        if is_enough || !grids.allows(index + 1, &finest.averages) {
            let found = finish(grids.estimate(friction, force, refinements, finest))?;
            let asked = if is_elastic {
                (name, driving)
            } else {
                (Name::Friction, friction)
            };
            return if asked.1.is_within(relative_error) && force.is_within(relative_error) {
                Ok(found)
            } else {
                Err(not_reached(asked, force, relative_error, found.into()))
            };
        }
        let excess = [driving, force].map(|known| known.error / known.value.abs());
        let excess = excess[0].max(excess[1]) / relative_error;
        grids.expect(index, excess, &finest.averages);
        index += 1;
        match grids.refine(index) {
            // A patch that coarser grids do not show: nothing follows from them.
            Err(BemError::GridTooCoarse { .. }) => {
                (index, finest) = grids.coarsest(index + 1)?;
                refinements.clear();
            }
            refined => finest = refined?,
        }
        refinements.push(finest.averages);
    }
}

/// Order of the error of the averages.
fn order_of_friction(apex_exponent: f64) -> Result<f64, BemError> {
    let order = (2.0 * apex_exponent - 1.0).min(FRONT_ORDER);
    // The friction of a sharper apex alone is infinite, as in the one-dimensional model.
    in_range("apex exponent", apex_exponent, order > 0.0, "above 1/2")?;
    Ok(order)
}

fn not_reached(
    driving: (Name, Estimate),
    force: Estimate,
    relative_error: f64,
    reached: Reached,
) -> BemError {
    let (quantity, known) = if force.is_within(relative_error) {
        driving
    } else {
        (Name::Force, force)
    };
    BemError::NotReached {
        quantity: quantity.in_words(),
        value: known.value,
        error: known.error,
        relative_error,
        reached: Box::new(reached),
    }
}

/// One refinement, and the last solution of it with its grid.
struct SolvedRefinement {
    averages: Refinement,
    state: SteadySliding,
    options: SteadyOptions,
}

/// A problem on finer and finer grids.
struct Grids<'a> {
    problem: &'a SteadyProblem<'a>,
    options: &'a RefinementOptions,
    /// Order of the error of the averages.
    order: f64,
    reuse: Reuse,
    progress: WorkProgress<'a>,
}

/// Each refinement has twice as many elements as the one before.
fn refinement_work(refinements: Range<i32>) -> f64 {
    refinements.map(|index| f64::from(index).exp2()).sum()
}

impl Grids<'_> {
    /// Expects the refinements that are left until the error is smaller by the excess, if it falls with the order.
    fn expect(&mut self, index: i32, excess: f64, last: &Refinement) {
        let most = (self.options.max_unknowns / last.unknowns.max(1)).ilog2();
        let needed = 2.0 * excess.log2() / self.order;
        let ahead = (1..).find(|ahead| f64::from(*ahead) >= needed.min(f64::from(most)));
        let ahead = ahead.unwrap_or(1).max(MIN_REFINEMENTS - 1 - index);
        self.progress
            .set_remaining_work(refinement_work(index + 1..index + 1 + ahead));
    }

    /// The limit of averages with what is left of their scatter, and under a body with edges with what it would be if the order
    /// were the observed one.
    fn limit(
        &self,
        refinements: &[Refinement],
        order: f64,
        quantity: impl Fn(&Refinement) -> Average,
    ) -> Estimate {
        let values: Vec<f64> = refinements.iter().map(|r| quantity(r).value).collect();
        let scatter = refinements
            .last()
            .map_or(0.0, |last| quantity(last).scatter);
        let limit = extrapolate(&values, order).widened(scatter);
        if self.problem.loading.has_edges {
            let hides_edge = refinements.last().is_some_and(|last| last.hides_edge);
            let powers = if hides_edge {
                HIDDEN_EDGE_ORDERS
            } else {
                OBSERVED_ORDERS
            };
            return limit.widened(change_at_observed_order(&values, order, powers));
        }
        limit
    }

    /// Of the pressure under the slopes, or of the dissipated power where that is known much better, with what no grid shows.
    fn friction(&self, refinements: &[Refinement]) -> Estimate {
        let mut friction = self.friction_from_slopes(refinements);
        if !self.problem.loading.creep.only_flows() {
            let dissipated =
                self.extrapolate_friction(refinements, |r| r.friction_from_dissipation);
            let has_edges = self.problem.loading.has_edges;
            if has_edges || dissipated.error < DISSIPATION_ERROR_RATIO * friction.error {
                friction = dissipated;
            }
            friction = Estimate::new(friction.value, SAFETY_FACTOR_CREEPING * friction.error);
        }
        let unresolved = refinements.last().map_or(0.0, |last| last.unresolved);
        friction.widened(unresolved * friction.value.abs())
    }

    /// The limit of one of the two frictions. Of a body of finite width without edges, on a material that recovers, errors of a small
    /// friction may fall faster than the front and the apex let them fall on a dashpot.
    fn extrapolate_friction(
        &self,
        refinements: &[Refinement],
        friction: impl Fn(&Refinement) -> Average,
    ) -> Estimate {
        let Loading {
            creep,
            strip,
            has_edges,
            ..
        } = &self.problem.loading;
        let is_small =
            self.reuse.solution.as_ref().is_some_and(|last| {
                last.friction_coefficient.abs() < SMALL_FRICTION * last.mean_slope
            });
        if !is_small || creep.only_flows() || strip.is_some() || *has_edges {
            return self.limit(refinements, self.order, friction);
        }
        let values: Vec<f64> = refinements.iter().map(|r| friction(r).value).collect();
        let scatter = refinements
            .last()
            .map_or(0.0, |last| friction(last).scatter);
        extrapolate_faster(&values, self.order).widened(scatter)
    }

    /// On a dashpot the scatter falls as fast as the rest of the error.
    fn friction_from_slopes(&self, refinements: &[Refinement]) -> Estimate {
        let Loading { creep, strip, .. } = &self.problem.loading;
        let counted = match strip {
            _ if creep.only_flows() => 0,
            Some(_) => STRIP_SCATTER_WINDOW,
            None => 1,
        };
        let value = |refinement: &Refinement| Average {
            scatter: 0.0,
            ..refinement.friction_coefficient
        };
        let friction = self.extrapolate_friction(refinements, value);
        let last = refinements.iter().rev().take(counted);
        let scatter = last.map(|refinement| refinement.friction_coefficient.scatter);
        friction.widened(scatter.fold(0.0, f64::max))
    }

    /// The normal force that is given, or the limit of those at the depth.
    fn force(&self, refinements: &[Refinement]) -> Estimate {
        let [given, _] = bars::given(self.problem.loading.control);
        given.unwrap_or_else(|| self.limit(refinements, self.order, |r| r.normal_force))
    }

    /// The depth that is given, or the limit of those under the force; none where it has no meaning, in plane strain on a half
    /// space.
    fn depth(&self, refinements: &[Refinement]) -> Option<Estimate> {
        let Loading { creep, strip, .. } = &self.problem.loading;
        let [_, given] = bars::given(self.problem.loading.control);
        let has_depth = strip.is_none() || creep.base().is_rigid();
        given.or_else(|| {
            has_depth.then(|| self.limit(refinements, self.order, |r| r.indentation_depth))
        })
    }

    fn estimate(
        &self,
        friction: Estimate,
        normal_force: Estimate,
        refinements: Vec<Refinement>,
        finest: SolvedRefinement,
    ) -> SteadyEstimate {
        let iteration = finest.state.iteration_error();
        let known = |of: fn(&Refinement) -> Average| self.limit(&refinements, self.order, of);
        let [dx, dy] = finest.options.spacing;
        SteadyEstimate {
            friction_coefficient: Estimate::new(friction.value, friction.error + iteration),
            error_parts: ErrorParts {
                iteration: Some(iteration),
                ..ErrorParts::discretisation_only(friction.error)
            },
            normal_force,
            indentation_depth: self.depth(&refinements),
            contact_area: self.limit(&refinements, AREA_ORDER, |r| r.contact_area),
            peak_pressure: (self.problem.has_peak).then(|| known(|r| r.peak_pressure)),
            contact_box_error: bars::contact_box_error(dx.max(dy)),
            refinements,
            finest: finest.state,
            options: finest.options,
        }
    }

    /// The coarsest refinement from one on in which body and contact are resolved, if enough of those that follow are within the
    /// limits.
    fn coarsest(&mut self, mut index: i32) -> Result<(i32, SolvedRefinement), BemError> {
        loop {
            let elements = self.n_elements(index + MIN_REFINEMENTS - 1);
            if elements > self.max_elements() {
                return Err(BemError::GridTooLarge {
                    elements,
                    limit: self.max_elements(),
                });
            }
            match self.refine(index) {
                Err(BemError::SlopeNotResolved { .. } | BemError::GridTooCoarse { .. }) => {
                    index += 1;
                }
                refinement => return Ok((index, refinement?)),
            }
        }
    }

    /// Whether a refinement is within the limits; it has twice as many unknowns as the one before.
    fn allows(&self, refinement: i32, before: &Refinement) -> bool {
        let SteadyProblem { plan, watch, .. } = self.problem;
        refinement < MAX_REFINEMENTS
            && self.n_elements(refinement) <= self.max_elements()
            && 2 * before.unknowns <= self.options.max_unknowns
            && watch.may_refine(plan.elements(refinement))
    }

    /// Elements of the footprint.
    fn n_elements(&self, refinement: i32) -> f64 {
        let footprint = &self.problem.plan.footprint;
        footprint.n_elements(self.edges(refinement))
    }

    /// Edges of an element.
    fn edges(&self, refinement: i32) -> [f64; 2] {
        let dx = self.problem.plan.spacing(refinement);
        let strip = self.problem.loading.strip;
        [dx, strip.unwrap_or(self.options.aspect * dx)]
    }

    fn phases(&self) -> &'static [[f64; 2]] {
        match self.problem.loading.strip {
            Some(_) => &STRIP_PHASES,
            None => &BODY_PHASES,
        }
    }

    fn max_elements(&self) -> f64 {
        let n_unknowns = self.options.max_unknowns as f64;
        let many = LARGE_GRID_ELEMENTS.max(LARGE_GRID_ELEMENTS_PER_UNKNOWN * n_unknowns);
        (ELEMENTS_PER_UNKNOWN * n_unknowns).clamp(MIN_GRID_LIMIT, many)
    }

    /// The averages over the shifts, each started from the contact of the one before.
    fn refine(&mut self, index: i32) -> Result<SolvedRefinement, BemError> {
        let (spacing, work) = (self.edges(index), refinement_work(index..index + 1));
        let footprint = self.problem.plan.footprint.widened(spacing[0]);
        let mut options = SteadyOptions::new(spacing, footprint);
        let mut states = Vec::new();
        for &phase in self.phases() {
            options.phase = phase;
            options.tolerance = self.tolerance();
            let state = self.solve_on_similar_grid(&options)?;
            self.progress.add(work / self.phases().len() as f64);
            states.push(state.clone());
            self.reuse.solution = Some(state);
        }
        let distance = self.problem.loading.sliding_distance;
        let per_length = self.problem.loading.strip.map_or(1.0, f64::recip);
        let average =
            |quantity: &dyn Fn(&SteadySliding) -> f64| Average::over_shifts(&states, quantity);
        let spacings = states.iter().map(|state| state.pressure.grid.spacing()[0]);
        let creep = &self.problem.loading.creep;
        let unresolved = states
            .iter()
            .map(|state| state.subgrid_friction_fraction(creep, self.problem.plan.kinks));
        let edges = self.edges_of_body();
        let averages = Refinement {
            hides_edge: states.iter().any(|state| state.hides_edge(&edges)),
            spacing: spacings.sum::<f64>() / states.len() as f64,
            friction_coefficient: Average::over_interleaved_shifts(&states, |state| {
                state.friction_coefficient
            }),
            friction_from_dissipation: Average::over_interleaved_shifts(&states, |state| {
                state.friction_from_dissipation
            }),
            unresolved: unresolved.fold(0.0, f64::max),
            normal_force: average(&|state| state.normal_force).times(per_length),
            indentation_depth: average(&|state| state.depth.at_distance(distance)),
            contact_area: average(&|state| state.contact_area).times(per_length),
            peak_pressure: average(&|state| state.pressure.largest()),
            unknowns: states.iter().map(|state| state.unknowns).max().unwrap_or(0),
        };
        let state = states.swap_remove(states.len() - 1);
        options.spacing = state.pressure.grid.spacing();
        Ok(SolvedRefinement {
            averages,
            state,
            options,
        })
    }

    /// Radii at which the slope of the body jumps, \[m].
    fn edges_of_body(&self) -> Vec<f64> {
        let body = self.problem.surface.as_axisymmetric();
        let kinks = body.map_or_else(Vec::new, |body| body.kinks());
        kinks.into_iter().map(|kink| kink.radius).collect()
    }

    /// The solution on a grid, or on a slightly finer one where pivoting cycles.
    fn solve_on_similar_grid(
        &mut self,
        options: &SteadyOptions,
    ) -> Result<SteadySliding, BemError> {
        let (surface, loading) = (self.problem.surface, &self.problem.loading);
        let mut solve_on = |spacing| {
            let options = SteadyOptions {
                spacing,
                ..*options
            };
            solve(surface, loading, &options, &mut self.reuse)
        };
        let mut solution = solve_on(options.spacing);
        for finer in CYCLING_SPACING_FACTORS {
            let is_lost = matches!(
                solution,
                Err(BemError::ContactNotConverged { .. } | BemError::SingularContact { .. })
            );
            if !is_lost {
                break;
            }
            solution = solve_on(loading.scaled(options.spacing, finer));
        }
        solution
    }

    /// A residual that disturbs the friction less than is asked: smaller where it is a small difference of large slopes.
    fn tolerance(&self) -> f64 {
        let part = match &self.reuse.solution {
            Some(last) => last.friction_coefficient.abs() / last.mean_slope,
            None if self.problem.loading.creep.only_flows() => 1.0,
            None => INITIAL_FRICTION_RATIO,
        };
        let share = match self.problem.loading.strip {
            Some(_) => STRIP_RESIDUAL_SHARE,
            None => RESIDUAL_SHARE,
        };
        (share * self.options.relative_error * part).max(MIN_TOLERANCE)
    }
}
