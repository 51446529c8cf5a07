//! Refinement to a requested error.
//!
//! The boundary of the contact follows the elements. On one grid that scatters the friction around its trend. Each refinement therefore
//! averages over four grids, shifted by half an element along x and y, in plane strain by quarters along x. The averages converge with
//! the order 3/2 of the singular front edge, or 2p − 1 where the apex h ∼ r^p is slower. They are extrapolated. On any material but a
//! dashpot the contact is also closed at its rear, and the remaining scatter decides: it is added to the error estimate.
//!
//! Theory: docs/theory/stationary-half-space.md, "Scatter, order, error bar" and "Order and error bar".

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

/// Shifts of the grid along x and y, in elements, which keep the mirror symmetry in y. The first two and the last two are diagonal
/// pairs.
const BODY_PHASES: [[f64; 2]; 4] = [[0.0, 0.0], [0.5, 0.5], [0.5, 0.0], [0.0, 0.5]];
/// Shifts of the grid in plane strain, in elements. As a function of the shift the friction has a second harmonic, by which the means
/// over the first two and over the last two differ. The mean of all four eliminates it.
const STRIP_PHASES: [[f64; 2]; 4] = [[0.0, 0.0], [0.5, 0.0], [0.25, 0.0], [-0.25, 0.0]];
/// Number of last refinements in plane strain whose largest scatter counts; chosen. On one of them it may be small by chance, and the
/// extrapolated limit contains the scatter of all values that it eliminates.
const STRIP_SCATTER_WINDOW: usize = 4;
/// Convergence order at the singular front.
const FRONT_ORDER: f64 = 1.5;
/// Convergence order of the area of the elements in contact.
const AREA_ORDER: f64 = 1.0;
/// The friction from dissipation replaces that from slopes if its error is below this fraction of the other; chosen. The smaller of
/// two error estimates holds less often than either.
const MAX_DISSIPATION_ERROR_RATIO: f64 = 0.5;
/// Safety factor on the error of the friction on any material but a dashpot. There the whole contact boundary scatters, and the last
/// refinement has a scatter that is small by chance. Without it 95.8 of 100 error estimates hold on random solids and cylinders, with
/// it 98.6 (docs/calibration.md).
const SAFETY_FACTOR_CREEPING: f64 = 1.5;
/// Ratio of friction to mean slope below which the friction is a small difference of slopes, and higher orders are tried; chosen. A
/// larger friction reaches the requested error without them.
const SMALL_FRICTION_RATIO: f64 = 0.2;
/// Smallest number of refinements for an error estimate. An elimination uses two values, and the estimate needs three limits.
const MIN_REFINEMENTS: i32 = 5;
/// Largest number of footprint elements per allowed unknown pressure; chosen. A steep body touches with a thin crescent.
const ELEMENTS_PER_UNKNOWN: f64 = 50.0;
/// Number of footprint elements from which [`LARGE_GRID_ELEMENTS_PER_UNKNOWN`] is the limit; they take some GB.
const LARGE_GRID_ELEMENTS: f64 = 2e6;
/// Largest number of footprint elements per allowed unknown pressure on large grids; chosen.
const LARGE_GRID_ELEMENTS_PER_UNKNOWN: f64 = 12.5;
/// Number of footprint elements up to which a grid is never refused; chosen. Such grids cost next to nothing.
const MIN_GRID_LIMIT: f64 = 1e5;
/// Factors on the spacing that are tried in turn where the active set cycles; chosen. The spacing that is reported is that of the grid
/// that was solved.
const CYCLING_SPACING_FACTORS: [f64; 2] = [0.99, 0.98];
/// Tolerance of a contact over the requested relative error and the ratio of friction to mean slope; measured by `evidence tuning`.
const RESIDUAL_SHARE: f64 = 1e-4;
/// Like [`RESIDUAL_SHARE`], in plane strain; chosen. The constant potential of the whole strip, which is absorbed in the depth, leaves
/// more rounding error.
const STRIP_RESIDUAL_SHARE: f64 = 1e-2;
/// Smallest tolerance of a contact, relative to the depth scale, that rounding error permits.
const MIN_TOLERANCE: f64 = 1e-12;
/// Ratio of friction to mean slope that is assumed on the first grid, on any material but a dashpot; chosen.
const INITIAL_FRICTION_RATIO: f64 = 1e-3;
/// Error of the friction over the mean slope below which the friction of an elastic material counts as known, because the rest is
/// rounding error; chosen.
const ELASTIC_ROUNDING: f64 = 1e-9;

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
            aspect: 0.5,
            max_unknowns: 160_000,
        }
    }
}

/// A sliding surface, and the plan of its grids.
pub(super) struct SteadyProblem<'a> {
    pub(super) surface: &'a dyn Surface,
    pub(super) loading: Loading,
    pub(super) plan: &'a GridPlan,
    /// True if the peak pressure is known to be finite.
    pub(super) has_peak: bool,
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
    let relative_error = between_zero_and_one("relative_error", options.relative_error)?;
    positive("aspect", options.aspect)?;
    let mut grids = Grids {
        problem,
        options,
        order: order_of_friction(problem.plan.apex_exponent)?,
        reuse: Reuse::default(),
        progress: WorkProgress::new(problem.watch, refinement_work(0..MIN_REFINEMENTS)),
    };
    let is_elastic = problem.loading.creep.is_elastic();
    let rounding = if is_elastic {
        ELASTIC_ROUNDING
    } else {
        MIN_TOLERANCE
    };
    let (mut index, mut finest) = grids.coarsest(0)?;
    let mut refinements = vec![finest.averages];
    loop {
        // Choose the quantity that decides. Without friction the contact is known as well as its depth; finer grids would only
        // show rounding error.
        let friction = grids.friction(&refinements);
        let force = grids.force(&refinements);
        let friction_is_rounding = friction.error <= rounding * finest.state.mean_slope;
        let (quantity, known) = match grids.depth(&refinements) {
            Some(depth) if friction_is_rounding => (Name::Depth, depth),
            None if friction_is_rounding => (Name::Force, force),
            _ => (Name::Friction, friction),
        };

        // Stop when the error is reached, or when the next grid would exceed the limits.
        let is_reached = known.is_within(relative_error) && force.is_within(relative_error);
        if is_reached || !grids.may_refine(index + 1, &finest.averages) {
            let found = finish(grids.estimate(friction, force, refinements, finest))?;
            let (quantity, known) = match quantity {
                _ if !force.is_within(relative_error) => (Name::Force, force),
                // Friction was asked for, unless the material has none.
                _ if !is_elastic => (Name::Friction, friction),
                _ => (quantity, known),
            };
            if known.is_within(relative_error) {
                return Ok(found);
            }
            return Err(BemError::NotReached {
                quantity: quantity.in_words(),
                value: known.value,
                error: known.error,
                relative_error,
                reached: Box::new(found.into()),
            });
        }
        let excess = (known.error / known.value.abs()).max(force.error / force.value.abs());
        grids.predict_work(index, excess / relative_error, &finest.averages);

        // Refine. A patch that coarser grids do not resolve makes their values worthless.
        index += 1;
        match grids.refine(index) {
            Err(BemError::GridTooCoarse { .. }) => {
                (index, finest) = grids.coarsest(index + 1)?;
                refinements.clear();
            }
            refined => finest = refined?,
        }
        refinements.push(finest.averages);
    }
}

/// Convergence order of the averages.
///
/// # Errors
/// [`BemError::InvalidParameter`] for an apex exponent of at most 1/2, for which the friction of the apex alone is infinite, as in the
/// one-dimensional model.
fn order_of_friction(apex_exponent: f64) -> Result<f64, BemError> {
    let order = (2.0 * apex_exponent - 1.0).min(FRONT_ORDER);
    in_range("apex exponent", apex_exponent, order > 0.0, "above 1/2")?;
    Ok(order)
}

/// The averages of one refinement, and the last of its solutions with its grid.
struct SolvedRefinement {
    averages: Refinement,
    state: SteadySliding,
    options: SteadyOptions,
}

/// A problem on a sequence of refined grids.
struct Grids<'a> {
    problem: &'a SteadyProblem<'a>,
    options: &'a RefinementOptions,
    /// Convergence order of the averages.
    order: f64,
    reuse: Reuse,
    progress: WorkProgress<'a>,
}

/// Relative work of some refinements; each has twice as many elements as the one before.
fn refinement_work(refinements: Range<i32>) -> f64 {
    refinements.map(|index| f64::from(index).exp2()).sum()
}

impl Grids<'_> {
    /// Reports the work that remains until the error is smaller by the factor `excess`, if it falls with the order of the averages.
    fn predict_work(&mut self, index: i32, excess: f64, last: &Refinement) {
        // Refinements until the error is small enough, at most those that the limit of unknowns allows.
        let max_ahead = (self.options.max_unknowns / last.unknowns.max(1)).ilog2();
        let needed = 2.0 * excess.log2() / self.order;
        let ahead = (1..).find(|ahead| f64::from(*ahead) >= needed.min(f64::from(max_ahead)));
        let ahead = ahead.unwrap_or(1).max(MIN_REFINEMENTS - 1 - index);
        self.progress
            .set_remaining_work(refinement_work(index + 1..index + 1 + ahead));
    }

    /// Extrapolated limit of the averages of a quantity. The error contains the remaining scatter, and under a body with edges the
    /// change of the limit if the observed order is assumed.
    fn limit(
        &self,
        refinements: &[Refinement],
        order: f64,
        quantity: impl Fn(&Refinement) -> Average,
    ) -> Estimate {
        let values: Vec<f64> = refinements.iter().map(|r| quantity(r).value).collect();
        let last = refinements.last();
        let scatter = last.map_or(0.0, |last| quantity(last).scatter);
        let limit = extrapolate(&values, order).widened(scatter);
        if self.problem.loading.has_edges {
            let hides_edge = last.is_some_and(|last| last.hides_edge);
            let range = [OBSERVED_ORDERS, HIDDEN_EDGE_ORDERS][usize::from(hides_edge)];
            return limit.widened(change_at_observed_order(&values, order, range));
        }
        limit
    }

    /// Friction from the slopes, or from the dissipated power where its error is much smaller. The error contains the sub-grid friction.
    fn friction(&self, refinements: &[Refinement]) -> Estimate {
        let mut friction = self.friction_from_slopes(refinements);
        if !self.problem.loading.creep.only_flows() {
            let dissipated =
                self.extrapolate_friction(refinements, |r| r.friction_from_dissipation);
            // Under edges the slopes of the elements miss the dissipation at the edge.
            let has_edges = self.problem.loading.has_edges;
            if has_edges || dissipated.error < MAX_DISSIPATION_ERROR_RATIO * friction.error {
                friction = dissipated;
            }
            friction = Estimate::new(friction.value, SAFETY_FACTOR_CREEPING * friction.error);
        }
        // Friction within an element of the grid.
        let unresolved = refinements.last().map_or(0.0, |last| last.unresolved);
        friction.widened(unresolved * friction.value.abs())
    }

    /// Extrapolated limit of one of the two frictions. A small friction on any material but a dashpot may converge faster than front
    /// and apex allow on a dashpot. Higher orders are then tried for bodies of finite width without edges.
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
        let is_small = self.reuse.solution.as_ref().is_some_and(|last| {
            last.friction_coefficient.abs() < SMALL_FRICTION_RATIO * last.mean_slope
        });
        if !is_small || creep.only_flows() || strip.is_some() || *has_edges {
            return self.limit(refinements, self.order, friction);
        }
        let values: Vec<f64> = refinements.iter().map(|r| friction(r).value).collect();
        let last = refinements.last();
        let scatter = last.map_or(0.0, |last| friction(last).scatter);
        extrapolate_faster(&values, self.order).widened(scatter)
    }

    /// Friction from the slopes. On a dashpot its scatter is not added, because it falls as fast as the rest of the error.
    fn friction_from_slopes(&self, refinements: &[Refinement]) -> Estimate {
        let Loading { creep, strip, .. } = &self.problem.loading;
        // Number of last refinements whose scatter is added.
        let scatter_window = match strip {
            _ if creep.only_flows() => 0,
            Some(_) => STRIP_SCATTER_WINDOW,
            None => 1,
        };
        let without_scatter = |refinement: &Refinement| Average {
            scatter: 0.0,
            ..refinement.friction_coefficient
        };
        let friction = self.extrapolate_friction(refinements, without_scatter);
        let last = refinements.iter().rev().take(scatter_window);
        let scatter = last.map(|refinement| refinement.friction_coefficient.scatter);
        friction.widened(scatter.fold(0.0, f64::max))
    }

    /// The given normal force, or its limit at a given depth.
    fn force(&self, refinements: &[Refinement]) -> Estimate {
        let [given, _] = bars::given(self.problem.loading.control);
        given.unwrap_or_else(|| self.limit(refinements, self.order, |r| r.normal_force))
    }

    /// The given depth, or its limit under a given force. `None` in plane strain on a half space, where depth has no meaning.
    fn depth(&self, refinements: &[Refinement]) -> Option<Estimate> {
        let Loading { creep, strip, .. } = &self.problem.loading;
        let [_, given] = bars::given(self.problem.loading.control);
        let has_depth = strip.is_none() || creep.base().is_rigid();
        given.or_else(|| {
            has_depth.then(|| self.limit(refinements, self.order, |r| r.indentation_depth))
        })
    }

    /// All quantities with their errors.
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

    /// The first refinement from `index` on that resolves body and contact.
    ///
    /// # Errors
    /// [`BemError::GridTooLarge`] if too few of the refinements that follow are within the limits for an error estimate.
    fn coarsest(&mut self, mut index: i32) -> Result<(i32, SolvedRefinement), BemError> {
        loop {
            // All refinements that an error estimate needs must be within the limits.
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

    /// True if a refinement is within the limits, supposing that it has twice as many unknowns as the one before.
    fn may_refine(&self, refinement: i32, before: &Refinement) -> bool {
        let SteadyProblem { plan, watch, .. } = self.problem;
        refinement < MAX_REFINEMENTS
            && self.n_elements(refinement) <= self.max_elements()
            && 2 * before.unknowns <= self.options.max_unknowns
            && watch.may_refine(plan.elements(refinement))
    }

    /// Number of elements of the footprint.
    fn n_elements(&self, refinement: i32) -> f64 {
        let footprint = &self.problem.plan.footprint;
        footprint.n_elements(self.edges(refinement))
    }

    /// Edges [Δx, Δy] of an element, \[m].
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
        let on_large = LARGE_GRID_ELEMENTS.max(LARGE_GRID_ELEMENTS_PER_UNKNOWN * n_unknowns);
        (ELEMENTS_PER_UNKNOWN * n_unknowns).clamp(MIN_GRID_LIMIT, on_large)
    }

    /// Solves all shifted grids, each from the active set of the one before, and averages.
    fn refine(&mut self, index: i32) -> Result<SolvedRefinement, BemError> {
        // Solve the shifted grids.
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

        // Average. Forces and areas of a strip become those per unit length.
        let distance = self.problem.loading.sliding_distance;
        let per_length = self.problem.loading.strip.map_or(1.0, f64::recip);
        type Quantity<'q> = &'q dyn Fn(&SteadySliding) -> f64;
        let over_pairs = |of: Quantity| Average::over_interleaved_shifts(&states, of);
        let average = |of: Quantity| Average::over_shifts(&states, of);
        let spacings = states.iter().map(|state| state.pressure.grid.spacing()[0]);
        let creep = &self.problem.loading.creep;
        let kinks = self.problem.plan.kinks;
        let unresolved = states
            .iter()
            .map(|one| one.subgrid_friction_fraction(creep, kinks));
        let edges = self.edges_of_body();
        let averages = Refinement {
            hides_edge: states.iter().any(|state| state.hides_edge(&edges)),
            spacing: spacings.sum::<f64>() / states.len() as f64,
            friction_coefficient: over_pairs(&|one| one.friction_coefficient),
            friction_from_dissipation: over_pairs(&|one| one.friction_from_dissipation),
            unresolved: unresolved.fold(0.0, f64::max),
            normal_force: average(&|state| state.normal_force).times(per_length),
            indentation_depth: average(&|state| state.depth.at_distance(distance)),
            contact_area: average(&|state| state.contact_area).times(per_length),
            peak_pressure: average(&|state| state.pressure.largest()),
            unknowns: states.iter().map(|state| state.unknowns).max().unwrap_or(0),
        };
        // Keep the last state, with the spacing that was solved.
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

    /// Tolerance of a contact that disturbs the friction by less than the requested error. It is proportional to the ratio of friction to
    /// mean slope, because a small friction is a difference of large slopes.
    fn tolerance(&self) -> f64 {
        let friction_ratio = match &self.reuse.solution {
            Some(last) => last.friction_coefficient.abs() / last.mean_slope,
            None if self.problem.loading.creep.only_flows() => 1.0,
            None => INITIAL_FRICTION_RATIO,
        };
        let share = match self.problem.loading.strip {
            Some(_) => STRIP_RESIDUAL_SHARE,
            None => RESIDUAL_SHARE,
        };
        (share * self.options.relative_error * friction_ratio).max(MIN_TOLERANCE)
    }
}
