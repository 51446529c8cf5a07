//! Refinement to a requested error.
//!
//! The boundary of the contact follows the elements. On one grid that scatters the friction around its trend. Each refinement therefore
//! averages over four grids, shifted by half an element along x and y, in plane strain by quarters along x. The averages converge with
//! the order 3/2 of the singular front edge, or 2p − 1 where the apex h ∼ r^p is slower. They are extrapolated. On any material but a
//! dashpot the contact is also closed at its rear, and the remaining scatter decides: it is added to the error estimate.
//!
//! Theory: docs/theory/stationary-half-space.md, "Scatter, order, error bar" and "Order and error bar".

use indenters::Surface;
use numerics::{
    ErrorParts, Estimate, Level, LevelForecast, NotReached, Progress, WorkProgress,
    between_zero_and_one, in_range, positive, refine_levels,
};

use crate::BemError;
use crate::Reached;
use crate::estimate::averages::{Average, Refinement};
use crate::estimate::bars::{self, FRONT_ORDER};
use crate::estimate::plan::{GridPlan, MAX_REFINEMENTS};
use crate::estimate::quantities::Name;
use crate::stationary::steady::extrapolation::{
    ACCEPTED_ERROR_RATIO, CREEPING_ORDERS, HIDDEN_EDGE_ORDERS, OBSERVED_ORDERS,
    change_at_observed_order, extrapolate,
};
use crate::stationary::steady::loading::{Loading, MIN_TOLERANCE};
use crate::stationary::steady::solution::{SteadyEstimate, SteadySliding};
use crate::stationary::steady::{Reuse, SteadyOptions, solve};

/// Shifts of the grid along x and y, in elements, which keep the mirror symmetry in y. Derived: each of the two diagonal pairs,
/// the first two and the last two, cancels the first harmonic of the scatter along either axis.
const BODY_PHASES: [[f64; 2]; 4] = [[0.0, 0.0], [0.5, 0.5], [0.5, 0.0], [0.0, 0.5]];
/// Shifts of the grid in plane strain, in elements. Derived: as a function of the shift the friction has a second harmonic, by
/// which the means over the first two and over the last two differ. The mean of all four eliminates it.
const STRIP_PHASES: [[f64; 2]; 4] = [[0.0, 0.0], [0.5, 0.0], [0.25, 0.0], [-0.25, 0.0]];
/// Number of refinements in plane strain, up to the last one, whose largest scatter is added to the error bar. On a single one
/// the scatter may be small by chance, and the extrapolated limit contains that of all values that it uses. Chosen; with 1 the
/// bar of the cylinder is 0.15 times as wide (case of `evidence tuning`).
const STRIP_SCATTER_WINDOW: usize = 4;
/// Convergence order of the contact area in sliding where the excess of its boundary is not known. Derived: it is an error of the first
/// order in the edges of elements.
const AREA_ORDER: f64 = 1.0;
/// Convergence order of the area of a smooth contact on a solid. Derived: the boundary divides elements, and the chords of its polygon
/// leave an error of the second order.
const SMOOTH_AREA_ORDER: f64 = 2.0;
/// Part of the difference between both orders of the area that its error always contains. Derived: with the safety factor, and the change
/// and elimination of the limit, the error of an area that falls with the first order is then within its bar.
const FIRST_ORDER_SHARE: f64 = 0.25;
/// Factor on the shift of the collocation points, −½ on a dashpot, that gives the part of the difference between both orders of the area
/// in its error. Chosen: twice the loss angle over π/2, because errors between both orders do not vanish like either.
const CREEP_SHARE: f64 = 4.0;
/// Factor on the error of the friction on any material but a dashpot. There the whole contact boundary scatters, and the scatter
/// of the last refinement may be small by chance. Chosen: with this factor 98.6 of 100 error estimates hold on random solids and
/// cylinders, without it 95.8 (docs/calibration.md; case of `evidence tuning`).
const SAFETY_FACTOR_CREEPING: f64 = 1.5;
/// Ratio of friction to mean slope below which the friction is a small difference of slopes, and higher orders are tried. A
/// larger friction reaches the requested error without them. Chosen; from 0 to 0.2 no digit of an answer changes, with 1 bars
/// become 0.2 to 0.4 times as wide (case of `evidence tuning`).
const SMALL_FRICTION_RATIO: f64 = 0.2;
/// Smallest number of refinements for an error estimate. Derived: an elimination shortens the sequence of values by two, and the
/// estimate needs three limits.
const MIN_REFINEMENTS: i32 = 5;
/// Largest ratio of the elements of a footprint to the allowed number of unknown pressures. Chosen to limit memory and time:
/// refinement ends before a larger grid. The ratio is large because a steep body touches with a thin crescent.
const ELEMENTS_PER_UNKNOWN: f64 = 50.0;
/// Number of footprint elements above which [`LARGE_GRID_ELEMENTS_PER_UNKNOWN`] replaces [`ELEMENTS_PER_UNKNOWN`]. Chosen to
/// limit the memory: with 1000 bytes for an element that is solved for, such a grid takes 1 to 2 GB.
const LARGE_GRID_ELEMENTS: f64 = 2e6;
/// Largest ratio of the elements of a footprint of more than [`LARGE_GRID_ELEMENTS`] to the allowed number of unknown pressures.
/// Chosen to limit memory and time: refinement ends before a larger grid.
const LARGE_GRID_ELEMENTS_PER_UNKNOWN: f64 = 12.5;
/// Number of footprint elements up to which a grid is never refused. Chosen: such grids take a fraction of a second and about 0.1
/// GB.
const MIN_GRID_LIMIT: f64 = 1e5;
/// Aspect ratio Δy/Δx of the elements under a body unless another is asked for. Chosen (case of `evidence tuning`): the contact
/// boundary is steeper across the sliding direction than along it, so that it moves less from row to row.
pub(super) const DEFAULT_ASPECT: f64 = 0.5;
/// Factors on the spacing that are tried in turn where the active set cycles. Chosen close to 1: another grid has another active
/// set, and the spacing that is reported is that of the grid that was solved. Two are tried to limit the time; then the search
/// fails.
const CYCLING_SPACING_FACTORS: [f64; 2] = [0.99, 0.98];
/// Factor on the requested relative error, times the ratio of the friction to the mean slope, that gives the tolerance of a
/// contact. Chosen; from 1e-4 to 1e-2 only times change, by up to a fifth (case of `evidence tuning`). In plane strain the constant
/// potential of the whole strip, which is absorbed in the depth, leaves more rounding error than a smaller one allows.
const RESIDUAL_SHARE: f64 = 1e-4;

/// Requested error, shape of the elements and limits of the work of a refinement.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct RefinementOptions {
    /// Requested relative error of the friction coefficient, and of the normal force where the depth is given.
    pub relative_error: f64,
    /// Aspect ratio Δy/Δx of the elements. The contact boundary is steeper across the sliding direction than along it.
    pub aspect: f64,
    /// Largest number of unknown pressures. Refinement stops before a grid that is expected to exceed it, from the number on the grid
    /// before. It also stops before a footprint of more than 1e5 elements that has more than 50 times as many elements as this. Beyond
    /// 2e6 elements the factor is 12.5.
    pub max_unknowns: usize,
}

impl Default for RefinementOptions {
    /// A relative error of 1e-3, elements half as wide as long, and at most 160 000 unknowns, which take some ten seconds.
    fn default() -> Self {
        Self {
            relative_error: 1e-3,
            aspect: DEFAULT_ASPECT,
            max_unknowns: 160_000,
        }
    }
}

/// A sliding surface, and the plan of its grids.
pub(super) struct SteadyProblem<'a> {
    /// Surface of the body, or of the strip in plane strain.
    pub(super) surface: &'a dyn Surface,
    /// Material, force or depth, and their scales.
    pub(super) loading: Loading,
    /// Footprint and spacings of the grids.
    pub(super) plan: &'a GridPlan,
    /// True if the peak pressure is known to be finite.
    pub(super) has_peak: bool,
    /// Observer of the progress, which may stop the refinement.
    pub(super) watch: &'a dyn Progress,
}

/// Refines until friction and force have the requested error. `finish` converts the estimate into the result, also into the result
/// that the error holds where the requested error was not reached.
///
/// # Errors
/// [`BemError::NotReached`]; [`BemError::GridTooLarge`] where no error can be estimated within the limits; errors of single grids.
pub(super) fn refine<E: Into<Reached>>(
    problem: &SteadyProblem,
    options: &RefinementOptions,
    finish: impl FnOnce(SteadyEstimate) -> Result<E, BemError>,
) -> Result<E, BemError> {
    between_zero_and_one("relative_error", options.relative_error)?;
    positive("aspect", options.aspect)?;
    // Begin at level 0, before any grid is solved.
    let mut grids = ShiftedGrids {
        problem,
        options,
        order: order_of_friction(problem.plan.apex_exponent)?,
        reuse: Reuse::default(),
        next: 0,
        refinements: Vec::new(),
        subgrid_friction_fraction: 0.0,
        creep_within_element: 0.0,
        hides_edge: false,
    };
    // Refine until the error is reached or a limit ends the refinement.
    let initial_work = (0..MIN_REFINEMENTS).map(work_of_level).sum();
    let finest = refine_levels(problem.watch, initial_work, |_, progress| {
        grids.solve_next(progress).map(Some)
    })?;
    let found = finish(finest.found)?;
    bars::reached_or_error(finest.missed, Name::of_quantity, found)
}

/// Convergence order of the friction and of the averages over shifts, for the exponent of the apex of the body.
fn order_of_friction(apex_exponent: f64) -> Result<f64, BemError> {
    let order = (2.0 * apex_exponent - 1.0).min(FRONT_ORDER);
    in_range("apex exponent", apex_exponent, order > 0.0, "above 1/2")?;
    Ok(order)
}

/// A problem on shifted grids, refined by √2 from level to level.
struct ShiftedGrids<'a> {
    /// Surface, loading and plan.
    problem: &'a SteadyProblem<'a>,
    /// Requested error and limits of the work.
    options: &'a RefinementOptions,
    /// Convergence order of the averages.
    order: f64,
    /// Last solution, and kernel tables.
    reuse: Reuse,
    /// Number of refinements by √2 of the next level.
    next: i32,
    /// Averages of the levels that resolve the contact, from coarse to fine.
    refinements: Vec<Refinement>,
    /// Fraction of the friction that may be lost on the last level, because the surface relaxes within one element.
    subgrid_friction_fraction: f64,
    /// Shift of the collocation points of the last level against the centres of elements, 0 on a spring and ½ on a dashpot.
    creep_within_element: f64,
    /// True if the contact on the last level ends within a few elements of an edge of the body, so that the elements do not resolve
    /// whether it ends at that edge.
    hides_edge: bool,
}

/// Work of a level, in units of that of level 0: each has twice as many elements as the one before.
fn work_of_level(index: i32) -> f64 {
    f64::from(index).exp2()
}

impl ShiftedGrids<'_> {
    /// Solves on the next level that resolves body and contact, and extrapolates all quantities.
    fn solve_next(
        &mut self,
        progress: &mut WorkProgress,
    ) -> Result<Level<SteadyEstimate>, BemError> {
        // Solve the next level that resolves the contact. If it does not resolve a patch, coarser levels do not either: drop them.
        let (state, options) = loop {
            if self.refinements.is_empty() {
                self.check_first_level()?;
            }
            let solved = self.solve_level(progress);
            self.next += 1;
            match solved {
                Err(BemError::SlopeNotResolved { .. }) if self.refinements.is_empty() => {}
                Err(BemError::GridTooCoarse { .. }) => self.refinements.clear(),
                solved => break solved?,
            }
        };

        // Choose the quantity that decides whether to refine: the friction, or depth or force if the friction is 0 on an elastic material or
        // only rounding error.
        let [friction, force] = [self.friction(), self.force()];
        let is_elastic = self.problem.loading.creep.is_elastic();
        let friction_is_known = is_elastic || friction.error <= MIN_TOLERANCE * state.mean_slope;
        let (name, known) = match self.depth() {
            Some(depth) if friction_is_known => (Name::Depth, depth),
            None if friction_is_known => (Name::Force, force),
            _ => (Name::Friction, friction),
        };
        let missed_force = self.unless_within(Name::Force, force);
        let undecided = missed_force.or(self.unless_within(name, known));
        Ok(Level {
            found: self.estimate(friction, force, state, options),
            // Friction was asked for, unless the material has none.
            missed: if is_elastic {
                undecided
            } else {
                missed_force.or(self.unless_within(Name::Friction, friction))
            },
            remaining_work: undecided
                .filter(|_| self.may_refine())
                .map(|missed| self.forecast().remaining_work(&missed)),
        })
    }

    /// True if the next level is within the limits, supposing that it has twice as many unknowns as the last one.
    fn may_refine(&self) -> bool {
        let SteadyProblem { plan, watch, .. } = self.problem;
        self.next < MAX_REFINEMENTS
            && self.n_elements(self.next) <= self.max_elements()
            && 2 * self.last_unknowns() <= self.options.max_unknowns
            && watch.may_refine(plan.elements(self.next))
    }

    /// Forecast of the work of the levels that follow, if the error falls with the order of the averages.
    fn forecast(&self) -> LevelForecast {
        let unknowns = self.last_unknowns().max(1);
        LevelForecast {
            work: work_of_level(self.next),
            work_ratio: 2.0,
            error_ratio: (-0.5 * self.order).exp2(),
            max_levels: f64::from((self.options.max_unknowns / unknowns).ilog2()),
        }
    }

    /// The requested and the estimated error of a quantity; `None` if the estimate is within the request.
    fn unless_within(&self, name: Name, known: Estimate) -> Option<NotReached> {
        let elements = self.problem.plan.elements(self.next - 1);
        NotReached::unless_within(self.options.relative_error, name.index(), known, elements)
    }

    /// Number of unknown pressures of the last level.
    fn last_unknowns(&self) -> usize {
        self.refinements.last().map_or(0, |last| last.unknowns)
    }

    /// Extrapolated limit of the averages of a `quantity` of all levels. The error contains the scatter of the last level.
    fn limit(&self, order: f64, quantity: impl Fn(&Refinement) -> Average) -> Estimate {
        self.limit_of(
            &Vec::from_iter(self.refinements.iter().map(quantity)),
            order,
            &[],
            1,
        )
    }

    /// Extrapolated limit of averages that converge with the order `order` or one of the `faster_orders`. The error contains the
    /// largest scatter of some last levels, and under a body with edges the change of the limit if the observed order is assumed.
    fn limit_of(
        &self,
        averages: &[Average],
        order: f64,
        faster_orders: &[f64],
        scatter_window: usize,
    ) -> Estimate {
        let values: Vec<f64> = averages.iter().map(|average| average.value).collect();
        let last = averages.iter().rev().take(scatter_window);
        let scatter = last.map(|average| average.scatter).fold(0.0, f64::max);
        let limit = extrapolate(&values, order, faster_orders).widened(scatter);
        if !self.problem.loading.has_edges {
            return limit;
        }
        let range = [OBSERVED_ORDERS, HIDDEN_EDGE_ORDERS][usize::from(self.hides_edge)];
        limit.widened(change_at_observed_order(&values, order, range))
    }

    /// Friction from the slopes, or from the dissipated power where its error is much smaller. The error contains the sub-grid
    /// friction.
    ///
    /// A small friction on any material but a dashpot may converge faster than front and apex allow on a dashpot. Higher orders are
    /// then tried for bodies of finite width without edges. On a dashpot the scatter is not added, because it falls as fast as the
    /// rest of the error.
    fn friction(&self) -> Estimate {
        let loading = &self.problem.loading;
        // A small friction may converge faster under a smooth body of finite width, except on a dashpot: then higher orders are
        // tried too.
        let is_small = self.reuse.solution.as_ref().is_some_and(|last| {
            last.friction_coefficient.abs() < SMALL_FRICTION_RATIO * last.mean_slope
        });
        let only_flows = loading.creep.only_flows();
        let may_be_faster =
            is_small && !only_flows && loading.strip.is_none() && !loading.has_edges;
        let faster_orders: &[f64] = if may_be_faster { &CREEPING_ORDERS } else { &[] };
        // Extrapolate the friction from slopes, then that from dissipation. The latter replaces the former under edges, or if its
        // error is much smaller.
        let limit = |quantity: fn(&Refinement) -> Average, scatter_window: usize| {
            let averages = Vec::from_iter(self.refinements.iter().map(quantity));
            self.limit_of(&averages, self.order, faster_orders, scatter_window)
        };
        let scatter_window = match loading.strip {
            _ if only_flows => 0,
            Some(_) => STRIP_SCATTER_WINDOW,
            None => 1,
        };
        let mut friction = limit(|level| level.friction_coefficient, scatter_window);
        if !only_flows {
            let dissipated = limit(|level| level.friction_from_dissipation, 1);
            // Under edges the slopes of the elements miss the dissipation at the edge.
            if loading.has_edges || dissipated.error < ACCEPTED_ERROR_RATIO * friction.error {
                friction = dissipated;
            }
            friction = Estimate::new(friction.value, SAFETY_FACTOR_CREEPING * friction.error);
        }
        friction.widened(self.subgrid_friction_fraction * friction.value.abs())
    }

    /// The given normal force, or its limit at a given depth.
    fn force(&self) -> Estimate {
        let [given, _] = bars::prescribed_estimates(self.problem.loading.control);
        given.unwrap_or_else(|| self.limit(self.order, |level| level.normal_force))
    }

    /// The given depth, or its limit under a given force. `None` in plane strain on a half space, where depth has no meaning.
    fn depth(&self) -> Option<Estimate> {
        let Loading { creep, strip, .. } = &self.problem.loading;
        let [_, given] = bars::prescribed_estimates(self.problem.loading.control);
        let has_depth = strip.is_none() || creep.base().is_rigid();
        given.or_else(|| has_depth.then(|| self.limit(self.order, |level| level.indentation_depth)))
    }

    /// The limit of the contact area.
    ///
    /// The excess at the boundary, which is subtracted, is that of smooth elastic contacts. It leaves an error of the first order where
    /// the body has edges or facets, and where the pressure does not vanish like a root. On a material that creeps within an element
    /// the error is between both orders, and their difference counts by the loss angle at the shortest wave.
    fn contact_area(&self) -> Estimate {
        let loading = &self.problem.loading;
        let limit = |order| self.limit(order, |level| level.contact_area);
        let first_order = limit(AREA_ORDER);
        if loading.has_edges || loading.may_have_patches || loading.creep.only_flows() {
            return first_order;
        }
        let second_order = limit(SMOOTH_AREA_ORDER);
        let difference = (second_order.value - first_order.value).abs();
        // The ends of a strip do not average over the directions of a boundary, and one error of the first order is all there is.
        if loading.strip.is_some() {
            return first_order.widened(difference);
        }
        let share = FIRST_ORDER_SHARE + CREEP_SHARE * self.creep_within_element;
        let error = SAFETY_FACTOR_CREEPING * second_order.error + share.min(1.0) * difference;
        Estimate::new(second_order.value, error)
    }

    /// The estimate with the given friction and force, and with the extrapolated values and errors of all other quantities.
    fn estimate(
        &self,
        friction: Estimate,
        normal_force: Estimate,
        finest: SteadySliding,
        options: SteadyOptions,
    ) -> SteadyEstimate {
        let iteration = finest.iteration_error();
        // Extrapolate each quantity, averaged over the grids of a level, to elements of size zero.
        let peak_pressure = || self.limit(self.order, |level| level.peak_pressure);
        let [dx, dy] = options.spacing;
        let strip = self.problem.loading.strip;
        SteadyEstimate {
            friction_coefficient: friction.widened(iteration),
            error_parts: ErrorParts {
                iteration: Some(iteration),
                ..ErrorParts::discretisation_only(friction.error)
            },
            normal_force,
            indentation_depth: self.depth(),
            contact_area: self.contact_area(),
            peak_pressure: self.problem.has_peak.then(peak_pressure),
            contact_box_error: bars::contact_box_error(strip.map_or(dx.max(dy), |_| dx)),
            refinements: self.refinements.clone(),
            finest,
            options,
        }
    }

    /// Checks that all levels that an error estimate needs, from the next one on, are within the limits.
    ///
    /// # Errors
    /// [`BemError::GridTooLarge`].
    fn check_first_level(&self) -> Result<(), BemError> {
        let elements = self.n_elements(self.next + MIN_REFINEMENTS - 1);
        let limit = self.max_elements();
        if elements > limit {
            return Err(BemError::GridTooLarge { elements, limit });
        }
        Ok(())
    }

    /// Number of elements of the footprint after a number of refinements.
    fn n_elements(&self, refinement: i32) -> f64 {
        let footprint = &self.problem.plan.footprint;
        footprint.n_elements(self.edges(refinement))
    }

    /// Edges [Δx, Δy] of an element after a number of refinements, \[m].
    fn edges(&self, refinement: i32) -> [f64; 2] {
        let dx = self.problem.plan.spacing(refinement);
        let strip = self.problem.loading.strip;
        [dx, strip.unwrap_or(self.options.aspect * dx)]
    }

    /// Shifts of the grids of one refinement.
    fn phases(&self) -> &'static [[f64; 2]] {
        match self.problem.loading.strip {
            Some(_) => &STRIP_PHASES,
            None => &BODY_PHASES,
        }
    }

    /// Largest number of elements of a footprint.
    fn max_elements(&self) -> f64 {
        let n_unknowns = self.options.max_unknowns as f64;
        let large_limit = LARGE_GRID_ELEMENTS.max(LARGE_GRID_ELEMENTS_PER_UNKNOWN * n_unknowns);
        (ELEMENTS_PER_UNKNOWN * n_unknowns).clamp(MIN_GRID_LIMIT, large_limit)
    }

    /// Solves all shifted grids of the next level, each from the active set of the one before, and averages. Returns the last
    /// solution with its grid.
    fn solve_level(
        &mut self,
        progress: &mut WorkProgress,
    ) -> Result<(SteadySliding, SteadyOptions), BemError> {
        // Solve on each shifted grid of this level, from the solution on the grid before.
        let (spacing, work) = (self.edges(self.next), work_of_level(self.next));
        let footprint = self.problem.plan.footprint.widened(spacing[0]);
        let mut options = SteadyOptions::new(spacing, footprint);
        let mut states = Vec::new();
        for &phase in self.phases() {
            options.phase = phase;
            options.tolerance = self.tolerance();
            let state = self.solve_on_similar_grid(&options)?;
            progress.add(work / self.phases().len() as f64);
            states.push(state.clone());
            self.reuse.solution = Some(state);
        }

        // Average all quantities over the shifted grids of the level.
        let loading = &self.problem.loading;
        // The type of a function that reads one quantity from the state on one grid.
        type Quantity<'q> = &'q dyn Fn(&SteadySliding) -> f64;
        let over_pairs = |of: Quantity| Average::over_interleaved_shifts(&states, of);
        let average = |of: Quantity| Average::over_shifts(&states, of);
        let spacings = states.iter().map(|state| state.pressure.grid.spacing()[0]);
        let averages = Refinement {
            spacing: spacings.sum::<f64>() / states.len() as f64,
            friction_coefficient: over_pairs(&|state| state.friction_coefficient),
            friction_from_dissipation: over_pairs(&|state| state.friction_from_dissipation),
            normal_force: average(&|state| state.normal_force),
            indentation_depth: average(&|state| state.depth.at_distance(loading.sliding_distance)),
            contact_area: average(&|state| state.contact_area),
            peak_pressure: average(&|state| state.pressure.largest()),
            unknowns: states.iter().map(|state| state.unknowns).max().unwrap_or(0),
        };
        let kinks = self.problem.plan.kinks;
        let subgrid_friction_fractions = states
            .iter()
            .map(|state| state.subgrid_friction_fraction(&loading.creep, kinks));
        self.subgrid_friction_fraction = subgrid_friction_fractions.fold(0.0, f64::max);
        let creep = loading.creep.over_element(averages.spacing)?;
        self.creep_within_element = creep.collocation_shift.abs();
        let edges = self.edges_of_body();
        self.hides_edge = states.iter().any(|state| state.hides_edge(&edges));
        self.refinements.push(averages);
        // Keep the last state, with the spacing that was solved.
        let state = states.swap_remove(states.len() - 1);
        options.spacing = state.pressure.grid.spacing();
        Ok((state, options))
    }

    /// Radii at which the slope of the body jumps, \[m].
    fn edges_of_body(&self) -> Vec<f64> {
        let body = self.problem.surface.as_axisymmetric();
        let kinks = body.map_or_else(Vec::new, |body| body.kinks());
        kinks.into_iter().map(|kink| kink.radius).collect()
    }

    /// Solves on a grid, or on a slightly finer one where the active set cycles.
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
        // Solve on the given grid, and on similar ones while the search does not end.
        let mut solution = solve_on(options.spacing);
        for factor in CYCLING_SPACING_FACTORS {
            let failed = matches!(
                solution,
                Err(BemError::ContactNotConverged { .. } | BemError::SingularContact { .. })
            );
            if !failed {
                break;
            }
            solution = solve_on(loading.scaled(options.spacing, factor));
        }
        solution
    }

    /// Tolerance of a contact that disturbs the friction by less than the requested error. It is proportional to the ratio of
    /// friction to mean slope, because a small friction is a difference of large slopes. The ratio is 1 at most, which is assumed
    /// on the first grid, and on an elastic material, whose depth is asked for.
    fn tolerance(&self) -> f64 {
        // The friction ratio is that of the last solution, which is on another grid.
        let last = self.reuse.solution.as_ref();
        let last = last.filter(|_| !self.problem.loading.creep.is_elastic());
        let friction_ratio = last.map_or(1.0, |last| {
            last.friction_coefficient.abs() / last.mean_slope
        });
        (RESIDUAL_SHARE * self.options.relative_error * friction_ratio).max(MIN_TOLERANCE)
    }
}
